#pragma once

#include <vector>

#include "symbolic/structure/relate/linear_case.hpp"

namespace casimir::structure {

/// An element of an algebra: its coordinates.
using Element = std::vector<cln::cl_RA>;

/// What an isomorphism keeps of the elements of one algebra.
class ElementSide {
 public:
  explicit ElementSide(const LinearCase& c);

  const StructureConstants& constants() const { return constants_; }
  /// Those of `characteristic_subspaces`, in that order.
  const std::vector<RationalMatrix>& subspaces() const { return subspaces_; }

  /// Traces and ranks of the powers of ad v, and which of the subspaces contain v: every
  /// isomorphism takes v to an element for which these numbers are the same.
  Element fingerprint(const Element& v) const;

 private:
  StructureConstants constants_;
  std::vector<RationalMatrix> subspaces_;
};

/// Orders of numbers and of elements, for tables.
struct NumberLess {
  bool operator()(const cln::cl_RA& a, const cln::cl_RA& b) const { return a < b; }
};
struct ElementLess {
  bool operator()(const Element& a, const Element& b) const;
};

/// The value of a quadratic form, given by a symmetric matrix.
cln::cl_RA value_of(const RationalMatrix& form, const Element& v);

/// All with whole coordinates up to `height` but zero, the smallest first.
std::vector<Element> small_elements(std::size_t n, int height);

}  // namespace casimir::structure
