#include "symbolic/functions/convert/elliptic_generators.hpp"

#include <array>

#include "symbolic/error.hpp"
#include "symbolic/expression/elliptic.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// Places behind the amplitude: its derivative by the modulus, that of d, sine, cosine, and d.
constexpr std::size_t kSlopeOfD = 2, kPlaceOfD = 5, kOfAmplitude = 6;

/// The number of the generator a; that of d is kPlaceOfD more.
std::size_t amplitude(const GeneratorTools& t, const ex& u, const ex& k) {
  const Polynomial argument = t.convert(u), modulus = t.convert(k);
  if (const auto known = t.find(kAmplitude, {argument, modulus})) return *known;
  const std::vector<Polynomial> slopes = t.slopes(argument), turns = t.slopes(modulus);
  t.reserve(kOfAmplitude);
  const std::size_t first = t.count();
  const auto place = [&](std::size_t behind) { return t.variable(first + behind); };
  const Polynomial d = place(kPlaceOfD), square = t.product(modulus, modulus);
  std::vector<Polynomial> of_a, of_d;
  for (std::size_t i = 0; i < slopes.size(); ++i)
    of_a.push_back(t.product(d, slopes[i]) + t.product(place(1), turns[i]));
  t.add(elliptic::am(u, k).hold(), argument, kAmplitude, of_a);
  // Of the derivatives by the modulus only that they are not zero counts: FunctionRing::derivative
  // refuses them.
  std::vector<Polynomial> unknown;
  for (std::size_t i = 0; i < slopes.size(); ++i)
    unknown.push_back(t.product(slopes[i], slopes[i]) + t.product(turns[i], turns[i]));
  t.add(elliptic::am_by_modulus(u, k).hold(), modulus, kModulusSlope, unknown);
  t.add(elliptic::dn_by_modulus(u, k).hold(), modulus, kModulusSlope, unknown);
  const Polynomial s = t.sine(place(0)), c = t.cosine(place(0));
  if (t.count() != first + kPlaceOfD)
    throw TooLarge("the sine of an amplitude is made of other functions already");
  for (std::size_t i = 0; i < slopes.size(); ++i)
    of_d.push_back(t.product(place(kSlopeOfD), turns[i]) -
                   t.product(t.product(square, t.product(s, c)), slopes[i]));
  t.add_root(elliptic::dn(u, k).hold(), t.ring.constant(1) - t.product(square, t.product(s, s)),
             of_d);
  return first;
}

/// The number of R, for its arguments in this order; D of the last one is the next.
std::size_t symmetric(const GeneratorTools& t, const std::array<ex, 3>& arguments) {
  std::array<Polynomial, 3> x{t.convert(arguments[0]), t.convert(arguments[1]),
                              t.convert(arguments[2])};
  if (const auto known = t.find(kFirstKind, {x[0], x[1], x[2]})) return *known;
  for (std::size_t i = 0; i < 3; ++i) {
    if (t.vanishes(x[i]))
      throw TooLarge("elliptic integrals of an argument 0 have no derivation here");
    if (t.vanishes(x[i] - x[(i + 1) % 3]))
      throw TooLarge(
          "elliptic integrals of two equal arguments are elementary functions: they have to be "
          "written as these to be proved of");
  }
  const Polynomial between = t.inverse(x[0] - x[1]), first = t.inverse(x[2] - x[0]),
                   second = t.inverse(x[2] - x[1]), over_last = t.inverse(x[2]);
  const Polynomial sum = t.inverse(t.square_root(t.product(x[0], t.product(x[1], x[2])))).scaled(3);
  const std::array<std::vector<Polynomial>, 3> slopes{t.slopes(x[0]), t.slopes(x[1]),
                                                      t.slopes(x[2])};
  t.reserve(2);
  const std::size_t place = t.count();
  const Polynomial r = t.variable(place), last = t.variable(place + 1);
  const Polynomial p = sum - last, q = r.scaled(3) - t.product(x[2], last);
  const Polynomial of_first = t.product(between, q - t.product(x[1], p)),
                   of_second = t.product(between, t.product(x[0], p) - q);
  const cln::cl_RA half = cln::cl_RA(1) / 2, sixth = cln::cl_RA(1) / 6;
  const Polynomial by_first = t.product(first, last - of_first).scaled(half),
                   by_second = t.product(second, last - of_second).scaled(half);
  const Polynomial by_last = -t.product(
      over_last, last.scaled(3 * half) + t.product(x[0], by_first) + t.product(x[1], by_second));
  std::vector<Polynomial> of_r, of_last;
  for (std::size_t i = 0; i < slopes[0].size(); ++i) {
    of_r.push_back(-(t.product(of_first, slopes[0][i]) + t.product(of_second, slopes[1][i]) +
                     t.product(last, slopes[2][i]))
                        .scaled(sixth));
    of_last.push_back(t.product(by_first, slopes[0][i]) + t.product(by_second, slopes[1][i]) +
                      t.product(by_last, slopes[2][i]));
  }
  const auto& [a, b, c] = arguments;
  // What depends on the arguments in general, so that nobody takes these for constants.
  const Polynomial all = t.product(x[0], t.product(x[1], x[2]));
  t.add(elliptic::R_F(a, b, c).hold(), all, kFirstKind, of_r);
  t.add(elliptic::R_D(a, b, c).hold(), all, kSecondKind, of_last);
  return place;
}

