#include "codegen/split.hpp"

#include <algorithm>
#include <utility>

#include "codegen/dag/expression_dag.hpp"
#include "codegen/optimise/optimise.hpp"
#include "symbolic/error.hpp"
#include "symbolic/expression/expression_size.hpp"

namespace casimir {
namespace {

using GiNaC::ex;
using GiNaC::matrix;
using GiNaC::symbol;

/// A Hamiltonian of more terms is taken for one that does not split.
constexpr double kMostTermsOfHamiltonian = 1e5;

using codegen::is_null;

bool is_null(const matrix& m) {
  for (unsigned i = 0; i < m.nops(); ++i)
    if (!is_null(m.op(i))) return false;
  return true;
}

/// exp(s A) - 1 as a polynomial in A: entry k stands before A^(k+1).
using Exponential = std::vector<ex>;

ex squared(const ex& e) { return GiNaC::pow(e, 2); }

/// The functions (sin, 1 - cos) of w s, over w and w^2, where -w^2 = kappa; for positive kappa
/// their hyperbolic twins. Half angles: no differences of near numbers.
std::pair<ex, ex> waves(const ex& kappa, const ex& s) {
  if (kappa.info(GiNaC::info_flags::negative)) {
    const ex w = GiNaC::sqrt(-kappa), half = w * s / 2;
    return {2 * GiNaC::sin(half) * GiNaC::cos(half) / w, 2 * squared(GiNaC::sin(half) / w)};
  }
  const ex w = GiNaC::sqrt(kappa), up = GiNaC::exp(w * s / 2), down = GiNaC::exp(-w * s / 2);
  return {(up - down) * (up + down) / (2 * w), squared((up - down) / w) / 2};
}

/// The rational numbers other than zero among the eigenvalues of a matrix, in order; nothing if
/// there are others.
std::optional<std::vector<ex>> rational_eigenvalues(const matrix& m) {
  for (unsigned i = 0; i < m.nops(); ++i)
    if (!m.op(i).info(GiNaC::info_flags::rational)) return {};
  const symbol x("x");
  const ex all = GiNaC::factor(m.charpoly(x));
  std::vector<ex> roots;
  const auto take = [&](const ex& factor) {
    const ex base = GiNaC::is_a<GiNaC::power>(factor) ? factor.op(0) : factor;
    if (!base.has(x)) return true;
    if (base.degree(x) != 1) return false;
    if (const ex root = -base.coeff(x, 0) / base.coeff(x, 1); !root.is_zero())
      roots.push_back(root);
    return true;
  };
  if (!GiNaC::is_a<GiNaC::mul>(all)) {
    if (!take(all)) return {};
  } else {
    for (const ex& factor : all)
      if (!take(factor)) return {};
  }
  std::ranges::sort(roots, [](const ex& a, const ex& b) {
    return GiNaC::ex_to<GiNaC::numeric>(a) < GiNaC::ex_to<GiNaC::numeric>(b);
  });
  return roots;
}

/// For rotations and boosts, several at a time: A times the product of A^2 - kappa_i is zero.
std::optional<Exponential> waves_exponential(const matrix& a, const ex& s,
                                             const std::vector<ex>& kappas) {
  const matrix a2 = a.mul(a);
  matrix product = a;
  for (const ex& kappa : kappas)
    product =
        product.mul(a2.sub(GiNaC::ex_to<matrix>(GiNaC::unit_matrix(a.rows())).mul_scalar(kappa)));
  if (!is_null(product)) return {};
  Exponential result(2 * kappas.size(), 0);
  for (const ex& kappa : kappas) {
    const auto [sine, less] = waves(kappa, s);
    std::vector<ex> lagrange{1};  // of kappa, as a polynomial in A^2
    for (const ex& other : kappas) {
      if (other.is_equal(kappa)) continue;
      lagrange.push_back(0);
      for (std::size_t k = lagrange.size(); k-- > 0;)
        lagrange[k] = ((k > 0 ? lagrange[k - 1] : 0) - other * lagrange[k]) / (kappa - other);
    }
    for (std::size_t k = 0; k < lagrange.size(); ++k) {
      result[2 * k] += lagrange[k] * sine;
      result[2 * k + 1] += lagrange[k] * less;
    }
  }
  return result;
}

/// For a screw: (A^2 + w^2)^2 A = 0.
std::optional<Exponential> screw_exponential(const matrix& a, const ex& s, const ex& w2) {
  const matrix a2 = a.mul(a), a3 = a2.mul(a);
  if (!is_null(a3.mul(a2).add(a3.mul_scalar(2 * w2)).add(a.mul_scalar(squared(w2))))) return {};
  const ex w = GiNaC::sqrt(w2), angle = w * s;
  const ex sine = GiNaC::sin(angle), less = 2 * squared(GiNaC::sin(angle / 2));
  const ex lags = angle * GiNaC::cos(angle);
  return Exponential{(3 * sine - lags) / (2 * w), (4 * less - angle * sine) / (2 * w2),
                     (sine - lags) / (2 * w * w2), (2 * less - angle * sine) / (2 * squared(w2))};
}

/// exp(s A) - 1 where A is nilpotent, a sum of commuting rotations and boosts, or a screw; nothing
/// for others.
std::optional<Exponential> exponential(const matrix& a, const ex& s) {
  const matrix a2 = a.mul(a);
  if (is_null(a2)) return Exponential{s};
  if (is_null(a2.mul(a))) return Exponential{s, squared(s) / 2};
  const auto kappas = rational_eigenvalues(a2);
  if (!kappas) return {};
  if (const auto waves = waves_exponential(a, s, *kappas)) return waves;
  const bool one = kappas->size() == 1 && kappas->front().info(GiNaC::info_flags::negative);
  return one ? screw_exponential(a, s, -kappas->front()) : std::nullopt;
}

/// One part and what its flow adds to the states in the time `t`.
struct Part {
  ex hamiltonian;
  std::vector<ex> added;
};

class Splitter {
 public:
  explicit Splitter(const SceneHamiltonian& source) : source_(source) {}

