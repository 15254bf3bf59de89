#include "tools/python/core/case.hpp"

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tools/analysis/scene_values.hpp"
#include "tools/cli/case_library.hpp"
#include "tools/python/core/guard.hpp"
#include "tools/runs/atlas.hpp"

namespace casimir::python {

namespace {

std::vector<Entry> entries(const Values& values, const std::string& where) {
  std::vector<Entry> result;
  for (const auto& [name, value] : values)
    result.emplace_back(typed(name, where), typed(value, where));
  return result;
}

}  // namespace

Text typed(const std::string& text, const std::string& where) {
  return {text, {where, 1, 1}, text};
}

std::vector<Text> typed(const Names& texts, const std::string& where) {
  std::vector<Text> result;
  for (const std::string& text : texts) result.push_back(typed(text, where));
  return result;
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Values with_others(Values values, const Values& others) {
  for (const auto& value : others) {
    std::erase_if(values, [&](const auto& other) { return other.first == value.first; });
    values.push_back(value);
  }
  return values;
}

std::shared_ptr<Case> Case::load(const std::string& name) {
  const ExactAlgebra guard;
  const std::shared_ptr<Case> result(new Case);
  result->source_ = tools::load_case(name, {});
  result->text_ = text_of_file(result->source_.file);
  result->build();
  return result;
}

std::shared_ptr<Case> Case::from_text(const std::string& text, const std::string& file) {
  const ExactAlgebra guard;
  const std::shared_ptr<Case> result(new Case);
  result->source_ = parse_case(text, file);
  result->text_ = text;
  result->build();
  return result;
}

Case::~Case() {
  const ExactAlgebra guard;
  notation_.reset();
  model_.reset();
}

std::shared_ptr<Case> Case::copied() const {
  const std::shared_ptr<Case> result(new Case);
  result->text_ = text_;
  result->source_ = source_;
  result->parameters_ = parameters_;
  result->initial_ = initial_;
  result->rounded_ = rounded_;
  result->set_ = set_;
  return result;
}

std::shared_ptr<Case> Case::in_variables(const std::string& set) const {
  const ExactAlgebra guard;
  const std::shared_ptr<Case> result = copied();
  result->set_ = set;
  result->build();
  return result;
}

std::shared_ptr<Case> Case::with(const Values& parameters, const Values& initial,
                                 bool rounded) const {
  const ExactAlgebra guard;
  const std::shared_ptr<Case> result = copied();
  result->parameters_ = with_others(parameters_, parameters);
  result->initial_ = with_others(initial_, initial);
  result->rounded_ = rounded_ || rounded;
  result->build();
  return result;
}

std::shared_ptr<const Case> Case::with_scene_parameters(const Values& parameters) const {
  const ExactAlgebra guard;
  const std::shared_ptr<Case> result = copied();
  Names known;
  for (const ParameterText& parameter : source_.parameters) known.push_back(parameter.name.value);
  for (const auto& [name, value] : entries(parameters, "parameters")) {
    if (std::ranges::find(known, name.value) == known.end())
      throw name.error("'" + printable(name.value) + "' is not a parameter of this case", 0,
                       suggest_or_list(name.value, known, "parameters"));
    set_in_scenes(result->source_, &SceneText::parameters, name, value);
  }
  result->build();
  return result;
}

void Case::build() {
  const CaseFile changed = with_initial_values(source_, entries(initial_, "initial"), rounded_);
  model_ = std::make_unique<Model>(
      tools::in_variables(tools::model_of(changed, entries(parameters_, "parameters")), set_));
}

tools::Written Case::shown(const GiNaC::ex& e) const {
  if (!notation_) notation_ = std::make_unique<tools::Notation>(*model_);
  return notation_->components(e);
}

}  // namespace casimir::python
