#pragma once

#include <Eigen/Core>

namespace rvbench::analysis {

/// One-sided amplitude spectrum over a uniform axis: Hz for time signals, orders for signals
/// sampled over shaft angle.
struct Spectrum {
  double resolution = 0;      ///< axis step per line: Hz, or events per input revolution
  Eigen::VectorXd amplitude;  ///< N/2 + 1 lines, 0-to-peak, in the unit of the signal

  double axis(Eigen::Index line) const { return double(line) * resolution; }
};

enum class Window { rectangular, hann };

/// Lines of noise that one under a Hann window holds, and the power of a tone over its three lines,
/// which read 1/2, 1 and 1/2 of its amplitude.
/// Source  Harris, Proc. IEEE 66(1), 51-83 (1978), table 1: equivalent noise bandwidth
inline constexpr double lines_per_hann_line = 1.5;

/// Amplitude spectrum of x, calibrated so that a sine of amplitude a on a line reads a.
///
/// Shape   N uniform samples → N/2 + 1 lines, resolution = rate / N
/// Units   that of x, 0-to-peak; line 0 is the magnitude of the mean, which is taken out before the
///         window is applied: an offset does not leak into line 1
/// Limits  a Hann line between two lines reads up to 1.42 dB low, a rectangular one 3.92 dB
/// Errors  throws std::invalid_argument: N < 2, rate ≤ 0, sample not finite
/// Source  Heinzel, Rüdiger & Schilling, Spectrum and spectral density estimation by the DFT (2002)
Spectrum amplitude_spectrum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate, Window window);

/// The same of what the N/2 + 1 lines that fft() gives of x are lines of.
/// @param n  samples of x
/// Errors  throws std::invalid_argument: n < 2, another number of lines, rate ≤ 0
Spectrum amplitude_spectrum(Eigen::VectorXcd lines, Eigen::Index n, double rate, Window window);

/// The first `count` lines of an unscaled transform under a Hann window of mean 1; line 0 and the
/// last, which lack a neighbour, are 0.
/// Shape   at least 3 lines, count >= 2
Eigen::VectorXcd lines_under_hann(const Eigen::VectorXcd& lines, Eigen::Index count);

/// Where between the lines a tone lies whose two highest lines, under a Hann window, are `line` and
/// a neighbour; `line` has two.
/// Units   lines
/// Errors  none thrown. Limits  right for a tone that is alone there
/// Source  Grandke, IEEE Trans. Instrum. Meas. 32(2), 350-355 (1983)
double place_of_tone(const Eigen::VectorXd& amplitude, Eigen::Index line);

}  // namespace rvbench::analysis
