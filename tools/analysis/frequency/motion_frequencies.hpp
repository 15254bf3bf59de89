#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/analysis/frequency/spectrum.hpp"

namespace casimir {

/// A line in the spectrum of a variable: amplitude * cos(frequency * t + phase), or of an angle q
/// a term amplitude * exp(i (frequency * t + phase)) of exp(i q).
struct MotionLine {
  double frequency = 0;  ///< in radians per unit of time
  double amplitude = 0, phase = 0;
  double error = 0;      ///< of the frequency: see SpectralLine::error, and `analysed_motion`
  bool settled = false;  ///< the same line is in both halves of the motion
  std::vector<int> combination;  ///< of the base frequencies; empty where it is none
};

/// The lines of one variable.
struct VariableSpectrum {
  std::string name;
  bool angle = false;  ///< of exp(i q): its values are known up to turns
  std::vector<MotionLine> lines;
  double rest = 0;  ///< what all lines leave of it, as a share
};

/// What frequency analysis finds in a motion.
struct MotionFrequencies {
  std::size_t samples = 0;
  double interval = 0;  ///< the time between two
  std::vector<VariableSpectrum> variables;
  /// Frequencies of which every settled line is a combination with small whole numbers; empty where
  /// none such were found. Which of the many bases of a module of frequencies these are has no
  /// meaning, their number is the dimension of the torus that the variables show.
  std::vector<double> base, base_errors;
  double near_folding = 0;  ///< the largest of all variables: see Spectrum
  bool settled = false;     ///< the strong lines of all variables are the same in both halves
  std::vector<std::string> warnings;
};

/// The motion at equal times.
struct SampledMotion {
  std::vector<std::string> names;
  std::vector<bool> angles;                 ///< one for each name: known up to 2 Pi
  std::vector<std::vector<double>> states;  ///< one for each time
  double interval = 0;                      ///< between two times
};

/// Below this the samples are dense enough: see Spectrum::near_folding.
inline constexpr double kFolded = 1e-7;

/// The strongest lines of each variable, and whether they are those of a quasi-periodic motion.
/// Where they are not, or the samples leave doubts, a warning says so.
MotionFrequencies frequencies_of(const SampledMotion& motion, std::size_t lines);

}  // namespace casimir
