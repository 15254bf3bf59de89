#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "symbolic/discrete/kahan.hpp"
#include "symbolic/discrete/moser_veselov.hpp"
#include "symbolic/model.hpp"

namespace casimir::tools {

/// A way to make a map of a flow.
struct Discretisation {
  std::string_view option;  ///< of the command line
  std::string_view name;    ///< as a sentence begins with it
  RationalMapText (*map)(const Model& flow, const std::optional<GiNaC::ex>& step);

  /// The option without dashes, for JSON and Python.
  constexpr std::string_view key() const { return option.substr(2); }
};

/// All of them.
inline constexpr std::array kDiscretisations{
    Discretisation{"--kahan", "Kahan's map", kahan_map},
    Discretisation{"--midpoint", "Implicit midpoint rule", midpoint_map},
    Discretisation{"--moser-veselov", "Moser's and Veselov's map", moser_veselov_map}};

/// The case file of a map that was made of a flow.
/// \param method  "Kahan's map"
/// \param value   of the step, as it was typed; without it a scene's step is 1/10
std::string discretised_case(const Model& flow, const RationalMapText& map,
                             const std::string& method, const std::optional<std::string>& value);

}  // namespace casimir::tools
