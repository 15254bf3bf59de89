#include "symbolic/discrete/moser_veselov.hpp"

#include <cln/real.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "symbolic/discrete/free_body.hpp"
#include "symbolic/discrete/moser_root.hpp"
#include "symbolic/discrete/new_names.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression_size.hpp"

namespace casimir {
namespace {

using GiNaC::ex;

/// The texts of the map, with m, J, e1, e2 by their names.
class MoserVeselov {
 public:
  MoserVeselov(const Model& flow, const std::optional<ex>& value)
      : flow_(flow),
        names_(flow),
        step_(names_.take({"eps", "epsilon", "step"})),
        step_value_(value.value_or(ex(step_))),
        ring_(symbols(), flow.assumptions, expressions(), flow.limits),
        body_(discrete::free_body(flow, ring_)) {
    for (const GiNaC::symbol& x : flow.variables) m_.push_back(x.get_name());
  }

  RationalMapText map() {
    if (step_value_.is_equal(step_)) text_.step = step_.get_name();
    for (const Polynomial& condition : body_.nonzero)
      text_.conditions.push_back(ring_.text(condition) + " != 0");
    define_body();
    define_rotation();
    define_relations();
    for (std::size_t i = 0; i < 3; ++i) text_.next.push_back(next(i));
    text_.added = {e1_, e2_};
    correct();
    text_.steps = {{3, 4}, {0, 1, 2}};
    claim();
    start();
    return std::move(text_);
  }

 private:
  static std::size_t after(std::size_t i) { return (i + 1) % 3; }

  std::vector<GiNaC::symbol> symbols() const {
    std::vector<GiNaC::symbol> result = flow_.symbols();
    result.push_back(step_);
    return result;
  }

  std::vector<ex> expressions() const {
    std::vector<ex> result{step_value_};
    if (flow_.hamiltonian) result.push_back(*flow_.hamiltonian);
    return result;
  }

  /// A definition of that value; its name.
  std::string define(const std::vector<std::string>& wanted, const std::string& value) {
    std::string name = names_.take(wanted);
    text_.definitions.emplace_back(name, value);
    return name;
  }

  /// "f(0) + f(1) + f(2)".
  template <class Term>
  static std::string sum(const Term& term) {
    return fmt::format("{} + {} + {}", term(0), term(1), term(2));
  }

  /// J, and the step in the units of J: dm/dt = m x grad H for the bracket -1.
  void define_body() {
    for (std::size_t i = 0; i < 3; ++i)
      j_.push_back(define({fmt::format("J{}", i + 1), fmt::format("inertia{}", i + 1)},
                          ring_.text(body_.tensor[i])));
    const Polynomial step =
        ring_.checked_product(ring_.convert(step_value_), body_.scale.scaled(-body_.bracket));
    h_ = define({"h", "scaled_step"}, text_of(step));
  }

  /// u with (J^2 + M^2 + e1 M + e2) u = m, by the adjugate matrix.
  void define_rotation() {
    e1_ = names_.take({"e1"});
    e2_ = names_.take({"e2"});
    n_ = define({"N", "square"}, sum([&](std::size_t i) { return m_[i] + "^2"; }));
    std::vector<std::string> d;
    for (std::size_t i = 0; i < 3; ++i)
      d.push_back(define({fmt::format("d{}", i + 1)},
                         fmt::format("{}^2 + {} - {}^2*{}", j_[i], e2_, h_, n_)));
    const std::string bottom =
        define({"D"}, fmt::format("({}*{} - {}*{}*{})^2 + {}^2*({})", e1_, e2_, j_[0], j_[1], j_[2],
                                  h_, sum([&](std::size_t i) {
                                    return fmt::format("({}^2 + {})^2*{}^2", j_[i], e2_, m_[i]);
                                  })));
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = after(i), k = after(j);
      u_.push_back(
          define({fmt::format("u{}", i + 1)},
                 fmt::format("({0}*{1}*{2} + {3}^2*{4}^2*{5}*{2} - "
                             "{3}*{4}*({6}^2 - {7}^2)*{8}*{9})/{10}",
                             d[j], d[k], m_[i], h_, e1_, n_, j_[j], j_[k], m_[j], m_[k], bottom)));
    }
  }

  void define_relations() {
    text_.relations.push_back(
        define({"A", "A_relation"},
               fmt::format("{}^2 - 2*{} - ({}) + {}^2*{}", e1_, e2_,
                           sum([&](std::size_t i) { return j_[i] + "^2"; }), h_, n_)));
    text_.relations.push_back(define(
        {"B", "B_relation"},
        fmt::format(
            "{}^2 - 2*{}*{}*{}*{} - ({}) + {}^2*({})", e2_, e1_, j_[0], j_[1], j_[2],
            sum([&](std::size_t i) { return fmt::format("{}^2*{}^2", j_[i], j_[after(i)]); }), h_,
            sum([&](std::size_t i) { return fmt::format("{}^2*{}^2", j_[i], m_[i]); }))));
  }

