#include "tools/show/notation.hpp"

#include <algorithm>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/elliptic.hpp"
#include "tools/typeset/dag_math.hpp"
#include "tools/typeset/latex.hpp"

namespace casimir::tools {
namespace {

/// Writes a letter for I.
class LetterForI : public GiNaC::map_function {
 public:
  explicit LetterForI(GiNaC::symbol letter) : letter_(std::move(letter)) {}

  bool found() const { return found_; }
  GiNaC::ex operator()(const GiNaC::ex& e) override {
    if (!GiNaC::is_a<GiNaC::numeric>(e)) return e.map(*this);
    const auto& number = GiNaC::ex_to<GiNaC::numeric>(e);
    if (number.is_real()) return e;
    found_ = true;
    return number.real() + number.imag() * letter_;
  }

 private:
  GiNaC::symbol letter_;
  bool found_ = false;
};

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

/// Whether it is written as a name with arguments, since it is no expression in what a Dag has.
bool is_named(const GiNaC::function& f) {
  return as_arbitrary(f).has_value() || is_elliptic_function(f);
}

/// The values of arbitrary and of elliptic functions in an expression, those within others too.
void collect_arbitrary(const ex& e, std::vector<ex>& found) {
  if (GiNaC::is_exactly_a<GiNaC::function>(e) && is_named(GiNaC::ex_to<GiNaC::function>(e)) &&
      std::ranges::none_of(found, [&](const ex& other) { return other.is_equal(e); }))
    found.push_back(e);
  for (std::size_t i = 0; i < e.nops(); ++i) collect_arbitrary(e.op(i), found);
}

std::vector<ex> arbitrary_values(const Model& model) {
  std::vector<ex> found;
  const auto add_all = [&](const std::vector<NamedExpression>& list) {
    for (const NamedExpression& f : list) collect_arbitrary(f.value, found);
  };
  if (model.hamiltonian) collect_arbitrary(*model.hamiltonian, found);
  for (const ex& rate : model.field) collect_arbitrary(rate, found);
  for (const auto* list : {&model.definitions, &model.casimirs, &model.integrals}) add_all(*list);
  for (const auto* claims : {&model.conditionals, &model.invariant_relations}) {
    for (const LevelClaim& claim : *claims) {
      collect_arbitrary(claim.expression.value, found);
      add_all(claim.on);
    }
  }
  for (const LaxPair& pair : model.lax_pairs) {
    for (const GiNaC::matrix* m : {&pair.l, &pair.a})
      for (std::size_t i = 0; i < m->nops(); ++i) collect_arbitrary(m->op(i), found);
  }
  for (const Identity& identity : model.identities) {
    collect_arbitrary(identity.left, found);
    collect_arbitrary(identity.right, found);
  }
  for (const Measure& measure : model.measures) collect_arbitrary(measure.density.value, found);
  if (model.poisson)
    for (std::size_t i = 0; i < model.poisson->dimension(); ++i)
      for (std::size_t j = 0; j < i; ++j) collect_arbitrary((*model.poisson)(i, j), found);
  return found;
}

/// What is written of such a value.
struct NamedValue {
  std::string name;
  std::vector<unsigned> orders;  ///< of the derivative, by each argument
  std::vector<ex> arguments;
};

NamedValue named_value(const GiNaC::function& f) {
  const auto own = as_arbitrary(f);
  if (!own) return {f.get_name(), std::vector<unsigned>(f.nops(), 0), {f.begin(), f.end()}};
  const auto function = function_name(own->function.get_name());
  return {function ? function->name : own->function.get_name(), own->orders, own->arguments};
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
  std::vector<GiNaC::symbol> named = model_.symbols();
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

/// Names that would be one on paper, as a1 and a_1: those with a line are set as they are.
void Notation::tell_names_apart() {
  std::map<std::string, std::vector<std::string>> alike;
  for (const GiNaC::symbol& symbol : symbols_) {
    std::string paper = typeset::latex(on_paper(symbol.get_name()));
    std::erase(paper, ' ');
    alike[paper].push_back(symbol.get_name());
  }
  for (const auto& [paper, names] : alike)
    for (const std::string& name : names)
      if (names.size() > 1 && name.find('_') != std::string::npos)
        paper_[name] = {typeset::Kind::word, name};
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
  if (model_.complex_numbers) {
    add_symbols({imaginary_}, 0);
    paper_[imaginary_.get_name()] = typeset::letter("i");
  }
  tell_names_apart();
  add_arbitrary_functions();
  dag_ = std::make_unique<codegen::Dag>(symbols_, degrees_);
  scalar_products_ = std::make_unique<ScalarProducts>(*dag_, places, pairs);
}

/// Each value of an arbitrary function is a symbol that is named as the value is written.
void Notation::add_arbitrary_functions() {
  std::vector<ex> values = arbitrary_values(model_);
  if (values.empty()) return;
  for (const ex& value : values) {
    const NamedValue own = named_value(GiNaC::ex_to<GiNaC::function>(value));
    codegen::Dag dag(symbols_, degrees_);
    std::vector<Math> arguments;
    std::string text;
    for (const ex& argument : own.arguments) {
      std::vector<ex> inner;
      collect_arbitrary(argument, inner);
      if (!inner.empty()) {  // U(V(x)): as GiNaC writes it
        text += (text.empty() ? "" : ", ") + expression_text(argument);
        arguments.push_back(typeset::prose(expression_text(argument)));
        continue;
      }
      const codegen::Scaled converted = dag.convert(argument);
      text += (text.empty() ? "" : ", ") + dag.text(converted);
      arguments.push_back(
          typeset::math(dag, converted, [this](const std::string& s) { return on_paper(s); }));
    }
    const std::string& name = own.name;
    Math letter = typeset::name(name);
    const std::string derivative = derivative_text(name, own.orders);
    if (own.orders.size() == 1) {
      for (unsigned k = 0; k < own.orders[0]; ++k)
        letter = {typeset::Kind::primed, {}, {std::move(letter)}};
    } else if (derivative.size() > name.size() + 3) {  // U'[1,2]
      letter = typeset::with_index(
          std::move(letter),
          typeset::number(derivative.substr(name.size() + 2, derivative.size() - name.size() - 3)));
    }
    const GiNaC::symbol stand_in(derivative + "(" + text + ")");
    paper_[stand_in.get_name()] = typeset::product(
        {std::move(letter), {typeset::Kind::tuple, {}, {typeset::list(std::move(arguments))}}});
    stand_ins_[value] = stand_in;
  }
  const GiNaC::exmap whole = stand_ins_;
  for (const auto& [value, stand_in] : whole) {
    const auto own = as_arbitrary(GiNaC::ex_to<GiNaC::function>(value));
    std::vector<ex> arguments;
    for (const ex& argument : own ? own->arguments : std::vector<ex>(value.begin(), value.end()))
      arguments.push_back(argument.subs(whole, GiNaC::subs_options::no_pattern));
    if (own) {
      stand_ins_[arbitrary(own->function, own->orders, arguments)] = stand_in;
    } else {
      const auto* function =
          find_elliptic_function(GiNaC::ex_to<GiNaC::function>(value).get_name());
      if (function) stand_ins_[function->apply({arguments.begin(), arguments.end()})] = stand_in;
    }
  }
  // In an order that is the same in every run, as that of GiNaC's terms is not.
  std::vector<GiNaC::symbol> ordered;
  for (const auto& [value, stand_in] : whole)
    ordered.push_back(GiNaC::ex_to<GiNaC::symbol>(stand_in));
  std::ranges::sort(ordered, {}, [](const GiNaC::symbol& s) { return s.get_name(); });
  add_symbols(ordered, 1);
}

/// Products of conjugates have imaginary factors, and are real when they are multiplied out. What
/// is not, as an entry of a Lax pair, is written with a letter for I.
codegen::Scaled Notation::converted(const ex& e) const {
  const ex shown = stand_ins_.empty() ? e : e.subs(stand_ins_, GiNaC::subs_options::no_pattern);
  if (!model_.complex_numbers) return dag_->convert(shown);
  LetterForI as_it_is(imaginary_), multiplied_out(imaginary_);
  const ex with_letter = as_it_is(shown);
  if (!as_it_is.found()) return dag_->convert(shown);
  const ex expanded = multiplied_out(shown.expand());
  return dag_->convert(multiplied_out.found() ? with_letter : expanded);
}

Math Notation::on_paper(const std::string& symbol) const {
  const auto found = paper_.find(symbol);
  return found == paper_.end() ? typeset::name(symbol) : found->second;
}

Written Notation::written(const codegen::Scaled& e) const {
  return {dag_->text(e),
          typeset::math(*dag_, e, [this](const std::string& s) { return on_paper(s); })};
}

Written Notation::components(const ex& e) { return written(converted(e)); }

std::string Notation::case_text(const ex& e) { return dag_->text(converted(e)); }

Written Notation::expression(const ex& e) { return written(scalar_products_->in(converted(e))); }

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
