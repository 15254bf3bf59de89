/* A system of differential equations that are polynomials of degree two, laid out for ensembles:
 * one trajectory in each lane of a register. Plain data, so that whoever makes it needs no kernel;
 * the kernel is in lane_quadratic.hpp. */
#ifndef CASIMIR_LANE_TABLES_H
#define CASIMIR_LANE_TABLES_H

enum { CASIMIR_MOST_LANE_STATES = 24 };

/* The product of two rows. Row i is state i; row states + c is copy c: a state times a number. */
struct casimir_lane_product {
  int left, right;
};

/* The structure is common to all members of an ensemble. The numbers in it belong to a member and
 * stand in one array: the factors of the copies, of the shared sums, of the linear terms, and one
 * constant for each state, in this order.
 *
 * Sum g < states holds the products that only rate g has, whose factors are 1, -1, or in a copy;
 * the others hold products that several rates share. Those of sum g are product[first[g]] ..
 * product[first[g + 1] - 1], and from negative[g] on they are subtracted. */
struct casimir_lane_tables {
  int states, copies, sums;
  const int* copied;   /* the state of each copy */
  const int* first;    /* sums + 1 entries */
  const int* negative; /* sums entries */
  const struct casimir_lane_product* product;
  const int* shared;       /* states + 1: rate i has the shared sums number shared[i] .. */
  const int* shared_sum;   /* .. and this is the sum that each of them takes */
  const int* linear;       /* states + 1: rate i has the linear terms number linear[i] .. */
  const int* linear_state; /* .. and this is the state of each */
};

#endif
