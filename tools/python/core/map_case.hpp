#pragma once

#include <memory>
#include <string>

#include "symbolic/discrete/map_model.hpp"
#include "tools/python/core/case.hpp"

namespace casimir::python {

/// The case of a map as Python holds it. As `Case`, it does not change.
class MapCase {
 public:
  /// \throws CaseError
  static std::shared_ptr<MapCase> load(const std::string& name);
  /// \param file  names the text in messages, and without its ending the case.
  /// \throws CaseError
  static std::shared_ptr<MapCase> from_text(const std::string& text, const std::string& file);
  /// Ends the model where no other thread computes.
  ~MapCase();

  /// The same map with numbers in the place of parameters, and other starts of variables.
  /// \throws CaseError  with the nearest name for one that is none.
  std::shared_ptr<MapCase> with(const Values& parameters, const Values& initial,
                                bool rounded) const;

  const std::string& text() const { return text_; }  ///< without the changes
  const std::string& file() const { return source_.file.file; }
  const Values& parameters() const { return parameters_; }  ///< as they were given to `with`
  const Values& initial() const { return initial_; }        ///< the same
  bool rounded() const { return rounded_; }                 ///< some start is a double
  const MapModel& map() const { return *map_; }             ///< with the changes

 private:
  MapCase() = default;
  void build();

  std::string text_;
  MapCaseFile source_;
  Values parameters_, initial_;
  bool rounded_ = false;
  std::unique_ptr<MapModel> map_;
};

}  // namespace casimir::python
