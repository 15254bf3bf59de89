/* The plain C interface between a generated module and the program that loads it. Generated code
 * contains this text and includes nothing. A change of meaning here raises CASIMIR_ABI_VERSION. */
#ifndef CASIMIR_MODULE_ABI_H
#define CASIMIR_MODULE_ABI_H

#define CASIMIR_ABI_VERSION 7

/* How many matrices a kernel may have factorised at a time. */
#define CASIMIR_MATRICES 7

/* How a run ended. */
enum casimir_status {
  CASIMIR_OK = 0,             /* the end of the interval was reached */
  CASIMIR_NON_FINITE = 1,     /* the state or its derivative is not a finite number */
  CASIMIR_STEP_UNDERFLOW = 2, /* the step that the tolerance asks for is lost in rounding */
  CASIMIR_SINGULARITY = 3, /* the solution runs into a pole of the right-hand side or to infinity */
  CASIMIR_MAX_STEPS = 4,   /* the limit on the number of steps was reached */
  CASIMIR_NO_CONVERGENCE = 5, /* an implicit step could not be solved at any step size tried */
  CASIMIR_STOPPED = 6         /* the observer asked for the end */
};

/* An accepted step, as an observer sees it. All pointers are valid during the call only. */
struct casimir_step {
  double t0, t1;
  const double* x0; /* n entries */
  const double* x1; /* n entries */
  /* Dense output: the state at a time between t0 and t1, n entries. */
  void (*dense)(const struct casimir_step* step, double t, double* x);
  const void* data; /* the kernel's own */
  /* dx/dt at both ends, n entries each, or null. */
  const double *f0, *f1;
};

/* How many terms of a Taylor series `casimir_leading` works out. */
enum { CASIMIR_LEADING = 2 };

/* The leading terms of a step along the series of the solution in twice the digits: for runs so
 * long that rounding errors of single steps add up. x + carry becomes x + carry + c[1] s + .. +
 * c[CASIMIR_LEADING] s^CASIMIR_LEADING + tail s^(CASIMIR_LEADING + 1), where x(t + s unit) is the
 * sum of c[k] s^k from x + carry. All arrays are filled up with zeros as registers are. */
struct casimir_leading {
  const void* object;
  /* The steps that a run has to be expected to take for this to be worth its time; 0: always. */
  unsigned long long from;
  void (*add)(const void* object, double t, double unit, double s, double* x, double* carry,
              const double* tail);
};

/* What a caller asks of an integration. */
struct casimir_run {
  double t_begin, t_end;
  const double* parameters; /* the run-time parameters, or null if there are none */
  double rtol, atol;        /* local error per component: atol + rtol * |x_i| */
  double fixed_step;        /* > 0: constant step of about this size (it divides the interval) */
  double first_step;        /* 0: the kernel chooses */
  unsigned long long max_steps; /* accepted and rejected; 0: no limit */
  /* Called after each accepted step unless null; a non-zero answer stops the run. */
  int (*observe)(void* observer, const struct casimir_step* step);
  void* observer;
  /* Dense linear algebra for implicit kernels, for several matrices at a time, `which` of them
   * from 0 to CASIMIR_MATRICES - 1. factor: n*n entries by columns, 0 if regular. solve:
   * overwrites n entries of b by the solution. */
  int (*factor)(void* solver, int which, int n, const double* matrix);
  void (*solve)(void* solver, int which, double* b);
  void* solver;
  /* Null, or what makes a step of the Taylor method more exact. */
  const struct casimir_leading* leading;
  /* Null, or what puts the state x + carry at the end of a step back onto the level of invariants,
   * before it is accepted. n entries each. */
  void (*project)(void* projector, double t, double* x, double* carry);
  void* projector;
  /* Null, or what looks at a step before it is accepted, where a step alone may not see what lies
   * within it. Returns 1 where it may be taken, 2 where it may and the right-hand side jumps at its
   * end, or how much of it may be tried instead, in (0, 1).
   * With a constant step it is not asked. */
  double (*look)(void* looker, const struct casimir_step* trial);
  void* looker;
};

