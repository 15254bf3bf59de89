#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "symbolic/algebra/polynomial.hpp"

namespace casimir {

/// A name of a case as part of an identifier of Coq: letters and digits stay, each '_' is doubled,
/// so that different names stay different, and single ones separate the parts of an identifier.
/// \throws std::logic_error  for what `check_name` would not accept: no other text may reach Coq.
std::string coq_name(const std::string& name);

/// Whether `coq_name` accepts it.
bool is_coq_name(const std::string& name);

/// A polynomial that a file for Coq defines.
struct CoqFunction {
  std::string name;  ///< an identifier of the file
  Polynomial value;
};

/// A file of definitions and identities about polynomials on a Poisson manifold, over the rational
/// numbers of Coq (8.16). Every identifier is made of a fixed prefix and checked names; symbols are
/// called x_NAME, so that nothing of Coq can be meant.
class CoqFile {
 public:
  /// \param symbols  the ring's variables: first the coordinates, then the parameters
  /// \param dimension  how many coordinates
  CoqFile(const std::vector<GiNaC::symbol>& symbols, std::size_t dimension);

  /// A comment before what is defined and before what is proved next. Everything but letters,
  /// digits and plain punctuation is left out of it.
  void begin_part(const std::string& title);
  /// A comment at the end of the file.
  void end_with(const std::string& text);

  /// {x_i, x_j} for i < j, row by row: each entry that is not zero with the derivatives that are
  /// not zero, and the bracket of two functions in terms of their gradients, `poisson`.
  void define_bracket(const std::vector<Polynomial>& upper);

  /// The function and all its derivatives, each with a lemma that it is one.
  CoqFunction define(const std::string& name, const Polynomial& value);

  /// poisson f g = - poisson g f.
  void state_skew_symmetry();
  /// {x_i, {x_j, x_k}} + cyclic = 0, for all i < j < k.
  void state_jacobi();
  /// {f, g} = 0 for every function g.
  void state_commutes_with_all(const std::string& name, const CoqFunction& f);
  /// {f, g} = sum of cofactor * function of the level.
  void state_bracket(const std::string& name, const CoqFunction& f, const CoqFunction& g,
                     const std::vector<CoqFunction>& level,
                     const std::vector<Polynomial>& cofactors);
  /// {x_i, f} = sum of cofactor * function of the level.
  void state_bracket(const std::string& name, std::size_t i, const CoqFunction& f,
                     const std::vector<CoqFunction>& level,
                     const std::vector<Polynomial>& cofactors);

  /// The whole file, with `head` as its first comment.
  std::string text(const std::string& head) const;

 private:
  std::string polynomial(const Polynomial& p) const;
  std::string call(const std::string& function) const;
  std::string bracket_name(std::size_t i, std::size_t j) const;
  std::string entry(std::size_t i, std::size_t j) const;
  std::string entry_slope(std::size_t i, std::size_t j, std::size_t l) const;
  std::string row(std::size_t i, const std::string& gradient) const;
  std::string gradient(const CoqFunction& f) const;
  std::string unit(std::size_t i) const;
  std::string combination(const std::vector<CoqFunction>& level,
                          const std::vector<Polynomial>& cofactors) const;
  const Polynomial& upper(std::size_t i, std::size_t j) const;
  void definition(const std::string& name, const std::string& arguments, const std::string& value);
  void define_slope(const CoqFunction& f, std::size_t i);
  void theorem(const std::string& name, const std::string& variables, const std::string& left,
               const std::string& right);

  std::size_t dimension_;
  std::vector<std::string> names_;    ///< of the symbols, as `coq_name` has them
  std::vector<std::string> symbols_;  ///< x_NAME
  std::string arguments_;             ///< " x_M1 x_M2 .. x_r"
  std::vector<Polynomial> upper_;
  std::vector<std::string> defined_;
  std::string definitions_, lemmas_, theorems_, end_;
};

}  // namespace casimir
