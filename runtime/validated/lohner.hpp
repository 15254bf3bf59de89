#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/validated/contraction.hpp"
#include "runtime/validated/flow_piece.hpp"

namespace casimir::validated {

/// How a step ended.
enum class StepOutcome {
  taken,
  no_value,       ///< the equations are not certain to have a value on the set
  no_enclosure,   ///< no step of a length worth taking could be enclosed
  contradiction,  ///< an integral has no level in the set: it is none, or there is a defect
};

/// What steps are made with.
struct StepSettings {
  int order = 20;
  int log2_error = -60;  ///< of a step, in units of the state
  slong integral_bits = 128;
  bool forwards = true;
  /// For tests that see an enclosure fail: leaves x_{N+1} out.
  bool without_remainder = false;
  /// Makes the rest of every set larger by 2^-20 of its size, of boxes by 2^-12, so that other
  /// arithmetic, which rounds otherwise, can verify each step.
  bool with_reserve = false;
  /// Follows the derivatives of the states by the start too. Not for a start on levels.
  bool derivatives = false;
};

/// The steps of a set along the flow, by Lohner's method.
template <class Ball>
class Lohner {
 public:
  using Vector = std::vector<Ball>;
  /// Gets each step before it is made: the piece, and its length.
  using Watch = std::function<void(const Lohner&, const Ball& h)>;

  /// The flow and the integrals must outlive this.
  Lohner(const FlowProgram& flow, const std::vector<Integral>& integrals,
         const StepSettings& settings)
      : settings_(settings), piece_(flow, settings.order, settings.forwards) {
    for (const Integral& integral : integrals)
      contractors_.emplace_back(integral, settings.integral_bits);
  }

  /// \param exact  the middle of the start, to more digits than balls have.
  /// \param wide   for each state by how much the start may be off; all 0: a point.
  void begin(const std::vector<ArbBall>& exact, const std::vector<Ball>& wide) {
    const std::size_t n = exact.size();
    bool is_point = true;
    for (const Ball& w : wide) is_point = is_point && is_exact(w) && approximate(w) == 0;
    set_.middle.clear();
    Vector box, off;
    for (std::size_t i = 0; i < n; ++i) {
      const Ball ball = ball_from<Ball>(exact[i]);
      set_.middle.push_back(middle_of(ball));
      off.push_back(symmetric(widened(deviation_of(ball), wide[i])));
      box.push_back(widened(set_.middle[i], off[i]));
    }
    set_.frame = unit_frame(n);
    set_.rest = is_point ? off : Vector(n);
    set_.start = is_point ? Vector() : off;
    set_.carried = Matrix<Ball>(n, set_.start.size());
    for (std::size_t i = 0; i < set_.start.size(); ++i) set_.carried(i, i) = Ball(1.);
    std::vector<ArbBall> from = exact;
    if (!is_point)
      for (std::size_t i = 0; i < n; ++i) from[i] = ArbBall(set_.middle[i]);
    for (Contractor<Ball>& contractor : contractors_) contractor.begin(from, box);
    if (settings_.derivatives) slopes_ = {unit_matrix<Ball>(n), Matrix<Ball>(n, n)};
    box_ = set_.hull();
  }

  /// Begins with the states m + C s + r that lie on the given levels of all integrals: those off
  /// them are no part of what is enclosed from then on.
  /// \param directions  C, exact.
  /// \param along, rest  the boxes of s and r, around zero.
  /// \param levels  contain the values of the integrals, in their order.
  void begin_on_levels(const std::vector<double>& middle, const Matrix<double>& directions,
                       const Vector& along, const Vector& rest,
                       const std::vector<ArbBall>& levels) {
    set_.middle.clear();
    for (const double m : middle) set_.middle.push_back(Ball(m));
    set_.frame = unit_frame(middle.size());
    set_.start = along;
    set_.rest = rest;
    set_.carried = Matrix<Ball>(directions.rows, directions.columns);
    for (std::size_t i = 0; i < directions.entries.size(); ++i)
      set_.carried.entries[i] = Ball(directions.entries[i]);
    for (std::size_t a = 0; a < contractors_.size(); ++a)
      contractors_[a].begin_on(levels[a], along.size());
    columns_.clear();
    box_ = set_.hull();
  }

