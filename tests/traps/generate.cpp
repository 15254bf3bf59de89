#include "tests/traps/generate.hpp"

#include "tests/traps/kinds.hpp"

namespace casimir::traps {
namespace {

struct Kind {
  std::string name;
  std::vector<Maker> shapes;
};

const std::vector<Kind>& all() {
  static const std::vector<Kind> kinds = {
      {"pulse", pulse_shapes()}, {"quiet", quiet_shapes()},       {"wall", wall_shapes()},
      {"well", well_shapes()},   {"late", late_shapes()},         {"scales", scale_shapes()},
      {"rest", rest_shapes()},   {"singular", singular_shapes()}, {"faint", faint_shapes()}};
  return kinds;
}

}  // namespace

Scene generated(std::uint64_t seed, std::uint64_t index) {
  const Kind& kind = all()[index % all().size()];
  Random random(seed, index);
  return kind.shapes[index / all().size() % kind.shapes.size()](random);
}

Texts kinds() {
  Texts names;
  for (const Kind& kind : all()) names.push_back(kind.name);
  return names;
}

}  // namespace casimir::traps
