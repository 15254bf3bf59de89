#pragma once

namespace casimir_kernel::taylor {

/// What the method of Taylor series takes for a good step. One trajectory (`taylor::March`) and one
/// in each lane of a register (`lanes::March`) follow it alike, whether their coefficients come
/// from tables, from an interpreter or from compiled code.
struct StepPolicy {
  /// How far the derivative within a step and at its end may be from the series, in allowed errors:
  /// far more than a step of the right size ever gives, far less than a wrong one ..
  static constexpr double kDefect = 100;
  /// .. and what rounding may add to that, as a part of the numbers that are compared.
  static constexpr double kRounding = 0x1p-40;
  /// A defect that is no larger than what the right-hand side changes by where the time, and all
  /// states, are moved by these parts of themselves is one of rounding: cos(t) has it where t is
  /// large. Different ones, so that a difference of two is moved as well.
  static constexpr double kNudgeOfTime = 0x1p-48, kNudgeOfStates = -0x3p-50;
  /// No step is longer than this many units: what a step may grow by ..
  static constexpr double kLongest = 16;
  /// .. which is where the last terms shrink by so many binary digits with each order.
  static constexpr double kSteepest = -4;
  /// The continuation of a series is taken to miss so many times what the last coefficients miss it
  /// by. It is used where the step becomes longer by the first log2, and to no more than the
  /// second.
  static constexpr double kDoubt = 2, kWorthwhile = 0.03, kMostGained = 0.7;
  /// And where what it is divided by, 1 at the start, does not come nearer to 0 than that.
  static constexpr double kLeastDenominator = 0x1p-4;
  /// Where rounding is all that a run shows, from the first tolerance down, little is gained: of a
  /// longer step all terms are larger, and so is what they are rounded by. From the other tolerance
  /// on it shrinks to that by degrees.
  static constexpr double kRounded = 1e-15, kUnaffected = 1e-14, kLeastGained = 0.15;
  /// Coarser than this it is not worth the time where steps are compared with the equations anyway.
  static constexpr double kFewDigits = 1e-8;
  /// A step longer than this many units leans on coefficients that it does not see: it is compared
  /// with the equations even where they are a polynomial.
  static constexpr double kUnseen = 3;
  /// The unit stays as it is for steps of so many units, and so many to either side.
  static constexpr double kUsual = 1.2, kAround = 0.8;
  /// The sizes of coefficients, in allowed errors, above which they are taken for no numbers.
  static constexpr double kNoNumber = 1e300;
  /// What is tried next of a step that did not hold.
  static constexpr double kShorter = 0.5;
  /// The next unit where the coefficients leave the range of numbers, as a part of this one.
  static constexpr double kSmallerUnit = 0x1p-8;
  /// A run creeps, and ends, whose unit was made smaller so often, and once in so few steps: where
  /// something that the equations divide by is beyond all doubles, only the coefficients in tiny
  /// units are numbers, and steps of that size come to no end.
  static constexpr double kOftenShrunk = 300, kEveryFew = 4;
  /// After so many steps a run knows how many it will take.
  static constexpr unsigned long long kStepsToJudge = 64;
  /// A step of fewer roundings of the time than this is none.
  static constexpr double kLeastRoundings = 16;
  /// From which part of a unit down the coefficients in that unit do not tell how large a state is
  /// during a step.
  static constexpr double kPartOfUnit = 0.125;
  /// At how many places within it a step is compared with the equations: where nothing has been
  /// compared yet, and otherwise.
  static constexpr int kPlacesAtFirst = 4, kPlaces = 1;
  /// Those places follow the golden section, so that no motion of whatever period has the same ones
  /// in each step.
  static constexpr double kGoldenSection = 0.6180339887498949;

  /// Place i of so many within a step, as a part of it.
  /// \param fraction  0 .. 1, another one in each step.
  static constexpr double place(int i, int places, double fraction) {
    return (static_cast<double>(i) + 0.1 + 0.8 * fraction) / places;
  }
};

/// The order at which a tolerance costs least for one trajectory, as measured; without one (0), the
/// highest.
constexpr int order_of_one(double tolerance) {
  return tolerance > 3e-5 ? 8 : tolerance > 1e-8 ? 16 : 24;
}

/// Systems of so many states, if nothing else is known of them, have so many products that their
/// sums take most of the time.
constexpr int kManyStates = 20;
/// So do systems of so many registers of products.
constexpr int kManyRegisters = 10;

/// The same where the products take the time and not what one coefficient has to wait for in the
/// one before. The time of a step then grows like the square of the order N, its length like
/// tolerance^(1/N), which would be best at N = log(1/tolerance)/2; as measured, a little above.
constexpr int order_of_large(double tolerance) {
  return tolerance > 3e-5    ? 8
         : tolerance > 1e-9  ? 12
         : tolerance > 1e-13 ? 16
         : tolerance > 0     ? 20
                             : order_of_one(tolerance);
}

/// The same for many trajectories at once, as measured: lower than for one, whose step has more to
/// wait for.
constexpr int order_of_many(double tolerance) {
  return tolerance > 3e-5 ? 8 : tolerance > 1e-8 ? 12 : tolerance > 7e-13 ? 16 : 20;
}

}  // namespace casimir_kernel::taylor
