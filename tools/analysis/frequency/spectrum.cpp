#include "tools/analysis/frequency/spectrum.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "runtime/step/dense.hpp"

namespace casimir {
namespace {

using Complex = std::complex<double>;
using Signal = std::vector<Complex>;

constexpr double kTurn = 2 * std::numbers::pi;
/// Of Hanning's window: the wings of a line fall like the 9th power of the distance.
constexpr int kWindowOrder = 4;
constexpr int kRoundsOfLine = 12, kSweepsOfLines = 2;
/// Beside the signal, what is left is rounding.
constexpr double kNothing = 1e-15;

/// The window, made so that its sum is 1.
std::vector<double> window(std::size_t n) {
  std::vector<double> w(n);
  double sum = 0;
  for (std::size_t j = 0; j < n; ++j) {
    w[j] = std::pow(1 - std::cos(kTurn * (static_cast<double>(j) + 0.5) / static_cast<double>(n)),
                    kWindowOrder);
    sum += w[j];
  }
  for (double& x : w) x /= sum;
  return w;
}

Complex wave(double frequency, std::size_t j) {
  const double turns = frequency * static_cast<double>(j);
  return std::polar(1., kTurn * (turns - std::round(turns)));
}

/// All waves of a frequency in their order, each to about a rounding: a power of the first one
/// behind a place that is exact.
class Waves {
 public:
  explicit Waves(double frequency) : frequency_(frequency) {
    for (std::size_t k = 0; k < kBlock; ++k) turns_[k] = wave(frequency, k);
  }

  Complex next() {
    const std::size_t k = place_ % kBlock;
    if (k == 0) base_ = wave(frequency_, place_);
    ++place_;
    return base_ * turns_[k];
  }

 private:
  static constexpr std::size_t kBlock = 16;
  double frequency_;
  std::array<Complex, kBlock> turns_;
  Complex base_ = 1;
  std::size_t place_ = 0;
};

double wrapped(double frequency) { return frequency - std::round(frequency); }

/// One signal, seen through the window.
class Analysis {
 public:
  explicit Analysis(std::span<const Complex> samples)
      : signal_(samples.begin(), samples.end()), weights_(window(samples.size())) {
    size_ = norm(signal_);
  }

  Spectrum run(std::size_t count) {
    rest_ = signal_;
    Spectrum result;
    result.size = size_;
    result.near_folding = near_folding();
    while (lines_.size() < count && norm(rest_) > kNothing * size_) {
      const double found = strongest(rest_);
      const bool again = std::ranges::any_of(lines_, [&](const SpectralLine& line) {
        return std::abs(wrapped(line.frequency - found)) * count_of() < 1;
      });
      if (again) break;  // the wings of a line that is none: nothing more can be told apart
      lines_.push_back({.frequency = found, .amplitude = {}});
      extend();
      fit();
    }
    for (int k = 0; k < kSweepsOfLines && !lines_.empty(); ++k) sweep();
    result.rest = norm(rest_);
    std::ranges::sort(lines_, std::greater{},
                      [](const SpectralLine& line) { return std::abs(line.amplitude); });
    result.lines = std::move(lines_);
    return result;
  }

 private:
  double count_of() const { return static_cast<double>(signal_.size()); }

  double norm(const Signal& z) const {
    double sum = 0;
    for (std::size_t j = 0; j < z.size(); ++j) sum += weights_[j] * std::norm(z[j]);
    return std::sqrt(sum);
  }

  /// The amplitudes of the window's spectrum, on a grid of at least twice as many frequencies.
  Signal transform(const Signal& z) const {
    std::size_t length = 64;
    while (length < 2 * z.size()) length *= 2;
    Signal padded(length), result;
    for (std::size_t j = 0; j < z.size(); ++j) padded[j] = weights_[j] * z[j];
    Eigen::FFT<double> fft;
    fft.fwd(result, padded);
    return result;
  }

  double near_folding() const {
    const Signal all = transform(signal_);
    double largest = 0, last = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double frequency = wrapped(static_cast<double>(k) / static_cast<double>(all.size()));
      const double size = std::abs(all[k]);
      largest = std::max(largest, size);
      if (std::abs(frequency) > 0.45) last = std::max(last, size);
    }
    return largest > 0 ? last / largest : 0;
  }

  double strongest(const Signal& z) const {
    const Signal all = transform(z);
    const auto peak = std::ranges::max_element(
        all, {}, [](const Complex& amplitude) { return std::norm(amplitude); });
    const auto length = static_cast<double>(all.size());
    return maximum(z, wrapped(static_cast<double>(peak - all.begin()) / length), 1 / length);
  }

  /// The value of the windowed spectrum, and its first two derivatives by the frequency.
  std::array<Complex, 3> spectrum_at(const Signal& z, double frequency) const {
    std::array<Complex, 3> sum{};
    const double middle = (count_of() - 1) / 2;
    Waves waves(frequency);
    for (std::size_t j = 0; j < z.size(); ++j) {
      const Complex term = weights_[j] * z[j] * std::conj(waves.next());
      const double t = static_cast<double>(j) - middle;  // no phase turns with the frequency
      sum[0] += term;
      sum[1] += t * term;
      sum[2] += t * t * term;
    }
    // Of exp(-2 Pi i f (t + middle)) the factor of `middle` has the size 1 and moves no maximum.
    sum[1] *= Complex(0, -kTurn);
    sum[2] *= -kTurn * kTurn;
    return sum;
  }

