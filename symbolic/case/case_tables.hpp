#pragma once

#include "symbolic/case/toml_reader.hpp"
#include "symbolic/discrete/map_case.hpp"

namespace casimir {

/// Reads the tables of a case file: of a flow, or of a map.
class CaseTables : private TomlReader {
 public:
  using TomlReader::line;
  using TomlReader::TomlReader;

  /// \throws CaseError  at the place of what is wrong
  AnyCaseFile read(const toml::table& root);

 private:
  CaseFile read_common(const toml::table& root);
  void read_claims(const toml::table& root, CaseFile& result) const;
  MapCaseFile map_case(const toml::table& root, CaseFile file) const;
  PhaseSpaceText phase_space(const toml::table& table, const std::string& what) const;
  VectorFieldText vector_field(const Text& momentum, const toml::node& node,
                               const std::vector<Text>& coordinates) const;
  VectorFieldsText vector_fields(const toml::table& table) const;
  LevelText level(const toml::table& table, const std::string& what) const;
  MapText map(const toml::table& table, const std::string& what) const;
  SceneText scene(const toml::table& table, const std::string& what) const;
  std::vector<ParameterText> parameters(const toml::table& root) const;
  std::vector<ParameterText> functions(const toml::table& root) const;
};

}  // namespace casimir
