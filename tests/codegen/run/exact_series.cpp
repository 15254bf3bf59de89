#include "tests/codegen/run/exact_series.hpp"

#include <cln/complex.h>
#include <cln/rational.h>
#include <cln/real.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "symbolic/expression/elementary.hpp"

namespace casimir::testing {

namespace {

using cln::cl_F;

const cln::float_format_t kFormat = cln::float_format(60);

cl_F number(const cln::cl_R& value) { return cln::cl_float(value, kFormat); }
cl_F number(std::size_t value) { return cln::cl_float(cln::cl_I(value), kFormat); }

double magnitude(const cl_F& value) { return std::fabs(cln::double_approx(value)); }

/// The sum of factor(j) * a_j * b_(k-j) for j from `first` to `last`.
Sized convolved(const Series& a, const Series& b, std::size_t k, std::size_t first,
                std::size_t last, const std::function<cl_F(std::size_t)>& factor) {
  Sized sum{number(std::size_t{0}), 0};
  for (std::size_t j = first; j <= last; ++j) {
    const cl_F f = factor(j);
    sum.value = sum.value + f * a[j].value * b[k - j].value;
    sum.size += magnitude(f) * a[j].size * b[k - j].size;
  }
  return sum;
}

cl_F one(std::size_t) { return number(std::size_t{1}); }

Series product(const Series& a, const Series& b) {
  Series c;
  for (std::size_t k = 0; k < a.size(); ++k) c.push_back(convolved(a, b, k, 0, k, one));
  return c;
}

Series sum(Series a, const Series& b, int sign = 1) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    a[k].value = sign > 0 ? a[k].value + b[k].value : a[k].value - b[k].value;
    a[k].size += b[k].size;
  }
  return a;
}

Sized divided(const Sized& a, const Sized& b) {
  if (cln::zerop(b.value)) throw std::domain_error("division by zero");
  const cl_F quotient = a.value / b.value;
  return {quotient, (a.size + magnitude(quotient) * b.size) / magnitude(b.value)};
}

Series quotient(const Series& a, const Series& b) {
  Series q;
  for (std::size_t k = 0; k < a.size(); ++k) {
    Sized rest = a[k];
    if (k > 0) {
      const Sized known = convolved(q, b, k, 0, k - 1, one);
      rest = {rest.value - known.value, rest.size + known.size};
    }
    q.push_back(divided(rest, b[0]));
  }
  return q;
}

/// The series from `start` whose derivative is u' * w.
Series integral(Sized start, const Series& u, const Series& w) {
  Series y{std::move(start)};
  for (std::size_t k = 1; k < u.size(); ++k)
    y.push_back(convolved(u, w, k, 1, k, [k](std::size_t j) { return number(j) / number(k); }));
  return y;
}

/// The value of a function at the constant term and the size of its error.
Sized at_start(const cl_F& value, const cl_F& slope, const Sized& argument) {
  return {value, magnitude(value) + magnitude(slope) * argument.size};
}

void sine_and_cosine(const Series& u, Series& s, Series& c) {
  const cl_F sine = cln::sin(u[0].value), cosine = cln::cos(u[0].value);
  s = {at_start(sine, cosine, u[0])};
  c = {at_start(cosine, sine, u[0])};
  for (std::size_t k = 1; k < u.size(); ++k) {
    const auto weight = [k](std::size_t j) { return number(j) / number(k); };
    const Sized next_sine = convolved(u, c, k, 1, k, weight);
    const Sized next_cosine = convolved(u, s, k, 1, k, weight);
    s.push_back(next_sine);
    c.push_back({-next_cosine.value, next_cosine.size});
  }
}

Series exponential(const Series& u) {
  const cl_F value = cln::exp(u[0].value);
  Series e{at_start(value, value, u[0])};
  for (std::size_t k = 1; k < u.size(); ++k)
    e.push_back(convolved(u, e, k, 1, k, [k](std::size_t j) { return number(j) / number(k); }));
  return e;
}

Series logarithm(const Series& u) {
  if (!cln::plusp(u[0].value)) throw std::domain_error("log");
  Series l{at_start(number(cln::ln(u[0].value)), number(1 / u[0].value), u[0])};
  for (std::size_t k = 1; k < u.size(); ++k) {
    const Sized known =
        convolved(l, u, k, 1, k - 1, [k](std::size_t j) { return number(j) / number(k); });
    l.push_back(divided({u[k].value - known.value, u[k].size + known.size}, u[0]));
  }
  return l;
}

/// u^p where u_0 is positive.
Series real_power(const Series& u, const cln::cl_RA& p) {
  if (!cln::plusp(u[0].value)) throw std::domain_error("root");
  const cl_F exponent = number(p);
  const cl_F value = number(cln::exp(exponent * number(cln::ln(u[0].value))));
  Series y{at_start(value, number(exponent * value / u[0].value), u[0])};
  for (std::size_t k = 1; k < u.size(); ++k) {
    const Sized next = convolved(u, y, k, 1, k, [&](std::size_t j) {
      return (exponent * number(j) - number(k - j)) / number(k);
    });
    y.push_back(divided(next, u[0]));
  }
  return y;
}

