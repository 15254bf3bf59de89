#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "runtime/program/program_series.hpp"
#include "runtime/validated/arb_ball.hpp"

namespace casimir::validated {

/// Whether the program is a polynomial in its inputs: analytic everywhere.
inline bool is_polynomial(const Program& program) {
  std::vector<bool> constant;
  for (const Instruction& line : program.code) {
    const bool literal = is_literal(line);
    bool fixed = literal;
    if (!literal && line.op != Op::input) {
      fixed = constant[static_cast<std::size_t>(line.a)] &&
              (line.b < 0 || constant[static_cast<std::size_t>(line.b)]);
      const bool ring = line.op == Op::add || line.op == Op::sub || line.op == Op::mul ||
                        line.op == Op::neg ||
                        (line.op == Op::div && constant[static_cast<std::size_t>(line.b)]);
      if (!ring && !fixed) return false;
    }
    constant.push_back(fixed);
  }
  return true;
}

/// Whether all outputs are quotients of polynomials of the inputs. Along a solution that is
/// analytic in the time such a function is meromorphic: where its derivative vanishes it has one
/// value, even beyond its poles. An angle, a logarithm, a root or |x| may have another one after
/// its cut.
inline bool is_rational(const Program& program) {
  return std::ranges::all_of(program.code, [](const Instruction& line) {
    return is_literal(line) || line.op == Op::input || line.op == Op::add || line.op == Op::sub ||
           line.op == Op::mul || line.op == Op::neg || line.op == Op::div;
  });
}

/// The Taylor coefficients of solutions, as TaylorJet has them, of a right-hand side that is a
/// polynomial: in balls of doubles, without what other functions need. It can expand from a point
/// and from a box around that point at once: the middles of the coefficients are the same numbers,
/// and only the radii are others.
class PolynomialJet {
 public:
  using Series = std::vector<MidRad>;
  /// The program must outlive this, and be a polynomial.
  /// \param radii  1, or 2 for what expands from a point and a box.
  PolynomialJet(const Program& program, int order, std::size_t radii = 1);

  /// The coefficients of the states over a box, where there is one radius.
  const std::vector<Series>& expand(const MidRad& t, const std::vector<MidRad>& x,
                                    const MidRad& unit);
  /// From a point without radius and from a box with the point for its middle, where there are two
  /// radii: see `states`.
  void expand_both(const MidRad& t, const std::vector<MidRad>& middle,
                   const std::vector<MidRad>& box, const MidRad& unit);

  /// The coefficients of the states, and of a line, with the first or the second radii.
  const std::vector<Series>& states(std::size_t which) const { return states_[which]; }
  const Series& series_of(int line, std::size_t which = 0) const {
    return *lines_[which][static_cast<std::size_t>(line)];
  }

  /// What the loops need, in plain numbers.
  enum class Kind { add, sub, neg, scale, scale_exactly, product, quotient };
  /// A line of the program: the coefficients of what it gets and gives, and where they are factors
  /// of products the places of these.
  struct Step {
    Kind kind;
    MidRad* out[2];
    const MidRad *a[2], *b[2];
    double* factor;  ///< of the line itself, or nullptr
    const double *left, *right;
  };
  /// A state, and the line of its rate.
  struct State {
    MidRad* series[2];
    const MidRad* rate[2];
    double* factor;
  };

 private:
  void find_constants();
  void add_step(std::size_t line);
  void find_factors();
  double* factor_of(const Series* series);
  /// Of a factor: see `publish`.
  std::size_t arrays() const { return 3 + 2 * radii_; }
  void run(const MidRad& t, const MidRad& unit);

