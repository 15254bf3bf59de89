#include "tests/adversary/judge_certificate.hpp"

#include <algorithm>
#include <sstream>

#include "symbolic/certificate.hpp"
#include "symbolic/prove.hpp"
#include "tests/adversary/parser.hpp"
#include "tests/adversary/residuals.hpp"
#include "tests/tools/commands/coq_reader.hpp"

namespace casimir::adversary {
namespace {

std::string coq_name(const std::string& name) {
  std::string result;
  for (const char c : name) result += c == '_' ? std::string("__") : std::string(1, c);
  return result;
}

Ball ball_of(const GiNaC::ex& number) {
  std::ostringstream stream;
  stream << "(" << number << ")";
  return value(parse(stream.str()), {});
}

/// A certificate beside the case, both at one point with whole coordinates.
class Reading {
 public:
  Reading(const Case& claim, const std::string& certificate, Random& random)
      : claim_(claim), reader_(certificate) {
    for (const std::string& name : claim.system.symbols()) {
      const long number = random.between(1, 9);
      point_[name] = Ball(number);
      arguments_.emplace_back(number);
      argument_text_ += " x_" + coq_name(name);
    }
  }

  /// What is not as the case has it; empty if nothing is.
  std::string wrong_dynamics() const {
    const System& s = claim_.system;
    const std::vector<std::vector<Ball>> structure = At(claim_, point_).structure();
    for (std::size_t i = 0; i < s.variables.size(); ++i) {
      for (std::size_t j = i + 1; j < s.variables.size(); ++j) {
        const std::string name =
            "bracket_" + coq_name(s.variables[i]) + "_and_" + coq_name(s.variables[j]);
        const Ball own = reader_.defines(name) ? ball_of(reader_.value(name, arguments_)) : Ball();
        if (!(own - structure[i][j]).is_tiny()) return name;
      }
    }
    return wrong_function("hamiltonian", s.hamiltonian);
  }

  /// The function of that name and its derivatives are those of the expression.
  std::string wrong_function(const std::string& name, const Expr& f) const {
    const At at(claim_, point_);
    const auto differs = [&](const std::string& own, const Ball& wanted) {
      return !reader_.defines(own) || !(ball_of(reader_.value(own, arguments_)) - wanted).is_tiny();
    };
    if (differs(name, at.value(f))) return name;
    const std::vector<Ball> slopes = at.gradient(f);
    for (std::size_t i = 0; i < claim_.system.variables.size(); ++i) {
      const std::string slope = slope_of(name, i);
      if (differs(slope, slopes[i])) return slope;
    }
    return {};
  }

  /// There is a theorem that the bracket of the function with `other`, the Hamiltonian or any
  /// function of gradient g, is zero.
  std::string wrong_theorem(const std::string& theorem, const std::string& function,
                            const std::string& other) const {
    const auto& theorems = reader_.theorems();
    if (std::find(theorems.begin(), theorems.end(), theorem) == theorems.end()) return theorem;
    const auto& statement = reader_.statements().at(theorem);
    std::string wanted = "poisson", second;
    for (std::size_t i = 0; i < claim_.system.variables.size(); ++i) {
      wanted += " (" + slope_of(function, i) + argument_text_ + ")";
      second += other.empty() ? " g_" + std::to_string(i + 1)
                              : " (" + slope_of(other, i) + argument_text_ + ")";
    }
    wanted += second + argument_text_;
    const bool same = plain(statement.left) == wanted && plain(statement.right) == "0";
    return same ? "" : theorem;
  }

 private:
  std::string slope_of(const std::string& function, std::size_t i) const {
    return function + "_d_" + coq_name(claim_.system.variables[i]);
  }
  /// With one blank between words.
  static std::string plain(const std::string& text) {
    std::istringstream stream(text);
    std::string result;
    for (std::string word; stream >> word;) result += (result.empty() ? "" : " ") + word;
    return result;
  }

  const Case& claim_;
  test::CoqReader reader_;
  Point point_;
  std::vector<GiNaC::ex> arguments_;
  std::string argument_text_;
};

}  // namespace

Outcome judge_certificate(const Case& claim, const Model& model, Random& random,
                          std::string& what) {
  const std::vector<Proof> proofs = prove(model);
  for (const Proof& proof : proofs) {
    if (!counts(model, proof) || proof.verdict == Verdict::proved) continue;
    what = proof.name + ": " + proof.reason;
    return proof.verdict == Verdict::refuted ? Outcome::false_refutation : Outcome::undecided;
  }
  const Certificate certificate = coq_certificate(model, {}, proofs);
  const Reading reading(claim, certificate.text, random);
  const auto is_left_out = [&](const std::string& kind, const std::string& name) {
    return std::any_of(
        certificate.left_out.begin(), certificate.left_out.end(),
        [&](const Uncertified& l) { return to_string(l.kind) == kind && l.name == name; });
  };
  what = reading.wrong_dynamics();
  const auto read = [&](const std::string& kind, const std::vector<Named>& functions,
                        const std::string& theorem, const std::string& other) {
    for (const Named& f : functions) {
      if (!what.empty() || is_left_out(kind, f.name)) continue;
      const std::string name = kind + "_" + coq_name(f.name);
      what = reading.wrong_function(name, f.value);
      if (what.empty()) what = reading.wrong_theorem(name + theorem, name, other);
    }
  };
  read("casimir", claim.casimirs, "_commutes_with_all", "");
  read("integral", claim.integrals, "_is_conserved", "hamiltonian");
  if (what.empty()) return Outcome::proved;
  what = "the certificate states something else, or nothing, of " + what;
  return Outcome::false_proof;
}

}  // namespace casimir::adversary