/// The angle of (b, a).
Series angle(const Series& a, const Series& b) {
  const Series square = sum(product(a, a), product(b, b));
  const Series first = quotient(b, square), second = quotient(a, square);
  const cl_F value = number(cln::atan(b[0].value, a[0].value));
  const Sized start{value, magnitude(value) + a[0].size * magnitude(first[0].value) +
                               b[0].size * magnitude(second[0].value)};
  return sum(integral(start, a, first), integral({number(std::size_t{0}), 0}, b, second), -1);
}

/// The arcsine, or with sign -1 the arccosine.
Series arcsine(const Series& u, int sign) {
  Series one_series(u.size(), Sized{number(std::size_t{0}), 0});
  one_series[0] = {number(std::size_t{1}), 1};
  const Series root = real_power(sum(one_series, product(u, u), -1), cln::recip(cln::cl_RA(-2)));
  const cl_F value = number(sign > 0 ? cln::realpart(cln::asin(u[0].value))
                                     : cln::realpart(cln::acos(u[0].value)));
  Series y = integral(at_start(value, root[0].value, u[0]), u, root);
  for (std::size_t k = 1; k < y.size() && sign < 0; ++k) y[k].value = -y[k].value;
  return y;
}

}  // namespace

void SeriesEvaluator::set(const GiNaC::symbol& symbol, Series series) {
  series.resize(order_ + 1, Sized{number(std::size_t{0}), 0});
  values_[symbol] = std::move(series);
}

Series SeriesEvaluator::constant(const cln::cl_R& value) const {
  Series result(order_ + 1, Sized{number(std::size_t{0}), 0});
  result[0] = {number(value), magnitude(number(value))};
  return result;
}

Series SeriesEvaluator::operator()(const GiNaC::ex& e) const {
  if (GiNaC::is_a<GiNaC::symbol>(e)) return values_.at(e);
  if (GiNaC::is_a<GiNaC::numeric>(e))
    return constant(cln::realpart(GiNaC::ex_to<GiNaC::numeric>(e).to_cl_N()));
  if (e.is_equal(GiNaC::Pi)) return constant(cln::pi(kFormat));
  if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
    Series result = (*this)(e.op(0));
    for (std::size_t i = 1; i < e.nops(); ++i)
      result = GiNaC::is_a<GiNaC::add>(e) ? sum(std::move(result), (*this)(e.op(i)))
                                          : product(result, (*this)(e.op(i)));
    return result;
  }
  if (GiNaC::is_a<GiNaC::power>(e)) return power(e.op(0), e.op(1));
  if (GiNaC::is_a<GiNaC::function>(e)) return call(e);
  throw std::domain_error("unknown expression");
}

Series SeriesEvaluator::power(const GiNaC::ex& base, const GiNaC::ex& exponent) const {
  const Series u = (*this)(base);
  const auto& p = GiNaC::ex_to<GiNaC::numeric>(exponent);
  if (!p.is_integer()) return real_power(u, cln::rational(cln::realpart(p.to_cl_N())));
  const int n = p.to_int();
  Series result = constant(1);
  for (int i = 0; i < std::abs(n); ++i) result = product(result, u);
  return n < 0 ? quotient(constant(1), result) : result;
}

Series SeriesEvaluator::call(const GiNaC::ex& function) const {
  const std::string name = GiNaC::ex_to<GiNaC::function>(function).get_name();
  const Series u = (*this)(function.op(0));
  if (name == "exp") return exponential(u);
  if (name == "log") return logarithm(u);
  if (name == "asin") return arcsine(u, 1);
  if (name == "acos") return arcsine(u, -1);
  if (name == "atan") return angle(u, constant(1));
  if (name == "atan2") return angle(u, (*this)(function.op(1)));
  if (const auto exponentials = by_exponentials(GiNaC::ex_to<GiNaC::function>(function)))
    return (*this)(*exponentials);
  Series sine, cosine;
  sine_and_cosine(u, sine, cosine);
  if (name == "sin") return sine;
  if (name == "cos") return cosine;
  if (name == "tan") return quotient(sine, cosine);
  throw std::domain_error("unknown function " + name);
}

std::vector<Series> solution_series(const std::vector<GiNaC::symbol>& variables,
                                    const std::vector<GiNaC::ex>& field,
                                    const std::vector<cln::cl_R>& state,
                                    const std::map<GiNaC::ex, cln::cl_R, GiNaC::ex_is_less>& fixed,
                                    const GiNaC::symbol* time, std::size_t order) {
  std::vector<Series> x;
  for (const cln::cl_R& value : state) x.push_back({{number(value), magnitude(number(value))}});
  for (std::size_t k = 0; k < order; ++k) {
    SeriesEvaluator evaluate(k);
    for (const auto& [symbol, value] : fixed)
      evaluate.set(GiNaC::ex_to<GiNaC::symbol>(symbol), evaluate.constant(value));
    if (time && k > 0) {
      Series t = evaluate.constant(fixed.at(*time));
      t[1] = {number(std::size_t{1}), 1};
      evaluate.set(*time, t);
    }
    for (std::size_t i = 0; i < x.size(); ++i) evaluate.set(variables[i], x[i]);
    std::vector<Sized> next;
    for (const GiNaC::ex& f : field) next.push_back(evaluate(f)[k]);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i].push_back({next[i].value / number(k + 1), next[i].size / static_cast<double>(k + 1)});
  }
  return x;
}

}  // namespace casimir::testing
