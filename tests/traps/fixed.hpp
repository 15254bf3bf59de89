#pragma once

#include <filesystem>

#include "tests/traps/scene.hpp"

namespace casimir::traps {

/// A scene that is written down as a case file: its kind is the first of its tags, and its truth
/// the `reference` in it, where there is one. A number `singular_at` says that there is none, and
/// `limit` is the longest step of the reference integrator: both stand in a comment `# name:
/// value`. \throws std::runtime_error  for what is no such file
Scene read_scene(const std::filesystem::path& file);

/// All of a folder, by name.
std::vector<Scene> read_scenes(const std::filesystem::path& folder);

}  // namespace casimir::traps
