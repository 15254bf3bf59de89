#include "symbolic/discrete/moser_root.hpp"

#include <cln/real.h>

namespace casimir::discrete {
namespace {

using cln::cl_F;
using cln::cl_RA;

constexpr int kRootDigits = 60;
constexpr int kWaypoints = 64;

/// The quartic in e1 for t m, t^2 = `square`.
class Quartic {
 public:
  Quartic(const std::array<cl_RA, 3>& j, const std::array<cl_RA, 3>& m) {
    for (std::size_t i = 0; i < 3; ++i) {
      const cl_RA own = j[i] * j[i], other = j[(i + 1) % 3] * j[(i + 1) % 3];
      trace_ = trace_ + own;
      minors_ = minors_ + own * other;
      length_ = length_ + m[i] * m[i];
      weighted_ = weighted_ + own * m[i] * m[i];
    }
    determinant_ = j[0] * j[1] * j[2];
    const cl_RA size = cln::abs(j[0]) + cln::abs(j[1]) + cln::abs(j[2]);
    small_ = exact(size / cln::expt_pos(cln::cl_I(10), kRootDigits - 6));
  }

  cl_F e2(const cl_F& e1, const cl_RA& square) const {
    return (e1 * e1 - exact(trace_ - square * length_)) / 2;
  }
  cl_F value(const cl_F& e1, const cl_RA& square) const {
    const cl_F second = e2(e1, square);
    return second * second - e1 * exact(2 * determinant_) - exact(minors_ - square * weighted_);
  }
  /// (J1 + J2)(J2 + J3)(J3 + J1) at m = 0, e1 = tr J, twice.
  cl_F slope(const cl_F& e1, const cl_RA& square) const {
    const cl_F half = e1 * e2(e1, square) - exact(determinant_);
    return half + half;
  }
  /// A change of the root by less than this does not count.
  const cl_F& small() const { return small_; }
  static cl_F exact(const cl_RA& number) {
    return cln::cl_float(number, cln::float_format(kRootDigits));
  }

 private:
  cl_RA trace_ = 0, minors_ = 0, length_ = 0, weighted_ = 0, determinant_ = 0;
  cl_F small_ = exact(0);
};

/// Newton's method from the root of the waypoint before.
std::optional<cl_F> polished(const Quartic& quartic, cl_F root, const cl_RA& square) {
  constexpr int kMostIterations = 30;
  for (int i = 0; i < kMostIterations; ++i) {
    const cl_F slope = quartic.slope(root, square);
    if (cln::zerop(slope)) return std::nullopt;
    const cl_F change = quartic.value(root, square) / slope;
    root = root - change;
    if (cln::abs(change) <= quartic.small()) return root;
  }
  return std::nullopt;
}

}  // namespace

/// Neighbouring simple roots have slopes of opposite signs: where the sign is that of the
/// beginning, no root beside it was taken by mistake.
std::optional<RotationStart> rotation_near_identity(const std::array<cl_RA, 3>& tensor,
                                                    const std::array<cl_RA, 3>& m) {
  const Quartic quartic(tensor, m);
  cl_F root = Quartic::exact(tensor[0] + tensor[1] + tensor[2]);
  const cl_F first = quartic.slope(root, 0);
  for (int k = 0; k <= kWaypoints; ++k) {
    const cl_RA square = cl_RA(k * k) / (kWaypoints * kWaypoints);
    const std::optional<cl_F> next = polished(quartic, root, square);
    if (!next || !cln::plusp(first * quartic.slope(*next, square))) return std::nullopt;
    root = *next;
  }
  return RotationStart{root, quartic.e2(root, 1)};
}

}  // namespace casimir::discrete
