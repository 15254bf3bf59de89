// Any bytes as an expression, a condition and an equation over a case.
#include <cstddef>
#include <cstdint>
#include <string>

#include "symbolic/expression/expression.hpp"
#include "symbolic/model.hpp"
#include "symbolic/model/model_dynamics.hpp"
#include "tests/fuzz/target.hpp"

namespace {

using namespace casimir;

/// What an expression of a case may use: symbols, a definition, the bracket of e(3) and its flow.
class Names : public NameTable {
 public:
  Names() : NameTable(test::small_limits()), dynamics_(model()) {
    for (const GiNaC::symbol& s : model().variables) add(s.get_name(), Quantity::symbol(s));
    for (const GiNaC::symbol& s : model().parameters) add(s.get_name(), Quantity::symbol(s));
    add("u", {model().definitions[0].value, 8, 4, 8});
  }
  const Dynamics* dynamics() override { return &dynamics_; }

 private:
  static const Model& model() {
    static const Model result = build_model(parse_case(R"toml(
hamiltonian = "(M1^2 + M2^2 + 2*M3^2)/2 - r*x"
[phase_space]
variables = ["M1", "M2", "M3", "x", "y", "z"]
algebra = "e(3)"
[parameters]
r = {}
[definitions]
u = "sqrt(x^2 + y^2)"
)toml",
                                                       "fuzz.toml", test::small_limits()));
    return result;
  }

  ModelDynamics dynamics_;
};

/// Whether the text was read.
template <class Read>
bool attempt(Read read) {
  try {
    read();
    return true;
  } catch (const CaseError&) {
  } catch (const ModelError&) {
  }
  return false;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const test::OneSecond limit;
  static Names names;
  const std::string value(reinterpret_cast<const char*>(data), size);
  const Text text{value, {"fuzz", 1, 1}, value};
  const bool read = attempt([&] { parse_equation(text, names); });
  if (!read && value.find_first_of("!<>") != std::string::npos)
    attempt([&] { parse_condition(text, names); });
  if (read) attempt([&] { parse_real_constant(text, names.limits()); });
  return 0;
}
