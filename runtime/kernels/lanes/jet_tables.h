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
  CASIMIR_JET_POW, /* a ^ value */
  CASIMIR_JET_SQRT,
  CASIMIR_JET_SIN,
  CASIMIR_JET_COS,
  CASIMIR_JET_TAN,
  CASIMIR_JET_EXP,
  CASIMIR_JET_LOG,
  CASIMIR_JET_ASIN,
  CASIMIR_JET_ACOS,
  CASIMIR_JET_ATAN2 /* atan2(a, b) */
};

struct casimir_jet_line {
  int op;   /* enum casimir_jet_op */
  int a, b; /* earlier lines; -1 where there is none */
  int row;  /* the first of the line's rows: its series, then those of its recurrence */
  double value;
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