  const Doubleton<Ball>& set() const { return set_; }
  /// Of the last step: log2 of the room of its rough enclosure, and for each integral the
  /// coordinate that it was to make smaller, or -1.
  int room() const { return room_; }
  const std::vector<int>& columns() const { return columns_; }
  /// A box that contains the set.
  const Vector& box() const { return box_; }
  const FlowPiece<Ball>& piece() const { return piece_; }

  /// The names of the integrals that have made the set smaller.
  std::vector<std::string> contracted_by() const {
    std::vector<std::string> names;
    for (const Contractor<Ball>& contractor : contractors_)
      if (contractor.has_contracted()) names.push_back(contractor.name());
    return names;
  }

  /// The name of an integral of which it is not certain that solutions have kept its value, up to
  /// the end of all that was passed.
  std::optional<std::string> not_kept() const {
    for (const Contractor<Ball>& contractor : contractors_)
      if (!contractor.is_kept()) return contractor.name();
    return std::nullopt;
  }

  /// Solutions go on for h at the most: looks whether the integrals are analytic all the way.
  void pass(const Ball& h) {
    for (Contractor<Ball>& contractor : contractors_) {
      if (!contractor.usable() ||
          contractor.is_analytic_on(piece_.tube(), time_of(elapsed_ + from_zero_to(h))))
        continue;
      if (!is_analytic_on_parts(contractor, h)) contractor.give_up();
    }
  }

  /// Expands the flow from the set, and says how far a step might go: log2 of it.
  /// \throws std::domain_error  where the equations have no certain value.
  double prepare(const Ball& elapsed) {
    elapsed_ = elapsed;
    piece_.expand(elapsed, set_.middle, box_);
    tangents_known_ = false;
    const auto reach = piece_.reach(settings_.log2_error);
    log2_size_ = reach.log2_size;
    return reach.log2_step + log2_factor_;
  }

  /// Tries whether a step of that length is enclosed; the next one that is proposed follows from
  /// how well. \return  by how much (log2) to shorten it; 0 if it is enclosed.
  double shortened_by(const Ball& h, bool is_full) {
    room_ = static_cast<int>(std::floor(settings_.log2_error + log2_size_));
    const double excess = piece_.encloses(h, symmetric(power_of_two<Ball>(room_)));
    const double share =
        std::isinf(excess) && excess > 0 ? 1 : (excess + kReserve) / (settings_.order + 1);
    if (excess <= 0 && settings_.derivatives) {
      know_tangents();
      if (!piece_.enclose_derivatives(h)) return 1;
    }
    if (excess <= 0) {
      if (is_full && std::isfinite(share)) log2_factor_ -= std::clamp(share, -0.1, 0.05);
      return 0;
    }
    const double by = std::clamp(share, 0.05, 1.0);
    if (is_full) log2_factor_ -= std::min(by, 0.3);
    return by;
  }

  /// The set at a time within the step, as a box. What `shortened_by` has found enclosed counts.
  Vector box_at(const Ball& t) {
    know_tangents();
    const Vector moved = displaced(t);
    const Matrix<Ball> derivative = piece_.derivative(t);
    const Vector start = product(product(derivative, set_.carried), set_.start);
    const Vector rest = product(product(derivative, set_.frame.columns), set_.rest);
    Vector box(moved.size());
    for (std::size_t i = 0; i < box.size(); ++i)
      box[i] = set_.middle[i] + (moved[i] + (start[i] + rest[i]));
    return box;
  }

  bool follows_derivatives() const { return settings_.derivatives; }
  /// The derivatives of the states by the start of the run, for every start: now, ..
  Matrix<Ball> derivatives() const {
    return sum(slopes_.middle, product(in_balls<Ball>(set_.frame.columns), slopes_.rest));
  }
  /// .. and at a time within the step. What `shortened_by` has found enclosed counts.
  Matrix<Ball> derivatives_at(const Ball& t) const {
    const Matrix<Ball> whole = piece_.whole_derivative(t, settings_.without_remainder);
    return sum(product(whole, slopes_.middle),
               product(product(whole, set_.frame.columns), slopes_.rest));
  }

