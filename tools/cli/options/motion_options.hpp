#pragma once

#include <string>
#include <vector>

#include "tools/cli/cli_names.hpp"
#include "tools/plot/motion_plot.hpp"

namespace casimir::tools {

/// `--plot` of integrate: states against time, and what else can be drawn of a motion.
class MotionOptions {
 public:
  void add_to(CLI::App& command);

  bool wanted() const { return !file_.empty(); }
  const std::string& file() const { return file_; }

  /// \throws UsageError  for a name that is no picture's, or options that do not go together
  void check() const;

  /// \throws UsageError, CaseError
  Plot picture(const Model& model, const Scene& scene, const Motion& motion) const;

 private:
  std::string file_;
  std::vector<std::string> against_time_;
  std::string phase_;          ///< "A,B"
  std::string sphere_, apex_;  ///< empty, "true" for the option alone, or a name
};

}  // namespace casimir::tools
