#include "tools/show/notation.hpp"

#include <algorithm>

#include "symbolic/error.hpp"
#include "tools/typeset/dag_math.hpp"

namespace casimir::tools {
namespace {

using GiNaC::ex;
using typeset::Math;

/// Stands for a phrase in a sum; no name in a case file can be this.
const std::string kPhrase = "#";

/// The Greek letter that a vector's name stands for, or the name itself.
std::string letter(const std::string& name) {
  static const std::map<std::string, std::string> kShort = {
      {"g", "gamma"}, {"ga", "gamma"},  {"gam", "gamma"},  {"al", "alpha"},
      {"be", "beta"}, {"la", "lambda"}, {"lam", "lambda"}, {"om", "omega"}};
  const auto found = kShort.find(name);
  return found == kShort.end() ? name : found->second;
}

/// The part of a name before its index.
std::string head(const std::string& name) {
  return name.substr(0, name.find_last_not_of("0123456789_") + 1);
}

/// Products of conjugates have imaginary factors, and are real when they are multiplied out.
codegen::Scaled converted(codegen::Dag& dag, const ex& e) {
  try {
    return dag.convert(e);
  } catch (const ModelError&) {
    return dag.convert(e.expand());
  }
}

}  // namespace

Notation::Notation(const Model& model) : model_(model) {
  if (model.poisson && model.hamiltonian) {
    form_ = find_vector_form(*model.poisson);
    if (form_ && !reproduces(*form_, model.variables, *model.hamiltonian, model.field))
      form_.reset();
  }
  name_letters();
  std::vector<Triple> vectors;
  if (form_) {
    for (const Block& block : form_->blocks) {
      const auto& c = block.coordinates;
      if (block.is_vector()) vectors.push_back({block.name, {c[0], c[1], c[2]}});
    }
    std::vector<std::string> names;
    for (const GiNaC::symbol& p : model.parameters) names.push_back(p.get_name());
    constants_ = find_triples(names);
  }
  const std::size_t moving = vectors.size();
  for (Triple triple : constants_) {
    for (std::size_t& i : triple.indices) i += model.variables.size();
    vectors.push_back(triple);
  }
  make_dag(vectors, moving);
}

/// Greek letters for the names of vectors, unless the case has the letter already.
void Notation::name_letters() {
  std::vector<GiNaC::symbol> named = model_.variables;
  named.insert(named.end(), model_.parameters.begin(), model_.parameters.end());
  if (!form_) return;
  for (const Block& block : form_->blocks) {
    const std::string greek = letter(block.name);
    if (!block.is_vector() || greek == block.name) continue;
    if (std::ranges::any_of(named,
                            [&](const GiNaC::symbol& s) { return head(s.get_name()) == greek; }))
      continue;
    heads_[block.name] = greek;
    for (const GiNaC::symbol& x : model_.variables) {  // of a quaternion the scalar, too
      const std::string name = x.get_name();
      if (head(name) == block.name)
        paper_[name] = typeset::name(greek + name.substr(block.name.size()));
    }
  }
}

GiNaC::symbol Notation::product_symbol(const std::string& a, const std::string& b) {
  const GiNaC::symbol product("(" + a + ", " + b + ")");
  paper_[product.get_name()] = {
      typeset::Kind::tuple, {}, {typeset::list({vector_name(a).math, vector_name(b).math})}};
  return product;
}

void Notation::add_symbols(const std::vector<GiNaC::symbol>& list, int degree) {
  symbols_.insert(symbols_.end(), list.begin(), list.end());
  degrees_.resize(symbols_.size(), degree);
}

/// The dag over scalar products, variables and parameters, in this order.
void Notation::make_dag(const std::vector<Triple>& vectors, std::size_t moving) {
  std::map<ScalarProducts::Pair, int> pairs;
  for (std::size_t a = 0; a < moving; ++a) {
    for (std::size_t b = a; b < vectors.size(); ++b) {
      pairs[{a, b}] = static_cast<int>(symbols_.size());
      const bool constant = b >= moving;  // (r, g): the parameters first, and linear in g
      add_symbols({product_symbol(vectors[constant ? b : a].name, vectors[constant ? a : b].name)},
                  constant ? 1 : 2);
    }
  }
  std::vector<std::array<int, 3>> places;
  for (const Triple& vector : vectors) {
    auto& place = places.emplace_back();
    std::ranges::transform(vector.indices, place.begin(),
                           [&](std::size_t i) { return static_cast<int>(symbols_.size() + i); });
  }
  add_symbols(model_.variables, 1);
  add_symbols(model_.parameters, 0);
  if (model_.time) add_symbols({*model_.time}, 0);
  if (model_.frame) add_symbols(model_.frame->velocities, 0);
  for (const LaxPair& pair : model_.lax_pairs) {
    if (pair.spectral) add_symbols({*pair.spectral}, 0);
  }
  dag_ = std::make_unique<codegen::Dag>(symbols_, degrees_);
  scalar_products_ = std::make_unique<ScalarProducts>(*dag_, places, pairs);
}

Math Notation::on_paper(const std::string& symbol) const {
  const auto found = paper_.find(symbol);
  return found == paper_.end() ? typeset::name(symbol) : found->second;
}

Written Notation::written(const codegen::Scaled& e) const {
  return {dag_->text(e),
          typeset::math(*dag_, e, [this](const std::string& s) { return on_paper(s); })};
}

Written Notation::components(const ex& e) { return written(converted(*dag_, e)); }

std::string Notation::case_text(const ex& e) { return dag_->text(converted(*dag_, e)); }

Written Notation::expression(const ex& e) {
  return written(scalar_products_->in(converted(*dag_, e)));
}

Written Notation::combination(const std::vector<std::pair<ex, Phrase>>& terms) {
  Written sum;
  for (const auto& term_of_sum : terms) {
    const auto& coefficient = term_of_sum.first;
    const Phrase& phrase = term_of_sum.second;
    // A factor that is printed as one: the last of the symbols, so that it ends the product.
    const GiNaC::symbol factor(kPhrase);
    std::vector<GiNaC::symbol> symbols = symbols_;
    std::vector<int> degrees = degrees_;
    symbols.push_back(factor);
    degrees.push_back(1);
    codegen::Dag dag(symbols, degrees);
    const codegen::Scaled product = dag.product({dag.convert(coefficient), dag.convert(factor)});
    typeset::add_term(sum.math, typeset::math(dag, product, [&](const std::string& symbol) {
                        return symbol == kPhrase ? phrase.written.math : on_paper(symbol);
                      }));
    std::string term = dag.text(product);
    const bool alone = term == kPhrase || term == "-" + kPhrase;
    const std::string& text = phrase.written.text;
    term.replace(term.find(kPhrase), kPhrase.size(),
                 phrase.compound && !alone ? "(" + text + ")" : text);
    if (sum.text.empty())
      sum.text = term;
    else if (term[0] == '-')
      sum.text += " - " + term.substr(1);
    else
      sum.text += " + " + term;
  }
  return sum.text.empty() ? Written{"0", typeset::number("0")} : sum;
}

Written Notation::name(const GiNaC::symbol& symbol) const {
  return {symbol.get_name(), on_paper(symbol.get_name())};
}

Math Notation::letter_of(const std::string& vector) const {
  const auto found = heads_.find(vector);
  return typeset::name(found == heads_.end() ? vector : found->second);
}

Written Notation::vector_name(const std::string& name) const {
  return {name, {typeset::Kind::bold, {}, {letter_of(name)}}};
}

Written Notation::block(const Block& block) const {
  if (block.is_vector()) return vector_name(block.name);
  return name(model_.variables[block.coordinates[0]]);
}

Written Notation::component(const Block& block, const std::string& index) const {
  Math letter = letter_of(block.name);
  Math& place = letter.kind == typeset::Kind::scripts ? letter.parts[1] : letter;
  Math with = typeset::letter(index);
  if (&place == &letter)
    letter = typeset::with_index(letter, std::move(with));
  else
    place = typeset::product({place, std::move(with)});
  return {block.name + "_" + index, std::move(letter)};
}

std::vector<VectorEntries> Notation::vector_entries() const {
  std::vector<VectorEntries> result;
  const auto add = [&](const std::string& vector, const auto& indices,
                       const std::vector<GiNaC::symbol>& symbols) {
    result.push_back({vector, vector_name(vector), {}});
    for (const std::size_t i : indices) result.back().entries.push_back(name(symbols[i]));
  };
  std::size_t moving = 0;
  for (; form_ && moving < form_->blocks.size() && form_->blocks[moving].is_vector(); ++moving)
    add(form_->blocks[moving].name, form_->blocks[moving].coordinates, model_.variables);
  for (const std::size_t vector : scalar_products_->used()) {
    if (vector < moving) continue;
    const Triple& triple = constants_[vector - moving];
    add(triple.name, triple.indices, model_.parameters);
  }
  return result;
}

}  // namespace casimir::tools
