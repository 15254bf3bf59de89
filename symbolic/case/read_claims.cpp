// The claims of a case file, each kind by a function of its own.

#include "symbolic/case/read_claims.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "symbolic/case/case_parts.hpp"
#include "symbolic/case/real_values.hpp"
#include "symbolic/case/toml_keys.hpp"
#include "symbolic/expression/expression_size.hpp"
#include "symbolic/lie_algebra.hpp"
#include "symbolic/model/phase_space.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

class ClaimReader {
 public:
  ClaimReader(const CaseFile& file, const FindCase& find_case, CaseNames& names, Model& model)
      : file_(file), find_case_(find_case), names_(names), model_(model) {}

  void read() {
    if (!model_.poisson && !file_.casimirs.empty()) {
      throw file_.casimirs[0].first.error(
          "a Casimir function needs a bracket, which this phase space does not have");
    }
    if (!model_.poisson && !file_.maps.empty()) {
      throw file_.maps[0].name.error(
          "a Poisson map needs a bracket, which this phase space does not have");
    }
    if (file_.superintegrable && (!model_.poisson || model_.time))
      throw CaseError(
          {file_.file, 1, 1},
          "'superintegrable' counts integrals on the leaves of a bracket, and this case "
          "has no bracket or depends on the time");
    model_.casimirs = read_named(file_.casimirs);
    model_.integrals = read_named(file_.integrals);
    for (const Text& text : file_.phase_space.constraints)
      model_.constraints.push_back(anonymous(text));
    if (file_.phase_space.dirac) add_constraints_to_casimirs();
    for (const LevelText& text : file_.conditionals)
      model_.conditionals.push_back(read_level(text));
    for (const LevelText& text : file_.invariant_relations)
      model_.invariant_relations.push_back(read_level(text));
    for (const LaxText& text : file_.lax) read_lax(text);
    for (const MapText& text : file_.maps) read_map(text);
    for (const MeasureText& text : file_.measures) {
      if (text.every_hamiltonian && !model_.poisson)
        throw text.density.error("'every_hamiltonian' needs a bracket");
      model_.measures.push_back({anonymous(text.density), text.every_hamiltonian});
    }
    for (const IdentityText& text : file_.identities) read_identity(text);
    if (file_.section) read_section(*file_.section);
  }

 private:
  std::vector<NamedExpression> read_named(const std::vector<Entry>& entries) {
    std::vector<NamedExpression> result;
    for (const auto& [name, text] : entries) {
      check_name(name, "a function");
      const Quantity quantity = parse_expression(text, names_);
      result.push_back(named(name, quantity));
      names_.name_function(name, quantity);
      check_name_H(name, quantity.value);
    }
    return result;
  }

  /// The constraints are the Casimir functions of their Dirac bracket: phi1, phi2, .. beside those
  /// that the file names, unless one of these is the same.
  void add_constraints_to_casimirs() {
    const auto is_named = [&](const NamedExpression& constraint) {
      return std::any_of(model_.casimirs.begin(), model_.casimirs.end(), [&](const auto& f) {
        return GiNaC::is_a<GiNaC::numeric>((f.value - constraint.value).expand());
      });
    };
    for (std::size_t i = 0; i < model_.constraints.size(); ++i) {
      if (is_named(model_.constraints[i])) continue;
      NamedExpression casimir = model_.constraints[i];
      casimir.name = fmt::format("phi{}", i + 1);
      while (names_.find(casimir.name) != nullptr) casimir.name += '_';
      model_.casimirs.push_back(std::move(casimir));
    }
  }

  /// Every command calls the Hamiltonian H where it lists the integrals.
  void check_name_H(const Text& name, const ex& value) const {
    if (name.value == "H" && model_.hamiltonian && !value.is_equal(*model_.hamiltonian))
      throw name.error("'H' names the Hamiltonian among the integrals; here it would be another", 0,
                       "give this function another name, or write it as the Hamiltonian");
  }

