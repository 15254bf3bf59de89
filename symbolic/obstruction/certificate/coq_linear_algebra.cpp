// The file for Coq of the linear algebra in a proof that there is no further integral.
#include "symbolic/obstruction/certificate/coq_linear_algebra.hpp"

#include <cln/integer.h>
#include <flint/fmpq_mat.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "symbolic/algebra/flint_conversion.hpp"
#include "symbolic/algebra/number_text.hpp"
#include "symbolic/obstruction/certificate/coq_vectors.hpp"
#include "symbolic/obstruction/equation/kovacic.hpp"

namespace casimir::obstruction {
namespace {

/// More unknowns than this would make Coq slow.
constexpr long kLargestDegree = 60;

std::string number(const cln::cl_RA& value) {
  const cln::cl_I denominator = cln::denominator(value);
  const std::string above = rational_text(cln::numerator(value));
  return denominator == 1 && !cln::minusp(value)
             ? above
             : fmt::format("({} # {})", above, rational_text(denominator));
}

template <class Items, class Print>
std::string list(const Items& items, const Print& print) {
  std::string result;
  for (const auto& item : items) result += (result.empty() ? "" : "; ") + print(item);
  return "[" + result + "]";
}

std::string vector_text(const std::vector<cln::cl_RA>& vector) { return list(vector, number); }

/// The images of 1, z, z^2, ..
std::vector<Univariate> images(const NoPolynomial& step) {
  std::vector<Univariate> p;
  for (const auto& coefficients : step.polynomials) p.emplace_back(coefficients);
  std::vector<Univariate> result;
  for (long j = 0; j <= step.degree; ++j) {
    const Univariate x = Univariate::variable().pow(static_cast<unsigned long>(j));
    if (step.power == 0) {
      const Univariate slope = x.derivative();
      result.push_back(p[0] * slope.derivative() + p[1] * slope + p[2] * x);
    } else {
      result.push_back(symmetric_power_image(p, step.power, x));
    }
  }
  return result;
}

using Witnesses = std::vector<std::vector<cln::cl_RA>>;

/// For each unknown (or the last one) a combination of the equations that contains it alone: the
/// solutions of l M = unit vectors, M having the images as columns. Empty where there are none.
Witnesses witnesses(const std::vector<Univariate>& columns, bool last_only) {
  const auto n = static_cast<long>(columns.size());
  const long targets = last_only ? 1 : n;
  long height = 1;
  for (const Univariate& c : columns) height = std::max(height, c.degree() + 1);
  fmpq_mat_t m;
  fmpq_mat_init(m, n, height + targets);
  for (long j = 0; j < n; ++j)
    for (long i = 0; i < height; ++i)
      fmpq_poly_get_coeff_fmpq(fmpq_mat_entry(m, j, i), columns[static_cast<std::size_t>(j)].raw(),
                               i);
  for (long k = 0; k < targets; ++k)
    fmpq_set_si(fmpq_mat_entry(m, last_only ? n - 1 : k, height + k), 1, 1);
  const long rank = fmpq_mat_rref(m, m);
  Witnesses result(static_cast<std::size_t>(targets),
                   std::vector<cln::cl_RA>(static_cast<std::size_t>(height), 0));
  for (long i = 0; i < rank; ++i) {
    long pivot = 0;
    while (fmpq_is_zero(fmpq_mat_entry(m, i, pivot))) ++pivot;
    if (pivot >= height) {
      result.clear();
      break;
    }
    for (long k = 0; k < targets; ++k) {
      Rational entry;
      fmpq_set(entry.get(), fmpq_mat_entry(m, i, height + k));
      result[static_cast<std::size_t>(k)][static_cast<std::size_t>(pivot)] = entry.number();
    }
  }
  fmpq_mat_clear(m);
  return result;
}

/// That the degree which the orders leave is negative: there is no polynomial.
std::string bound(const NoPolynomial& step, std::size_t number_of) {
  std::string sum = "0";
  for (const auto& [order, count] : step.orders) sum += fmt::format(" - ({}) * ({})", order, count);
  return fmt::format("Theorem no_degree_{} : ({} < 0)%Z.\nProof. reflexivity. Qed.\n", number_of,
                     sum);
}

std::string theorem(const NoPolynomial& step, std::size_t number_of, const Witnesses& rows) {
  std::string result;
  const char* names = step.power == 0 ? "abc" : "gdwr";
  for (std::size_t i = 0; i < step.polynomials.size(); ++i)
    result += fmt::format("Definition {}_{} : list Q := {}.\n", names[i], number_of,
                          vector_text(step.polynomials[i]));
  result +=
      step.power == 0
          ? fmt::format("Definition image_{0} := second_order a_{0} b_{0} c_{0}.\n", number_of)
          : fmt::format(
                "Definition image_{0} := symmetric_power g_{0} d_{0} w_{0} r_{0} "
                "{1}.\n",
                number_of, step.power);
  result += fmt::format(
      "Definition images_{0} := map image_{0} (monomials {1}).\n"
      "Definition witnesses_{0} : list (list Q) := {2}.\n",
      number_of, step.degree + 1,
      list(rows, [](const auto& row) { return "\n  " + vector_text(row); }));
  if (step.exactly)
    return result +
           fmt::format(
               "Theorem no_polynomial_{0} : forall c, zero (combination c images_{0}) -> nth {1} c "
               "0 == 0.\nProof.\n  intros c Z; apply (told (nth 0 witnesses_{0} []) {1} images_{0} "
               "c); [vm_compute; reflexivity|exact Z].\nQed.\n",
               number_of, step.degree);
  return result +
         fmt::format(
             "Theorem no_polynomial_{0} : forall c n, (n < {1})%nat ->\n  zero (combination c "
             "images_{0}) -> nth n c 0 == 0.\nProof.\n  intros c n L Z; apply (told (nth n "
             "witnesses_{0} []) n images_{0} c); [|exact Z].\n  apply (all_told_each witnesses_{0} "
             "0 images_{0} n); [vm_compute; reflexivity|exact L].\nQed.\n",
             number_of, step.degree + 1);
}

}  // namespace

LinearCertificate linear_certificate(const Obstruction& obstruction) {
  if (!obstruction.proved || !obstruction.free.empty() || obstruction.examined.empty())
    throw NoCertificate("nothing is proved of one equation");
  LinearCertificate result;
  result.text = kCoqVectors;
  std::size_t count = 0;
  for (const NoPolynomial& step : obstruction.examined.back().steps) {
    if (step.degree > kLargestDegree) {
      result.left_out.push_back(
          fmt::format("{}: a polynomial of degree {} is too large", step.what, step.degree));
      continue;
    }
    const Witnesses rows = step.degree < 0 ? Witnesses() : witnesses(images(step), step.exactly);
    if (step.degree >= 0 && rows.empty())
      throw std::logic_error("linear equations have a solution after all");
    ++count;
    result.text +=
        fmt::format("\n(** Step {}: {} *)\n\n", count,
                    step.power == 0 ? "case 1 of Kovacic's algorithm"
                                    : fmt::format("invariants of degree {}", step.power));
    result.text += step.degree < 0 ? bound(step, count) : theorem(step, count, rows);
  }
  if (count == 0)
    throw NoCertificate("the proof has no linear equations of a size that Coq could check");
  return result;
}

}  // namespace casimir::obstruction
