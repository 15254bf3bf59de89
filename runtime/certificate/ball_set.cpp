#include "runtime/certificate/ball_set.hpp"

#include <arb_mat.h>

#include "runtime/certificate/hex_float.hpp"

namespace casimir::certificate {
namespace {

/// The ball around zero of a size.
ArbBall around_zero(const std::string& size) { return validated::symmetric(number_of(size)); }

Vector numbers(const std::vector<std::string>& texts) {
  Vector result;
  result.reserve(texts.size());
  for (const std::string& text : texts) result.push_back(number_of(text));
  return result;
}

BallMatrix matrix_of(const std::vector<std::string>& texts, std::size_t rows) {
  BallMatrix result(rows, texts.empty() ? 0 : rows);
  result.entries = numbers(texts);
  return result;
}

BallMatrix unit_matrix(std::size_t n) {
  BallMatrix result(n, n);
  for (std::size_t i = 0; i < n; ++i) result(i, i) = ArbBall(1.);
  return result;
}

}  // namespace

BallSet first_set(const RunTrace& trace, bool wide) {
  const std::size_t n = trace.middle.size();
  BallSet set;
  set.middle = numbers(trace.middle);
  Vector off;
  for (const std::string& size : trace.off) off.push_back(around_zero(size));
  set.frame = unit_matrix(n);
  set.carried = wide ? unit_matrix(n) : BallMatrix(n, 0);
  set.start = wide ? off : Vector();
  set.rest = wide ? Vector(n) : off;
  return set;
}

BallSet set_of(const TracedSet& traced, const Vector& start) {
  BallSet set;
  set.middle = numbers(traced.middle);
  set.carried = matrix_of(traced.carried, set.middle.size());
  set.start = start;
  set.frame = matrix_of(traced.frame, set.middle.size());
  for (const std::string& size : traced.rest) set.rest.push_back(around_zero(size));
  return set;
}

Vector deviations(const BallSet& set) {
  return validated::sum(validated::product(set.carried, set.start),
                        validated::product(set.frame, set.rest));
}

Vector hull_of(const BallSet& set) {
  const Vector by = deviations(set);
  Vector box = set.middle;
  for (std::size_t i = 0; i < box.size(); ++i) box[i] = validated::widened(box[i], by[i]);
  return box;
}

std::vector<std::array<std::string, 2>> exact_box(const BallSet& set) {
  std::vector<std::array<std::string, 2>> result;
  arf_t reach, part, size, end;
  for (arf_ptr number : {reach, part, size, end}) arf_init(number);
  // |factor| radius, exactly
  const auto add = [&](const ArbBall& factor, const ArbBall& ball) {
    arf_set_mag(size, arb_radref(ball.raw()));
    arf_mul(part, arb_midref(factor.raw()), size, ARF_PREC_EXACT, ARF_RND_DOWN);
    arf_abs(part, part);
    arf_add(reach, reach, part, ARF_PREC_EXACT, ARF_RND_DOWN);
  };
  for (std::size_t i = 0; i < set.dimension(); ++i) {
    arf_zero(reach);
    for (std::size_t k = 0; k < set.start.size(); ++k) add(set.carried(i, k), set.start[k]);
    for (std::size_t k = 0; k < set.rest.size(); ++k) add(set.frame(i, k), set.rest[k]);
    arf_sub(end, arb_midref(set.middle[i].raw()), reach, ARF_PREC_EXACT, ARF_RND_DOWN);
    const std::string low = double_text(end, false);
    arf_add(end, arb_midref(set.middle[i].raw()), reach, ARF_PREC_EXACT, ARF_RND_DOWN);
    result.push_back({low, double_text(end, true)});
  }
  for (arf_ptr number : {reach, part, size, end}) arf_clear(number);
  return result;
}

bool invert(const BallMatrix& matrix, BallMatrix& inverse) {
  const auto n = static_cast<slong>(matrix.rows);
  arb_mat_t from, to;
  arb_mat_init(from, n, n);
  arb_mat_init(to, n, n);
  inverse = BallMatrix(matrix.rows, matrix.rows);
  for (slong i = 0; i < n; ++i)
    for (slong j = 0; j < n; ++j)
      arb_set(arb_mat_entry(from, i, j),
              matrix(static_cast<std::size_t>(i), static_cast<std::size_t>(j)).raw());
  const bool regular = arb_mat_inv(to, from, ArbBall::precision()) != 0;
  for (slong i = 0; regular && i < n; ++i)
    for (slong j = 0; j < n; ++j)
      arb_set(inverse(static_cast<std::size_t>(i), static_cast<std::size_t>(j)).raw(),
              arb_mat_entry(to, i, j));
  arb_mat_clear(from);
  arb_mat_clear(to);
  return regular;
}

}  // namespace casimir::certificate