  LevelClaim read_level(const LevelText& text) {
    LevelClaim claim{named(text.name, parse_expression(text.expression, names_)), {}};
    for (const Text& relation : text.on) claim.on.push_back(anonymous(relation));
    return claim;
  }

  void read_lax(const LaxText& text) {
    const std::size_t n = text.l.size();
    if (n == 0 || text.a.size() != n) {
      throw CaseError(
          {file_.file, text.l.empty() || text.l[0].empty() ? 1 : text.l[0][0].where.line, 1},
          "the matrices L and A of a Lax pair must have the same size");
    }
    LaxPair pair{std::nullopt, GiNaC::matrix(unsigned(n), unsigned(n)),
                 GiNaC::matrix(unsigned(n), unsigned(n))};
    pair.spectral = GiNaC::symbol(text.spectral ? text.spectral->value : "(none)");
    if (text.spectral) {
      check_name(*text.spectral, "the spectral parameter");
      check_symbol_name(*text.spectral);
      if (names_.find(text.spectral->value) != nullptr)
        throw text.spectral->error(fmt::format("'{}' is declared twice", text.spectral->value));
    }
    ExtendedNames names(names_, {*pair.spectral});
    for (unsigned i = 0; i < n; ++i) {
      for (unsigned j = 0; j < n; ++j) {
        const Quantity l = parse_expression(text.l[i][j], names);
        const Quantity a = parse_expression(text.a[i][j], names);
        pair.l(i, j) = l.value;
        pair.a(i, j) = a.value;
        for (const Quantity* entry : {&l, &a})
          for (const ex& part : lost_parts(*entry)) pair.domain.push_back(part);
      }
    }
    if (!text.spectral) pair.spectral.reset();
    for (const Text& relation : text.on) pair.on.push_back(anonymous(relation));
    model_.lax_pairs.push_back(std::move(pair));
  }

  /// The phase space that a map leads to: written out, an algebra, or that of another case.
  PhaseSpaceText target_of(const MapText& text) const {
    if (text.to_table) return *text.to_table;
    if (!find_lie_algebra(text.to->value)) {
      if (const auto found = find_case(text.to->value)) return found->phase_space;
      throw text.to->error(
          fmt::format("'{}' is neither a Lie algebra nor a case", printable(text.to->value)), 0,
          fmt::format("{} (a case would be {}.toml beside this file, or a bundled one)",
                      lie_algebra_hint(text.to->value), printable(text.to->value)));
    }
    PhaseSpaceText target;
    target.where = text.to->where;
    target.algebra = text.to;
    for (const Entry& entry : text.expressions) target.variables.push_back(entry.first);
    return target;
  }

  /// The case of that name: the file beside this one comes first, as the nearest.
  std::optional<CaseFile> find_case(const std::string& name) const {
    if (name.find('/') != std::string::npos) return std::nullopt;
    const auto path = std::filesystem::path(file_.file).parent_path() / (name + ".toml");
    std::error_code problem;
    if (std::filesystem::is_regular_file(path, problem)) return read_case(path, file_.limits);
    return find_case_ ? find_case_(name) : std::nullopt;
  }

