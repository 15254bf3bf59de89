#include "tools/cli/options/motion_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "tools/cli/errors.hpp"

namespace casimir::tools {
namespace {

/// Splits at commas outside brackets: "atan2(M1, M2), M3".
std::vector<std::string> parts(const std::string& text) {
  std::vector<std::string> result(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0)
      result.emplace_back();
    else
      result.back() += c;
  }
  for (std::string& part : result) {
    part.erase(0, std::min(part.find_first_not_of(' '), part.size()));
    part.erase(part.find_last_not_of(' ') + 1);
  }
  return result;
}

std::string vector_name(const std::string& option) { return option == "true" ? "" : option; }

}  // namespace

void MotionOptions::add_to(CLI::App& command) {
  command
      .add_option(
          "--plot", file_,
          "Draw the motion to this .svg, .png, .pdf or .tex file: states against time, or what the "
          "following options say")
      ->type_name("FILE.svg|png|pdf");
  command
      .add_option("--plot-y", against_time_,
                  "With --plot: these against time, states or expressions such as M1^2 + M2^2")
      ->allow_extra_args(false)
      ->type_name("A,B");
  command
      .add_option("--plot-xy", phase_,
                  "With --plot: a phase curve, B against A; states, expressions, or t")
      ->type_name("A,B");
  command.add_flag("--plot-sphere", sphere_,
                   "With --plot: a vector of constant length on its sphere (with =NAME: this one)");
  command.add_flag("--plot-apex", apex_,
                   "With --plot: the third axis of the body in space, the apex on the fixed sphere "
                   "(with =NAME: NAME is vertical)");
}

void MotionOptions::check() const {
  const int kinds = static_cast<int>(!against_time_.empty()) + static_cast<int>(!phase_.empty()) +
                    static_cast<int>(!sphere_.empty()) + static_cast<int>(!apex_.empty());
  if (file_.empty()) {
    if (kinds > 0)
      throw UsageError(
          "--plot-y, --plot-xy, --plot-sphere and --plot-apex need --plot FILE.svg, .png, .pdf or "
          ".tex");
    return;
  }
  check_plot_name(file_);
  if (kinds > 1)
    throw UsageError(
        "--plot-y, --plot-xy, --plot-sphere and --plot-apex are different pictures: give one");
  if (!phase_.empty() && parts(phase_).size() != 2)
    throw UsageError(
        fmt::format("--plot-xy '{}': expected two, as in --plot-xy M1,M2", printable(phase_)));
}

Plot MotionOptions::picture(const Model& model, const Scene& scene, const Motion& motion) const {
  if (!phase_.empty()) {
    const std::vector<std::string> pair = parts(phase_);
    return phase_picture(model, scene, motion, pair[0], pair[1]);
  }
  if (!sphere_.empty()) return sphere_picture(model, scene, motion, vector_name(sphere_));
  if (!apex_.empty()) return apex_picture(model, scene, motion, vector_name(apex_));
  std::vector<std::string> names;
  for (const std::string& text : against_time_)
    for (std::string& part : parts(text)) names.push_back(std::move(part));
  return time_picture(model, scene, motion, names);
}

}  // namespace casimir::tools
