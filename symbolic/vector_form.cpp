#include "symbolic/vector_form.hpp"

#include <algorithm>
#include <map>

#include "symbolic/expression/expression_size.hpp"

namespace casimir {
namespace {

using GiNaC::ex;
using Symbols = std::vector<GiNaC::symbol>;
using Vector = std::array<ex, 3>;

bool vanishes(const ex& e) {
  return e.expand().is_zero() || (is_fit_for_normal(e) && e.normal().is_zero());
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Reads the brackets between blocks; an answer is none where they have no vector shape.
class VectorReader {
 public:
  VectorReader(const PoissonStructure& structure, const std::vector<Block>& blocks)
      : structure_(structure), blocks_(blocks) {}

  std::optional<BlockBracket> read(std::size_t a, std::size_t b) const {
    const Block& first = blocks_[a];
    const Block& second = blocks_[b];
    if (!first.is_vector()) {
      return BlockBracket{a, b, {}, structure_(first.coordinates[0], second.coordinates[0])};
    }
    if (second.is_vector()) return read_vectors(a, b);
    Vector values;
    for (std::size_t i = 0; i < 3; ++i)
      values[i] = structure_(first.coordinates[i], second.coordinates[0]);
    const auto terms = combination(values);
    if (!terms) return std::nullopt;
    return BlockBracket{a, b, *terms, 0};
  }

 private:
  std::optional<BlockBracket> read_vectors(std::size_t a, std::size_t b) const {
    const auto entry = [&](std::size_t i, std::size_t j) {
      return structure_(blocks_[a].coordinates[i], blocks_[b].coordinates[j]);
    };
    Vector skew;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3;
      const std::size_t j = (k + 2) % 3;
      if (!vanishes(entry(i, j) + entry(j, i)) || !vanishes(entry(i, i) - entry(j, j)))
        return std::nullopt;
      skew[k] = entry(i, j);
    }
    const auto terms = combination(skew);
    if (!terms) return std::nullopt;
    return BlockBracket{a, b, *terms, entry(0, 0)};
  }

  /// The vector as a sum of vector blocks.
  std::optional<std::vector<BlockTerm>> combination(Vector rest) const {
    std::vector<BlockTerm> terms;
    for (std::size_t c = 0; c < blocks_.size() && blocks_[c].is_vector(); ++c) {
      const auto component = [&](std::size_t i) {
        return structure_.coordinates()[blocks_[c].coordinates[i]];
      };
      const ex coefficient = rest[0].diff(component(0)).expand();
      if (coefficient.is_zero()) continue;
      if (has_vectors(coefficient)) return std::nullopt;
      terms.push_back({coefficient, c});
      for (std::size_t i = 0; i < 3; ++i) rest[i] = (rest[i] - coefficient * component(i)).expand();
    }
    if (!std::ranges::all_of(rest, vanishes)) return std::nullopt;
    return terms;
  }

  bool has_vectors(const ex& e) const {
    return std::ranges::any_of(blocks_, [&](const Block& block) {
      return block.is_vector() && std::ranges::any_of(block.coordinates, [&](std::size_t i) {
               return e.has(structure_.coordinates()[i]);
             });
    });
  }

  const PoissonStructure& structure_;
  const std::vector<Block>& blocks_;
};

std::vector<Block> blocks_of(const std::vector<Triple>& triples, const Symbols& coordinates) {
  std::vector<Block> blocks;
  std::vector<bool> taken(coordinates.size());
  for (const Triple& triple : triples) {
    blocks.push_back({triple.name, {triple.indices.begin(), triple.indices.end()}});
    for (const std::size_t i : triple.indices) taken[i] = true;
  }
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (!taken[i]) blocks.push_back({coordinates[i].get_name(), {i}});
  }
  return blocks;
}

/// All brackets between the blocks; `failures` counts for each block how many have no vector shape.
std::vector<BlockBracket> read_all(const PoissonStructure& structure,
                                   const std::vector<Block>& blocks,
                                   std::vector<std::size_t>& failures) {
  const VectorReader reader(structure, blocks);
  std::vector<BlockBracket> brackets;
  failures.assign(blocks.size(), 0);
  for (std::size_t a = 0; a < blocks.size(); ++a) {
    for (std::size_t b = a; b < blocks.size(); ++b) {
      if (a == b && !blocks[a].is_vector()) continue;
      if (const auto bracket = reader.read(a, b)) {
        brackets.push_back(*bracket);
      } else {
        ++failures[a];
        if (a != b) ++failures[b];
      }
    }
  }
  return brackets;
}

/// The triple that is least of a vector, if one is none: first the one that most brackets speak
/// against, and of several one that nothing rotates (it has no bracket with an eps_ijk), the last.
std::optional<std::size_t> no_vector(std::size_t triples, const std::vector<Block>& blocks,
                                     const std::vector<BlockBracket>& brackets,
                                     const std::vector<std::size_t>& failures) {
  std::vector<bool> rotated(triples);
  for (const BlockBracket& bracket : brackets) {
    if (bracket.v.empty() || !blocks[bracket.b].is_vector()) continue;
    rotated[bracket.a] = rotated[bracket.b] = true;
  }
  std::optional<std::size_t> result;
  const auto badness = [&](std::size_t i) { return std::pair(failures[i], !rotated[i]); };
  for (std::size_t i = 0; i < triples; ++i) {
    if (failures[i] == 0 && rotated[i]) continue;
    if (!result || badness(i) >= badness(*result)) result = i;
  }
  return result;
}

/// What the bracket contributes to d(target)/dt, where `source` is the other block. The motion of A
/// in {A_i, B_j} = eps_ijk v_k + delta_ij s is -v x dH/dB + s dH/dB, and that of B the same with s
/// of the other sign; {A_i, t} = v_i gives dA/dt = (dH/dt) v and dt/dt = -(v, dH/dA).
void add_flow(VectorForm& form, const BlockBracket& bracket, std::size_t target,
              std::size_t source) {
  const bool vectors = form.blocks[target].is_vector() && form.blocks[source].is_vector();
  const bool swapped = target != bracket.a;
  const int sign = vectors || swapped ? -1 : 1;
  for (const BlockTerm& term : bracket.v)
    form.flows[target].push_back({sign * term.coefficient, term.block, source});
  if (!bracket.s.is_zero())
    form.flows[target].push_back({swapped ? -bracket.s : bracket.s, std::nullopt, source});
}

VectorForm form_of(std::vector<Block> blocks, std::vector<BlockBracket> brackets) {
  VectorForm form{std::move(blocks), std::move(brackets), {}};
  form.flows.resize(form.blocks.size());
  for (std::size_t target = 0; target < form.blocks.size(); ++target) {
    for (const BlockBracket& bracket : form.brackets) {
      if (bracket.a == target)
        add_flow(form, bracket, target, bracket.b);
      else if (bracket.b == target)
        add_flow(form, bracket, target, bracket.a);
    }
  }
  return form;
}

Vector vector_of(const Block& block, const std::vector<ex>& values) {
  return {values[block.coordinates[0]], values[block.coordinates[1]], values[block.coordinates[2]]};
}

/// The name without its last character, if it could be that of a component: {name, 0 to 2}.
std::optional<std::pair<std::string, std::size_t>> component_name(const std::string& name) {
  if (name.size() < 2) return std::nullopt;
  for (const char* suffixes : {"123", "xyz"}) {
    const std::size_t place = std::string(suffixes).find(name.back());
    if (place == std::string::npos) continue;
    const std::string stem = name.substr(0, name.size() - 1);
    if (stem.back() >= '0' && stem.back() <= '9') return std::nullopt;
    return std::pair(stem + suffixes[0], place);
  }
  return std::nullopt;
}

}  // namespace

