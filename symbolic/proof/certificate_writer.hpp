#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "symbolic/functions/function_ring.hpp"
#include "symbolic/proof/coq_file.hpp"
#include "symbolic/prove.hpp"

namespace casimir {

/// Why a claim has no theorem.
class NotCovered : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A claim that a certificate may state.
struct Statement {
  ClaimKind kind;
  std::optional<LevelClaim> function;  ///< of a claim about one function: it, and its level
  std::size_t number = 1;              ///< among the claims of its kind

  /// How the file speaks of it.
  std::string title() const;
};

/// How the file speaks of a claim: "integral no. 2, K". Names that are no identifiers do not get
/// into it.
std::string claim_title(ClaimKind kind, const std::string& name, std::size_t number);

/// The polynomials of a case, and the file for Coq that states what is claimed of them.
class CertificateWriter {
 public:
  /// \param about  what the statements are about, beside the bracket and the Hamiltonian
  /// \throws NotCovered  where bracket or Hamiltonian is no polynomial with rational coefficients
  CertificateWriter(const Model& model, const std::vector<GiNaC::ex>& about);

  CoqFile& file() { return file_; }
  std::size_t dimension() const { return model_.variables.size(); }
  /// As the file defines it.
  const CoqFunction& hamiltonian() const { return *hamiltonian_; }

  /// The functions of a statement, before any of them is written.
  struct Parts {
    std::string name;  ///< of the function
    Polynomial function;
    std::vector<Polynomial> level;
  };
  /// \throws NotCovered  where one of them is no polynomial with rational coefficients
  Parts parts(const Statement& statement);

  /// Defines the functions of a level: NAME_level_1, NAME_level_2, ..
  std::vector<CoqFunction> define_level(const std::string& name,
                                        const std::vector<Polynomial>& functions);

  /// {f, g}
  Polynomial bracket(const Polynomial& f, const Polynomial& g) const;
  /// {x_i, g}
  Polynomial flow(std::size_t i, const Polynomial& g) const;
  /// {x_i, x_j}
  const Polynomial& bracket_entry(std::size_t i, std::size_t j) const {
    return field_[i * dimension() + j];
  }

  /// The polynomials q_k with p = sum q_k level_k.
  /// \throws NotCovered  where there are none, or division does not find them
  static std::vector<Polynomial> cofactors(const Polynomial& p,
                                           const std::vector<Polynomial>& level);

 private:
  Polynomial polynomial(const GiNaC::ex& e);

  const Model& model_;
  FunctionRing ring_;
  CoqFile file_;
  std::vector<Polynomial> field_;  ///< {x_i, x_j}
  std::optional<CoqFunction> hamiltonian_;
};

}  // namespace casimir
