#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// What became of a module that begins interpreted: whether a run was so long that the rest of it
/// was compiled.
struct LaterCode {
  bool compiled = false;
  bool from_cache = false;
  bool missing = false;  ///< it could not be: there is no compiler
  double seconds = 0;    ///< to compile or fetch it
};

/// A module, and what becomes of it.
struct BegunModule {
  CompiledModule code;
  std::shared_ptr<const LaterCode> later;  ///< where it begins interpreted, else null
};

/// The module of a scene for runs that begin at once, without a compiler: tables where there are
/// any, else programs that are interpreted. Where the first steps show that a run is long, it goes
/// over to compiled code, at a step that depends on the equations and the run only: on neither the
/// clock nor what the cache holds. So the same run gives the same bits, whenever it is made.
///
/// A run is long if the interpreted steps that it needs, as far as can be told from those made,
/// would take more than a twentieth of a second, or five milliseconds for each line of the program
/// if that is more, on a machine that needs the nominal times of interpreted_first.cpp. It is asked
/// after 1, 2, 4, 8 and so on steps, once an eighth of that time has gone by; with a constant step,
/// in the beginning.
///
/// Methods that cannot be interpreted are compiled, as by `compile_for`.
/// \param may_go_over  asked before anything is compiled; false ends the run as stopped. May be
///                     empty.
BegunModule interpreted_first(
    const PreparedScene& run, const Method& method,
    const std::function<bool(double t, const std::vector<double>& x)>& may_go_over = {});

/// As `compile_for`, and compiled whatever the method.
/// \throws CompilerMissing  without a compiler.
CompiledModule compile_always(const PreparedScene& run, const Method& method);

}  // namespace casimir
