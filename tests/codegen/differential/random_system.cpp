#include "tests/codegen/differential/random_system.hpp"

#include <algorithm>

namespace casimir::testing {

namespace {

enum class Kind { polynomial, rational, trigonometric };

/// Writes random expressions over some names.
class Writer {
 public:
  Writer(Random& random, Kind kind, std::vector<std::string> variables,
         std::vector<std::string> constants)
      : random_(random),
        kind_(kind),
        variables_(std::move(variables)),
        constants_(std::move(constants)) {}

  std::string expression(unsigned depth) {
    if (depth == 0) return leaf();
    switch (random_.below(kind_ == Kind::polynomial ? 6 : kind_ == Kind::rational ? 8 : 11)) {
      case 0:
      case 1:
        return "(" + expression(depth - 1) + (random_.one_in(2) ? " + " : " - ") +
               expression(depth - 1) + ")";
      case 2:
        return "(" + number() + "*" + expression(depth - 1) + " - " + expression(depth - 1) +
               " + " + leaf() + ")";
      case 3:
      case 4:
        return expression(depth - 1) + "*" + expression(depth - 1);
      case 5:
        return "(" + expression(depth - 1) + ")^" +
               std::to_string(2 + random_.below(depth > 1 ? 2 : 5));
      case 6:
        return "(" + expression(depth - 1) + ")/" + positive(depth - 1);
      case 7:
        return random_.one_in(2)
                   ? number() + "/" + random_.of(variables_)
                   : random_.of(variables_) + "^(-" + std::to_string(1 + random_.below(3)) + ")";
      default:
        return call(depth - 1);
    }
  }

 private:
  std::string number() {
    const unsigned value = 1 + random_.below(9);
    switch (random_.below(kind_ == Kind::trigonometric ? 6 : 4)) {
      case 0:
        return std::to_string(value);
      case 1:
        return std::to_string(value) + "/" + std::to_string(2 + random_.below(9));
      case 2:
        return "0." + std::to_string(1 + random_.below(9999));
      case 3:
        return "(-" + std::to_string(value) + ")";
      case 4:
        return "Pi";
      default:
        return "sqrt(" + std::to_string(value + 1) + ")";
    }
  }

  std::string leaf() {
    const unsigned choice = random_.below(10);
    if (choice < 7 || constants_.empty()) return choice == 0 ? number() : random_.of(variables_);
    return random_.of(constants_);
  }

  /// At least one half.
  std::string positive(unsigned depth) {
    return "(" + std::to_string(1 + random_.below(3)) + "/2 + (" + expression(depth) + ")^2)";
  }

  /// Between -1 and 1, not close to them.
  std::string small(unsigned depth) {
    const std::string u = expression(depth);
    return "(" + u + ")/(3/2 + (" + u + ")^2)";
  }

  std::string call(unsigned depth) {
    switch (random_.below(15)) {
      case 0:
        return "sin(" + expression(depth) + ")";
      case 1:
        return "cos(" + expression(depth) + ")";
      case 2:
        return "tan(" + small(depth) + ")";
      case 3:
        return "exp(" + small(depth) + ")";
      case 4:
        return "log(" + positive(depth) + ")";
      case 5:
        return "sqrt(" + positive(depth) + ")";
      case 6:
        return "atan(" + expression(depth) + ")";
      case 7:
        return "atan2(" + expression(depth) + ", " + positive(depth) + ")";
      case 8:
        return "asin(" + small(depth) + ")";
      case 9:
        return "acos(" + small(depth) + ")";
      case 10:
        return positive(depth) + "^(" + (random_.one_in(2) ? "-" : "") +
               random_.of<std::string>({"1/2", "3/2", "1/3", "2/3", "5/2", "1/4", "7/3"}) + ")";
      case 11:
        return "sinh(" + small(depth) + ")";
      case 12:
        return "cosh(" + small(depth) + ")";
      case 13:
        return "tanh(" + expression(depth) + ")";
      default:
        return random_.one_in(2) ? "exp(-" + expression(0) + ")" : "cos(2*" + expression(0) + ")";
    }
  }

