/* A system of differential equations that are polynomials of degree two, laid out for registers of
 * a width that is less than the number of states: the states fill several registers. Plain data
 * between the layout and the precompiled kernels (wide.hpp). A "register" of numbers or indices is
 * `width` of them; arrays of registers are aligned like registers. */
#ifndef CASIMIR_WIDE_TABLES_H
#define CASIMIR_WIDE_TABLES_H

enum { CASIMIR_WIDE_STATES = 24, CASIMIR_WIDE_PRODUCTS = 320 };

struct casimir_wide {
  int states, width;
  int blocks;    /* registers of states */
  int registers; /* of products */
  int linear;    /* whether there are linear terms */

  /* Product i of register m is x[left[m * width + i]] * x[right[m * width + i]]. */
  const long long *left, *right;

  /* dx/dt is a sum over sources: the registers of products and, behind them, those of the states.
   * Register b of the rates is constant[b], and for e = own_begin[b] .. own_begin[b+1] - 1 the
   * lanes of source own_source[e] times own_factor[e], and for e = moved_begin[b] .. the numbers
   * moved_from[e] of the sources, counted through all of them, times moved_factor[e]. The second
   * kind is for what stands in another lane than it is needed in. The counts of both are even. */
  const double* constant;
  const int *own_begin, *own_source;
  const double* own_factor;
  const int* moved_begin;
  const long long* moved_from;
  const double* moved_factor;

  /* Where a register is moved by one instruction (8 lanes): all lanes of moved_from[e] are in
   * source moved_source[e]. */
  const int* moved_source;
};

#endif
