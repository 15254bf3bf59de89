// Rational solutions of w' + w^2 = r: Kovacic's case 1 over Q(z).
#include <flint/fmpq_mat.h>
#include <fmt/format.h>

#include <stdexcept>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

/// A part of w at a singular point, and what it adds to the sum of residues.
struct Choice {
  RationalFunction part;
  cln::cl_RA residues;  ///< at infinity: the degree of y without its exponential
};

/// The first `count` coefficients of the root of a power series whose leading one is a square.
std::vector<cln::cl_RA> series_root(const std::vector<cln::cl_RA>& series, const cln::cl_RA& root,
                                    std::size_t count) {
  std::vector<cln::cl_RA> result{root};
  for (std::size_t n = 1; n < count; ++n) {
    cln::cl_RA rest = series[n];
    for (std::size_t i = 1; i < n; ++i) rest = rest - result[i] * result[n - i];
    result.push_back(rest / (2 * root));
  }
  return result;
}

/// The coefficients of Taylor's series of a quotient at zero, where its denominator is not zero.
std::vector<cln::cl_RA> quotient_series(const Univariate& above, const Univariate& below,
                                        std::size_t count) {
  std::vector<cln::cl_RA> result;
  for (std::size_t n = 0; n < count; ++n) {
    cln::cl_RA rest = above.coefficient(static_cast<long>(n));
    for (std::size_t i = 0; i < n; ++i)
      rest = rest - result[i] * below.coefficient(static_cast<long>(n - i));
    result.push_back(rest / below.coefficient(0));
  }
  return result;
}

/// The coefficient of degree nu - 1 of a series less the square of the polynomial `root`.
cln::cl_RA next_coefficient(const std::vector<cln::cl_RA>& series,
                            const std::vector<cln::cl_RA>& root, std::size_t degree) {
  cln::cl_RA result = series[degree];
  for (std::size_t i = 0; i <= degree; ++i)
    if (i < root.size() && degree - i < root.size()) result = result - root[i] * root[degree - i];
  return result;
}

/// At a pole of order 2*nu >= 4.
std::vector<Choice> irregular_pole(const RationalFunction& r, const Singularity& s) {
  if (s.at.degree() > 1) {
    if (!square_root(leading_coefficient(r, s.at, s.order), s.at)) return {};
    throw NotDecided("a pole of order 4 or more is not a rational number");
  }
  const auto nu = static_cast<std::size_t>(s.order / 2);
  const Univariate moved = Univariate::variable() - Univariate(s.at.coefficient(0));
  const Univariate rest = r.denominator().divided(s.at.pow(2 * nu)).first;
  const auto series = quotient_series(r.numerator().composed(moved), rest.composed(moved), nu);
  const auto leading = square_root(series[0]);
  if (!leading) return {};
  const auto root = series_root(series, *leading, nu - 1);
  RationalFunction part;
  for (std::size_t i = 0; i < root.size(); ++i)
    part = part + RationalFunction(Univariate(root[i]), s.at.pow(nu - i));
  const cln::cl_RA b = next_coefficient(series, root, nu - 1);
  std::vector<Choice> result;
  for (const int sign : {1, -1}) {
    const cln::cl_RA alpha =
        (sign * b / *leading + cln::cl_RA(static_cast<long>(nu))) / cln::cl_RA(2);
    result.push_back(
        {RationalFunction(Univariate(sign)) * part + RationalFunction(Univariate(alpha), s.at),
         alpha});
  }
  return result;
}

/// At conjugate poles of order 2 at most: alpha = (1 + s)/2 with s^2 the square of the difference.
std::vector<Choice> regular_pole(const Singularity& s) {
  const Univariate slope = s.at.derivative();
  const auto choice = [&](const Univariate& alpha) {
    const Univariate above = (alpha * slope).remainder(s.at);
    return Choice{RationalFunction(above, s.at), above.coefficient(s.at.degree() - 1)};
  };
  if (s.order == 1) return {choice(Univariate(1))};
  const auto root = square_root(s.difference_squared, s.at);
  if (!root) return {};
  const Univariate half(cln::cl_RA(1) / 2);
  std::vector<Choice> result{choice(half * (Univariate(1) + *root))};
  if (!root->is_zero()) result.push_back(choice(half * (Univariate(1) - *root)));
  return result;
}