  Random& random_;
  Kind kind_;
  std::vector<std::string> variables_, constants_;
};

/// Names that a generator of code might use itself.
const std::vector<std::string> kNames{
    "x",          "y",          "z",           "w",        "dx",        "J",
    "p",          "t1",         "c1",          "x_",       "values",    "k",
    "degree",     "next",       "series_1",    "fixed_1",  "Order",     "delta_x",
    "rhs",        "real",       "Real",        "system",   "dimension", "coefficients",
    "dvalues",    "entries",    "start",       "initial",  "sum",       "sin_1",
    "cos_1",      "parameters", "jacobian",    "std_",     "n",         "i",
    "j",          "M_1",        "y0",          "duration", "taylor",    "ddelta_x",
    "invariants", "state",      "time_series", "fixed",    "a1",        "alpha",
    "q",          "std"};

class CaseWriter {
 public:
  explicit CaseWriter(std::uint64_t seed)
      : random_(seed), kind_(static_cast<Kind>(random_.below(3))), names_(kNames) {}

  std::string text() {
    for (std::size_t i = names_.size() - 1; i > 0; --i)
      std::swap(names_[i], names_[random_.below(static_cast<unsigned>(i + 1))]);
    const unsigned parameters = random_.below(4);
    for (unsigned i = 0; i < parameters; ++i) parameters_.push_back(name());
    const unsigned shape = random_.below(10);
    std::string text = shape < 6 ? by_equations() : shape < 8 ? canonical() : on_an_algebra();
    if (!parameters_.empty()) {
      text += "[parameters]\n";
      for (const std::string& p : parameters_) text += p + " = {}\n";
    }
    text += rest_ + "[[scene]]\nname = \"default\"\n";
    if (!parameters_.empty()) {
      text += "parameters = { ";
      for (const std::string& p : parameters_)
        text += (p == parameters_[0] ? "" : ", ") + p + " = \"" + (random_.one_in(3) ? "-" : "") +
                std::to_string(1 + random_.below(9)) + "/" + std::to_string(1 + random_.below(7)) +
                "\"";
      text += " }\n";
    }
    text += "initial = { ";
    for (const std::string& x : variables_)
      text += (x == variables_[0] ? "" : ", ") + x + " = \"" +
              std::to_string(1 + random_.below(5)) + "/4\"";
    return text + " }\nduration = \"1\"\n";
  }

 private:
  std::string name() {
    std::string result = names_.back();
    names_.pop_back();
    return result;
  }

  std::string head(const std::string& more) {
    std::string list;
    for (const std::string& x : variables_) list += (list.empty() ? "\"" : ", \"") + x + "\"";
    return "title = \"random\"\n" + hamiltonian_ + "[phase_space]\nvariables = [" + list + "]\n" +
           more;
  }

  Writer writer(bool with_time) {
    std::vector<std::string> leaves = variables_;
    if (with_time) leaves.push_back(time_);
    if (defined_) leaves.push_back("D");
    return {random_, kind_, leaves, parameters_};
  }

  /// A definition that several expressions may use.
  void define() {
    if (!random_.one_in(3)) return;
    rest_ += "[definitions]\nD = \"" + writer(false).expression(1) + "\"\n";
    defined_ = true;
  }

  std::string by_equations() {
    const unsigned dimension = 1 + random_.below(4);
    for (unsigned i = 0; i < dimension; ++i) variables_.push_back(name());
    const bool timed = random_.one_in(3);
    time_ = name();
    define();
    std::string rates;
    for (const std::string& x : variables_)
      rates += x + " = \"" + writer(timed).expression(2 + random_.below(2)) + "\"\n";
    rest_ += "[integrals]\nF1 = \"" + writer(false).expression(2) + "\"\n";
    return head(timed ? "time = \"" + time_ + "\"\n" : "") + "[equations]\n" + rates;
  }

  std::string canonical() {
    const unsigned pairs = 1 + random_.below(2);
    for (unsigned i = 0; i < 2 * pairs; ++i) variables_.push_back(name());
    define();
    hamiltonian_ = "hamiltonian = \"" + writer(false).expression(3) + "\"\n";
    return head("canonical = true\n");
  }

  std::string on_an_algebra() {
    const bool large = random_.one_in(2);
    for (int i = 0; i < (large ? 6 : 3); ++i) variables_.push_back(name());
    if (large) kind_ = Kind::polynomial;
    define();
    hamiltonian_ = "hamiltonian = \"" + writer(false).expression(2) + "\"\n";
    return head(std::string("algebra = \"") + (large ? "e(3)" : "so(3)") + "\"\n");
  }

  Random random_;
  Kind kind_;
  std::vector<std::string> names_, variables_, parameters_;
  std::string time_, hamiltonian_, rest_;
  bool defined_ = false;
};

}  // namespace

std::string random_case(std::uint64_t seed) { return CaseWriter(seed).text(); }

}  // namespace casimir::testing
