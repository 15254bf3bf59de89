#pragma once

// The reader of expressions, for expression.cpp and the sources of its name alone.
#include <fmt/format.h>
#include <ginac/ginac.h>

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/arbitrary.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/elementary.hpp"
#include "symbolic/expression/elliptic.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir {

/// Recursive descent over one range of a text. Sums and products are collected before GiNaC sees
/// them, since adding term by term costs quadratic time.
class Parser {
 public:
  /// Reads `text` from `begin` up to `end`, within the limits of `names`.
  /// \param text, names  outlive it.
  Parser(const Text& text, Scope& names, std::size_t begin, std::size_t end)
      : text_(text), names_(names), limits_(names.limits()), at_(begin), end_(end) {}

  /// All of it as one expression; see `parse_expression`.
  Quantity parse();

 private:
  using ex = GiNaC::ex;
  /// A body of so many characters is as much work as a term.
  static constexpr double kCharactersOfTerm = 1000;

  /// While it lives, the expression is one level deeper.
  class Depth {
   public:
    explicit Depth(Parser& parser) : parser_(parser) {
      parser_.check(++parser_.depth_, &Limits::nesting, parser_.at_,
                    "the expression is nested more than {:.0f} deep");
    }
    ~Depth() { --parser_.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;

   private:
    Parser& parser_;
  };

  // Errors.

