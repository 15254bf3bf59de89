/* The right-hand side of a quadratic system, every factor in twice the digits, laid out for
 * registers of any width: what leading_kernel.cpp reads. Plain data. */
#ifndef CASIMIR_LEADING_TABLES_H
#define CASIMIR_LEADING_TABLES_H

enum { CASIMIR_LEADING_STATES = 24 };

/* Rate i of register b, in lane i of the rows: constant + the sums over its linear terms, for
 * e = linear_begin[b] .. linear_begin[b+1] - 1, and over its products in the same way. A row is
 * `width` numbers; factors are two rows, the number and what its rounding lost. The factor of a
 * lane without such a term is 0. */
struct casimir_leading_tables {
  int states, width, blocks;
  const double* constant; /* two rows for each register */
  const int *linear_begin, *product_begin;
  const double *linear_factor, *product_factor;
  const long long* linear_state;                 /* a row for each entry */
  const long long *product_left, *product_right; /* the same */
};

#endif
