#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/model.hpp"
#include "tools/show/notation.hpp"

namespace casimir::python {

using Names = std::vector<std::string>;
/// Names with exact numbers as case files have them.
using Values = std::vector<std::pair<std::string, std::string>>;
/// Names of variables with the highest degree in them.
using DegreesIn = std::vector<std::pair<Names, int>>;

/// A case as Python holds it: its text, what was changed in it, and the model of that.
class Case {
 public:
  /// \throws CaseError
  static std::shared_ptr<Case> load(const std::string& name);
  /// \param file  names the text in messages, and without its ending the case.
  /// \throws CaseError
  static std::shared_ptr<Case> from_text(const std::string& text, const std::string& file);
  /// Ends the model where no other thread computes.
  ~Case();

  /// The same case with numbers in the place of parameters, and other starts of variables.
  /// \param rounded  some start is a double: it may be off a level by rounding.
  /// \throws CaseError  with the nearest name for one that is none.
  std::shared_ptr<Case> with(const Values& parameters, const Values& initial, bool rounded) const;

  /// The same case with other values of parameters in all scenes, which stay parameters.
  /// \throws CaseError  with the nearest name for one that is none.
  std::shared_ptr<const Case> with_scene_parameters(const Values& parameters) const;

  /// The same case in other variables, as "euler-angles": equations, integrals and scenes are
  /// carried along the maps of the bundled cases. Starts that `with` changes stay those of the
  /// case's own variables.
  /// \throws ModelError  for an unknown set, or one that no maps lead to
  /// \throws SingularPoint  where a scene begins at a point that these variables cannot describe
  std::shared_ptr<Case> in_variables(const std::string& set) const;

  /// The text that it was read from, without the changes.
  const std::string& text() const { return text_; }
  /// What names it in messages.
  const std::string& file() const { return source_.file; }
  /// As they were given to `with`.
  const Values& parameters() const { return parameters_; }
  /// The same.
  const Values& initial() const { return initial_; }
  /// The variables that it is in; empty: its own.
  const std::string& set() const { return set_; }
  /// Whether one of the starts is a double.
  bool rounded() const { return rounded_; }
  /// With the changes.
  const Model& model() const { return *model_; }
  /// An expression as case files or LaTeX have it. The caller may use exact algebra.
  tools::Written shown(const GiNaC::ex& e) const;

 private:
  Case() = default;
  /// The same text and the same changes, without a model.
  std::shared_ptr<Case> copied() const;
  void build();

  std::string text_;
  CaseFile source_;
  Values parameters_, initial_;
  bool rounded_ = false;
  std::string set_;
  std::unique_ptr<Model> model_;
  mutable std::unique_ptr<tools::Notation> notation_;  ///< made where it is asked for
};

/// What Python typed, with a place for messages.
Text typed(const std::string& text, const std::string& where);
/// The text of a file that was just read as a case.
std::string text_of_file(const std::string& path);

/// The values, with others in the place of those that have the same names.
Values with_others(Values values, const Values& others);

/// The same as `typed` for a list.
std::vector<Text> typed(const Names& texts, const std::string& where);

}  // namespace casimir::python