  [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const;
  [[noreturn]] void fail_at(std::size_t offset, const std::string& what,
                            const std::string& hint = {}, double Limits::*limit = nullptr) const;
  /// What stands here cannot: `expected` could.
  [[noreturn]] void unexpected(const std::string& expected);
  /// What people mean who write this character where no expression has it.
  std::string hint_for(char c) const;

  // Characters (parser.cpp).

  /// The next one that is no space; 0 at the end.
  char peek();
  bool accept(char c);
  std::string here();
  std::string character() const;

  // Limits, and what GiNaC does.

  void check(double value, double Limits::*limit, std::size_t offset, const char* what) const;
  Quantity checked(Quantity q, std::size_t offset) const;
  /// GiNaC gives log(-3) and sqrt(-4) complex values. Where numbers are real they have none, and an
  /// expression with one is about nothing.
  ex real_value(const ex& value, std::size_t offset) const;
  /// Runs one GiNaC operation that may meet a pole.
  template <class Operation>
  ex evaluated(std::size_t offset, Operation operation) const {
    try {
      return operation();
    } catch (const GiNaC::pole_error&) {
      fail_at(offset, "this has no value: division by zero or a pole of the function");
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const CaseError&) {
      throw;
    } catch (const std::exception& problem) {  // GiNaC's own errors have no common type
      fail_at(offset, fmt::format("this has no value ({})", printable(problem.what(), 80)));
    }
  }
  /// Each once; numbers have values everywhere.
  void add_part(const ex& part);
  void add_parts_of(const Quantity& quantity);

  // The grammar (parser.cpp).

  Quantity sum();
  /// '*' or '/', if one of them or a cross or dot of LaTeX stands here.
  char product_sign();
  /// `^`, or `**` as in Python.
  bool accept_power();
  /// {a} after a sign or command that takes it so; braces are brackets of Poisson elsewhere.
  Quantity braced();
  Quantity product();
  Quantity unary();
  Quantity power();
  Quantity primary();
  Quantity number();
  /// What starts with a command of LaTeX: a fraction, a root, or a name.
  Quantity latex(std::string_view command);

  // Names and calls (parser_names.cpp).

  Quantity name();
  /// U(r), U'(r), .. of an arbitrary function.
  Quantity arbitrary_call(const ex& symbol, const FunctionName& function, std::size_t start);
  [[noreturn]] void undeclared(const std::string& word, std::size_t start);
  std::vector<Quantity> arguments(std::string_view function, std::size_t arity, std::size_t start);
  /// What differentiating may make of an expression: each factor is differentiated in turn.
  static double derivative_nodes(const Quantity& q) { return q.nodes * std::max(1.0, q.degree); }
  /// {F, G}
  Quantity bracket();
  /// rate(F) = dF/dt
  Quantity rate(std::size_t start);
  /// diff(F, x)
  Quantity partial_derivative(std::size_t start);
  Quantity call(const ElementaryFunction& function, std::size_t start);
  Quantity call(const EllipticFunction& function, std::size_t start);

  // Families and vectors (parser_families.cpp).

  /// What a letter with a range stands for here; of no other name.
  std::optional<long> value_of_index(const std::string& word, std::size_t start);
  /// An integer that is known where it is read.
  long integer(const char* what);
  /// The indices behind the name of a family, and the name of the member that they are of.
  std::string member_of(const std::string& family);
  static Quantity known_integer(long value);
  /// mod(a, b): what is left of the integer a, from 0 to b - 1.
  Quantity remainder(std::size_t start);
  /// sum(i, a, b, F) and product(i, a, b, F): F for i = a .. b, of which nothing is left if b < a.
  Quantity repeated(bool is_sum, std::size_t start);
  /// The letter that a sum goes over.
  std::string letter();
  /// Where the argument that begins there ends, which nobody reads.
  std::size_t end_of_argument(std::size_t at) const;
  /// Of a part of the text where no vector can stand.
  const Quantity& number_of(std::size_t start, const Quantity& q) const;
  /// How many of x1, x2, .. are there.
  long members(const std::string& family);
  /// The component that is asked for of x = (x1, x2, ..). All vectors of a `dot` are as long.
  Quantity component_of(const std::string& family, std::size_t start);
  /// The component k of the vector that is written from `begin` on; leaves its end as the place.
  Quantity component_at(std::size_t begin, long k);
  /// a1*b1 + a2*b2 + .., or minus the last one.
  Quantity combined(const std::vector<std::pair<Quantity, Quantity>>& pairs, bool difference,
                    std::size_t start) const;
  /// dot(a, b) of vectors of any length.
  Quantity scalar_product(std::size_t start);
  /// The component k of cross(a, b), of which `left` is the place of a. Its place is then its end.
  Quantity component_of_product(std::size_t left, long k, std::size_t start);
  /// cross(a, b) within `dot` and `cross`, and cross(a, b)[k] everywhere.
  Quantity vector_product(std::size_t start);

  // Matrices (parser_matrices.cpp).

  struct Matrix;
  /// trace(A*B + C)
  Quantity trace(std::size_t start);
  /// det(A*B + C)
  Quantity determinant(std::size_t start);
  /// matrix(A*B + C)[i, j]
  Quantity entry(std::size_t start);
  /// The one argument of a function of matrices.
  Matrix matrix_argument(const char* function, std::size_t start);
  Matrix matrix_sum();
  /// \param difference  a less b
  Matrix added(const Matrix& a, const Matrix& b, bool difference, std::size_t offset);
  Matrix matrix_product();
  Matrix multiplied(const Matrix& a, const Matrix& b, std::size_t offset);
  Matrix matrix_unary();
  Matrix matrix_power();
  /// A family, a commutator [A, B], transpose(A), skew(M), symmetric(M), something in brackets, or
  /// a number.
  Matrix matrix_primary();
  /// An entry that has to be declared.
  Quantity member(const std::string& family, const std::vector<long>& places, std::size_t start);
  /// x12 of x1, x2, .. is no entry of a matrix.
  void refuse_vector(const std::string& family, std::size_t start) const;
  /// A11, A12, ..: as many rows as the first row or the first column is long.
  Matrix of_family(const std::string& family, std::size_t start);
  /// The matrix of which the entries above the diagonal are declared: M12, M13, M23, .. of a skew
  /// one, and those of the diagonal of a symmetric one.
  Matrix of_triangle(bool skew);

  const Text& text_;
  Scope& names_;
  const Limits& limits_;
  std::size_t at_;
  std::size_t end_;
  int depth_ = 0;
  std::optional<long> component_;                      ///< of vectors that is asked for
  long dimension_ = 0;                                 ///< of all vectors here; 0: not known yet
  double repetitions_ = 0;                             ///< of all sums and products
  std::vector<std::pair<std::string, long>> indices_;  ///< of those that are open
  bool imaginary_unit_ = false;                        ///< `I` has been read
  /// Whether numbers may be complex: those of the case, or those of this text, as a candidate is
  /// for a case of real numbers.
  bool complex_numbers() const { return names_.complex_numbers() || imaginary_unit_; }
  std::vector<ex> parts_;
  std::unordered_set<ex> seen_;
};

}  // namespace casimir
