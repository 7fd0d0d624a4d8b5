#include "analysis/tpa/deconvolution_filters.hpp"

#include <catch2/catch.hpp>
#include <complex>
#include <vector>

#include "analysis/tpa/linear_phase_filters.hpp"
#include "analysis/tpa/mimo_convolver.hpp"
#include "hal/types/linear_algebra.hpp"
#include "hal/types/units.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;
using Complex = std::complex<double>;

namespace {

constexpr double rate_Hz = 4960;
constexpr Index length = 4096;
constexpr double step_Hz = rate_Hz / double(length);
constexpr FilterDesign design{.rate_Hz = rate_Hz,
                              .taps = 2048,
                              .delay_samples = 1024,
                              .from_Hz = 25,
                              .to_Hz = 2200,
                              .edge_Hz = 20};

/// Masses on springs and dampers, struck and heard at each mass.
struct Structure {
  Eigen::MatrixXd mass_kg, damping_Ns_m, stiffness_N_m;

  /// m/s² per N
  Eigen::MatrixXcd accelerance(double frequency_Hz) const {
    const double omega = units::two_pi * frequency_Hz;
    const Eigen::MatrixXcd dynamic = (stiffness_N_m - omega * omega * mass_kg).cast<Complex>() +
                                     Complex(0, omega) * damping_Ns_m.cast<Complex>();
    return -omega * omega * algebra::inverse_by_full_pivots(dynamic);
  }
  LineMatrices accelerances() const {
    LineMatrices lines(mass_kg.rows(), mass_kg.rows(), length / 2);
    for (Index line = 0; line < lines.lines; ++line) {
      lines[line] = accelerance(double(line + 1) * step_Hz);
    }
    return lines;
  }
};

/// 2 kg that ring at 120 Hz, 3 % damped.
Structure one_mass() {
  const double omega = units::two_pi * 120;
  return {Eigen::MatrixXd::Constant(1, 1, 2), Eigen::MatrixXd::Constant(1, 1, 0.06 * 2 * omega),
          Eigen::MatrixXd::Constant(1, 1, 2 * omega * omega)};
}

Structure two_masses() {
  Structure s{Eigen::MatrixXd(2, 2), Eigen::MatrixXd(2, 2), Eigen::MatrixXd(2, 2)};
  s.mass_kg << 2, 0, 0, 0.5;
  s.stiffness_N_m << 3e6, -1e6, -1e6, 1.5e6;
  s.damping_Ns_m = 5e-5 * s.stiffness_N_m;
  return s;
}

LineMatrices inverted(LineMatrices lines) {
  for (Index line = 0; line < lines.lines; ++line)
    lines[line] = algebra::inverse_by_full_pivots(lines[line]);
  return lines;
}

/// A force of each of these frequencies at each place.
struct Tones {
  std::vector<std::vector<double>> of_place_Hz;

  Eigen::MatrixXd forces(const Eigen::ArrayXd& times_s) const {
    return sum(times_s, [](double, Index place) {
      return Eigen::VectorXcd(Eigen::VectorXcd::Unit(place + 1, place));
    });
  }
  Eigen::MatrixXd responses(const Structure& structure, const Eigen::ArrayXd& times_s) const {
    return sum(times_s, [&](double frequency_Hz, Index place) {
      return Eigen::VectorXcd(structure.accelerance(frequency_Hz).col(place));
    });
  }

 private:
  template <typename Amplitudes>
  Eigen::MatrixXd sum(const Eigen::ArrayXd& times_s, const Amplitudes& amplitudes) const {
    const auto places = Index(of_place_Hz.size());
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(times_s.size(), places);
    for (Index place = 0; place < places; ++place) {
      for (const double frequency_Hz : of_place_Hz[std::size_t(place)]) {
        const Eigen::ArrayXd angle = units::two_pi * frequency_Hz * times_s;
        const Eigen::VectorXcd z = amplitudes(frequency_Hz, place);
        for (Index i = 0; i < z.size(); ++i) {
          all.col(i) += (z[i].real() * angle.cos() - z[i].imag() * angle.sin()).matrix();
        }
      }
    }
    return all;
  }
};

/// Of the forces that the filters make of the tones' responses, over those that were there.
double force_error(const FirMatrix& filters, const Structure& structure, const Tones& tones) {
  constexpr Index samples = 3 * length;
  const Eigen::ArrayXd times_s = test::times_s(samples, rate_Hz);
  MimoConvolver convolver(filters, {samples, 1});
  Eigen::MatrixXd found(samples, filters.outputs);
  REQUIRE(convolver.push(tones.responses(structure, times_s), found) == samples);
  const Eigen::MatrixXd there = tones.forces(times_s - filters.delay_samples / rate_Hz);
  const Eigen::MatrixXd settled = found.bottomRows(samples - length);
  return (settled - there.bottomRows(samples - length)).norm() /
         there.bottomRows(samples - length).norm();
}

const Tones all_over{{{61.3, 133.7, 411.1, 1203.9}}};
// The article's filters are what they were designed to be on their lines alone.
const Tones below{{{50 * step_Hz}}}, above{{{1000 * step_Hz}}};
const Tones on_lines{{{50 * step_Hz, 110 * step_Hz, 340 * step_Hz, 1000 * step_Hz}}};
const Tones of_two_on_lines{{{50 * step_Hz, 175 * step_Hz}, {110 * step_Hz, 340 * step_Hz}}};
const Tones of_two{{{61.3, 211.7}, {133.7, 411.1, 1203.9}}};

}  // namespace

