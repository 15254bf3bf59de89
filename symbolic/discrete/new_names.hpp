#pragma once

#include <set>
#include <string>
#include <vector>

#include "symbolic/model.hpp"

namespace casimir::discrete {

/// Names for what a map has beside the case that it was made of.
class NewNames {
 public:
  /// No name of a symbol, a definition or a function of the case is given out.
  explicit NewNames(const Model& model);

  /// The first of these that is free, or the first one with a number behind it; it is taken then.
  std::string take(const std::vector<std::string>& wanted);

 private:
  std::set<std::string> taken_;
};

}  // namespace casimir::discrete
