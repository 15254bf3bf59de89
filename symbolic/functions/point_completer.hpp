#pragma once

#include <cln/rational.h>

#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "symbolic/functions/generator_table.hpp"

namespace casimir::functions {

/// Finds exact points at which the functions of a table have values: those of the generators obey
/// all relations.
class PointCompleter {
 public:
  explicit PointCompleter(const GeneratorTable& table) : table_(table) {}

  /// How `complete` may choose the values of sines and exponentials.
  struct Freedom {
    /// Freely: they are algebraically independent of their arguments, so that what holds at such a
    /// point (a rank) holds at generic points. Logarithms and inverse functions are not drawn.
    bool formal = false;
    /// Not formal: symbols that occur as they are, so that they keep their rational values. An
    /// angle of any other symbol is drawn, and the symbol has the value that belongs to it.
    std::vector<bool> bare{};
    /// Sines and cosines that are not drawn, by the sine's place in the ring.
    std::map<std::size_t, std::pair<cln::cl_RA, cln::cl_RA>> angles{};
  };

  /// The places of the sines, each followed by its cosine, whose angles are plain symbols that
  /// `complete` chooses freely.
  std::vector<std::size_t> free_sines(const Freedom& freedom) const;

  /// Given values of the symbols in point[0..symbols), this fills in values of the generators that
  /// obey all relations. Sines and exponentials are drawn from `draw` as `freedom` says;
  /// logarithms, inverse functions and I get no value (see `has_value`).
  /// \return  false where a denominator vanishes or a root is not rational: another point has to be tried
  bool complete(std::vector<cln::cl_RA>& point, const std::function<cln::cl_RA()>& draw,
                const Freedom& freedom) const;

  /// The largest total degree of the arguments of the generators: what it costs to complete a
  /// point.
  long argument_degree() const;

  /// Whether `p` has a value at a completed point: logarithms, inverse functions and I have none.
  bool has_value(const Polynomial& p) const;

  /// Which symbols occur as they are in `p` or in any generator, and not only as plain angles.
  std::vector<bool> bare_symbols(const Polynomial& p) const;

  /// An angle or exponent `factor * symbol` with its value at a completed point.
  struct PlainArgument {
    std::size_t symbol;
    cln::cl_RA factor;
    bool angle;               ///< else an exponent
    cln::cl_RA sine, cosine;  ///< of an angle
    cln::cl_RA exponential;   ///< of an exponent
  };
  std::vector<PlainArgument> plain_arguments(const std::vector<cln::cl_RA>& point) const;

 private:
  bool complete_argument(std::size_t g, std::vector<cln::cl_RA>& point, std::vector<bool>& chosen,
                         const std::function<cln::cl_RA()>& draw, const Freedom& freedom) const;
  std::optional<std::pair<std::size_t, cln::cl_RA>> plain_symbol(const Polynomial& p) const;

  const GeneratorTable& table_;
};

}  // namespace casimir::functions