TEST_CASE("the force on one mass is recovered from its acceleration", "[analysis][tpa]") {
  const Structure structure = one_mass();
  const DesignedFilters designed =
      deconvolution_filters(inverted(structure.accelerances()), step_Hz, step_Hz, design);
  CHECK(force_error(designed.filters, structure, all_over) < 1e-3);
  CHECK(designed.cut_share.maxCoeff() < 1e-4);
  // At each frequency the force is what the mass, the damper and the spring take.
  const LineMatrices response = frequency_response(designed.filters, 2 * length);
  for (const Index k : {101, 303, 1501, 3001}) {  // odd: half-way between the design's lines
    const double omega = units::two_pi * double(k) * step_Hz / 2;
    const Complex expected = 2. + structure.damping_Ns_m(0, 0) / Complex(0, omega) -
                             structure.stiffness_N_m(0, 0) / (omega * omega);
    const Complex in_time = std::polar(1., omega / rate_Hz * designed.filters.delay_samples);
    CHECK(std::abs(in_time * response[k](0, 0) - expected) < 2e-3 * std::abs(expected));
  }
}

TEST_CASE("two forces are told apart from two accelerations", "[analysis][tpa]") {
  const Structure structure = two_masses();
  const LineMatrices h = structure.accelerances();
  const DesignedFilters designed = deconvolution_filters(inverted(h), step_Hz, step_Hz, design);
  CHECK(force_error(designed.filters, structure, of_two) < 1e-3);
  CHECK(force_error(designed.filters, structure, {{{}, {133.7}}}) < 2e-3);  // the other stays still
}

TEST_CASE("the article's linear phase gives a force's amplitude and loses its time",
          "[analysis][tpa]") {
  const Structure structure = one_mass();
  const FirMatrix filters =
      linear_phase_filters(inverted(structure.accelerances()), step_Hz, step_Hz, rate_Hz);
  // Below its resonance the mass moves against its acceleration: the force comes with a wrong sign.
  CHECK(force_error(filters, structure, below) == Approx(2).epsilon(0.02));
  CHECK(force_error(filters, structure, above) < 0.05);
  CHECK(force_error(filters, structure, on_lines) > 0.5);
  const FirMatrix of_two_masses =
      linear_phase_filters(inverted(two_masses().accelerances()), step_Hz, step_Hz, rate_Hz);
  CHECK(force_error(of_two_masses, two_masses(), of_two_on_lines) > 0.5);
}

