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
#include "tools/typeset/math.hpp"

namespace casimir::tools {

/// A formula for a terminal, in the notation of case files as far as that goes, and for paper.
struct Written {
  std::string text;
  typeset::Math math;
};

/// A part of a formula that stands beside a coefficient.
struct Phrase {
  Written written;
  bool compound = false;  ///< in the text it needs brackets there: "dH/dM"
};

/// M = (M1, M2, M3), written out.
struct VectorEntries {
  std::string name;  ///< as the case has it
  Written shown;
  std::vector<Written> entries;
};

/// A case in the notation of its field: vectors where its bracket has them, scalar products in
/// expressions, Greek letters on paper. The same in every run.
class Notation {
 public:
  /// Borrows the model.
  explicit Notation(const Model& model);

  /// The vector form of the bracket, if it has one and that gives the equations of motion.
  const std::optional<VectorForm>& vectors() const { return form_; }

  /// In components.
  Written components(const GiNaC::ex& e);
  /// The text of that alone, which is the notation of case files.
  std::string case_text(const GiNaC::ex& e);
  /// With scalar products: "(M, g)".
  Written expression(const GiNaC::ex& e);
  /// "-M x dH/dM + 2*(g x dH/dg)": the sum of coefficient * phrase.
  Written combination(const std::vector<std::pair<GiNaC::ex, Phrase>>& terms);

  Written name(const GiNaC::symbol& symbol) const;
  /// A block of the vector form: "M", on paper bold if it is a vector.
  Written block(const Block& block) const;
  /// Its component with an index that is a letter: "M_i".
  Written component(const Block& block, const std::string& index) const;
  /// The vectors of the phase space, and those of parameters that occur in a scalar product which
  /// `expression` has found so far.
  std::vector<VectorEntries> vector_entries() const;

 private:
  void name_letters();
  void tell_names_apart();
  void make_dag(const std::vector<Triple>& vectors, std::size_t moving);
  void add_symbols(const std::vector<GiNaC::symbol>& list, int degree);
  void add_arbitrary_functions();
  codegen::Scaled converted(const GiNaC::ex& e) const;
  GiNaC::symbol product_symbol(const std::string& a, const std::string& b);
  typeset::Math on_paper(const std::string& symbol) const;
  Written written(const codegen::Scaled& e) const;
  typeset::Math letter_of(const std::string& vector) const;
  Written vector_name(const std::string& name) const;

  const Model& model_;
  std::optional<VectorForm> form_;
  std::vector<Triple> constants_;               ///< of parameters
  std::map<std::string, std::string> heads_;    ///< of a vector's name: the letter for it on paper
  std::map<std::string, typeset::Math> paper_;  ///< of symbols that are not written as their names
  GiNaC::exmap
      stand_ins_;  ///< for values of arbitrary functions: symbols named as they are written
  GiNaC::symbol imaginary_{"I"};
  std::vector<GiNaC::symbol> symbols_;
  std::vector<int> degrees_;
  std::unique_ptr<codegen::Dag> dag_;
  std::unique_ptr<ScalarProducts> scalar_products_;
};

}  // namespace casimir::tools
