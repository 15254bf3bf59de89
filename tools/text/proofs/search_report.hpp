#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "symbolic/model.hpp"
#include "symbolic/search/conditions/darboux_conditions.hpp"
#include "symbolic/search/darboux.hpp"
#include "symbolic/search/search.hpp"

namespace casimir::tools {

/// " in the variables and exp(x)": what the functions of a search are polynomials in; empty where
/// these are the variables alone.
std::string in_functions(const std::vector<std::string>& functions);

/// The interface's document for `search`.
nlohmann::ordered_json to_json(const Model& model, int degree, const search::Report& report,
                               double seconds);

nlohmann::ordered_json to_json(const Model& model, int degree,
                               const search::ConditionReport& report, double seconds);
nlohmann::ordered_json to_json(const Model& model, int degree, const search::DarbouxReport& report,
                               double seconds);
nlohmann::ordered_json to_json(const Model& model, int degree,
                               const search::DarbouxConditionReport& report, double seconds);
nlohmann::ordered_json to_json(const Model& model, int degree, const search::RationalReport& report,
                               double seconds);

/// The same for a person.
void print(const Model& model, int degree, const search::Report& report, double seconds);
void print(const Model& model, int degree, const search::ConditionReport& report, double seconds);
void print(const Model& model, int degree, const search::DarbouxReport& report, double seconds);
void print(const Model& model, int degree, const search::DarbouxConditionReport& report,
           double seconds);
void print(const Model& model, int degree, const search::RationalReport& report, double seconds);

}  // namespace casimir::tools