  Splitting run() {
    take_terms();
    take_drifts();
    take_functions_of_one_variable();
    take_squares();
    return written();
  }

 private:
  std::size_t n() const { return source_.states.size(); }
  const symbol& state(std::size_t i) const { return source_.states[i]; }

  bool moves(const ex& e) const {
    return std::ranges::any_of(source_.states, [&](const symbol& x) { return e.has(x); });
  }

  void take_terms() {
    const ex expanded = expanded_within(source_.hamiltonian, kMostTermsOfHamiltonian);
    const std::size_t count = GiNaC::is_a<GiNaC::add>(expanded) ? expanded.nops() : 1;
    for (std::size_t k = 0; k < count; ++k) {
      const ex term = GiNaC::is_a<GiNaC::add>(expanded) ? expanded.op(k) : expanded;
      if (moves(term)) terms_.push_back(term);
    }
    // GiNaC's order of terms differs from run to run.
    codegen::Dag dag = names();
    std::ranges::sort(terms_, [&](const ex& a, const ex& b) {
      return dag.compare(dag.convert(a).node, dag.convert(b).node) < 0;
    });
  }

  codegen::Dag names() const {
    std::vector<symbol> symbols = source_.states;
    symbols.insert(symbols.end(), source_.parameters.begin(), source_.parameters.end());
    symbols.push_back(time_);
    return {symbols, n()};
  }

  std::vector<ex> field(const ex& h) const {
    std::vector<ex> x(n(), 0);
    for (std::size_t j = 0; j < n(); ++j) {
      const ex slope = h.diff(state(j));
      if (slope.is_zero()) continue;
      for (std::size_t i = 0; i < n(); ++i)
        x[i] += source_.bracket(static_cast<unsigned>(i), static_cast<unsigned>(j)) * slope;
    }
    return x;
  }

  /// Whether the field of h does not change along itself.
  bool drifts(const ex& h) const {
    const std::vector<ex> x = field(h);
    for (std::size_t i = 0; i < n(); ++i) {
      ex change = 0;
      for (std::size_t j = 0; j < n(); ++j) change += x[i].diff(state(j)) * x[j];
      if (!is_null(change)) return false;
    }
    return true;
  }

  void take_drifts() {
    std::vector<ex> sums, rest;
    for (const ex& term : terms_) {
      const auto alone = drifts(term);
      const auto group =
          std::ranges::find_if(sums, [&](const ex& sum) { return alone && drifts(sum + term); });
      if (group != sums.end())
        *group += term;
      else
        (alone ? sums : rest).push_back(term);
    }
    terms_ = rest;
    for (const ex& sum : sums) {
      Part part{sum, field(sum)};
      for (ex& x : part.added) x = time_ * x;
      parts_.push_back(part);
    }
  }

  /// The matrix A of a field A (x, 1) of the states and a constant 1; nothing if it is not linear.
  std::optional<matrix> linear_field(const std::vector<ex>& x) const {
    const auto size = static_cast<unsigned>(n());
    matrix a(size + 1, size + 1);
    for (unsigned i = 0; i < size; ++i) {
      ex rest = x[i].expand();
      for (unsigned j = 0; j < size; ++j) {
        a(i, j) = rest.diff(state(j));
        if (moves(a(i, j))) return {};
      }
      for (unsigned j = 0; j < size; ++j) rest -= a(i, j) * state(j);
      a(i, size) = rest.expand();
      if (moves(a(i, size))) return {};
    }
    return a;
  }

  /// The flow of x' = speed A (x, 1), where the speed does not change along it.
  bool take_linear_flow(const ex& hamiltonian, const matrix& a, const ex& speed) {
    const auto powers = exponential(a, time_ * speed);
    if (!powers) return false;
    matrix x(static_cast<unsigned>(n()) + 1, 1);
    for (unsigned i = 0; i < n(); ++i) x(i, 0) = state(i);
    x(x.rows() - 1, 0) = 1;
    Part part{hamiltonian, std::vector<ex>(n(), 0)};
    for (const ex& coefficient : *powers) {
      x = a.mul(x);
      for (unsigned i = 0; i < n(); ++i) part.added[i] += coefficient * x(i, 0).expand();
    }
    parts_.push_back(part);
    return true;
  }