/* What came of it. The state array given to `integrate` then holds the state at `t`. */
struct casimir_outcome {
  int status; /* enum casimir_status */
  double t;
  unsigned long long steps, rejected, evaluations, jacobians;
};

/* A step of members that stand in the lanes of registers, before their states are replaced. The
 * state i of the member in lane l is the sum of rows[i][k * lanes + l] s^k at the time t[l] + s
 * unit[l], from s = 0 up to taken[l]. All pointers are valid during the call only. */
struct casimir_lane_step {
  int lanes, states, order;
  const double* const* rows; /* for each state, order + 1 registers */
  const double *t, *unit, *taken;
  const long long* member; /* in each lane; negative: none */
  const long long* held;   /* non-zero in the lanes whose members take the step */
  long long* finished;     /* zero; what is set ends the member in that lane as stopped. Null where
                            * the step is not accepted yet */
};

/* What one thread asks of a kernel that advances many trajectories, one in each lane of a register.
 * Which trajectories stand beside each other makes no difference to any of them. */
struct casimir_ensemble {
  double t_begin, t_end;
  double rtol, atol;            /* as above, for every member */
  unsigned long long max_steps; /* of each member; 0: no limit */
  int order;                    /* of the Taylor series, a multiple of 4; 0: the kernel chooses */
  /* The next member: writes its n states, and points `numbers` at its parameters, or at what the
   * kernel's tables say, until the next call. Negative: there is none left. */
  long long (*next)(void* source, double* x, const double** numbers);
  /* A member has ended in the state x, as `outcome` says. */
  void (*done)(void* source, long long member, const double* x,
               const struct casimir_outcome* outcome);
  /* Asked after each step: non-zero ends all members as stopped. May be null. */
  int (*give_up)(void* source);
  void* source;
  /* Shown every accepted step, of any lane. May be null. */
  void (*observe)(void* source, const struct casimir_lane_step* step);
  /* Null, or what looks at a step before it is accepted: writes what casimir_run::look returns for
   * each lane that is to take it, and leaves the others. */
  void (*look)(void* source, const struct casimir_lane_step* trial, double* parts);
};

/* A module exports, with C linkage:
 *   int  casimir_abi_version(void);
 *   int  casimir_dimension(void);        number of states n
 *   int  casimir_parameter_count(void);  number of run-time parameters
 *   int  casimir_invariant_count(void);
 *   void casimir_rhs(double t, const double* x, const double* p, double* dx);
 *   void casimir_jacobian(double t, const double* x, const double* p, double* J);  n*n by columns
 *   void casimir_invariants(double t, const double* x, const double* p, double* values);
 *   void casimir_integrate(const struct casimir_run*, double* x, struct casimir_outcome*);
 *   int  casimir_lanes(void);            trajectories in a register
 *   void casimir_integrate_lanes(const struct casimir_ensemble*);
 * `casimir_jacobian` is present only where it was asked for, `casimir_integrate` only with a
 * kernel that is compiled for the system. For the method of Taylor series there are instead
 *   unsigned long casimir_series_size(void);  bytes of a series, which is aligned to 64 bytes and
 *                                             begins with the rows of kernels/series.h
 *   int casimir_series_width(void);           numbers in the registers that rows are made of
 *   int casimir_series_smooth(void);
 * and the functions casimir_series_start, _begin and _expand of kernels/series.h, whose object is
 * the series. A kernel for ensembles exports casimir_lanes and casimir_integrate_lanes.
 *
 * Both kinds of kernels may export beside these
 *   int  casimir_watched_count(void);
 *   void casimir_watched(double t, const double* x, const double* p, double* values);
 * what the steps are watched for: the outputs of StepWatch::arguments of the right-hand side.
 */

#endif
