#include "tools/section/plane_options.hpp"

#include "tools/cli/options/choices.hpp"

namespace casimir::tools {

void add_plane_options(CLI::App& command, SectionOptions& request) {
  command.add_option("--energy", request.energy, "Value of the Hamiltonian (default: the scene's)")
      ->type_name("VALUE");
  command
      .add_option("--casimir", request.casimirs,
                  "Value of a Casimir function of the case (default: the scene's; repeatable)")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  command
      .add_option("--plane", request.plane,
                  "The surface: an expression, which is zero there, or LEFT = RIGHT (default: that "
                  "of [section])")
      ->type_name("EXPR");
  command
      .add_option("--direction", request.direction, "In which it is crossed: up (default) or down")
      ->check(one_of({"up", "down"}))
      ->type_name("DIRECTION");
  command
      .add_option("--pair", request.pair,
                  "The two functions that are plotted (default: those of [section])")
      ->expected(2)
      ->type_name("U V");
  command.add_option("--labels", request.labels, "Labels of the axes of a picture")
      ->expected(2)
      ->type_name("U V");
}

}  // namespace casimir::tools
