#pragma once

#include <nlohmann/json.hpp>

#include "symbolic/structure/brackets.hpp"
#include "symbolic/structure/conformal.hpp"
#include "symbolic/structure/orbital.hpp"
#include "symbolic/structure/tensors.hpp"

namespace casimir::tools {

/// The document of `search` for invariant tensors.
nlohmann::ordered_json to_json(const Model& model, int degree,
                               const structure::TensorReport& report, double seconds);
/// The document of `search` for brackets, first or second ones.
nlohmann::ordered_json to_json(const Model& model, int degree,
                               const structure::BracketReport& report, double seconds);

/// The document of `search` for symmetries of orbits.
nlohmann::ordered_json to_json(const Model& model, int degree,
                               const structure::OrbitalReport& report, double seconds);

/// The document of `search` for conformal tensors.
nlohmann::ordered_json to_json(const Model& model, int degree,
                               const structure::ConformalReport& report, double seconds);

/// The same for people.
void print(const Model& model, int degree, const structure::ConformalReport& report,
           double seconds);
void print(const Model& model, int degree, const structure::TensorReport& report, double seconds);
void print(const Model& model, int degree, const structure::OrbitalReport& report, double seconds);
void print(const Model& model, int degree, const structure::BracketReport& report, double seconds);

}  // namespace casimir::tools
