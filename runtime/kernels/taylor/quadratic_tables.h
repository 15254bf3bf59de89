/* A system of differential equations that are polynomials of degree two, laid out for SIMD
 * registers: each product of two states has a lane of its own. Plain data, so that generated code
 * and precompiled kernels share it; the kernels are in quadratic.hpp. */
#ifndef CASIMIR_QUADRATIC_TABLES_H
#define CASIMIR_QUADRATIC_TABLES_H

enum {
  CASIMIR_LANES = 8,
  CASIMIR_MOST_PRODUCTS = 5,
  CASIMIR_MOST_DIAGONALS = 8,
  CASIMIR_MOST_PARTS = 8
};

/* Lane i is factor[i] times lane from[i] of a register. */
struct casimir_move {
  long long from[CASIMIR_LANES];
  double factor[CASIMIR_LANES];
};

struct casimir_quadratic {
  int states;
  int products; /* registers of products: product i of register m is x[left[m][i]] * x[right[m][i]]
                 */
  long long left[CASIMIR_MOST_PRODUCTS][CASIMIR_LANES], right[CASIMIR_MOST_PRODUCTS][CASIMIR_LANES];

  /* dx/dt = constant + linear terms + products: those of register m that stand in the lane where
   * they are needed, with the factor own[m], and others, moved there. */
  double constant[CASIMIR_LANES];
  double own[CASIMIR_MOST_PRODUCTS][CASIMIR_LANES];
  int moves[CASIMIR_MOST_PRODUCTS];
  struct casimir_move move[CASIMIR_MOST_PRODUCTS][CASIMIR_LANES];

  /* The derivative of dx/dt in the direction v is the sum over d of diagonal[d] * (v moved by
   * column[d]), and diagonal[d] is fixed[d] plus moved states: the Jacobian, of which every
   * diagonal takes one entry from each row. The columns carry no factor. */
  int diagonals; /* even; the last may be zero */
  long long column[CASIMIR_MOST_DIAGONALS][CASIMIR_LANES];
  double fixed[CASIMIR_MOST_DIAGONALS][CASIMIR_LANES];
  int parts[CASIMIR_MOST_DIAGONALS];
  struct casimir_move part[CASIMIR_MOST_DIAGONALS][CASIMIR_MOST_PARTS];
};

#endif
