/* A system of differential equations that are polynomials of degree two, laid out for registers of
 * any width: the states fill `blocks` of them. Plain data between the layout and the precompiled
 * kernels (wide.hpp). A "register" of numbers or indices is `width` of them; arrays of registers
 * are aligned like registers. */
#ifndef CASIMIR_WIDE_TABLES_H
#define CASIMIR_WIDE_TABLES_H

enum {
  CASIMIR_WIDE_STATES = 24,
  CASIMIR_WIDE_PRODUCTS = 320,
  CASIMIR_WIDE_FEW = 4,
  CASIMIR_WIDE_BLOCKS = 3
};

struct casimir_wide {
  int states, width;
  int blocks;    /* registers of states: two or more if each holds four or eight, since what fits
                    one of them has a kernel of its own (quadratic.hpp) */
  int registers; /* of products */

  /* Product i of register m is that of the states left[m * width + i] and right[m * width + i].
   * Indices of states are in the form of `gathered` (lanes.hpp). */
  const long long *left, *right;

  /* Register b of dx/dt is constant[b], the linear terms, for e = linear_begin[b] ..
   * linear_begin[b+1] - 1 the states linear_state[e] times linear_factor[e], and the products: for
   * e = own_begin[b] .. those of register own_from[e] times own_factor[e], each in its lane, and
   * for e = moved_begin[b] .. others, times moved_factor[e], which stand in another lane than they
   * are needed in: those in the lanes moved_lane[e] of register moved_from[e], or with two lanes
   * in a register the products moved_lane[e] counted through all registers. The counts of own and
   * moved ones are even.
   * Where there are few registers (CASIMIR_WIDE_FEW of products, CASIMIR_WIDE_BLOCKS of states),
   * the products in their own lanes are not in the list: the factors of register m in register b
   * of dx/dt are dense[m * blocks + b]. */
  const double *constant, *dense;
  const int* linear_begin;
  const long long* linear_state;
  const double* linear_factor;
  const int *own_begin, *own_from;
  const double* own_factor;
  const int *moved_begin, *moved_from;
  const long long* moved_lane; /* in the form of `permuted_by` (lanes.hpp) */
  const double* moved_factor;
};

#endif
