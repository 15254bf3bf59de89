#include "tools/show/notation.hpp"

#include <algorithm>

#include "symbolic/error.hpp"

namespace casimir::tools {
namespace {

using GiNaC::ex;

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

/// A phrase beside a coefficient: in brackets if it is a vector product or a gradient.
std::string as_factor(const std::string& phrase) {
  const bool enclosed = phrase.front() == '(' && phrase.back() == ')';
  const bool compound =
      phrase.find(" x ") != std::string::npos || phrase.find('/') != std::string::npos;
  return compound && !enclosed ? "(" + phrase + ")" : phrase;
}

std::string bold(const std::string& letters) {
  if (letters.size() == 1) return "\\boldsymbol " + letters;
  const bool command =
      letters[0] == '\\' && std::all_of(letters.begin() + 1, letters.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      });
  return command ? "\\boldsymbol" + letters : "\\boldsymbol{" + letters + "}";
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
        latex_[name] = codegen::latex_name(greek + name.substr(block.name.size()));
    }
  }
}

GiNaC::symbol Notation::product_symbol(const std::string& a, const std::string& b) {
  const GiNaC::symbol product("(" + a + ", " + b + ")");
  latex_[product.get_name()] =
      "(" + vector_name(a, Markup::latex) + ", " + vector_name(b, Markup::latex) + ")";
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

std::string Notation::typeset(const std::string& symbol) const {
  const auto found = latex_.find(symbol);
  return found == latex_.end() ? codegen::latex_name(symbol) : found->second;
}

std::string Notation::render(const codegen::Scaled& e, Markup markup) const {
  if (markup == Markup::text) return dag_->text(e);
  return dag_->latex(e, [this](const std::string& symbol) { return typeset(symbol); });
}

std::string Notation::components(const ex& e, Markup markup) {
  return render(converted(*dag_, e), markup);
}

std::string Notation::expression(const ex& e, Markup markup) {
  return render(scalar_products_->in(converted(*dag_, e)), markup);
}

std::string Notation::combination(const std::vector<std::pair<ex, Phrase>>& terms, Markup markup) {
  std::string sum;
  for (const auto& [coefficient, phrase] : terms) {
    // A factor that is printed as one: the last of the symbols, so that it ends the product.
    const GiNaC::symbol factor(kPhrase);
    std::vector<GiNaC::symbol> symbols = symbols_;
    std::vector<int> degrees = degrees_;
    symbols.push_back(factor);
    degrees.push_back(1);
    codegen::Dag dag(symbols, degrees);
    const codegen::Scaled product = dag.product({dag.convert(coefficient), dag.convert(factor)});
    std::string term;
    if (markup == Markup::latex) {
      term = dag.latex(product, [&, &latex = phrase.latex](const std::string& symbol) {
        return symbol == kPhrase ? latex : typeset(symbol);
      });
    } else {
      term = dag.text(product);
      const bool alone = term == kPhrase || term == "-" + kPhrase;
      term.replace(term.find(kPhrase), kPhrase.size(),
                   alone ? phrase.text : as_factor(phrase.text));
    }
    if (sum.empty())
      sum = term;
    else if (term[0] == '-')
      sum += " - " + term.substr(1);
    else
      sum += " + " + term;
  }
  return sum.empty() ? "0" : sum;
}

std::string Notation::name(const GiNaC::symbol& symbol, Markup markup) const {
  return markup == Markup::text ? symbol.get_name() : typeset(symbol.get_name());
}

std::string Notation::vector_name(const std::string& name, Markup markup) const {
  if (markup == Markup::text) return name;
  const auto found = heads_.find(name);
  return bold(codegen::latex_name(found == heads_.end() ? name : found->second));
}

std::string Notation::block(const Block& block, Markup markup) const {
  if (block.is_vector()) return vector_name(block.name, markup);
  return name(model_.variables[block.coordinates[0]], markup);
}

std::string Notation::component(const Block& block, const std::string& index, Markup markup) const {
  if (markup == Markup::text) return block.name + "_" + index;
  const auto found = heads_.find(block.name);
  const std::string letters =
      codegen::latex_name(found == heads_.end() ? block.name : found->second);
  const bool indexed = letters.find("_{") != std::string::npos;
  if (indexed) return letters.substr(0, letters.size() - 1) + " " + index + "}";
  return letters + "_{" + index + "}";
}

std::vector<VectorEntries> Notation::vector_entries(Markup markup) const {
  std::vector<VectorEntries> result;
  const auto add = [&](const std::string& vector, const auto& indices,
                       const std::vector<GiNaC::symbol>& symbols) {
    result.push_back({vector, vector_name(vector, markup), {}});
    for (const std::size_t i : indices) result.back().entries.push_back(name(symbols[i], markup));
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
