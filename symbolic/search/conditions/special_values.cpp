#include "symbolic/search/conditions/special_values.hpp"

#include <flint/fmpz_poly.h>

#include <algorithm>
#include <set>

namespace casimir::search {
namespace {

using GiNaC::ex;

void collect_numbers(
    const ex& e, std::set<cln::cl_RA, bool (*)(const cln::cl_RA&, const cln::cl_RA&)>& numbers) {
  if (GiNaC::is_a<GiNaC::numeric>(e)) {
    const GiNaC::numeric& n = GiNaC::ex_to<GiNaC::numeric>(e);
    if (n.is_rational() && n.is_real()) numbers.insert(cln::the<cln::cl_RA>(n.to_cl_N()));
    return;
  }
  for (const ex& part : e) collect_numbers(part, numbers);
}

bool less(const cln::cl_RA& a, const cln::cl_RA& b) { return a < b; }

}  // namespace

std::vector<std::size_t> inside_functions(const System& system,
                                          const std::vector<std::size_t>& free) {
  const FunctionRing& ring = system.functions();
  std::set<std::size_t> seen;
  std::vector<std::size_t> open = system.atoms();
  open.insert(open.end(), system.parameters().begin(), system.parameters().end());
  std::set<std::size_t> inside;
  while (!open.empty()) {
    const std::size_t place = open.back();
    open.pop_back();
    if (place < ring.symbols().size() || place >= ring.end_of_generators()) continue;
    if (!seen.insert(place).second) continue;
    const Polynomial argument = ring.origin(place).argument;
    for (std::size_t i = 0; i < ring.end_of_generators(); ++i)
      if (argument.uses(i)) open.push_back(i);
    for (const std::size_t parameter : free) {
      if (!ring.derivative(ring.ring().variable(place), parameter).is_zero())
        inside.insert(parameter);
    }
  }
  for (const System::Defined& d : system.defined())
    for (const std::size_t parameter : free)
      if (!ring.derivative(d.value, parameter).is_zero()) inside.insert(parameter);
  return {inside.begin(), inside.end()};
}

std::vector<cln::cl_RA> simple_values(const Model& model) {
  std::set<cln::cl_RA, bool (*)(const cln::cl_RA&, const cln::cl_RA&)> numbers(less);
  for (const ex& rate : model.field) collect_numbers(rate, numbers);
  if (model.hamiltonian) collect_numbers(*model.hamiltonian, numbers);
  constexpr std::size_t kMostNumbers = 8;
  constexpr int kLargest = 4;
  std::vector<cln::cl_RA> result;
  const auto add = [&](const cln::cl_RA& value) {
    if (std::find(result.begin(), result.end(), value) == result.end()) result.push_back(value);
  };
  for (int n = 0; n <= kLargest; ++n)
    for (const int sign : {1, -1}) add(sign * n);
  for (const int sign : {1, -1}) {
    for (const int n : {1, 3}) add(cln::cl_RA(sign * n) / 2);
    for (const int n : {1, 2, 4}) add(cln::cl_RA(sign * n) / 3);
  }
  std::size_t used = 0;
  for (const cln::cl_RA& number : numbers) {
    if (++used > kMostNumbers) break;
    for (const cln::cl_RA& factor : {cln::cl_RA(1), cln::cl_RA(1) / 2, cln::cl_RA(2)})
      for (const int sign : {1, -1}) add(sign * factor * number);
  }
  return result;
}

long real_roots(const Polynomial& p, std::size_t place) {
  fmpz_poly_t poly;
  fmpz_poly_init(poly);
  const Polynomial primitive = p.scaled(1 / p.content());
  const std::vector<Polynomial> coefficients = primitive.coefficients(place);
  fmpq_t number;
  fmpq_init(number);
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    fmpq_zero(number);
    if (!coefficients[k].is_zero())
      fmpq_mpoly_get_fmpq(number, coefficients[k].raw(), coefficients[k].ring().context());
    fmpz_poly_set_coeff_fmpz(poly, static_cast<slong>(k), fmpq_numref(number));
  }
  const long result = fmpz_poly_num_real_roots(poly);
  fmpq_clear(number);
  fmpz_poly_clear(poly);
  return result;
}

}  // namespace casimir::search
