#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/program.hpp"
#include "symbolic/case/limits.hpp"

namespace casimir {

/// A WebAssembly module that expands the solutions of a system in Taylor series, and where in its
/// memory the numbers stand: offsets in bytes of doubles, which are little-endian.
///
/// It exports `memory` and, without results,
///   `prepare()`      what depends on the parameters alone; to be called after they were written;
///   `expand(order)`  the series of the states at `inputs`, up to 1 <= order <= `order`;
///   `rates()`        the rates of the states at `inputs`, to `rates`;
///   `evaluate()`     the further functions at `inputs`, to `values`.
/// Of the browser it asks for functions of `Math`, as imports from a module that is called "m".
struct WasmSeries {
  std::string bytes;  ///< the binary format, version 1
  int order = 0;      ///< the highest that there is room for
  int inputs = 0;     ///< states, parameters, time, as in Program::inputs
  int unit = 0;       ///< of time: coefficient k is that of (t/unit)^k
  int rates = 0;
  int values = 0;
  int stride = 0;             ///< from a series to the next
  int states = 0;             ///< coefficient 0 of the first state; the others follow by `stride`
  std::vector<int> followed;  ///< the series of the outputs of `flow` that are no rates
  std::vector<int> singular;  ///< series that may end sooner than those of the states
  std::vector<int> kinks;     ///< series at whose zeros a function has a kink or a jump
  bool needs_comparison = false;  ///< it has functions whose value the series may lose on their way
};

/// Writes the module, byte by byte: no compiler takes part. The recurrences are those of
/// runtime/program/function_table.hpp (Griewank & Walther, Evaluating Derivatives, 2008,
/// Tables 13.1 and 13.2). Parameters are inputs and stay open.
/// \param flow  its inputs are the states, the parameters and the time; its outputs are the rates of
///              the states, and what else is to be followed as a series, to order - 1.
/// \param values  of the same inputs.
/// \param limits  of the constants, see `codegen::constant_value`
/// \throws ModelError  for constants that are no doubles, and for programs of more than 20,000 lines
WasmSeries emit_wasm(const Program& flow, std::size_t states, const Program& values, int order,
                     const Limits& limits);

/// Two programs with the same inputs as one: the outputs of the first, then those of the second.
Program side_by_side(const Program& first, const Program& second);

}  // namespace casimir