  /// The set at a time within the step, as middle + by_start s + by_rest r with the s and r of
  /// `set`. What `shortened_by` has found enclosed counts.
  struct AffineForm {
    Vector middle;
    Matrix<Ball> by_start, by_rest;
  };
  AffineForm affine_at(const Ball& t) {
    know_tangents();
    const Matrix<Ball> derivative = piece_.derivative(t);
    return {sum(set_.middle, displaced(t)), product(derivative, set_.carried),
            product(derivative, set_.frame.columns)};
  }

  /// Goes on by h, which was found to be enclosed.
  StepOutcome advance(const Ball& h) {
    know_tangents();
    pass(h);
    const Vector moved = displaced(h);
    const Matrix<Ball> derivative = piece_.derivative(h);
    Doubleton<Ball> next;
    next.start = set_.start;
    Vector shift(moved.size());  // phi(m) - m', which is small
    for (std::size_t i = 0; i < moved.size(); ++i) {
      next.middle.push_back(middle_of(set_.middle[i] + moved[i]));
      shift[i] = (set_.middle[i] - next.middle[i]) + moved[i];
    }
    next.carried = product(derivative, set_.carried);
    for (std::size_t i = 0; i < next.carried.rows; ++i) {
      for (std::size_t k = 0; k < next.carried.columns; ++k) {
        shift[i] = shift[i] + deviation_of(next.carried(i, k)) * set_.start[k];
        next.carried(i, k) = middle_of(next.carried(i, k));
      }
    }
    const Matrix<Ball> image = product(derivative, set_.frame.columns);
    const Ball end = time_of(elapsed_ + h);
    std::vector<int> columns;
    next.frame = new_frame(image, next.middle, end, columns);
    if (next.frame.columns.rows == 0) return StepOutcome::no_enclosure;
    next.rest = product(transposed_product(next.frame.columns, image), set_.rest);
    next.rest =
        corrected(sum(next.rest, transposed_product(next.frame.columns, shift)), next.frame);
    for (const Ball& r : next.rest)
      if (!is_usable(r)) return StepOutcome::no_enclosure;
    if (!contract(next, columns, end)) return StepOutcome::contradiction;
    recentre(next);
    if (settings_.with_reserve) enlarge(next);
    Vector box = next.hull();
    for (const Ball& x : box)
      if (!is_usable(x)) return StepOutcome::no_enclosure;
    if (settings_.derivatives) {
      slopes_ = carried_slopes(h, next.frame);
      if (!contract_slopes(next, columns, box, end)) return StepOutcome::contradiction;
      for (const Ball& one : slopes_.rest.entries)
        if (!is_usable(one)) return StepOutcome::no_enclosure;
    }
    set_ = std::move(next);
    box_ = std::move(box);
    columns_ = std::move(columns);
    return StepOutcome::taken;
  }

 private:
  /// Steps are meant to be enclosed at the first try: remainders are aimed at 2^-2 of their bound.
  static constexpr double kReserve = 2;

  /// The box around an arc of a circle may contain the middle of the circle: parts of the step are
  /// looked at one by one.
  bool is_analytic_on_parts(Contractor<Ball>& contractor, const Ball& h) {
    constexpr int kParts = 16;
    const Ball length = h * Ball(1. / kParts);
    for (int k = 0; k < kParts; ++k) {
      const Ball t = length * Ball(static_cast<double>(k)) + from_zero_to(length);
      if (!contractor.is_analytic_on(box_at(t), time_of(elapsed_ + t))) return false;
    }
    return true;
  }

  Ball time_of(const Ball& elapsed) const { return settings_.forwards ? elapsed : -elapsed; }

  void know_tangents() {
    if (!tangents_known_) piece_.expand_tangents();
    tangents_known_ = true;
  }

  Vector displaced(const Ball& t) const {
    return piece_.displacement(t, settings_.without_remainder);
  }

  Frame new_frame(const Matrix<Ball>& image, const Vector& middle, const Ball& time,
                  std::vector<int>& columns) {
    std::vector<std::vector<double>> gradients;
    for (Contractor<Ball>& contractor : contractors_)
      gradients.push_back(contractor.direction(middle, time));
    Matrix<double> others(image.rows, image.columns);
    for (std::size_t i = 0; i < image.entries.size(); ++i)
      others.entries[i] = approximate(image.entries[i]);
    // Relative to the largest, since balls with many digits may be thinner than any double.
    std::vector<double> sizes, weights;
    for (const Ball& r : set_.rest) sizes.push_back(log2_magnitude(r));
    const double largest = *std::ranges::max_element(sizes);
    for (const double size : sizes)
      weights.push_back(std::isinf(size) ? 0 : std::exp2(size - largest));
    return frame_along(gradients, others, weights, columns);
  }