std::vector<Choice> infinity(const RationalFunction& r, const Singularity& s) {
  if (s.order > 2) return {{RationalFunction(), 0}, {RationalFunction(), 1}};
  if (s.order == 2) {
    const auto root = square_root(s.difference_squared.coefficient(0));
    if (!root) return {};
    return {{RationalFunction(), (1 + *root) / 2}, {RationalFunction(), (1 - *root) / 2}};
  }
  if (s.order % 2 != 0) return {};
  // In x = 1/z: r = x^order times a power series.
  const auto reversed = [](const Univariate& p) {
    std::vector<cln::cl_RA> coefficients;
    for (long i = p.degree(); i >= 0; --i) coefficients.push_back(p.coefficient(i));
    return Univariate(coefficients);
  };
  const auto nu = static_cast<std::size_t>(-s.order / 2);
  const auto series = quotient_series(reversed(r.numerator()), reversed(r.denominator()), nu + 2);
  const auto leading = square_root(series[0]);
  if (!leading) return {};
  const auto root = series_root(series, *leading, nu + 1);
  Univariate part;
  for (std::size_t i = 0; i < root.size(); ++i)
    part += Univariate(root[i]) * Univariate::variable().pow(nu - i);
  const cln::cl_RA b = next_coefficient(series, root, nu + 1);
  std::vector<Choice> result;
  for (const int sign : {1, -1})
    result.push_back({RationalFunction(Univariate(sign) * part),
                      (sign * b / *leading - cln::cl_RA(static_cast<long>(nu))) / cln::cl_RA(2)});
  return result;
}

std::vector<cln::cl_RA> all_coefficients(const Univariate& p) {
  std::vector<cln::cl_RA> result;
  for (long i = 0; i <= p.degree(); ++i) result.push_back(p.coefficient(i));
  return result;
}

/// A monic P of degree d with P'' + 2 theta P' + (theta' + theta^2 - r) P = 0.
std::optional<Univariate> monic_polynomial(const RationalFunction& theta, const RationalFunction& r,
                                           long d, std::vector<NoPolynomial>& steps) {
  const RationalFunction last = theta.derivative() + theta * theta - r;
  const Univariate common = (theta.denominator() * theta.denominator());
  const Univariate scale = common.divided(gcd(common, last.denominator())).first *
                           last.denominator();  // the least common multiple
  const auto cleared = [&](const RationalFunction& f) {
    return f.numerator() * scale.divided(f.denominator()).first;
  };
  const Univariate first = Univariate(2) * cleared(theta), second = cleared(last);
  std::vector<Univariate> images;
  long height = 0;
  for (long j = 0; j <= d; ++j) {
    const Univariate p = Univariate::variable().pow(static_cast<unsigned long>(j));
    const Univariate slope = p.derivative();
    images.push_back(scale * slope.derivative() + first * slope + second * p);
    height = std::max(height, images.back().degree() + 1);
  }
  if (height == 0) return Univariate::variable().pow(static_cast<unsigned long>(d));
  fmpq_mat_t matrix;
  fmpq_mat_init(matrix, height, d + 1);
  for (long i = 0; i < height; ++i)
    for (long j = 0; j <= d; ++j)
      fmpq_poly_get_coeff_fmpq(fmpq_mat_entry(matrix, i, j),
                               images[static_cast<std::size_t>(j)].raw(), i);
  const long rank = fmpq_mat_rref(matrix, matrix);
  // The last column depends on the others exactly where no pivot is in it.
  std::optional<Univariate> result;
  std::vector<cln::cl_RA> coefficients(static_cast<std::size_t>(d) + 1, 0);
  coefficients.back() = 1;
  bool free = true;
  for (long i = 0; i < rank; ++i) {
    long pivot = 0;
    while (fmpq_is_zero(fmpq_mat_entry(matrix, i, pivot))) ++pivot;
    if (pivot == d) free = false;
    if (pivot == d) break;
    Rational entry;
    fmpq_set(entry.get(), fmpq_mat_entry(matrix, i, d));
    coefficients[static_cast<std::size_t>(pivot)] = -entry.number();
  }
  if (free)
    result = Univariate(coefficients);
  else
    steps.push_back({fmt::format("case 1: a polynomial of degree {}", d),
                     0,
                     {all_coefficients(scale), all_coefficients(first), all_coefficients(second)},
                     d,
                     true,
                     {}});
  fmpq_mat_clear(matrix);
  return result;
}

