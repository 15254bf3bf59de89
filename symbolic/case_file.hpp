#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/indices.hpp"

namespace casimir {

/// A line of source, which all texts in it share: copies would take the square of its length.
class SourceLine {
 public:
  SourceLine() = default;
  /// Of a line, without its end.
  SourceLine(const char* text) : SourceLine(std::string(text)) {}
  /// Of a line, without its end.
  SourceLine(std::string text) : text_(std::make_shared<const std::string>(std::move(text))) {}

  /// The line; empty where none was given.
  const std::string& text() const {
    static const std::string none;
    return text_ ? *text_ : none;
  }

 private:
  std::shared_ptr<const std::string> text_;
};

/// A string of a case file (or of the command line) and where it stands.
struct Text {
  std::string value;
  Location where;      ///< of the first character of `value`
  SourceLine excerpt;  ///< the source line, if `value` stands in it unchanged
  /// What letters stand for in it, where its key is one of a family; may be null.
  std::shared_ptr<const Indices> indices{};

  /// The error that something is wrong at `offset` bytes into this text.
  CaseError error(const std::string& what, std::size_t offset = 0, const std::string& hint = {},
                  double Limits::*limit = nullptr) const;
  /// The same of what exceeds a limit; the hint says what allows more.
  CaseError beyond(const Limits& limits, double Limits::*limit, const std::string& what,
                   std::size_t offset = 0) const {
    return error(what, offset, limits.hint(limit), limit);
  }
};

using Entry = std::pair<Text, Text>;  ///< key and value

/// The vector field that belongs to a quasi-velocity: its components along some coordinates (the
/// others are zero), filed under the momentum conjugate to that quasi-velocity.
struct VectorFieldText {
  Text momentum;
  std::vector<Entry> components;  ///< coordinate and expression
};

/// The frame of the Poincare-Chetaev equations.
struct VectorFieldsText {
  Location where;
  std::vector<Text> coordinates, momenta;
  std::vector<Text> velocities;  ///< names of the quasi-velocities, for a Lagrangian; may be empty
  std::vector<VectorFieldText> fields;
};

/// The phase space as written: which of its forms is used is for the model to decide.
struct PhaseSpaceText {
  Location where;
  std::vector<Text> variables;
  std::optional<Text> algebra;
  bool canonical = false;
  std::optional<std::vector<Entry>> brackets;
  std::optional<std::vector<Entry>> structure_constants;
  std::optional<VectorFieldsText> vector_fields;
  std::optional<Text> sign;
  std::vector<Text> domain;
  std::vector<Text> constraints;
  std::optional<Text> dirac;  ///< the place where it is `true`
  std::optional<Text> time;
};

/// A claim about the zero level of some functions: see LevelClaim.
struct LevelText {
  Text name;
  Text expression;
  std::vector<Text> on;
};

/// See Identity.
struct IdentityText {
  Text name;
  Text left;
  std::optional<Text> right;  ///< else zero
  std::vector<Text> on;
};

/// See LaxPair.
struct LaxText {
  std::optional<Text> spectral;
  std::vector<std::vector<Text>> l, a;
  std::vector<Text> on;  ///< the level that it is one on; empty: everywhere
};

/// A right inverse of a map: this case's variables as functions of those of the map's target.
struct MapInverseText {
  std::vector<Entry> expressions;
  std::vector<Text> domain;
};

/// See PoissonMap.
struct MapText {
  Text name;
  std::optional<Text> to;                  ///< an algebra or a case
  std::optional<PhaseSpaceText> to_table;  ///< or a phase space written out
  std::vector<Entry> expressions;
  std::vector<Text> on;
  std::optional<Text> sign;
  std::vector<Text> image;  ///< functions on the target that vanish on the image
  std::vector<MapInverseText> inverses;
};

/// See Measure.
struct MeasureText {
  Text density;
  bool every_hamiltonian = false;
};

/// See Section.
struct SectionText {
  Text function;
  std::optional<Text> direction;
  std::vector<Text> plot;
  std::vector<Text> labels;     ///< of the axes of a picture
  std::optional<Text> energy;   ///< the level; without it that of the scene
  std::vector<Entry> casimirs;  ///< the same for Casimir functions
};

/// See Scene.
struct SceneText {
  Text name;
  std::vector<Entry> parameters;
  std::vector<Entry> initial;
  std::optional<Text> duration;
  std::vector<Text> on;
  bool altered = false;  ///< values were given from outside: it may be off its levels
  bool rounded = false;  ///< and by doubles: rounding alone takes it off a level
  std::vector<Text> observe;
  std::optional<Text> extreme;
  std::vector<Entry> reference;
};

/// A parameter and what is assumed of it.
struct ParameterText {
  Text name;
  std::vector<Text> assume;
};

/// A case file as strings with their places: the structure is checked, no expression is read yet.
/// Tables keep the order of the file.
struct CaseFile {
  std::string name;  ///< file name without folder and extension
  std::string file;  ///< as messages show it
  std::string title;
  std::string source;
  std::string book;  ///< section or appendix of the book, as "2.4"; may be empty
  std::vector<std::string> tags;
  bool integrable = false;
  bool superintegrable = false;
  bool complex_numbers = false;  ///< some string has I as a word of its own
  std::optional<Text> hamiltonian;
  std::optional<Text> lagrangian;
  PhaseSpaceText phase_space;
  std::vector<ParameterText> parameters;
  std::vector<Entry> definitions, casimirs, integrals;
  std::optional<std::vector<Entry>> equations;
  std::vector<LevelText> conditionals, invariant_relations;
  std::vector<LaxText> lax;
  std::vector<MapText> maps;
  std::vector<MeasureText> measures;
  std::vector<IdentityText> identities;
  std::optional<SectionText> section;
  std::vector<SceneText> scenes;
  Limits limits{};  ///< that it was read under, and that hold for what is made of it
};

/// Reads a case file.
/// \param limits  hold for the file, and for the model and whatever else is made of it
/// \throws CaseError  for a file that cannot be read, broken TOML, an unknown or missing key, or a
///                    value of the wrong type, with its place.
CaseFile read_case(const std::filesystem::path& path, const Limits& limits = {});

/// The same for text in memory; `file` names it in messages.
CaseFile parse_case(const std::string& toml, const std::string& file, const Limits& limits = {});

}  // namespace casimir
