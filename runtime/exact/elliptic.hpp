#pragma once

#include <cln/float.h>

#include <vector>

namespace casimir {

/// A number as the sum of two doubles, good to 32 digits.
struct TwoDoubles {
  double high = 0, low = 0;
};
TwoDoubles two_doubles(const cln::cl_F& value);

/// A time that has passed, exactly: the difference of two doubles.
TwoDoubles difference(double later, double earlier);

/// What turns as rate * t + start, in turns, and stays exact over many of them: the whole turns are
/// taken off in twice the digits.
class Phase {
 public:
  Phase() = default;
  Phase(const cln::cl_F& rate, const cln::cl_F& start);

  /// The part of a turn after a time, from -1/2 to 1/2, and how many whole ones there are besides.
  struct Turned {
    double part, whole;
  };
  Turned after(const TwoDoubles& t) const;

 private:
  TwoDoubles rate_, start_;
};

/// Jacobi's elliptic functions of the parameter m = k^2, 0 <= m < 1: by the arithmetic-geometric
/// mean (Abramowitz & Stegun 16.4, 17.6), and near m = 1, where that loses digits, as sums of
/// hyperbolic functions (Whittaker & Watson, 22.6, by Jacobi's imaginary transformation). Good to a
/// few units in the last place of 1.
class JacobiFunctions {
 public:
  JacobiFunctions() = default;
  /// \param complement  1 - m, which subtraction would make inexact.
  JacobiFunctions(const cln::cl_F& parameter, const cln::cl_F& complement);

  struct Values {
    double sn, cn, dn, am;
  };
  /// At 4 K part, for part from -1/2 to 1/2. The amplitude is the one from -Pi to Pi.
  Values at_part(double part) const;

  /// m and 1 - m.
  const cln::cl_F& parameter() const { return m_; }
  const cln::cl_F& complement() const { return m1_; }
  /// The quarter period K.
  const cln::cl_F& quarter() const { return quarter_; }
  double four_quarters() const { return four_quarters_; }
  /// The u from -2 K to 2 K with sn u = sine and cn u = cosine, of a point on the unit circle.
  cln::cl_F inverse(const cln::cl_F& sine, const cln::cl_F& cosine) const;

 private:
  Values by_means(double u) const;
  Values by_hyperbolic_functions(double u) const;

  double four_quarters_ = 0, parameter_ = 0, complement_ = 1, scale_ = 1;
  double decay_ = 1;           ///< Pi / 2K', with K' the quarter period of 1 - m
  std::vector<double> ratio_;  ///< c_n / a_n from n = 1 on
  cln::cl_F m_, m1_, quarter_;
};

}  // namespace casimir
