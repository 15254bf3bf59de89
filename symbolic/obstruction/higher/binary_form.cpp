#include "symbolic/obstruction/higher/binary_form.hpp"

#include <algorithm>

namespace casimir::obstruction {
namespace {

using cln::cl_RA;

bool is_zero(const BinaryForm& form) {
  return std::all_of(form.begin(), form.end(), [](const cl_RA& c) { return cln::zerop(c); });
}

/// q11 d^2/dc1^2 + q12 d^2/dc1dc2 + q22 d^2/dc2^2: d/dy1 d/dy2.
BinaryForm polarised(const BinaryForm& form, const ProductOfSolutions& q) {
  const auto r = static_cast<long>(form.size()) - 1;
  BinaryForm result(form.size() - 2, 0);
  for (long j = 0; j <= r; ++j) {
    const cl_RA& c = form[static_cast<std::size_t>(j)];
    const auto add = [&](long place, const cl_RA& value) {
      if (place < 0 || place > r - 2) return;
      cl_RA& own = result[static_cast<std::size_t>(place)];
      own = own + value;
    };
    add(j - 2, q[0] * c * cl_RA(j * (j - 1)));
    add(j - 1, q[1] * c * cl_RA(j * (r - j)));
    add(j, q[2] * c * cl_RA((r - j) * (r - j - 1)));
  }
  return result;
}

/// A polynomial as forms in the last two constants, one for each monomial of the others and degree.
using Forms = std::map<std::pair<Monomial, std::size_t>, BinaryForm>;

void add_term(Forms& forms, Monomial monomial, const cl_RA& value) {
  const std::size_t n = monomial.size();
  const std::size_t first = monomial[n - 2], degree = first + monomial[n - 1];
  monomial.resize(n - 2);
  BinaryForm& form = forms[{monomial, degree}];
  form.resize(degree + 1, 0);
  form[first] = form[first] + value;
}

BinaryForm product_of(const BinaryForm& a, const BinaryForm& b) {
  BinaryForm result(a.size() + b.size() - 1, 0);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) result[i + j] = result[i + j] + a[i] * b[j];
  return result;
}

void append(const Forms& forms, std::vector<BinaryForm>& result) {
  for (const auto& [what, form] : forms) result.push_back(form);
}

}  // namespace

bool has_invariant_part(const BinaryForm& form, const ProductOfSolutions& q) {
  if (form.size() % 2 == 0) return false;
  const bool one_line = cln::zerop(q[1] * q[1] - 4 * q[0] * q[2]);
  BinaryForm rest = form;
  while (!one_line && rest.size() > 1) rest = polarised(rest, q);
  return !is_zero(rest);
}

bool has_other_part(const BinaryForm& form, const ProductOfSolutions& q) {
  if (cln::zerop(q[1] * q[1] - 4 * q[0] * q[2]) || is_zero(form)) return false;
  if (form.size() % 2 == 0) return true;
  BinaryForm power{1};
  while (power.size() < form.size()) power = product_of(power, {q[0], -q[1], q[2]});
  for (std::size_t i = 0; i < form.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!cln::zerop(form[i] * power[j] - form[j] * power[i])) return true;
  return false;
}

std::vector<BinaryForm> forms_of(const std::vector<ConstantPolynomial>& field) {
  const std::size_t n = field.size();
  Forms determinant;
  std::vector<BinaryForm> result;
  for (std::size_t i = 0; i < n; ++i) {
    Forms own;
    for (const auto& [monomial, value] : field[i]) {
      Monomial with = monomial;
      if (i + 2 < n) {
        add_term(own, with, value);
      } else if (i + 2 == n) {
        ++with[n - 1];
        add_term(determinant, with, -value);
      } else {
        ++with[n - 2];
        add_term(determinant, with, value);
      }
    }
    append(own, result);
  }
  append(determinant, result);
  return result;
}

}  // namespace casimir::obstruction