  const Program& program_;
  std::size_t order_, radii_;
  std::vector<Series> states_[2], own_[2];  ///< own_: of the lines that are no states
  std::vector<Series*> lines_[2];           ///< of each line
  std::vector<bool> constant_;
  std::map<const Series*, std::size_t> places_;  ///< of the factors of products
  std::vector<double> factors_;                  ///< see `publish`
  std::vector<Step> steps_;
  std::vector<State> rates_;
  std::vector<std::size_t> times_;
  bool constants_known_ = false;
};

/// TaylorJet, or what does the same in less time.
template <class Ball>
class FlowSeries {
 public:
  using Series = std::vector<Ball>;
  /// The program must outlive this.
  FlowSeries(const Program& program, int order)
      : jet_(program, Arithmetic<Ball>{}, std::vector<Ball>{}, order) {}
  const std::vector<Series>& expand(const Ball& t, const std::vector<Ball>& x, const Ball& unit) {
    return jet_.expand(t, x, unit);
  }
  const Series& series_of(int line) const { return jet_.series_of(line); }

 private:
  TaylorJet<Ball> jet_;
};

template <>
class FlowSeries<MidRad> {
 public:
  using Series = std::vector<MidRad>;
  FlowSeries(const Program& program, int order) {
    if (is_polynomial(program))
      polynomial_.emplace(program, order);
    else
      jet_.emplace(program, Arithmetic<MidRad>{}, std::vector<MidRad>{}, order);
  }
  const std::vector<Series>& expand(const MidRad& t, const std::vector<MidRad>& x,
                                    const MidRad& unit) {
    return polynomial_ ? polynomial_->expand(t, x, unit) : jet_->expand(t, x, unit);
  }
  const Series& series_of(int line) const {
    return polynomial_ ? polynomial_->series_of(line) : jet_->series_of(line);
  }

 private:
  std::optional<PolynomialJet> polynomial_;
  std::optional<TaylorJet<MidRad>> jet_;
};

/// The series of solutions from a point and from a box around it, whose lines are those of one
/// program.
template <class Ball>
class FlowSeriesPair {
 public:
  using Series = std::vector<Ball>;
  /// \param rates  and \param both  see FlowProgram; they must outlive this.
  FlowSeriesPair(const Program& rates, const Program& both, int order)
      : point_(rates, order), box_(both, order) {}
  /// \param middle  without radii, the middles of `box`.
  void expand(const Ball& t, const std::vector<Ball>& middle, const std::vector<Ball>& box,
              const Ball& unit) {
    of_point_ = &point_.expand(t, middle, unit);
    of_box_ = &box_.expand(t, box, unit);
  }
  const std::vector<Series>& of_point() const { return *of_point_; }
  const std::vector<Series>& of_box() const { return *of_box_; }
  /// Of a line of `both`, over the box.
  const Series& series_of(int line) const { return box_.series_of(line); }

 private:
  FlowSeries<Ball> point_, box_;
  const std::vector<Series>*of_point_ = nullptr, *of_box_ = nullptr;
};

/// Of polynomials at once.
template <>
class FlowSeriesPair<MidRad> {
 public:
  using Series = std::vector<MidRad>;
  FlowSeriesPair(const Program& rates, const Program& both, int order) {
    if (is_polynomial(both)) {
      polynomial_.emplace(both, order, 2);
    } else {
      point_.emplace(rates, order);
      box_.emplace(both, order);
    }
  }
  void expand(const MidRad& t, const std::vector<MidRad>& middle, const std::vector<MidRad>& box,
              const MidRad& unit) {
    if (polynomial_) {
      polynomial_->expand_both(t, middle, box, unit);
      of_point_ = &polynomial_->states(0);
      of_box_ = &polynomial_->states(1);
    } else {
      of_point_ = &point_->expand(t, middle, unit);
      of_box_ = &box_->expand(t, box, unit);
    }
  }
  const std::vector<Series>& of_point() const { return *of_point_; }
  const std::vector<Series>& of_box() const { return *of_box_; }
  const Series& series_of(int line) const {
    return polynomial_ ? polynomial_->series_of(line, 1) : box_->series_of(line);
  }

 private:
  std::optional<PolynomialJet> polynomial_;
  std::optional<FlowSeries<MidRad>> point_, box_;
  const std::vector<Series>*of_point_ = nullptr, *of_box_ = nullptr;
};

}  // namespace casimir::validated
