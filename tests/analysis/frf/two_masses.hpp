#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>

#include "analysis/fft.hpp"
#include "analysis/frf/frf_record.hpp"
#include "hal/types/units.hpp"
#include "tests/support/signals.hpp"

namespace rvbench::test {

/// Two equal masses on equal springs, coupled: modes (1, 1) and (1, -1), in closed form.
struct TwoMasses {
  double mass_kg = 2;
  double first_Hz = 40, second_Hz = 65;
  double first_damping = 0.01, second_damping = 0.02;

  /// Response of mass `to` to a force on mass `at` (0 or 1), at a complex frequency s in rad/s.
  std::complex<double> receptance_m_N(std::complex<double> s, int to, int at) const {
    const auto mode = [&](double f_Hz, double damping) {
      const double w = units::two_pi * f_Hz;
      return 1.0 / (s * s + 2 * damping * w * s + w * w) / (2 * mass_kg);
    };
    const double sign = to == at ? 1 : -1;
    return mode(first_Hz, first_damping) + sign * mode(second_Hz, second_damping);
  }

  std::complex<double> accelerance(std::complex<double> s, int to, int at) const {
    return s * s * receptance_m_N(s, to, at);
  }
};

inline std::complex<double> j_omega(double frequency_Hz) {
  return {0, units::two_pi * frequency_Hz};
}

/// The accelerance from first_Hz = 0 on.
inline FrequencyResponse accelerance_of(const TwoMasses& body, int to, int at, double step_Hz,
                                        Eigen::Index lines) {
  FrequencyResponse frf;
  frf.source = "closed form";
  frf.response = {to == 0 ? "left" : "right", "+X"};
  frf.excitation = {at == 0 ? "left" : "right", "+X"};
  frf.response_unit = "m/s²";
  frf.excitation_unit = "N";
  frf.step_Hz = step_Hz;
  frf.values = Eigen::VectorXcd::NullaryExpr(lines, [&](Eigen::Index k) {
    return body.accelerance(j_omega(double(k) * step_Hz), to, at);
  });
  return frf;
}

/// A pulse of raised cosine, 1 high.
inline Eigen::VectorXd pulse(Eigen::Index n, double rate_Hz, double at_s, double width_s) {
  const Eigen::ArrayXd from_peak = times_s(n, rate_Hz) - at_s;
  return (from_peak.abs() < width_s / 2)
      .select(0.5 * (1 + (units::two_pi * from_peak / width_s).cos()), 0.0);
}

/// What both masses answer to a force on the left one; exact on the lines of the record, into which
/// it must have died away.
inline Eigen::MatrixXd answers(const TwoMasses& body, const Eigen::VectorXd& force,
                               double rate_Hz) {
  const Eigen::VectorXcd lines = analysis::fft(force);
  Eigen::MatrixXd responses(force.size(), 2);
  for (int to = 0; to < 2; ++to) {
    Eigen::VectorXcd y = lines;
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      y[k] *= body.accelerance(j_omega(double(k) * rate_Hz / double(force.size())), to, 0);
    }
    responses.col(to) = analysis::inverse_fft(y, force.size());
  }
  return responses;
}

inline analysis::FrfSetup hammer_on_left() {
  return {{{{"left", "+X"}, "N"}}, {{{"left", "+X"}, "m/s²"}, {{"right", "+X"}, "m/s²"}}};
}

struct HitSpec {
  double rate_Hz = 1024;
  double length_s = 8;
  double at_s = 0.1;
  double width_s = 0.008;
  double peak_N = 100;
};

inline analysis::FrfRecord hit_on(const TwoMasses& body, const HitSpec& spec = {}) {
  const auto n = Eigen::Index(std::lround(spec.length_s * spec.rate_Hz));
  const Eigen::VectorXd force = spec.peak_N * pulse(n, spec.rate_Hz, spec.at_s, spec.width_s);
  return {"hit", spec.rate_Hz, force, answers(body, force, spec.rate_Hz)};
}

}  // namespace rvbench::test