/// D of the argument `which` of a known integral with these arguments in any order.
Polynomial second_kind(const GeneratorTools& t, const std::array<ex, 3>& arguments) {
  const std::array<Polynomial, 3> x{t.convert(arguments[0]), t.convert(arguments[1]),
                                    t.convert(arguments[2])};
  // All of R_F's orders of these arguments are one generator, of the order that came first.
  for (const auto& order : {std::array{0, 1, 2}, std::array{1, 0, 2}, std::array{0, 2, 1},
                            std::array{2, 0, 1}, std::array{1, 2, 0}, std::array{2, 1, 0}}) {
    const auto at = [&](int i) {
      return x[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])];
    };
    const auto known = t.find(kFirstKind, {at(0), at(1), at(2)});
    if (!known) continue;
    const Polynomial r = t.variable(*known), last = t.variable(*known + 1);
    if (order[2] == 2) return last;
    const Polynomial sum =
        t.inverse(t.square_root(t.product(at(0), t.product(at(1), at(2))))).scaled(3);
    const Polynomial p = sum - last, q = r.scaled(3) - t.product(at(2), last);
    const Polynomial between = t.inverse(at(0) - at(1));
    return order[0] == 2 ? t.product(between, q - t.product(at(1), p))
                         : t.product(between, t.product(at(0), p) - q);
  }
  return t.variable(symmetric(t, arguments) + 1);
}

Polynomial first_kind(const GeneratorTools& t, const std::array<ex, 3>& arguments) {
  const std::array<Polynomial, 3> x{t.convert(arguments[0]), t.convert(arguments[1]),
                                    t.convert(arguments[2])};
  for (const auto& order : {std::array{0, 1, 2}, std::array{1, 0, 2}, std::array{0, 2, 1},
                            std::array{2, 0, 1}, std::array{1, 2, 0}, std::array{2, 1, 0}}) {
    const auto at = [&](int i) {
      return x[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])];
    };
    if (const auto known = t.find(kFirstKind, {at(0), at(1), at(2)})) return t.variable(*known);
  }
  return t.variable(symmetric(t, arguments));
}

Polynomial third_kind(const GeneratorTools& t, const GiNaC::function& f) {
  std::vector<Polynomial> x;
  for (std::size_t i = 0; i < 4; ++i) x.push_back(t.convert(f.op(i)));
  if (const auto known = t.find(kThirdKind, x)) return t.variable(*known);
  std::vector<Polynomial> kinds, over;
  for (std::size_t i = 0; i < 3; ++i) {
    const Polynomial difference = x[3] - x[i];
    if (t.vanishes(x[i]) || t.vanishes(x[3]))
      throw TooLarge("elliptic integrals of an argument 0 have no derivation here");
    if (t.vanishes(difference))
      throw TooLarge("R_J(x, y, z, z) is R_D(x, y, z), and has to be written as that");
    over.push_back(t.inverse(difference));
    kinds.push_back(second_kind(t, {f.op((i + 1) % 3), f.op((i + 2) % 3), f.op(i)}));
  }
  const Polynomial over_last = t.inverse(x[3]);
  std::vector<std::vector<Polynomial>> slopes;
  for (const Polynomial& argument : x) slopes.push_back(t.slopes(argument));
  t.reserve(1);
  const Polynomial j = t.variable(t.count());
  const cln::cl_RA half = cln::cl_RA(1) / 2;
  std::vector<Polynomial> by;
  Polynomial rest = j.scaled(3 * half);
  for (std::size_t i = 0; i < 3; ++i) {
    by.push_back(t.product(over[i], j - kinds[i]).scaled(half));
    rest += t.product(x[i], by[i]);
  }
  by.push_back(-t.product(over_last, rest));
  std::vector<Polynomial> derivatives;
  for (std::size_t s = 0; s < slopes[0].size(); ++s) {
    Polynomial sum(t.ring);
    for (std::size_t i = 0; i < 4; ++i) sum += t.product(by[i], slopes[i][s]);
    derivatives.push_back(std::move(sum));
  }
  const std::size_t place = t.count();
  const Polynomial all = t.product(t.product(x[0], x[1]), t.product(x[2], x[3]));
  t.add(f, all, kThirdKind, std::move(derivatives));
  return t.variable(place);
}

}  // namespace

Polynomial elliptic_polynomial(const GeneratorTools& tools, const GiNaC::function& f) {
  if (tools.complex)
    throw TooLarge(
        "elliptic functions are known for real numbers alone, and this has complex ones");
  const std::string name = f.get_name();
  const bool is_carlson = name == "R_F" || name == "R_D" || name == "R_J";
  for (std::size_t i = 0; is_carlson && i < f.nops(); ++i)
    tools.take_as_positive(tools.convert(f.op(i)));
  if (!is_carlson) {
    const Polynomial modulus = tools.convert(f.op(1));
    tools.take_as_positive(tools.ring.constant(1) - tools.product(modulus, modulus));
  }
  if (name == "R_F") return first_kind(tools, {f.op(0), f.op(1), f.op(2)});
  if (name == "R_D") return second_kind(tools, {f.op(0), f.op(1), f.op(2)});
  if (name == "R_J") return third_kind(tools, f);
  const std::size_t a = amplitude(tools, f.op(0), f.op(1));
  if (name == "am") return tools.variable(a);
  if (name == "sn") return tools.sine(tools.variable(a));
  if (name == "cn") return tools.cosine(tools.variable(a));
  return tools.variable(a + kPlaceOfD);
}

}  // namespace casimir
