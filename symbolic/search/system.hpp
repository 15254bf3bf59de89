#pragma once

#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/proof/prover.hpp"
#include "symbolic/search/modular/modular.hpp"

namespace casimir::search {

/// A value for each variable of a ring.
using Point = std::vector<Residue>;

/// A case as a search sees it: the functions that its ansatz is made of, and the vector fields that
/// have to annihilate what is found. Each of these functions (atoms) is a variable of the ring: the
/// coordinates, the time if the system depends on it, and the sines, roots or denominators that the
/// equations of motion need or the user declares. Denominators are multiplied out of a field: that
/// changes the speed of its motion and no integral.
class System {
 public:
  /// What becomes of the denominators of the equations of motion and the Hamiltonian: they are
  /// multiplied out, or their inverses are atoms.
  enum class Denominators { multiplied_out, atoms };

  /// \param functions  more functions of the variables that the ansatz may use; those that it has
  ///     without them stay in it, though the ring make them of finer ones.
  /// \param others  further expressions that will be converted.
  /// \throws CaseError, ModelError
  System(const Model& model, const std::vector<NamedExpression>& functions,
         const std::vector<GiNaC::ex>& others,
         Denominators denominators = Denominators::multiplied_out);

  const Model& model() const { return prover_.model(); }
  Prover& prover() { return prover_; }
  const FunctionRing& functions() const { return prover_.ring(); }
  const PolynomialRing& ring() const { return prover_.ring().ring(); }

  /// The places of the atoms in the ring: coordinates first, then the time, then the others.
  const std::vector<std::size_t>& atoms() const { return atoms_; }
  /// A declared function that is not a variable of the ring, such as exp(4*t) where that has
  /// exp(t): an atom of its own, which is a symbol of the ring bound to a polynomial in the others.
  struct Defined {
    std::size_t place;
    Polynomial value;
  };
  /// They are the last atoms.
  const std::vector<Defined>& defined() const { return defined_; }
  /// Atoms that only the rates and values of defined functions need: no unknowns of the ansatz.
  const std::vector<bool>& is_silent() const { return silent_; }
  /// Functions that vanish identically, such as s^2 + c^2 - 1, which generate all of the kind.
  const std::vector<Polynomial>& relations() const { return relations_; }
  /// The names of the atoms that the ansatz is made of, beside the coordinates and the time.
  std::vector<std::string> names_of_functions() const;
  std::string name(std::size_t place) const { return prover_.ring().text(ring().variable(place)); }
  /// A polynomial of the ring over the symbols of the model: declared functions are put in.
  GiNaC::ex expression(const Polynomial& p) const;
  /// An expression as the ring writes it; for comparison with names.
  std::string text_of(const GiNaC::ex& expression) const;

  /// Which of the ring's variables are constants of the motion: parameters and what is made of
  /// them.
  const std::vector<bool>& is_constant() const { return constant_; }
  /// Those that the fields contain.
  const std::vector<std::size_t>& parameters() const { return parameters_; }
  /// The names of these that have values: sqrt(2) and I have one alone.
  std::vector<std::string> generic_parameters() const;
  /// Whether a variable of the ring is a number, as sqrt(2).
  bool is_number(std::size_t place) const;
  /// The q for which the power u^q of a variable of the ring is made of earlier ones, as of a root
  /// of order q; 0 where there is none.
  unsigned long order_of(std::size_t place) const;
  /// A parameter that is bound to others, as the root of one is; empty if there is none.
  std::string bound_parameter() const;

  /// The field of the motion: the rate of each atom, times one common function.
  const std::vector<Polynomial>& flow() const { return flow_; }
  /// The Hamiltonian fields of the coordinates: {atom, x_j} in row j, the time at rest.
  const std::vector<std::vector<Polynomial>>& coordinate_flows() const { return coordinate_flows_; }
  /// The same fields as they are: denominators are variables of the ring, atoms or none.
  const std::vector<Polynomial>& plain_flow() const { return plain_flow_; }
  const std::vector<std::vector<Polynomial>>& plain_coordinate_flows() const {
    return plain_coordinate_flows_;
  }
  /// What binds a variable of the ring to earlier ones, as u^2 - b or y*d - 1; empty where nothing
  /// does.
  std::optional<Polynomial> relation_of(std::size_t place) const;