  /// F(l) for a linear form l, the `slope` being dF/dl.
  bool take_function_of(const ex& form, const ex& hamiltonian, const ex& slope) {
    const auto a = linear_field(field(form));
    return a && take_linear_flow(hamiltonian, *a, slope);
  }

  void take_functions_of_one_variable() {
    std::vector<ex> functions(n(), 0), rest;
    for (const ex& term : terms_) {
      std::vector<std::size_t> in;
      for (std::size_t i = 0; i < n(); ++i)
        if (term.has(state(i))) in.push_back(i);
      if (in.size() == 1)
        functions[in[0]] += term;
      else
        rest.push_back(term);
    }
    for (std::size_t i = 0; i < n(); ++i) {
      // What is not taken here may still be part of a quadratic form.
      if (functions[i].is_zero()) continue;
      if (!take_function_of(state(i), functions[i], functions[i].diff(state(i))))
        rest.push_back(functions[i]);
    }
    terms_ = rest;
  }

  void take_squares() {
    if (terms_.empty()) return;
    const auto size = static_cast<unsigned>(n());
    ex form = 0;
    for (const ex& term : terms_) form += term;
    form = form.expand();
    matrix q(size, size);
    ex rest = form;
    for (unsigned i = 0; i < size; ++i)
      for (unsigned j = 0; j < size; ++j) {
        q(i, j) = form.diff(state(i)).diff(state(j)) / 2;
        if (moves(q(i, j))) refuse(terms_.front());
        rest -= q(i, j) * state(i) * state(j);
      }
    if (!is_null(rest)) refuse(terms_.front());
    if (const auto a = linear_field(field(form)); a && take_linear_flow(form, *a, 1)) return;
    take_sum_of_squares(q);
  }

  /// Lagrange's reduction of a quadratic form.
  void take_sum_of_squares(matrix q) {
    const unsigned size = q.rows();
    const auto take = [&](const matrix& row, const ex& factor) {
      ex form = 0;
      for (unsigned i = 0; i < size; ++i) form += row(0, i) * state(i);
      const ex hamiltonian = factor * squared(form);
      if (!take_function_of(form, hamiltonian, 2 * factor * form)) refuse(hamiltonian);
      for (unsigned i = 0; i < size; ++i)
        for (unsigned j = 0; j < size; ++j)
          q(i, j) = normal_form(q(i, j) - factor * row(0, i) * row(0, j));
    };
    while (!is_null(q)) {
      matrix row(1, size);
      unsigned i = 0;
      while (i < size && is_null(q(i, i))) ++i;
      if (i < size) {
        for (unsigned j = 0; j < size; ++j) row(0, j) = normal_form(q(i, j) / q(i, i));
        take(row, q(i, i));
        continue;
      }
      unsigned k = 0;
      while (is_null(q.op(k))) ++k;
      const ex both = q.op(k);
      for (const int sign : {1, -1}) {
        matrix pair(1, size);
        pair(0, k / size) = 1;
        pair(0, k % size) = sign;
        take(pair, sign * both / 2);
      }
    }
  }

  [[noreturn]] void refuse(const ex& term) const {
    codegen::Dag dag = names();
    throw ModelError("the Hamiltonian does not split: the flow of " +
                     printable(dag.text(dag.convert(term))) +
                     " has no closed form here; gauss8 keeps quadratic invariants without one");
  }

  Splitting written() const {
    codegen::Dag dag = names();
    std::vector<std::string> inputs, outputs;
    for (const symbol& x : source_.states) inputs.push_back(x.get_name());
    for (const symbol& p : source_.parameters) inputs.push_back(p.get_name());
    inputs.emplace_back("t");
    for (const symbol& x : source_.states) outputs.push_back("added to " + x.get_name());
    Splitting result;
    for (const Part& part : parts_) {
      std::vector<codegen::Scaled> added;
      for (const ex& e : part.added) added.push_back(dag.convert(e));
      result.parts.push_back(dag.text(dag.convert(part.hamiltonian)));
      result.flows.push_back(codegen::optimised(dag, added, inputs, outputs));
    }
    return result;
  }

  const SceneHamiltonian& source_;
  const symbol time_{"t"};
  std::vector<ex> terms_;  ///< of the Hamiltonian, that are in no part yet
  std::vector<Part> parts_;
};

}  // namespace

Splitting split(const SceneHamiltonian& source) { return Splitter(source).run(); }

std::vector<bool> codegen::moved_states(const Program& flow) {
  std::vector<bool> moved;
  for (const int output : flow.outputs) {
    const Instruction& line = flow.code[static_cast<std::size_t>(output)];
    moved.push_back(line.op != Op::constant ||
                    flow.constants[static_cast<std::size_t>(line.a)] != 0);
  }
  return moved;
}

}  // namespace casimir
