#pragma once

#include "runtime/methods.hpp"
#include "tools/analysis/run/prepared_scene.hpp"

namespace casimir {

/// What `auto` begins with: the method of Taylor series or, for a dozen states and more that have
/// to be compiled anyhow, dop853, if by a model of their costs it takes well less time: where few
/// digits are asked for. Tables need no compiler, which no shorter run makes up for, and stay.
/// Equations with branches stay with Taylor series, too, which know them best.
/// \param tolerance  relative; 0 for a constant step.
const Method& smooth_method(const PreparedScene& run, double tolerance);

/// Whether a closed form, if there is one, is the fastest for `auto`: where the run is so long that
/// all the steps of another method take more than it does to find the form and to show it to those
/// who watch. The length is that in units in which the state at the start changes by its own size;
/// for each sample that is asked for it has to be longer by what the form takes to give it. Never
/// with a constant step or with parameters at run time, and not where $CASIMIR_CLOSED_FORMS is
/// "off".
bool closed_form_pays(const PreparedScene& run, const Settings& settings);

}  // namespace casimir
