#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace casimir {

/// The orbit of a return map, or of any map, as points of some space.
struct OrbitPoints {
  std::size_t dimension = 0;
  std::vector<double> coordinates;  ///< of one point after the other; angles as cosine and sine
  /// The same points in the plane of the picture, which says what the positive direction is.
  std::vector<std::array<double, 2>> places;
  std::array<double, 2> periods{};  ///< > 0: that coordinate of the plane is an angle

  /// How many points the orbit has.
  std::size_t size() const { return dimension == 0 ? 0 : coordinates.size() / dimension; }
};

/// How an orbit turns. A return map knows its rotation number up to whole turns.
struct Rotation {
  /// What the orbit lies on.
  enum class Kind {
    curve,    ///< one closed curve
    islands,  ///< several closed curves, which are visited in turn
    cycle,    ///< it is periodic, to rounding
    none      ///< nothing of that was found: the reason says why
  };
  Kind kind = Kind::none;
  /// In turns per iterate, from 0 to 1, along the curve; of islands and cycles p/q for the way
  /// they go about their middle, not a number where they have no such order.
  double number = 0;
  double error = 0;         ///< how far it may be off: see SpectralLine::error
  std::size_t parts = 1;    ///< how many islands, or the length of the cycle
  double inner_number = 0;  ///< of islands, in turns per `parts` iterates along one of them
  double inner_error = 0;
  /// The direction is that of the picture: counter-clockwise, or towards larger angles. False where
  /// the curve crosses itself there: then the number or its complement to 1 is meant.
  bool directed = true;
  std::string reason;
};

/// "curve", "islands", "cycle" or "none".
std::string to_string(Rotation::Kind kind);

/// The rotation number of an orbit. The strongest lines of its spectrum are whole multiples of the
/// rotation number, up to whole turns: of all numbers that this leaves the one is taken by whose
/// phases the points stand in line along a curve that is run through once. Where none does so, the
/// same is tried with every second, third, .. point. Nothing is said of an orbit whose points stand
/// in no line: one that is chaotic, too short, or on a torus of more dimensions.
///
/// Sources: Laskar's frequency analysis, see `spectrum_of`; the order of an orbit on a circle
/// determines its rotation number (Katok & Hasselblatt, Introduction to the Modern Theory of
/// Dynamical Systems, 1995, 11.2).
Rotation rotation_of(const OrbitPoints& points);

}  // namespace casimir
