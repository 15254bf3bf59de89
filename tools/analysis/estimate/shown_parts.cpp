#include "tools/analysis/estimate/shown_parts.hpp"

#include <algorithm>

#include "codegen/optimise/optimise.hpp"
#include "symbolic/error.hpp"

namespace casimir {
namespace {

using codegen::NodeId;
using codegen::NodeKind;
using codegen::Scaled;
using GiNaC::ex;

bool is_negative(const cln::cl_RA& r) { return cln::minusp(r); }

/// Whether a program is computed without a single operation that may have no value.
bool has_values_everywhere(const Program& program) {
  return std::ranges::none_of(program.code, [](const Instruction& line) {
    return line.op == Op::div || line.op == Op::pow || line.op == Op::sqrt || line.op == Op::log ||
           line.op == Op::asin || line.op == Op::acos || line.op == Op::atan2 ||
           line.op == Op::tan || line.op == Op::sign;
  });
}

bool is_call(const ex& part, const char* name) {
  return GiNaC::is_a<GiNaC::function>(part) &&
         GiNaC::ex_to<GiNaC::function>(part).get_name() == name;
}

}  // namespace

ShownParts::ShownParts(const std::vector<ex>& fields, const std::vector<GiNaC::symbol>& inputs)
    : dag_(inputs, inputs.size()) {
  std::vector<Scaled> outputs;
  std::vector<std::string> names, labels;
  for (const ex& field : fields) {
    outputs.push_back(dag_.convert(field));
    labels.push_back("f" + std::to_string(labels.size()));
  }
  for (const GiNaC::symbol& input : inputs) names.push_back(input.get_name());
  // What is expanded may cancel as well.
  if (has_values_everywhere(codegen::optimised(dag_, outputs, names, labels))) return;
  for (const Scaled& output : outputs) collect(output.node);
}

void ShownParts::collect(NodeId id) {
  if (!seen_.insert(id).second) return;
  const codegen::Node node = dag_[id];
  for (const Scaled& term : node.terms) collect(term.node);
  for (const codegen::Factor& factor : node.factors) {
    powers_[factor.node].push_back(factor.exponent);
    collect(factor.node);
  }
}

/// A pole is shown by any pole of the same, a root by any root of it.
bool ShownParts::shows_factor(NodeId id, const cln::cl_RA& exponent) const {
  const bool is_whole = codegen::is_integer(exponent);
  const auto fits = [&](const cln::cl_RA& other) {
    return (!cln::minusp(exponent) || cln::minusp(other)) &&
           (is_whole || !codegen::is_integer(other));
  };
  if (is_whole && cln::plusp(exponent)) {
    const NodeKind kind = dag_[id].kind;
    return kind != NodeKind::function || seen_.contains(id);
  }
  const auto found = powers_.find(id);
  return found != powers_.end() && std::ranges::any_of(found->second, fits);
}

bool ShownParts::shows(const ex& part) {
  const codegen::Scaled own = dag_.convert(part);
  const codegen::Node node = dag_[own.node];
  if (node.kind == NodeKind::product)
    return std::ranges::all_of(node.factors, [&](const codegen::Factor& factor) {
      return shows_factor(factor.node, factor.exponent);
    });
  return shows_factor(own.node, 1);
}

/// Whether the fields have a pole, or a root in a divisor, where an expression vanishes; of a
/// product where each factor does.
bool ShownParts::has_pole_at_zero_of(const ex& base) {
  const auto has = [&](const codegen::Factor& factor) {
    const auto found = powers_.find(factor.node);
    return found != powers_.end() && std::ranges::any_of(found->second, is_negative);
  };
  // The radicand of a root has a sign of its own.
  for (const ex& exponent : {ex(-1), ex(-1) / 2}) {
    try {
      const codegen::Node node = dag_[dag_.convert(GiNaC::pow(base, exponent)).node];
      if (node.kind == NodeKind::product && std::ranges::all_of(node.factors, has)) return true;
    } catch (const ModelError&) {  // a root that is real nowhere
    }
  }
  return false;
}

bool ShownParts::keeps(const ex& part) {
  if (is_call(part, "log")) return has_pole_at_zero_of(part.op(0));
  if (is_call(part, "asin") || is_call(part, "acos"))
    return has_pole_at_zero_of(1 - GiNaC::pow(part.op(0), 2));
  if (is_call(part, "atan2"))
    return has_pole_at_zero_of(GiNaC::pow(part.op(0), 2) + GiNaC::pow(part.op(1), 2)) ||
           has_pole_at_zero_of(part.op(1));
  // A root is real as long as its radicand does not come to zero.
  return GiNaC::is_a<GiNaC::power>(part) && part.op(1).info(GiNaC::info_flags::rational) &&
         has_pole_at_zero_of(part.op(0));
}

}  // namespace casimir