constexpr long kLargestDegreeOfCaseOne = 1000;
constexpr std::size_t kMostPlaces = 14;

/// Every choice at every place, one after the other.
class Choices {
 public:
  Choices(const RationalFunction& r, const std::vector<std::vector<Choice>>& places,
          const std::function<void()>& tick)
      : r_(r), places_(places), tick_(tick) {}

  std::optional<RationalFunction> search() {
    visit(0, RationalFunction(), 0);
    return found_;
  }
  std::size_t sums() const { return sums_; }
  std::size_t degrees() const { return degrees_; }
  const std::vector<NoPolynomial>& steps() const { return steps_; }

 private:
  /// The last place is infinity: d is its degree less the sum of the residues.
  void visit(std::size_t place, const RationalFunction& theta, const cln::cl_RA& residues) {
    if (found_) return;
    for (const Choice& choice : places_[place]) {
      const RationalFunction sum = theta + choice.part;
      if (place + 1 < places_.size())
        visit(place + 1, sum, residues + choice.residues);
      else
        decide(sum, choice.residues - residues);
      if (found_) return;
    }
  }

  void decide(const RationalFunction& theta, const cln::cl_RA& d) {
    tick_();
    ++sums_;
    if (cln::denominator(d) != 1 || cln::minusp(d)) return;
    ++degrees_;
    if (d > kLargestDegreeOfCaseOne)
      throw NotDecided("a polynomial of case 1 may have a degree above 1000");
    const auto p = monic_polynomial(theta, r_, cln::cl_I_to_long(cln::numerator(d)), steps_);
    if (p) found_ = theta + RationalFunction(p->derivative(), *p);
  }

  const RationalFunction& r_;
  const std::vector<std::vector<Choice>>& places_;
  const std::function<void()>& tick_;
  std::optional<RationalFunction> found_;
  std::size_t sums_ = 0, degrees_ = 0;
  std::vector<NoPolynomial> steps_;
};

}  // namespace

RiccatiSearch rational_riccati(const RationalFunction& r, const std::vector<Singularity>& singular,
                               const std::function<void()>& tick, const std::string& z) {
  for (const Singularity& s : singular)
    if (!s.regular() && s.order % 2 != 0)
      return {{}, fmt::format("a pole of r of odd order, {}", s.text(z))};
  std::vector<std::vector<Choice>> places;
  std::string unresolved;
  for (const Singularity& s : singular) {
    try {
      places.push_back(s.at_infinity() ? infinity(r, s)
                       : s.regular()   ? regular_pole(s)
                                       : irregular_pole(r, s));
    } catch (const NotDecided& problem) {
      unresolved = problem.what();
      continue;
    }
    if (places.back().empty()) return {{}, fmt::format("no residue of w is in Q at {}", s.text(z))};
  }
  if (!unresolved.empty()) throw NotDecided(unresolved);
  if (places.size() > kMostPlaces) throw NotDecided("more than 14 singular points in case 1");
  Choices choices(r, places, tick);
  const auto solution = choices.search();
  if (solution) return {solution, {}};
  return {{},
          choices.degrees() == 0
              ? fmt::format("none of {} sums of residues leaves a degree in 0, 1, 2, ..",
                            choices.sums())
              : fmt::format("{} of {} sums of residues leave a degree in 0, 1, 2, ..; the linear "
                            "equations for a polynomial of it have no solution",
                            choices.degrees(), choices.sums()),
          choices.steps()};
}

}  // namespace casimir::obstruction
