#pragma once

#include <vector>

#include "codegen/wasm/module_writer.hpp"
#include "codegen/wasm/values_body.hpp"
#include "runtime/program.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir::codegen::wasm {

/// Where the series of a program stand in memory, in bytes.
struct SeriesPlaces {
  int inputs = 0, unit = 0;
  int first = 0;   ///< of all series: those of the states come first, then that of the time
  int stride = 0;  ///< from a series to the next
};

/// The sums of two series that the recurrences are made of: functions of (u, v, k, from, to), where
/// u and v are addresses of series and the others are numbers of coefficients, times 8.
struct SeriesSums {
  int plain = 0;     ///< sum over j = from..to of u_j v_{k-j}
  int weighted = 0;  ///< sum over j = from..to of j u_j v_{k-j}
};
SeriesSums add_sums(ModuleWriter& module);

/// The Taylor coefficients of a right-hand side, as TaylorJet of the runtime has them: a series for
/// each line, each with its recurrence.
class SeriesBodies {
 public:
  /// \param flow  without dead code; its first outputs are the rates of the states
  /// \param limits  of the constants, see `codegen::constant_value`
  SeriesBodies(const Program& flow, std::size_t states, const SeriesPlaces& places,
               const Imports& imports, const SeriesSums& sums, const Limits& limits);

  Body prepare() const;  ///< () -> (): lines that depend on the parameters alone
  Body begin() const;    ///< () -> (): coefficient 0 of all others
  Body extend() const;   ///< (8 k) -> (): coefficient k > 0
  Body advance() const;  ///< (8 k) -> (): coefficient k + 1 of the states, with a local for 1/(k+1)

  int end() const { return end_; }  ///< of the memory that is used
  int place(int line) const { return places_[static_cast<std::size_t>(line)]; }
  int state(std::size_t i) const { return at_.first + static_cast<int>(i) * at_.stride; }
  std::vector<int> singular() const;
  std::vector<int> kinks() const;
  bool needs_comparison() const;

 private:
  struct Recurrence;

  bool varies(int line) const {
    return line >= 0 && kinds_[static_cast<std::size_t>(line)] == kVaries;
  }
  void value(Body& body, int line) const;
  void next(Body& body, int line) const;
  void begin_helpers(Body& body, std::size_t i) const;
  void extend_line(Body& body, std::size_t i) const;
  void extend_product(Body& body, const Instruction& line) const;
  void extend_quotient(Body& body, const Instruction& line, int y) const;

  enum Kind { kConstant, kPrepared, kVaries };
  const Program& flow_;
  const std::size_t states_;
  const SeriesPlaces at_;
  const Imports& imports_;
  const SeriesSums sums_;
  std::vector<Kind> kinds_;
  std::vector<double> constants_;
  std::vector<int> places_;   ///< of the series of each line
  std::vector<int> helpers_;  ///< the first of two more, or -1
  int end_ = 0;
};

}  // namespace casimir::codegen::wasm
