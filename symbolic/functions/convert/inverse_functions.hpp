#pragma once

#include <ginac/ginac.h>

#include <array>
#include <optional>
#include <utility>

#include "symbolic/functions/convert/angles.hpp"
#include "symbolic/functions/convert/roots.hpp"
#include "symbolic/functions/function_probe.hpp"
#include "symbolic/functions/generator_table.hpp"
#include "symbolic/functions/sign_table.hpp"

namespace casimir::functions {

/// The inverse functions atan, asin, acos and atan2 as generators of a table, or as other inverse
/// functions that they are.
class InverseFunctions {
 public:
  InverseFunctions(GeneratorTable& table, SignTable& signs, Roots& roots, Angles& angles,
                   Convert convert)
      : table_(table),
        signs_(signs),
        roots_(roots),
        angles_(angles),
        convert_(std::move(convert)) {}

  /// Forgets what was computed of generators: the table starts again.
  void restart() { probes_ = {}; }
  /// \param v  the first argument of f
  Polynomial polynomial(const GiNaC::function& f, const Polynomial& v);

 private:
  /// An inverse function with its tag.
  struct Arc {
    GiNaC::ex value;
    unsigned long tag;
  };
  /// How many times the angles are taken that are compared.
  struct Multiples {
    int own, others;
  };
  /// The range of an inverse function, in quarters of a turn.
  struct TurnRange {
    int low, high;
    bool has_low, has_high;  ///< whether the ends belong to it

    /// Of the function times a positive number.
    TurnRange times(int factor) const { return {low * factor, high * factor, has_low, has_high}; }
  };
  /// The squares of a sine and a cosine, over one denominator.
  struct Squares {
    Polynomial sine, cosine, bottom;
  };

  Polynomial generator(const GiNaC::function& f, const Polynomial& factor, const Polynomial& key,
                       unsigned long tag);
  Polynomial arc_tangent(const GiNaC::function& f, const Polynomial& v);
  Polynomial arc_sine_or_cosine(const GiNaC::function& f, const Polynomial& v);
  Polynomial arc_tangent_of_two(const GiNaC::function& f, const Polynomial& v);
  std::optional<Polynomial> known_inverse(const GiNaC::function& function);
  static bool is_one_turn_only(const TurnRange& a, const TurnRange& b, int sign, int quarters);
  TurnRange range(const Arc& arc);
  Squares squares(const Arc& arc);
  Squares doubled(const Squares& s) const;
  double square_at_point(const Arc& arc, std::size_t point);
  Probe& own_probe(std::size_t k);
  bool may_agree(const Arc& f, const Arc& other, const Multiples& multiples);
  bool agree_in_squares(const Arc& f, const Arc& other, const Multiples& multiples);
  bool has_values(const Arc& f, const Arc& other);
  std::optional<Polynomial> by_turns(const Arc& f, const Arc& other, std::size_t g,
                                     const Multiples& multiples);

  GeneratorTable& table_;
  SignTable& signs_;
  Roots& roots_;
  Angles& angles_;
  Convert convert_;
  std::array<Probe, kProbes> probes_;
};

}  // namespace casimir::functions
