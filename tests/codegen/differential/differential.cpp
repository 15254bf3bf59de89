#include "tests/codegen/differential/differential.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <stdexcept>

#include "symbolic/error.hpp"

namespace casimir::testing {

namespace {

std::string numbered(const char* what, std::size_t i) {
  return what + ("[" + std::to_string(i) + "]");
}

/// How many rounding errors may add up in an expression: those of a power as often as it has the
/// base as a factor.
double operations_of(const GiNaC::ex& e) {
  if (GiNaC::is_a<GiNaC::power>(e) && GiNaC::is_a<GiNaC::numeric>(e.op(1))) {
    const double exponent = std::fabs(GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_double());
    return std::max(1., exponent) * (operations_of(e.op(0)) + 1);
  }
  double sum = 1;
  for (std::size_t i = 0; i < e.nops(); ++i) sum += operations_of(e.op(i));
  return sum;
}

/// The text of a case that can be read: a random expression may divide by what is always zero.
std::string readable_case(std::uint64_t seed) {
  for (;; seed += 1'000'000) {
    std::string text = random_case(seed);
    try {
      model_of(text);
      return text;
    } catch (const CaseError& problem) {
      const std::string what = problem.what();
      if (what.find("division by zero") == std::string::npos &&
          what.find("zero to a power") == std::string::npos)
        throw;
    }
  }
}

cln::cl_R exact_value(double x) { return cln::rational(cln::cl_DF(x)); }

}  // namespace

RandomSystem::RandomSystem(std::uint64_t seed, bool bound)
    : text_(readable_case(seed)), model_(model_of(text_, "s" + std::to_string(seed) + ".toml")) {
  Random random(seed ^ 0x5eed);
  SpecialiseOptions what;
  what.gradients = what.variational = what.taylor = true;
  what.fold_parameters = random.one_in(2) || bound;
  if (!bound && what.fold_parameters && !model_.parameters.empty() && random.one_in(2))
    what.keep_parameters = {model_.parameters.front().get_name()};
  what.observe = std::vector<std::string>{};
  specialisation_ = specialise(model_, model_.scenes[0], what);
  scalar_ = static_cast<Scalar>(seed % 5);
  try {
    emit_header(specialisation_, {scalar_});
  } catch (const ModelError&) {  // a number that float cannot hold
    scalar_ = Scalar::real64;
  }
  field_ = model_.field;
  // Those that are emitted: constants are not.
  std::map<std::string, GiNaC::ex> named;
  if (model_.hamiltonian) named["H"] = *model_.hamiltonian;
  for (const auto* list : {&model_.casimirs, &model_.integrals})
    for (const NamedExpression& f : *list) named[f.name] = f.value;
  for (const std::string& name : specialisation_.invariant_names)
    invariants_.push_back(named.at(name));
  for (const GiNaC::symbol& p : model_.parameters)
    values_[p] = cln::realpart(
        GiNaC::ex_to<GiNaC::numeric>(model_.at_parameters(p, model_.scenes[0])).to_cl_N());
  for (const auto* list : {&field_, &invariants_})
    for (const GiNaC::ex& f : *list) operations_ += operations_of(f);
  for (int tries = 0; tries < 50 && places_.size() < kPlaces; ++tries) {
    Place place;
    for (std::size_t i = 0; i < field_.size(); ++i) {
      place.state.push_back(random.coordinate());
      place.deviation.push_back(random.coordinate());
    }
    place.time = bound ? 0 : random.coordinate();
    try {
      expected(place);
      places_.push_back(place);
    } catch (const std::exception&) {  // a pole, or the root of a negative number
    }
  }
}

SeriesEvaluator RandomSystem::evaluator(const Place& place, std::size_t order) const {
  SeriesEvaluator result(order);
  for (const auto& [symbol, value] : values_)
    result.set(GiNaC::ex_to<GiNaC::symbol>(symbol), result.constant(value));
  for (std::size_t i = 0; i < place.state.size(); ++i)
    result.set(model_.variables[i], result.constant(exact_value(place.state[i])));
  if (model_.time) result.set(*model_.time, result.constant(exact_value(place.time)));
  return result;
}

std::vector<Series> RandomSystem::coefficients(const Place& place, std::size_t order) const {
  std::vector<cln::cl_R> state;
  for (const double x : place.state) state.push_back(exact_value(x));
  auto fixed = values_;
  if (model_.time) fixed[*model_.time] = exact_value(place.time);
  return solution_series(model_.variables, field_, state, fixed,
                         model_.time ? &*model_.time : nullptr, order);
}

std::vector<Expected> RandomSystem::expected(const Place& place) const {
  const std::size_t n = field_.size();
  std::vector<Expected> result;
  const auto add = [&](const std::string& what, const Sized& exact, double order = 0) {
    result.push_back({what, exact, operations_ * (order + 1)});
  };
  const SeriesEvaluator values = evaluator(place, 0);
  std::vector<Sized> rates;
  for (std::size_t i = 0; i < n; ++i) rates.push_back(values(field_[i])[0]);
  for (std::size_t i = 0; i < n; ++i) add(numbered("rhs", i), rates[i]);
  for (std::size_t i = 0; i < invariants_.size(); ++i)
    add(numbered("invariants", i), values(invariants_[i])[0]);

  // Along each coordinate, and along the deviation.
  const auto along = [&](const GiNaC::ex& f, const std::vector<double>& direction) {
    SeriesEvaluator line = evaluator(place, 1);
    for (std::size_t i = 0; i < n; ++i) {
      Series x = line.constant(exact_value(place.state[i]));
      x[1] = line.constant(exact_value(direction[i]))[0];
      line.set(model_.variables[i], x);
    }
    return line(f)[1];
  };
  const auto derivatives = [&](const std::vector<GiNaC::ex>& functions, const char* what,
                               bool by_columns) {
    for (std::size_t a = 0; a < (by_columns ? n : functions.size()); ++a) {
      for (std::size_t b = 0; b < (by_columns ? functions.size() : n); ++b) {
        std::vector<double> axis(n);
        axis[by_columns ? a : b] = 1;
        add(numbered(what, by_columns ? b + n * a : b + n * a),
            along(functions[by_columns ? b : a], axis), 1);
      }
    }
  };
  derivatives(invariants_, "gradients", false);
  derivatives(field_, "jacobian", true);
  derivatives(field_, "jacobian_entries", true);
  for (std::size_t i = 0; i < n; ++i) add(numbered("variational x", i), rates[i], 1);
  for (std::size_t i = 0; i < n; ++i)
    add(numbered("variational delta", i), along(field_[i], place.deviation), 1);
  const std::vector<Series> series = coefficients(place, kOrder);
  for (std::size_t k = 0; k <= kOrder; ++k)
    for (std::size_t i = 0; i < n; ++i)
      add(numbered("taylor", i + n * k), series[i][k], static_cast<double>(k));
  return result;
}

Precision precision_of(Scalar scalar) {
  switch (scalar) {
    case Scalar::real32:
      return {FLT_EPSILON, FLT_MAX, FLT_MIN};
    case Scalar::long_double:
      return {LDBL_EPSILON, DBL_MAX, DBL_MIN};  // what is read here is a double
    case Scalar::float128:
      return {0x1p-112, DBL_MAX, DBL_MIN};
    default:
      return {DBL_EPSILON, DBL_MAX, DBL_MIN};
  }
}

namespace {

const char* type_name(Scalar scalar) {
  switch (scalar) {
    case Scalar::real32:
      return "float";
    case Scalar::long_double:
      return "long double";
    case Scalar::float128:
      return "__float128";
    default:
      return "double";
  }
}

/// Runs every function of the header of one system.
std::string caller(const RandomSystem& system) {
  const Specialisation& s = system.specialisation();
  const std::string scope = s.case_name;
  const std::string n = std::to_string(s.states.size());
  const std::string m = std::to_string(s.invariant_names.size());
  const bool templated = system.scalar() == Scalar::templated;
  const bool has_parameters = !s.parameters.empty();
  const std::string time = s.uses_time ? "t, " : "";
  const std::string p = has_parameters ? "p, " : "";
  std::string text =
      "static void run_" + scope + "(const double*& in, std::vector<double>& out) {\n";
  text += "  using R = " + std::string(type_name(system.scalar())) + ";\n";
  text +=
      "  constexpr int n = " + n + ";\n  R x[n], d[n], a[n * (n + 1) * 10 + 100], b[n * n + 1];\n";
  text += "  for (int i = 0; i < n; ++i) x[i] = static_cast<R>(*in++);\n";
  text += "  for (int i = 0; i < n; ++i) d[i] = static_cast<R>(*in++);\n";
  text += "  [[maybe_unused]] const R t = static_cast<R>(*in++);\n";
  if (has_parameters)
    text += "  const " + scope + "::parameters" + (templated ? "<R>" : "") + " p{};\n";
  const auto call = [&](const std::string& function, const std::string& inputs,
                        const std::string& outputs) {
    text += "  " + scope + "::" + function + "(" + time + inputs + p + outputs + ");\n";
  };
  const auto put = [&](const std::string& array, const std::string& count) {
    text += "  for (int i = 0; i < " + count + "; ++i) put(" + array + "[i], out);\n";
  };
  call("rhs", "x, ", "a");
  put("a", "n");
  if (m != "0") {
    call("invariants", "x, ", "a");
    put("a", m);
    call("gradients", "x, ", "a");
    put("a", "n * " + m);
  }
  call("jacobian", "x, ", "a");
  put("a", "n * n");
  call("jacobian_entries", "x, ", "b");
  text += "  for (int i = 0; i < n * n; ++i) a[i] = 0;\n";
  if (!s.jacobian.entries.empty())  // else there are no such tables
    text += "  for (int j = 0; j < n; ++j)\n    for (int k = " + scope +
            "::jacobian_columns[j]; k < " + scope + "::jacobian_columns[j + 1]; ++k)\n      a[" +
            scope + "::jacobian_rows[k] + n * j] = b[k];\n";
  put("a", "n * n");
  call("variational", "x, d, ", "a, a + n");
  put("a", "2 * n");
  call("taylor<" + std::to_string(RandomSystem::kOrder) + ">", "x, ", "a");
  put("a", "n * " + std::to_string(RandomSystem::kOrder + 1));
  return text + "}\n\n";
}

}  // namespace

std::string driver(const std::vector<RandomSystem>& systems) {
  std::string text;
  for (const RandomSystem& system : systems) {
    const bool wide = system.scalar() == Scalar::float128;
    if (wide) text += "#ifndef __clang__\n";  // Debian's clang does not find quadmath.h
    text += emit_header(system.specialisation(), {system.scalar(), true}) + caller(system);
    if (wide) text += "#endif\n";
  }
  text += "int main(int, char** files) {\n  std::vector<double> in(" +
          std::string("1 << 20), out;\n") +
          "  std::FILE* file = std::fopen(files[1], \"rb\");\n"
          "  in.resize(std::fread(in.data(), sizeof(double), in.size(), file));\n"
          "  std::fclose(file);\n  const double* next = in.data();\n";
  for (const RandomSystem& system : systems) {
    const bool wide = system.scalar() == Scalar::float128;
    const std::string values = std::to_string(2 * system.specialisation().states.size() + 1);
    if (wide)
      text += "#ifdef __clang__\n  next += " + std::to_string(system.places().size()) + " * " +
              values + ";\n#else\n";
    for (std::size_t i = 0; i < system.places().size(); ++i)
      text += "  run_" + system.specialisation().case_name + "(next, out);\n";
    if (wide) text += "#endif\n";
  }
  // As three doubles, which hold the digits of every type.
  return "#include <cstdio>\n#include <vector>\n\ntemplate <class R>\nstatic void put(R value, "
         "std::vector<double>& out) {\n  for (int i = 0; i < 3; ++i) {\n    const double part = "
         "static_cast<double>(value);\n    out.push_back(part);\n    value -= "
         "static_cast<R>(part);\n"
         "  }\n}\n\n" +
         text +
         "  file = std::fopen(files[2], \"wb\");\n  std::fwrite(out.data(), sizeof(double), "
         "out.size(), file);\n  return std::fclose(file);\n}\n";
}

}  // namespace casimir::testing