  /// The Hamiltonian, where it is an integral and a polynomial in the atoms.
  std::optional<Polynomial> hamiltonian();

  /// The derivatives along the coordinates and the time, through all functions of them.
  std::vector<Polynomial> gradient(const Polynomial& p) const;

  /// Whether a polynomial uses only atoms and constants.
  bool in_atoms(const Polynomial& p) const;

  /// Whether a polynomial of the ring is zero as a function, by the relations that the ring knows.
  bool is_zero_function(const Polynomial& p) const;

  /// Values of all variables of the ring that obey its relations; empty where none were found, as
  /// roots do not always have values modulo a prime.
  /// \param constants  if not null, the constants' values are taken from there
  std::optional<Point> random_point(const Modulus& modulus, std::mt19937_64& random,
                                    const Point* constants = nullptr) const;

 private:
  /// All functions are declared.
  struct Declared {};
  System(const Model& model, const std::vector<NamedExpression>& functions,
         const std::vector<GiNaC::ex>& others, Denominators denominators, Declared);
  /// The declared functions, and those that the ansatz has without them.
  static std::vector<NamedExpression> with_own_functions(const Model& model,
                                                         std::vector<NamedExpression> functions,
                                                         const std::vector<GiNaC::ex>& others,
                                                         Denominators denominators);
  std::vector<std::size_t> places_of_functions() const;

  /// How a generator of the ring is bound to earlier variables.
  struct Bond {
    enum class Kind { none, inverse, root } kind = Kind::none;
    Polynomial base;          ///< denominator, or radicand
    unsigned long order = 1;  ///< of a root
  };
  Bond bond_of(std::size_t place) const;
  void collect_atoms(const std::vector<NamedExpression>& functions, Denominators denominators);
  void need(const Polynomial& p);
  void need_denominators(const Polynomial& p);
  void need_all(const std::vector<Polynomial>& rates);
  /// The derivative along the i-th of the coordinates and the time.
  Polynomial slope(const Polynomial& p, std::size_t i) const;
  /// The rates of the atoms where the coordinates and the time have these rates ..
  std::vector<Polynomial> plain_rates(const std::vector<Polynomial>& rates) const;
  /// .. and without denominators.
  std::vector<Polynomial> of_atoms(const std::vector<Polynomial>& rates) const;
  void collect_parameters();
  std::optional<Residue> bound_value(std::size_t place, const Point& point, const Modulus& modulus,
                                     std::mt19937_64& random) const;

  std::optional<WorkMeter> meter_;   ///< while the constructor works
  std::unique_ptr<Model> extended_;  ///< with a symbol for each defined function
  Prover prover_;
  std::vector<Defined> defined_;
  std::vector<bool> silent_;
  std::vector<std::size_t> moving_;  ///< coordinates and time
  std::vector<std::size_t> atoms_;
  std::vector<Polynomial> relations_;
  std::vector<Bond> bonds_;  ///< of the ring's variables after the symbols
  std::vector<bool> constant_;
  std::vector<std::size_t> parameters_;
  std::vector<Polynomial> flow_;
  std::vector<std::vector<Polynomial>> coordinate_flows_;
  std::vector<Polynomial> plain_flow_;
  std::vector<std::vector<Polynomial>> plain_coordinate_flows_;
};

/// The first prime modulo which all variables of the system's ring have values: a root of 2 is not
/// in every field.
Modulus usable_modulus(const System& system);

/// The value of p, where every variable of its ring has one.
/// \return  empty where the modulus divides a denominator.
std::optional<Residue> value_at(const Polynomial& p, const Point& point, const Modulus& modulus);

}  // namespace casimir::search
