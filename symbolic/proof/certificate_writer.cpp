#include "symbolic/proof/certificate_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace casimir {
namespace {

using GiNaC::ex;

/// A polynomial as it stands, with rational coefficients: nothing has to be known or assumed to
/// read it as one.
bool is_plain_polynomial(const ex& e) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) return true;
  if (GiNaC::is_a<GiNaC::numeric>(e)) return GiNaC::ex_to<GiNaC::numeric>(e).is_rational();
  if (GiNaC::is_a<GiNaC::power>(e)) {
    return is_plain_polynomial(e.op(0)) && GiNaC::is_a<GiNaC::numeric>(e.op(1)) &&
           GiNaC::ex_to<GiNaC::numeric>(e.op(1)).is_nonneg_integer();
  }
  if (!GiNaC::is_a<GiNaC::add>(e) && !GiNaC::is_a<GiNaC::mul>(e)) return false;
  return std::all_of(e.begin(), e.end(), is_plain_polynomial);
}

/// The plain polynomials among what the file may be about.
std::vector<ex> polynomials_of(const Model& model, const std::vector<ex>& about) {
  std::vector<ex> all{*model.hamiltonian};
  for (std::size_t i = 0; i < model.variables.size(); ++i) {
    for (std::size_t j = i + 1; j < model.variables.size(); ++j)
      all.push_back((*model.poisson)(i, j));
  }
  all.insert(all.end(), about.begin(), about.end());
  std::erase_if(all, [](const ex& e) { return !is_plain_polynomial(e); });
  return all;
}

}  // namespace

std::string claim_title(ClaimKind kind, const std::string& name, std::size_t number) {
  const std::string place = fmt::format("{} no. {}", to_string(kind), number);
  return is_coq_name(name) ? fmt::format("{}, {}", place, name) : place;
}

std::string Statement::title() const {
  return claim_title(kind, function ? function->expression.name : "", number);
}

CertificateWriter::CertificateWriter(const Model& model, const std::vector<ex>& about)
    : model_(model),
      // Without the assumptions of the case: what they would simplify is not what the file says.
      ring_(model.symbols(), {}, polynomials_of(model, about), model.limits),
      file_(model.symbols(), model.variables.size()) {
  file_.begin_part("The bracket and the Hamiltonian");
  std::vector<Polynomial> upper;
  for (std::size_t i = 0; i < dimension(); ++i) {
    for (std::size_t j = i + 1; j < dimension(); ++j)
      upper.push_back(polynomial((*model.poisson)(i, j)));
  }
  file_.define_bracket(upper);
  field_.assign(dimension() * dimension(), Polynomial(ring_.ring()));
  for (std::size_t i = 0, entry = 0; i < dimension(); ++i) {
    for (std::size_t j = i + 1; j < dimension(); ++j, ++entry) {
      field_[i * dimension() + j] = upper[entry];
      field_[j * dimension() + i] = -upper[entry];
    }
  }
  hamiltonian_.emplace(file_.define("hamiltonian", polynomial(*model.hamiltonian)));
}

Polynomial CertificateWriter::polynomial(const ex& e) {
  if (!is_plain_polynomial(e))
    throw NotCovered("it is not about polynomials with rational coefficients");
  return ring_.convert(e);
}

CertificateWriter::Parts CertificateWriter::parts(const Statement& statement) {
  const LevelClaim& claim = statement.function.value();
  Parts result{claim.expression.name, polynomial(claim.expression.value), {}};
  for (const NamedExpression& g : claim.on) result.level.push_back(polynomial(g.value));
  return result;
}

std::vector<CoqFunction> CertificateWriter::define_level(const std::string& name,
                                                         const std::vector<Polynomial>& functions) {
  std::vector<CoqFunction> level;
  for (std::size_t k = 0; k < functions.size(); ++k)
    level.push_back(file_.define(fmt::format("{}_level_{}", name, k + 1), functions[k]));
  return level;
}

Polynomial CertificateWriter::bracket(const Polynomial& f, const Polynomial& g) const {
  SumOfProducts sum(ring_.ring());
  for (std::size_t i = 0; i < dimension(); ++i) {
    if (f.uses(i)) sum.add(f.derivative(i), flow(i, g));
  }
  return sum.finish();
}

Polynomial CertificateWriter::flow(std::size_t i, const Polynomial& g) const {
  SumOfProducts sum(ring_.ring());
  for (std::size_t j = 0; j < dimension(); ++j) {
    if (g.uses(j)) sum.add(bracket_entry(i, j), g.derivative(j));
  }
  return sum.finish();
}

std::vector<Polynomial> CertificateWriter::cofactors(const Polynomial& p,
                                                     const std::vector<Polynomial>& level) {
  std::vector<Polynomial> quotients(level.size(), Polynomial(p.ring()));
  if (p.is_zero()) return quotients;
  if (level.empty()) throw NotCovered("it is no identity of polynomials without assumptions");
  // What is zero anyway is no divisor.
  std::vector<Polynomial> divisors, own;
  for (const Polynomial& f : level)
    if (!f.is_zero()) divisors.push_back(f);
  own.assign(divisors.size(), Polynomial(p.ring()));
  if (divisors.empty() || !p.remainder(divisors, &own).is_zero())
    throw NotCovered("division by the functions of the level gave no polynomial cofactors");
  for (std::size_t k = 0, next = 0; k < level.size(); ++k)
    if (!level[k].is_zero()) quotients[k] = std::move(own[next++]);
  return quotients;
}

}  // namespace casimir
