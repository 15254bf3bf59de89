#include "codegen/real_constants.hpp"

#include <unordered_map>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/principal_values.hpp"

namespace casimir::codegen {
namespace {

using GiNaC::ex;

class ConstantParts {
 public:
  ConstantParts(const Model& model, const Scene& binding) : model_(model), binding_(binding) {}

  /// Whether no variable occurs in an expression. Each part is looked at once.
  bool look(const ex& e) {
    if (GiNaC::is_a<GiNaC::symbol>(e)) return is_parameter(e);
    if (e.nops() == 0) return true;
    if (const auto known = known_.find(e); known != known_.end()) return known->second;
    bool constant = true;
    for (std::size_t i = 0; i < e.nops(); ++i) constant = look(e.op(i)) && constant;
    if (constant && may_be_complex(e)) check(e);
    known_.emplace(e, constant);
    return constant;
  }

 private:
  bool is_parameter(const ex& symbol) const {
    for (const GiNaC::symbol& parameter : model_.parameters)
      if (symbol.is_equal(parameter)) return true;
    return false;
  }
  static bool may_be_complex(const ex& e) {
    return GiNaC::is_a<GiNaC::function>(e) ||
           (GiNaC::is_a<GiNaC::power>(e) && !e.op(1).info(GiNaC::info_flags::integer));
  }
  void check(const ex& e) const {
    if (is_no_real_constant(model_.at_parameters(e, binding_), model_.limits.bits))
      throw ModelError("'" + printable(expression_text(e), 80) + "' is not a real number");
  }

  const Model& model_;
  const Scene& binding_;
  std::unordered_map<ex, bool> known_;
};

}  // namespace

void require_real_constants(const Model& model, const ex& expression, const Scene& binding) {
  ConstantParts(model, binding).look(expression);
}

}  // namespace casimir::codegen
