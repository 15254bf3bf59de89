/* A straight-line program laid out for the precompiled kernel of its Taylor series: operations of
 * one kind that do not wait for each other stand side by side. */
#ifndef CASIMIR_PROGRAM_TABLES_H
#define CASIMIR_PROGRAM_TABLES_H

/* What a group of operations does. The functions of a later kind have series to keep. */
enum casimir_group_kind {
  CASIMIR_GROUP_ADD,
  CASIMIR_GROUP_SUB,
  CASIMIR_GROUP_NEG,
  CASIMIR_GROUP_SCALE,  /* a times a constant */
  CASIMIR_GROUP_SHRINK, /* a divided by a constant */
  CASIMIR_GROUP_MUL,
  CASIMIR_GROUP_DIV,
  CASIMIR_GROUP_SQRT,
  CASIMIR_GROUP_POW, /* a to a constant power */
  CASIMIR_GROUP_EXP,
  CASIMIR_GROUP_LOG,
  CASIMIR_GROUP_SINCOS /* both, of the same argument */
};

/* Operation i takes the numbers in the places a[i] and b[i], and its result goes to the place
 * target + i; a cosine to target + padded + i. Beyond `count` there is room up to `padded`, whole
 * registers. */
struct casimir_group {
  int kind, count, padded, target;
  const int *a, *b;       /* b: of two operands */
  const double* constant; /* of scale, shrink, pow */
  /* The series that the recurrence needs, up to four: series h has its coefficient k of all
   * operations at history[(h * rows + k) * padded]. */
  double* history;
};

struct casimir_program {
  int states, parameters, order, rows;
  int stride; /* numbers in a row of coefficients of the states */
  int groups;
  const struct casimir_group* group;
  const int* output; /* places of the rates */
  int time;          /* the place of the time */
  int constants;     /* how many constants are places, from first_constant on */
  int first_constant;
  const double* constant;
  double* place; /* coefficient k of everything, for one k at a time; the states first */
};

#endif
