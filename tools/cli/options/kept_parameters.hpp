#pragma once

#include <string>
#include <vector>

#include "tools/cli/case_library.hpp"
#include "tools/cli/cli_names.hpp"

namespace casimir::tools {

/// `--keep-params[=A,B]`: parameters that stay arguments of the generated code, so that one module
/// serves all their values. Without the option none, without names all.
class KeptParameters {
 public:
  void add_to(CLI::App& command);

  /// The model of a case with the values of `--param`: those of kept parameters take the place of
  /// every scene's, the others are put in before anything else happens.
  /// \throws CaseError
  Model model_of(const CaseFile& file, const ParameterValues& given) const;

  /// The same for the case of a map.
  MapModel map_model_of(const MapCaseFile& file, const ParameterValues& given) const;

  bool given() const { return !text_.empty(); }

  /// Sets `fold_parameters` and `keep_parameters`.
  template <class Options>
  Options in(Options options = {}) const {
    options.fold_parameters = options.fold_parameters && !all();
    if (!all()) options.keep_parameters = names();
    return options;
  }

 private:
  /// A case with the values of kept parameters in its scenes, and the values of the others.
  struct Chosen {
    CaseFile file;
    ParameterValues fixed;
  };
  Chosen chosen(const CaseFile& file, const ParameterValues& given) const;
  bool all() const;
  std::vector<std::string> names() const;

  std::string text_;  ///< empty, "true" for the option alone, or the names
};

}  // namespace casimir::tools