  /// w m = J (m x u + e1 u) + det(J) J^(-1) u.
  std::string next(std::size_t i) const {
    const std::size_t j = after(i), k = after(j);
    return fmt::format("{0}*({1}*{2} + {3}*({4}*{5} - {6}*{7})) + {8}*{9}*{2}", j_[i], e1_, u_[i],
                       h_, m_[j], u_[k], m_[k], u_[j], j_[j], j_[k]);
  }

  /// One step of Newton's method for A = B = 0 with m as it is. On the level it changes nothing;
  /// off it the formula for the next m may lead away from it, so that rounding errors would grow.
  void correct() {
    const std::string determinant = fmt::format("{}*{}*{}", j_[0], j_[1], j_[2]);
    const std::string bottom = fmt::format("(2*({}*{} - {}))", e1_, e2_, determinant);
    const std::string &a = text_.relations[0], &b = text_.relations[1];
    text_.next.push_back(fmt::format("{0} - ({1}*{2} + {3})/{4}", e1_, e2_, a, b, bottom));
    text_.next.push_back(
        fmt::format("{0} - ({1}*{2} + {3}*{4})/{5}", e2_, determinant, a, e1_, b, bottom));
  }

  std::string text_of(const Polynomial& p) const {
    const auto [top, bottom] = ring_.lowest_terms(p);
    if (bottom.is_constant()) return ring_.text(top.scaled(1 / bottom.content()));
    return fmt::format("({})/({})", ring_.text(top), ring_.text(bottom));
  }

  void claim() {
    text_.conditionals = {{names_.take({"E1"}), e1_},
                          {names_.take({"E2"}), e2_},
                          {names_.take({"K", "length"}), n_},
                          {names_.take({"energy"}), text_of(ring_.convert(*flow_.hamiltonian))}};
  }

  /// The exact value of an expression in a scene, or one of double accuracy; empty where it has
  /// none.
  std::optional<cln::cl_RA> number(const Polynomial& p, const Scene& scene, const ex& step) const {
    GiNaC::exmap at{{step_, step}};
    for (std::size_t i = 0; i < scene.parameters.size(); ++i)
      at[flow_.parameters[i]] = scene.parameters[i];
    for (std::size_t i = 0; i < scene.initial.size(); ++i)
      at[flow_.variables[i]] = scene.initial[i];
    const ex value = substituted(ring_.expression(p), at, flow_.limits);
    if (GiNaC::is_a<GiNaC::numeric>(value) && GiNaC::ex_to<GiNaC::numeric>(value).is_rational())
      return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
    const std::optional<GiNaC::numeric> rounded = real_decimal(value, flow_.limits.bits);
    if (!rounded) return std::nullopt;
    return cln::rational(cln::the<cln::cl_R>(rounded->to_cl_N()));
  }

  std::optional<discrete::RotationStart> rotation(const Scene& scene, const ex& step) {
    const auto given = number(ring_.convert(step_value_), scene, step);
    const auto scale = number(body_.scale, scene, step);
    if (!given || !scale) return std::nullopt;
    std::array<cln::cl_RA, 3> tensor, m;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto own = number(body_.tensor[i], scene, step);
      const auto start = number(ring_.ring().variable(i), scene, step);
      if (!own || !start) return std::nullopt;
      tensor[i] = *own;
      m[i] = *given * *scale * -body_.bracket * *start;
    }
    return discrete::rotation_near_identity(tensor, m);
  }

  /// A step that is a parameter is made smaller until a rotation is near the identity.
  void start() {
    constexpr int kSmallest = 6;
    std::size_t usable = 0;
    for (const Scene& scene : flow_.scenes) {
      if (!scene.unusable.empty()) continue;
      ++usable;
      for (int k = 1; k <= kSmallest; ++k) {
        const auto found = rotation(scene, GiNaC::pow(ex(10), -k));
        if (found) {
          text_.starts.push_back({scene.name,
                                  fmt::format("1/1{}", std::string(std::size_t(k), '0')),
                                  {found->e1, found->e2}});
          break;
        }
        if (text_.step.empty()) break;
      }
    }
    if (usable > 0 && text_.starts.empty())
      throw ModelError(
          "no scene starts where the equation for the rotation of a step has a solution near the "
          "identity: a smaller step has one");
  }

  const Model& flow_;
  discrete::NewNames names_;
  GiNaC::symbol step_;
  ex step_value_;
  FunctionRing ring_;
  discrete::FreeBody body_;
  RationalMapText text_;
  std::vector<std::string> m_, j_, u_;
  std::string h_, e1_, e2_, n_;
};

}  // namespace

RationalMapText moser_veselov_map(const Model& flow, const std::optional<ex>& value) {
  return MoserVeselov(flow, value).map();
}

}  // namespace casimir