  void read_map(const MapText& text) {
    const PhaseSpaceText target = target_of(text);
    const std::vector<GiNaC::symbol> coordinates = make_variables(target, file_.limits);
    NameTable names(
        file_.limits);  // the bracket of the target may have the parameters of this case
    for (const GiNaC::symbol& s : model_.parameters) names.add(s.get_name(), Quantity::symbol(s));
    for (const auto& [parameter, value] : model_.fixed) names.add(parameter.value, measured(value));
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      const std::string name = coordinates[i].get_name();
      // What this file writes over the target's coordinates must not be able to mean a parameter.
      const bool written_here = text.to_table || !text.image.empty() || !text.inverses.empty();
      if (written_here && names.find(name) != nullptr)
        throw(text.to_table ? target.variables[i] : text.name)
            .error(fmt::format("'{}' names a parameter of this case and a variable of 'to'", name));
      names.add(name, Quantity::symbol(coordinates[i]));
    }
    const std::optional<Frame> frame = make_frame(target, coordinates, model_.parameters, names);
    std::vector<ex> target_domain, domain;
    const std::optional<PoissonStructure> bracket =
        make_bracket(target, coordinates, names, frame, &target_domain);
    if (!bracket) throw CaseError(target.where, "the phase space of 'to' needs a bracket");
    PoissonMap map{text.name.value,
                   text.name.where,
                   *bracket,
                   all_components(text.name, text.expressions, coordinates, names_,
                                  "a variable of the phase space of 'to'", domain),
                   {},
                   1,
                   text.to ? text.to->value : std::string{},
                   {},
                   {}};
    GiNaC::exmap image;
    for (std::size_t i = 0; i < coordinates.size(); ++i) image[coordinates[i]] = map.expressions[i];
    const auto need_at_image = [&](const ex& f) {
      for (const ex& part : substituted_with_parts(f, image, file_.limits)) domain.push_back(part);
    };
    for (const ex& part : target_domain) need_at_image(part);
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      for (std::size_t j = i + 1; j < coordinates.size(); ++j) need_at_image((*bracket)(i, j));
    for (const Text& condition : target.domain) {
      std::vector<ex> lost;
      // A map leads into the target's domain: where it does not, nothing is claimed.
      Assumption inside = assumption_of(condition, names, lost);
      for (const ex& part : lost) need_at_image(part);
      need_at_image(inside.difference);
      if (inside.comparison == Comparison::equal) {
        map.image.push_back({condition.value, inside.difference, {}});
        continue;
      }
      inside.difference = substituted(inside.difference, image, file_.limits);
      if (inside.comparison != Comparison::unequal)
        if (const auto part = real_only_where(inside)) domain.push_back(*part);
      map.leads_to.push_back(std::move(inside));
    }
    for (const Text& function : text.image.empty() ? target.constraints : text.image) {
      const Quantity value = parse_expression(function, names);
      map.image.push_back({function.value, value.value, {}});
      for (const ex& part : lost_parts(value)) need_at_image(part);
      need_at_image(value.value);
    }
    map.domain = std::move(domain);
    for (const MapInverseText& inverse : text.inverses) {
      MapInverse& branch = map.inverses.emplace_back();
      branch.expressions = all_components(text.name, inverse.expressions, model_.variables, names,
                                          "a variable of this case", branch.defined_by);
      for (const Text& condition : inverse.domain)
        branch.domain.push_back(assumption_of(condition, names, branch.defined_by));
    }
    for (const Text& relation : text.on) map.on.push_back(anonymous(relation));
    map.sign = sign_of(text.sign);
    model_.maps.push_back(std::move(map));
  }

  void read_identity(const IdentityText& text) {
    const Quantity left = parse_expression(text.left, names_);
    const Quantity right = text.right ? parse_expression(*text.right, names_) : Quantity{0};
    Identity identity{text.name.value, text.name.where, left.value, right.value, {},
                      lost_parts(left)};
    for (const ex& part : lost_parts(right)) identity.domain.push_back(part);
    for (const Text& relation : text.on) identity.on.push_back(anonymous(relation));
    model_.identities.push_back(std::move(identity));
  }

  void read_section(const SectionText& text) {
    Section section{parse_expression(text.function, names_).value, true, {}};
    if (const auto& direction = text.direction) {
      if (direction->value != "up" && direction->value != "down")
        throw direction->error("'direction' must be \"up\" or \"down\"");
      section.upwards = direction->value == "up";
    }
    for (const Text& coordinate : text.plot)
      section.plot.push_back(parse_expression(coordinate, names_).value);
    model_.section = section;
  }

  NamedExpression anonymous(const Text& text) { return casimir::anonymous(text, names_); }

  const CaseFile& file_;
  const FindCase& find_case_;
  CaseNames& names_;
  Model& model_;
};

}  // namespace

void read_claims(const CaseFile& file, const FindCase& find_case, CaseNames& names, Model& model) {
  ClaimReader(file, find_case, names, model).read();
}

}  // namespace casimir
