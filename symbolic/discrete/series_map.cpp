#include "symbolic/discrete/series_map.hpp"

#include "symbolic/discrete/kahan.hpp"

namespace casimir::discrete {
namespace {

/// The functions, and behind them their derivatives row by row.
std::vector<GiNaC::ex> with_derivatives(const Model& model, std::vector<GiNaC::ex> functions) {
  const std::size_t count = functions.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (const GiNaC::symbol& x : model.variables) functions.push_back(functions[i].diff(x));
  }
  return functions;
}

}  // namespace

SeriesMap::SeriesMap(const Model& model, const std::vector<GiNaC::ex>& functions)
    : dimension_(model.variables.size()),
      program_(model.symbols(), with_derivatives(model, functions), kSplittingPrime) {
  parameters_.resize(model.parameters.size());
  choose_parameters();
}

void SeriesMap::choose_parameters() {
  const PrimeField field(kSplittingPrime);
  for (Element& value : parameters_) value = field.random(random_);
  if (half_step_) half_step_ = field.random(random_);
}

SeriesMap::SeriesMap(const MapModel& map) : SeriesMap(map.base, map.next) {}

SeriesMap SeriesMap::kahan(const Model& flow) {
  check_quadratic(flow);
  SeriesMap map(flow, flow.field);
  map.half_step_ = 1;
  map.choose_parameters();
  return map;
}

std::vector<Element> SeriesMap::random_point() const {
  std::vector<Element> point;
  for (std::size_t i = 0; i < dimension_; ++i)
    point.push_back(PrimeField(kSplittingPrime).random(random_));
  return point;
}

std::optional<std::vector<Series>> SeriesMap::run(const std::vector<Series>& point,
                                                  const SeriesField& field) const {
  if (field.has_numbers_only()) return run_numbers(point, field);
  std::vector<Series> arguments = point;
  for (const Element value : parameters_) arguments.push_back(field.constant(value));
  return program_.run_over(arguments, field);
}

/// The same at a point of the field, which is quicker.
std::optional<std::vector<Series>> SeriesMap::run_numbers(const std::vector<Series>& point,
                                                          const SeriesField& field) const {
  std::vector<Element> arguments;
  for (const Series& x : point) {
    if (!x.is_zero() && (x.valuation != 0 || x.terms.empty())) throw TooFewTerms();
    arguments.push_back(x.is_zero() ? 0 : x.terms[0]);
  }
  arguments.insert(arguments.end(), parameters_.begin(), parameters_.end());
  const auto values = program_.run(arguments);
  if (!values) return std::nullopt;
  std::vector<Series> result;
  for (const Element value : *values) result.push_back(field.constant(value));
  return result;
}

std::optional<SeriesMap::Image> SeriesMap::operator()(const std::vector<Series>& point,
                                                      const SeriesField& field) const {
  if (half_step_) return kahan_image(point, field);
  const auto values = run(point, field);
  if (!values) return std::nullopt;
  Image image{{values->begin(), values->begin() + static_cast<long>(dimension_)}, {}};
  for (std::size_t i = 0; i < dimension_; ++i) {
    const auto begin = values->begin() + static_cast<long>(dimension_ * (i + 1));
    image.jacobian.emplace_back(begin, begin + static_cast<long>(dimension_));
  }
  return image;
}

/// (I - (eps/2) f'(x)) (x' - x) = eps f(x), and since (x' - x)/eps is bilinear in x and x',
/// (I - (eps/2) f'(x)) dx' = (I + (eps/2) f'(x')) dx.
std::optional<SeriesMap::Image> SeriesMap::kahan_image(const std::vector<Series>& point,
                                                       const SeriesField& field) const {
  const std::size_t n = dimension_;
  const auto here = run(point, field);
  if (!here) return std::nullopt;
  const auto matrix = [&](const std::vector<Series>& values, Element factor) {
    SeriesField::Rows rows(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const Series slope = field.scaled(values[n + i * n + j], factor);
        rows[i].push_back(i == j ? field.add(field.constant(1), slope) : slope);
      }
    }
    return rows;
  };
  const PrimeField residues(kSplittingPrime);
  const SeriesField::Rows left = matrix(*here, residues.subtract(0, *half_step_));
  SeriesField::Rows rows = left;
  for (std::size_t i = 0; i < n; ++i)
    rows[i].push_back(field.scaled((*here)[i], residues.add(*half_step_, *half_step_)));
  if (field.eliminate(rows).is_zero()) return std::nullopt;
  Image image;
  for (std::size_t i = 0; i < n; ++i) image.point.push_back(field.add(point[i], rows[i][n]));
  const auto there = run(image.point, field);
  if (!there) return std::nullopt;
  const SeriesField::Rows right = matrix(*there, *half_step_);
  rows = left;
  for (std::size_t i = 0; i < n; ++i)
    rows[i].insert(rows[i].end(), right[i].begin(), right[i].end());
  if (field.eliminate(rows).is_zero()) return std::nullopt;
  for (std::size_t i = 0; i < n; ++i)
    image.jacobian.emplace_back(rows[i].begin() + static_cast<long>(n), rows[i].end());
  return image;
}

}  // namespace casimir::discrete
