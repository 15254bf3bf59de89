/* The Taylor coefficients of a solution, as the precompiled integrator asks for them. */
#ifndef CASIMIR_SERIES_H
#define CASIMIR_SERIES_H

enum { CASIMIR_SERIES_ORDER = 24, CASIMIR_SERIES_STATES = 4096 };

struct casimir_series {
  int states;
  int smooth;    /* the right-hand side is a polynomial of low degree, without the time */
  int direct;    /* `expand` needs no `begin` before it: it reads its state from the row of s^0 */
  int registers; /* of products, or 0 where that is not known */
  void* object;
  /* Aligned like registers. Rows of as many registers as the states fill, the rest zero: first
   * dx/dt, then the coefficients of s^0 .. s^order in x(t + s unit). */
  double* rows;
  void (*start)(void* object, int order, const double* parameters);
  void (*begin)(void* object, double t, const double* x); /* dx/dt at a state, which is a row */
  /* All coefficients from the one of s^0, which is the state of the last `begin` if there was one.
   */
  void (*expand)(void* object, double unit);
};

#endif
