#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "codegen/dag/expression_dag.hpp"
#include "symbolic/model.hpp"
#include "symbolic/vector_form.hpp"
#include "tools/show/scalar_products.hpp"

namespace casimir::tools {

enum class Markup { text, latex };

/// Words of a formula in both markups: "dH/dM".
struct Phrase {
  std::string text, latex;
  const std::string& in(Markup markup) const { return markup == Markup::text ? text : latex; }
};

/// M = (M1, M2, M3), written out.
struct VectorEntries {
  std::string name;   ///< as the case has it
  std::string shown;  ///< in the markup
  std::vector<std::string> entries;
};

/// A case in the notation of its field: vectors where its bracket has them, scalar products in
/// expressions, Greek letters in LaTeX. The same in every run.
class Notation {
 public:
  /// Borrows the model.
  explicit Notation(const Model& model);

  /// The vector form of the bracket, if it has one and that gives the equations of motion.
  const std::optional<VectorForm>& vectors() const { return form_; }

  /// In components: as text this is the notation of case files.
  std::string components(const GiNaC::ex& e, Markup markup);
  /// With scalar products: "(M, g)".
  std::string expression(const GiNaC::ex& e, Markup markup);
  /// "-M x dH/dM + 2*(g x dH/dg)": the sum of coefficient * phrase.
  std::string combination(const std::vector<std::pair<GiNaC::ex, Phrase>>& terms, Markup markup);

  std::string name(const GiNaC::symbol& symbol, Markup markup) const;
  /// A block of the vector form: "M", in LaTeX bold if it is a vector.
  std::string block(const Block& block, Markup markup) const;
  /// Its component with an index that is a letter: "M_i".
  std::string component(const Block& block, const std::string& index, Markup markup) const;
  /// The vectors of the phase space, and those of parameters that occur in a scalar product which
  /// `expression` has found so far.
  std::vector<VectorEntries> vector_entries(Markup markup) const;

 private:
  void name_letters();
  void make_dag(const std::vector<Triple>& vectors, std::size_t moving);
  void add_symbols(const std::vector<GiNaC::symbol>& list, int degree);
  GiNaC::symbol product_symbol(const std::string& a, const std::string& b);
  std::string typeset(const std::string& symbol) const;
  std::string render(const codegen::Scaled& e, Markup markup) const;
  std::string vector_name(const std::string& name, Markup markup) const;

  const Model& model_;
  std::optional<VectorForm> form_;
  std::vector<Triple> constants_;             ///< of parameters
  std::map<std::string, std::string> heads_;  ///< of a vector's name: the letter for it in LaTeX
  std::map<std::string, std::string> latex_;  ///< of symbols
  std::vector<GiNaC::symbol> symbols_;
  std::vector<int> degrees_;
  std::unique_ptr<codegen::Dag> dag_;
  std::unique_ptr<ScalarProducts> scalar_products_;
};

}  // namespace casimir::tools
