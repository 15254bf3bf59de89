#pragma once

#include <optional>
#include <vector>

#include "symbolic/discrete/map_model.hpp"
#include "symbolic/discrete/modular_program.hpp"
#include "symbolic/discrete/series_field.hpp"

namespace casimir::discrete {

/// A rational map and its Jacobian matrix at points whose coordinates are series, with random
/// values of the parameters.
class SeriesMap {
 public:
  /// \throws ModelError  for a map that is not rational
  explicit SeriesMap(const MapModel& map);
  /// Kahan's map of a quadratic flow, with a random step.
  /// \throws ModelError  as above, and for a flow that is not quadratic
  static SeriesMap kahan(const Model& flow);

  std::size_t dimension() const { return dimension_; }
  /// Other random values of the parameters, and of the step of Kahan's map.
  void choose_parameters();
  /// One for each coordinate.
  std::vector<Element> random_point() const;

  struct Image {
    std::vector<Series> point;
    SeriesField::Rows jacobian;
  };
  /// Empty where a denominator is zero.
  /// \throws TooFewTerms
  std::optional<Image> operator()(const std::vector<Series>& point, const SeriesField& field) const;

 private:
  SeriesMap(const Model& model, const std::vector<GiNaC::ex>& functions);
  std::optional<std::vector<Series>> run(const std::vector<Series>& point,
                                         const SeriesField& field) const;
  std::optional<std::vector<Series>> run_numbers(const std::vector<Series>& point,
                                                 const SeriesField& field) const;
  std::optional<Image> kahan_image(const std::vector<Series>& point,
                                   const SeriesField& field) const;

  std::size_t dimension_;
  ModularProgram program_;  ///< of functions and their derivatives
  std::vector<Element> parameters_;
  std::optional<Element> half_step_;  ///< of Kahan's map
  mutable std::mt19937_64 random_{20231105};
};

}  // namespace casimir::discrete