TEST_CASE("the article's filters are symmetric, and are its interpolation between their samples",
          "[analysis][tpa][literature]") {
  constexpr Index n = 32;
  LineMatrices s(1, 1, n / 2);  // lines 1 ... 16
  for (Index line = 0; line < s.lines; ++line) {
    s[line](0, 0) = std::polar(1 / (1 + 0.1 * double(line)), 0.7 * double(line));
  }
  const FirMatrix filters = linear_phase_filters(s, 1, 1, double(n));
  const Eigen::VectorXd h = filters.response(0, 0);
  // Phases of up to 16π are rounded to 1e-14.
  CHECK((h - h.reverse()).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(filters.delay_samples == 15.5);
  // Eq. 8, over all N samples of eq. 6, those above half the rate being the conjugates.
  const auto sample = [&](Index k) -> Complex {
    if (k == 0 || k == n / 2) return 0;
    const Index mirrored = k < n / 2 ? k : n - k;
    const double omega = units::two_pi * double(mirrored) / double(n);
    const Complex below_half = std::polar(std::abs(s[mirrored - 1](0, 0)), -15.5 * omega);
    return k < n / 2 ? below_half : std::conj(below_half);
  };
  for (const double omega : {0.05, 0.3, 1.234, 2.9}) {
    Complex direct = 0, article = 0;
    for (Index i = 0; i < n; ++i) direct += h[i] * std::polar(1., -omega * double(i));
    for (Index k = 0; k < n; ++k) {
      const double half = omega / 2 - units::two_pi / 2 * double(k) / double(n);
      const double turned = units::two_pi / 2 * double(k) * double(n - 1) / double(n);
      article += std::polar(1. / double(n), turned) * sample(k) *
                 (std::sin(double(n) * half) / std::sin(half));
    }
    article *= std::polar(1., -15.5 * omega);
    CHECK(std::abs(article - direct) < 1e-13);
  }
}

TEST_CASE("filters and structure in series give forces back inside the band, and nothing outside",
          "[analysis][tpa]") {
  const LineMatrices h = two_masses().accelerances();
  const LineMatrices s = inverted(h);
  const DesignedFilters designed = deconvolution_filters(s, step_Hz, step_Hz, design);
  const Eigen::VectorXd errors = identity_errors(designed.filters, h, step_Hz, step_Hz);
  const auto line_at = [](double frequency_Hz) { return Index(frequency_Hz / step_Hz) - 1; };
  const Index from = line_at(60), to = line_at(2170);
  CHECK(errors.segment(from, to - from).maxCoeff() < 0.01);
  CHECK(errors[line_at(2300)] == Approx(1).epsilon(0.01));
  // Taps that do not hold the response: it is told, by their share and by the error.
  FilterDesign too_short = design;
  too_short.taps = 128;
  too_short.delay_samples = 4;
  const DesignedFilters cut = deconvolution_filters(s, step_Hz, step_Hz, too_short);
  CHECK(cut.cut_share.maxCoeff() > 0.01);
  CHECK(identity_errors(cut.filters, h, step_Hz, step_Hz).segment(from, to - from).maxCoeff() >
        0.1);
  // And the article's own.
  const FirMatrix linear = linear_phase_filters(s, step_Hz, step_Hz, rate_Hz);
  CHECK(identity_errors(linear, h, step_Hz, step_Hz).segment(from, to - from).maxCoeff() > 1);
}

TEST_CASE("a delay is a delay, what comes too late for the taps is all cut off",
          "[analysis][tpa]") {
  LineMatrices all_pass(1, 2, 33);
  for (Index line = 0; line < 33; ++line) {
    all_pass[line](0, 0) = 1;
    all_pass[line](0, 1) = std::polar(1., -units::two_pi * double(line) * 40 / 64);
  }
  const DesignedFilters designed = deconvolution_filters(
      all_pass, 0, 1, {.rate_Hz = 64, .taps = 32, .delay_samples = 16, .from_Hz = 0, .to_Hz = 32});
  const Eigen::VectorXd expected = Eigen::VectorXd::Unit(32, 16);
  CHECK((designed.filters.response(0, 0) - expected).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(designed.cut_share(0, 0) < 1e-14);
  CHECK(designed.cut_share(0, 1) == Approx(1));
}

TEST_CASE("of nothing a filter of nothing is made, and of nonsense none", "[analysis][tpa]") {
  const LineMatrices nothing(2, 3, length / 2);
  const DesignedFilters designed = deconvolution_filters(nothing, step_Hz, step_Hz, design);
  CHECK(designed.filters.taps.isZero(0));
  CHECK(designed.cut_share.isZero(0));
  const auto with = [&](auto change) {
    FilterDesign changed = design;
    change(changed);
    return deconvolution_filters(nothing, step_Hz, step_Hz, changed);
  };
  CHECK_THROWS_AS(with([](FilterDesign& d) { d.taps = length + 1; }), std::invalid_argument);
  CHECK_THROWS_AS(with([](FilterDesign& d) { d.delay_samples = d.taps; }), std::invalid_argument);
  CHECK_THROWS_AS(with([](FilterDesign& d) { d.to_Hz = d.from_Hz; }), std::invalid_argument);
  CHECK_THROWS_AS(with([](FilterDesign& d) { d.from_Hz = 0; }), std::invalid_argument);
  CHECK_THROWS_AS(with([](FilterDesign& d) { d.edge_Hz = 2000; }), std::invalid_argument);
  CHECK_THROWS_AS(with([](FilterDesign& d) { d.rate_Hz = 4961; }), std::invalid_argument);
  CHECK_THROWS_AS(linear_phase_filters(nothing, step_Hz, step_Hz, 0.5 * rate_Hz),
                  std::invalid_argument);
}
