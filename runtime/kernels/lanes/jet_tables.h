/* A function of the states as a list of instructions, laid out for the kernel that works out its
 * Taylor series along steps of trajectories, one in each lane of a register. Plain data; the kernel
 * is in lane_jet.hpp. */
#ifndef CASIMIR_JET_TABLES_H
#define CASIMIR_JET_TABLES_H

enum casimir_jet_op {
  CASIMIR_JET_STATE,    /* state a */
  CASIMIR_JET_CONSTANT, /* `value` */
  CASIMIR_JET_ADD,
  CASIMIR_JET_SUB,
  CASIMIR_JET_MUL,
  CASIMIR_JET_DIV,
  CASIMIR_JET_NEG,
  CASIMIR_JET_POW,     /* a ^ value */
  CASIMIR_JET_ATAN2,   /* atan2(a, b); its recurrence has one row more */
  CASIMIR_JET_FUNCTION /* by its recurrence */
};

/* The rules of recurrences, for coefficient k > 0 of a row y from those of the rows a and f and the
 * sign s. */
enum casimir_jet_rule {
  CASIMIR_JET_INTEGRAL, /* y' = s f a' */
  CASIMIR_JET_QUOTIENT, /* f y' = s a' */
  CASIMIR_JET_ROOT,     /* y y = a */
  CASIMIR_JET_SQUARES   /* y = 1 + s a a */
};

/* A line of a recurrence. The first coefficient of the row is that of a function of the argument,
 * or where that is null follows from those of the row `of`: 1 + s a a, or the root. */
struct casimir_jet_step {
  int rule;      /* enum casimir_jet_rule */
  int row, a, f; /* rows */
  double sign;
  double (*first)(double);
};

enum { CASIMIR_MOST_JET_STEPS = 3 };

struct casimir_jet_line {
  int op;   /* enum casimir_jet_op */
  int a, b; /* earlier lines; -1 where there is none */
  int row;  /* the first of the line's rows: its series, then those of its recurrence */
  double value;
  int steps; /* of a function */
  struct casimir_jet_step step[CASIMIR_MOST_JET_STEPS];
};

enum { CASIMIR_MOST_JET_ORDER = 24 };

/* The last line is the function. A row has CASIMIR_MOST_JET_ORDER + 1 registers. */
struct casimir_jet_tables {
  int lines, rows;
  const struct casimir_jet_line* line;
};

/* What a step does to the function, for each lane. */
struct casimir_jet_range {
  double first[8], last[8];    /* its values at both ends */
  double least[8], largest[8]; /* bounds for those between */
  double tail[8];              /* the last two terms of the series, beside all of them */
};

struct casimir_lane_step;

/* Of one instruction set. `memory` has tables->rows rows and is aligned to a register; what is left
 * in it is what casimir_jet_bernstein wants. */
typedef void casimir_jet_kernel(const struct casimir_jet_tables* tables,
                                const struct casimir_lane_step* step, double* memory,
                                struct casimir_jet_range* range);

#endif
