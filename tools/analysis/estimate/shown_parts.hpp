#pragma once

#include <ginac/ginac.h>

#include <map>
#include <set>
#include <vector>

#include "codegen/dag/expression_dag.hpp"

namespace casimir {

/// What equations show, as they are computed: where a function, a root or a quotient in them has no
/// value, a run notices by itself. A sum such as (q^2)^(-1/2) - q^2 (q^2)^(-3/2) shows nothing,
/// since it is computed as zero.
class ShownParts {
 public:
  /// \param inputs  all symbols of the fields and of the parts that are asked for.
  ShownParts(const std::vector<GiNaC::ex>& fields, const std::vector<GiNaC::symbol>& inputs);

  /// Whether the fields have no value where a function or a power has none.
  bool shows(const GiNaC::ex& part);

  /// Whether along a solution that begins where a part has a value it keeps one as long as the
  /// fields have theirs: log(q) beside 1/q, asin(u) beside a root of 1 - u^2.
  bool keeps(const GiNaC::ex& part);

 private:
  void collect(codegen::NodeId node);
  bool has_pole_at_zero_of(const GiNaC::ex& base);
  bool shows_factor(codegen::NodeId node, const cln::cl_RA& exponent) const;

  codegen::Dag dag_;
  std::set<codegen::NodeId> seen_;
  std::map<codegen::NodeId, std::vector<cln::cl_RA>> powers_;  ///< exponents, but for 1
};

}  // namespace casimir
