#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/search/integral_space.hpp"
#include "symbolic/structure/lift.hpp"

namespace casimir::structure {

/// The invariant tensors of one type up to a degree of their components, as polynomials of the ring
/// of the lifted system.
class TensorSpace {
 public:
  TensorSpace(const Model& model, TensorType type);
  TensorSpace(const TensorSpace&) = delete;
  TensorSpace& operator=(const TensorSpace&) = delete;

  const Lift& lift() const { return lift_; }
  search::System& system() { return system_; }
  const search::System& system() const { return system_; }

  /// Takes an integral as known, or its numerator where the denominator is another integral; false
  /// where that is constant, no polynomial in the atoms or not proved to be an integral.
  bool add_integral(const GiNaC::ex& integral);
  /// Takes an invariant tensor as known, or its numerator where the denominator is an integral;
  /// false where that is zero, no polynomial in the atoms or not proved to be invariant.
  bool add_tensor(const std::vector<GiNaC::ex>& components);

  /// Finds what the known ones do not generate, degree by degree. What is found at one degree is
  /// known at the next.
  ///
  /// Theorem: dim V <= nullity modulo a prime at any values of the parameters, as a rank can only
  /// become smaller there. V has at least as many dimensions as the span of what was found, whose
  /// rank modulo the prime is no larger than the true one either. Where the two numbers agree, the
  /// dimension is proved, and there are no others.
  void search_up_to(int degree, const search::Watch& watch);

  /// Of all degrees so far, in ascending order.
  const std::vector<search::Generator>& found() const { return found_; }
  /// The dimension of the space up to the degree 0, 1, ..
  const std::vector<std::size_t>& dimensions() const { return dimensions_; }
  bool complete() const { return complete_; }
  const std::string& reason() const { return reason_; }

  /// Linearly independent tensors that span all that was known or found up to this degree.
  std::vector<Polynomial> basis(int degree);

  /// The components of a tensor times a function of the parameters, as polynomials in the atoms;
  /// empty where they are none.
  std::optional<std::vector<Polynomial>> polynomials(const std::vector<GiNaC::ex>& tensor);
  /// The components of a tensor, in the order of the lift's indices.
  std::vector<Polynomial> components(const Polynomial& tensor) const;
  std::vector<GiNaC::ex> expressions(const Polynomial& tensor) const;
  int degree_of(const Polynomial& tensor) const;

 private:
  bool add(const GiNaC::ex& function);
  /// The numerator of a function in lowest terms.
  struct Numerator {
    Polynomial function;
    bool is_divided;  ///< the denominator depends on the coordinates
  };
  /// Empty where it is no polynomial in the atoms, and where the denominator is no integral.
  std::optional<Numerator> numerator_of(const GiNaC::ex& function);
  search::Problem problem(int degree) const;

  Lift lift_;
  search::System system_;
  std::vector<bool> fibre_;
  std::vector<search::Generator> known_, found_;
  std::vector<std::size_t> dimensions_;
  bool complete_ = true;
  std::string reason_;
};

}  // namespace casimir::structure