std::vector<Triple> find_triples(const std::vector<std::string>& names) {
  std::map<std::string, std::array<std::optional<std::size_t>, 3>> found;  // by the first member
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const auto component = component_name(names[i]))
      found[component->first][component->second] = i;
  }
  std::vector<Triple> triples;
  for (const std::string& name : names) {
    const auto place = found.find(name);
    if (place == found.end()) continue;
    const auto& [x, y, z] = place->second;
    std::string stem = name.substr(0, name.size() - 1);
    if (!x || !y || !z || std::ranges::count(names, stem + "4") > 0) continue;
    while (stem.size() > 1 && stem.back() == '_') stem.pop_back();
    triples.push_back({stem, {*x, *y, *z}});
  }
  return triples;
}

std::optional<VectorForm> find_vector_form(const PoissonStructure& structure) {
  const Symbols& coordinates = structure.coordinates();
  std::vector<std::string> names;
  for (const GiNaC::symbol& x : coordinates) names.push_back(x.get_name());
  std::vector<Triple> triples = find_triples(names);
  while (!triples.empty()) {
    const std::vector<Block> blocks = blocks_of(triples, coordinates);
    std::vector<std::size_t> failures;
    std::vector<BlockBracket> brackets = read_all(structure, blocks, failures);
    const auto rejected = no_vector(triples.size(), blocks, brackets, failures);
    if (!rejected) return form_of(blocks, std::move(brackets));
    triples.erase(triples.begin() + static_cast<std::ptrdiff_t>(*rejected));
  }
  return std::nullopt;
}

std::vector<ex> VectorForm::flow(const Symbols& coordinates, const ex& h) const {
  std::vector<ex> gradient;
  for (const GiNaC::symbol& x : coordinates) gradient.push_back(h.diff(x));
  const std::vector<ex> values(coordinates.begin(), coordinates.end());
  std::vector<ex> result(coordinates.size());
  for (std::size_t target = 0; target < blocks.size(); ++target) {
    for (const FlowTerm& term : flows[target]) {
      const Block& source = blocks[term.gradient];
      if (!blocks[target].is_vector()) {
        ex& sum = result[blocks[target].coordinates[0]];
        for (std::size_t i = 0; i < source.coordinates.size(); ++i) {
          const ex factor = term.left ? values[blocks[*term.left].coordinates[i]] : ex(1);
          sum += term.coefficient * factor * gradient[source.coordinates[i]];
        }
        continue;
      }
      Vector value;
      if (!term.left) {
        value = vector_of(source, gradient);
      } else {
        value = vector_of(blocks[*term.left], values);
        if (source.is_vector())
          value = cross(value, vector_of(source, gradient));
        else
          for (ex& entry : value) entry *= gradient[source.coordinates[0]];
      }
      for (std::size_t i = 0; i < 3; ++i)
        result[blocks[target].coordinates[i]] += term.coefficient * value[i];
    }
  }
  return result;
}

bool reproduces(const VectorForm& form, const Symbols& coordinates, const ex& h,
                const std::vector<ex>& field) {
  const std::vector<ex> own = form.flow(coordinates, h);
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (!vanishes(own[i] - field[i])) return false;
  }
  return own.size() == field.size();
}

}  // namespace casimir