  /// The frequency near `begin` at which the square of the spectrum is largest.
  double maximum(const Signal& z, double begin, double cell) const {
    double frequency = begin;
    for (int round = 0; round < kRoundsOfLine; ++round) {
      const auto [value, first, second] = spectrum_at(z, frequency);
      const double slope = 2 * std::real(first * std::conj(value));
      const double bend = 2 * (std::norm(first) + std::real(second * std::conj(value)));
      if (!(bend < 0)) break;
      double step = -slope / bend;
      if (std::abs(step) > cell / 2) step = std::copysign(cell / 2, step);
      frequency += step;
      if (std::abs(step) < 1e-17) break;
    }
    // Newton's method may have left for another maximum.
    return std::abs(frequency - begin) < 2 * cell ? frequency : begin;
  }

  Complex projection(const Signal& z, double frequency) const {
    Complex sum = 0;
    Waves waves(frequency);
    for (std::size_t j = 0; j < z.size(); ++j) sum += weights_[j] * z[j] * std::conj(waves.next());
    return sum;
  }

  /// Of two waves, seen through the window.
  Complex product(double first, double second) const {
    Complex sum = 0;
    Waves waves(second - first);
    for (const double weight : weights_) sum += weight * waves.next();
    return sum;
  }

  /// Row and column of the last line in the normal equations of least squares.
  void extend() {
    const auto n = static_cast<Eigen::Index>(lines_.size());
    normal_.conservativeResize(n, n);
    right_.conservativeResize(n);
    const double last = lines_.back().frequency;
    for (Eigen::Index a = 0; a < n; ++a) {
      normal_(a, n - 1) = product(lines_[static_cast<std::size_t>(a)].frequency, last);
      normal_(n - 1, a) = std::conj(normal_(a, n - 1));
    }
    right_[n - 1] = projection(signal_, last);
  }

  /// The amplitudes of all lines by least squares, and what they leave.
  void fit() {
    const Eigen::VectorXcd amplitudes = shortest_solution(normal_, right_, 1e-13);
    rest_ = signal_;
    for (std::size_t a = 0; a < lines_.size(); ++a) {
      lines_[a].amplitude = amplitudes[static_cast<Eigen::Index>(a)];
      add(-lines_[a].amplitude, lines_[a].frequency, rest_);
    }
  }

  static void add(Complex amplitude, double frequency, Signal& to) {
    Waves waves(frequency);
    for (Complex& sample : to) sample += amplitude * waves.next();
  }

  /// Each line without the others, then all amplitudes anew.
  void sweep() {
    for (SpectralLine& line : lines_) {
      add(line.amplitude, line.frequency, rest_);
      line.frequency = wrapped(maximum(rest_, line.frequency, 0.5 / count_of()));
      line.amplitude = projection(rest_, line.frequency);
      add(-line.amplitude, line.frequency, rest_);
    }
    std::vector<SpectralLine> all;
    std::swap(all, lines_);
    for (const SpectralLine& line : all) {
      lines_.push_back(line);
      extend();
    }
    fit();
  }

  Signal signal_, rest_;
  std::vector<double> weights_;
  double size_ = 0;
  std::vector<SpectralLine> lines_;
  Eigen::MatrixXcd normal_;
  Eigen::VectorXcd right_;
};

/// How far the nearest line of each half is from each line.
void compare_with_halves(std::span<const Complex> samples, Spectrum& whole, std::size_t count) {
  const std::size_t half = samples.size() / 2;
  const double width = 2 / static_cast<double>(half);
  // Of two lines of one size either may be the last: the halves are asked for both.
  const std::size_t more = count + 2;
  const std::array<Spectrum, 2> halves{Analysis(samples.first(half)).run(more),
                                       Analysis(samples.last(half)).run(more)};
  for (SpectralLine& line : whole.lines) {
    double error = 0;
    for (const Spectrum& part : halves) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const SpectralLine& other : part.lines)
        nearest = std::min(nearest, std::abs(wrapped(other.frequency - line.frequency)));
      error = std::max(error, nearest);
    }
    line.in_both_halves = error < width;
    line.error = line.in_both_halves ? error : 1 / static_cast<double>(samples.size());
    line.error = std::max(line.error, std::numeric_limits<double>::epsilon() / 4);
  }
}

}  // namespace

Spectrum spectrum_of(std::span<const Complex> samples, std::size_t count) {
  Spectrum result = Analysis(samples).run(count);
  compare_with_halves(samples, result, count);
  return result;
}

Spectrum spectrum_of(std::span<const double> samples, std::size_t count) {
  const Signal complex(samples.begin(), samples.end());
  // The mean, and each line with its mirror image.
  Spectrum result = spectrum_of(std::span<const Complex>(complex), 2 * count + 1);
  const double width = 1 / static_cast<double>(samples.size());
  std::erase_if(result.lines, [&](SpectralLine& line) {
    if (std::abs(line.frequency) < width / 8) line.frequency = 0;
    return line.frequency < 0;
  });
  if (result.lines.size() > count) result.lines.resize(count);
  return result;
}

}  // namespace casimir
