#pragma once

#include <cln/rational.h>
#include <ginac/ginac.h>

#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "runtime/program.hpp"

namespace casimir::codegen {

/// Whether an exponent or a coefficient is one.
inline bool is_integer(const cln::cl_RA& value) { return cln::denominator(value) == 1; }

/// Index of a node of a Dag. Equal expressions have equal indices; the indices themselves follow
/// the order of construction, so results must never be ordered by them.
using NodeId = int;

/// coefficient * node: an expression, a term of a sum, an argument of a function.
struct Scaled {
  cln::cl_RA coefficient;
  NodeId node;
};

/// node ^ exponent: a factor of a product.
struct Factor {
  NodeId node;
  cln::cl_RA exponent;
};

enum class NodeKind {
  one,       ///< the number 1: the node of a constant
  symbol,    ///< Node::symbol
  sum,       ///< the sum of Node::terms, of which there are two or more
  function,  ///< Node::function of Node::terms
  pi,
  number,   ///< Node::number, an integer: occurs only as the base of an irrational root
  product,  ///< the product of Node::factors; one factor has an exponent other than 1
};

struct Node {
  NodeKind kind = NodeKind::one;
  int symbol = -1;
  Op function = Op::input;
  cln::cl_I number = 0;
  std::vector<Scaled> terms;
  std::vector<Factor> factors;
  cln::cl_RA degree = 0;  ///< in the coordinates; a function counts as 0
  bool constant = true;   ///< free of symbols
};

/// Expressions in a normal form that does not depend on memory addresses, unlike GiNaC's.
///
/// Sums are primitive: integer coefficients without common divisor, the first one positive, so that
/// x-y and y-x are one node with coefficients 1 and -1. Sums and products are sorted by `compare`.
/// Nothing is expanded. All arithmetic is exact.
class Dag {
 public:
  static constexpr NodeId kOne = 0;

  /// \param symbols  what expressions may contain; the order of terms and factors follows it.
  /// \param coordinates  how many of them, from the first, count for the degree of a term.
  Dag(std::vector<GiNaC::symbol> symbols, std::size_t coordinates);

  /// \param degrees  one for each symbol: what it adds to the degree of a term. A symbol of degree
  /// 0
  ///                 is a parameter.
  Dag(std::vector<GiNaC::symbol> symbols, std::vector<int> degrees);

  /// \throws ModelError  for unknown symbols and functions, for numbers that are not real and
  ///                     exact, and for divisions by zero; the text names them.
  Scaled convert(const GiNaC::ex& expression);

  Scaled symbol(int index);
  Scaled pi();
  Scaled sum(const std::vector<Scaled>& terms);
  Scaled product(const std::vector<Scaled>& factors);
  Scaled power(const Scaled& base, const cln::cl_RA& exponent);
  Scaled call(Op function, std::vector<Scaled> arguments);

  const Node& operator[](NodeId id) const { return nodes_[static_cast<std::size_t>(id)]; }

  /// Negative, zero or positive: the order of a before b. Higher degree first, then by factors, in
  /// the order of the symbols; total and the same in every process.
  int compare(NodeId a, NodeId b) const;

  /// The expression in the notation of case files, e.g. "M1^2/2 - r*g1".
  std::string text(const Scaled& expression) const;

  const std::string& symbol_name(int symbol) const;
  /// Whether the symbol of that index occurs in the expression.
  bool contains(const Scaled& expression, int symbol) const;
  /// Whether every symbol in it is a parameter.
  bool free_of_coordinates(NodeId id) const;

 private:
  Scaled convert_new(const GiNaC::ex& expression);
  Scaled convert_power(const GiNaC::ex& base, const cln::cl_RA& exponent);
  Scaled convert_function(const GiNaC::ex& expression);
  Scaled primitive_sum(std::vector<Scaled> terms);
  Scaled assemble(cln::cl_RA coefficient, std::vector<Factor> factors);
  void multiply_in(const Scaled& base, const cln::cl_RA& exponent, cln::cl_RA& coefficient,
                   std::vector<Factor>& factors);
  void multiply_root(const cln::cl_RA& base, const cln::cl_RA& exponent, cln::cl_RA& coefficient,
                     std::vector<Factor>& factors);
  /// Whether this is the opposite of a sum in its normal form, made for a root of it.
  bool is_radicand(NodeId id) const;
  void join_radicands(cln::cl_RA& coefficient, std::map<NodeId, cln::cl_RA>& exponents);
  NodeId intern(Node node);
  int compare_atoms(NodeId a, NodeId b) const;
  std::vector<Factor> factors_of(NodeId id) const;

  std::vector<std::string> names_;
  std::vector<int> degrees_;
  std::map<GiNaC::ex, int, GiNaC::ex_is_less> ranks_;
  std::map<GiNaC::ex, Scaled, GiNaC::ex_is_less> converted_;
  std::vector<Node> nodes_;
  std::unordered_map<std::size_t, std::vector<NodeId>> index_;
};

}  // namespace casimir::codegen