  bool contract(Doubleton<Ball>& next, const std::vector<int>& columns, const Ball& time) {
    if (std::ranges::none_of(columns, [](int column) { return column >= 0; })) return true;
    const Vector hull = next.hull();
    for (std::size_t a = 0; a < contractors_.size(); ++a) {
      if (columns[a] < 0 || !contractors_[a].usable()) continue;
      if (!contractors_[a].contract(next, static_cast<std::size_t>(columns[a]), hull, time))
        return false;
    }
    return true;
  }

  /// The derivatives at the end of the step, by the chain rule: V (M + B R) = M' + B' R' with
  /// M' about V M, and R' = (B'^-1 V B) R + B'^-1 (V M - M'), where V are the derivatives of the
  /// step for all states of the set. The factors are multiplied in this order, so that R is turned
  /// and not wrapped (Lohner's method for the variational equation).
  Slopes<Ball> carried_slopes(const Ball& h, const Frame& frame) const {
    const Matrix<Ball> whole = piece_.whole_derivative(h, settings_.without_remainder);
    Slopes<Ball> next;
    next.middle = product(whole, slopes_.middle);
    Matrix<Ball> off(next.middle.rows, next.middle.columns);
    for (std::size_t i = 0; i < off.entries.size(); ++i) {
      off.entries[i] = deviation_of(next.middle.entries[i]);
      next.middle.entries[i] = middle_of(next.middle.entries[i]);
    }
    // In the coordinates of the next frame: B'^-1 of both terms.
    const Matrix<Ball> turned =
        transposed_product(frame.columns, product(whole, set_.frame.columns));
    next.rest = corrected(
        sum(product(turned, slopes_.rest), transposed_product(frame.columns, off)), frame);
    return next;
  }

  bool contract_slopes(const Doubleton<Ball>& next, const std::vector<int>& columns,
                       const Vector& hull, const Ball& time) {
    for (std::size_t a = 0; a < contractors_.size(); ++a) {
      if (columns[a] < 0 || !contractors_[a].usable()) continue;
      if (!contractors_[a].contract_slopes(slopes_, next, static_cast<std::size_t>(columns[a]),
                                           hull, time))
        return false;
    }
    return true;
  }

  /// Moves the middle to where the middle of the rest is: m + B r = m'' + B (r + B^-1 (m - m'')).
  static void recentre(Doubleton<Ball>& set) {
    Vector middles, moved(set.middle.size());
    for (const Ball& r : set.rest) middles.push_back(middle_of(r));
    const Vector along = product(set.frame.columns, middles);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Ball before = set.middle[i];
      set.middle[i] = middle_of(before + along[i]);
      moved[i] = before - set.middle[i];
    }
    set.rest = sum(set.rest, corrected(transposed_product(set.frame.columns, moved), set.frame));
  }

  /// Where the start is a box the rest is what that leaves over, of second order: other bounds of
  /// functions differ by more than rounding there. An integral may make a coordinate as thin as the
  /// rounding of other coordinates: some 2^-13 of a unit in the last place of the state is added.
  void enlarge(Doubleton<Ball>& set) const {
    double largest = 0;
    for (const Ball& m : set.middle) largest = std::max(largest, std::abs(approximate(m)));
    const Ball by(1 + (set.start.empty() ? 0x1p-20 : 0x1p-12));
    const Ball floor = symmetric(
        power_of_two<Ball>(67 - static_cast<int>(settings_.integral_bits)) * Ball(largest));
    for (Ball& r : set.rest) r = widened(symmetric(symmetric(r) * by), floor);
  }

  StepSettings settings_;
  FlowPiece<Ball> piece_;
  std::vector<Contractor<Ball>> contractors_;
  Doubleton<Ball> set_;
  Slopes<Ball> slopes_;  ///< where derivatives are followed
  Vector box_;
  Ball elapsed_;
  double log2_factor_ = -0.5, log2_size_ = 0;
  bool tangents_known_ = false;
  int room_ = 0;
  std::vector<int> columns_;
};

}  // namespace casimir::validated
