#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace casimir {

/// A line in the spectrum of a signal: amplitude * exp(2 Pi i frequency j) at sample j.
struct SpectralLine {
  double frequency = 0;  ///< in turns per sample, from -1/2 to 1/2
  std::complex<double> amplitude;
  /// How far the frequency may be off: the largest difference between that of the whole signal and
  /// those of its first and its second half. The halves know a line of a quasi-periodic signal less
  /// exactly than the whole does, and a line of another signal wanders from one to the other.
  double error = 0;
  bool in_both_halves = false;  ///< else the error is the width of a line, 1/samples
};

/// What frequency analysis says of a signal.
struct Spectrum {
  std::vector<SpectralLine> lines;  ///< in the order of their strength
  double size = 0;                  ///< the weighted root mean square of the signal
  double rest = 0;                  ///< the same of what all lines together leave
  /// The largest amplitude in the last tenth below the highest frequency that the samples can tell,
  /// beside the largest of all: where it is not small, lines from beyond may have been folded back.
  double near_folding = 0;
};

/// The strongest lines of a signal by Laskar's frequency analysis (Laskar, Physica D 67 (1993) 257;
/// Laskar, Froeschle & Celletti, Physica D 56 (1992) 253): the maxima of the spectrum seen through
/// Hanning's window of order 4, (1 + cos(Pi t))^4, by the fast Fourier transform, each refined by
/// Newton's method, amplitudes of all lines by least squares. At the end each line is found again
/// without the others, twice, so that their wings move it no more.
/// \param samples  at equal distances, 32 at least
/// \param count  of lines; fewer where nothing is left beside the rounding
Spectrum spectrum_of(std::span<const std::complex<double>> samples, std::size_t count);

/// The same of a real signal: only lines of frequencies from 0 on, each of amplitude a standing for
/// 2 Re(a exp(..)), or for the mean where the frequency is 0.
Spectrum spectrum_of(std::span<const double> samples, std::size_t count);

}  // namespace casimir
