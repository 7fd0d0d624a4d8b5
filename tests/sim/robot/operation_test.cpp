#include "sim/robot/operation.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/fft.hpp"
#include "tests/sim/robot/direct_solution.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using sim::RobotMotion;
using sim::VirtualRobot;
using test::relative_difference;

namespace {

sim::RobotOptions short_records(std::uint64_t seed) {
  sim::RobotOptions options;
  options.seed = seed;
  options.record_s = 3;
  return options;
}

sim::RobotOptions without_noise(std::uint64_t seed) {
  sim::RobotOptions options = short_records(seed);
  options.sensor_noise = 0;
  return options;
}

Eigen::MatrixXd samples_of(const Recording& recording) {
  Eigen::MatrixXd samples(recording.channels[0].samples.size(),
                          static_cast<Eigen::Index>(recording.channels.size()));
  for (std::size_t i = 0; i < recording.channels.size(); ++i) {
    samples.col(static_cast<Eigen::Index>(i)) = recording.channels[i].samples;
  }
  return samples;
}

double rms(const Eigen::VectorXd& x) { return std::sqrt(x.squaredNorm() / double(x.size())); }

// Of the part of a record between two frequencies, by Parseval.
double rms_between(const Eigen::VectorXd& x, double first_Hz, double last_Hz) {
  const Eigen::VectorXcd lines = analysis::fft(x);
  const double per_Hz = double(x.size()) / 4960;
  const auto first = std::lround(first_Hz * per_Hz), last = std::lround(last_Hz * per_Hz);
  return lines.segment(first, last - first + 1).norm() * std::sqrt(2.0) / double(x.size());
}

// Amplitude of the sinusoid of that frequency, with a Hann window.
double amplitude_at(const Eigen::VectorXd& x, double frequency_Hz) {
  std::complex<double> sum = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double window = 1 - std::cos(units::two_pi * (double(i) + 0.5) / double(x.size()));
    sum += window * x[i] * std::polar(1.0, -units::two_pi * frequency_Hz * double(i) / 4960);
  }
  return 2 * std::abs(sum) / double(x.size());
}

// Amplitude of a line over the three targets.
double at_flange(const Recording& recording, double frequency_Hz) {
  double squares = 0;
  for (std::size_t i = 36; i < 39; ++i) {
    squares += std::pow(amplitude_at(recording.channels[i].samples, frequency_Hz), 2);
  }
  return std::sqrt(squares);
}

// What lies in a period's last sample: a period without mean sums to 0.
Eigen::MatrixXd completed(const Eigen::MatrixXd& all_but_one) {
  Eigen::MatrixXd period(all_but_one.rows() + 1, all_but_one.cols());
  period << all_but_one, -all_but_one.colwise().sum();
  return period;
}

Eigen::MatrixXcd lines_of(const Eigen::MatrixXd& period) {
  Eigen::MatrixXcd lines(period.rows() / 2 + 1, period.cols());
  for (Eigen::Index i = 0; i < period.cols(); ++i) lines.col(i) = analysis::fft(period.col(i));
  return lines;
}

}  // namespace

SCENARIO("records are the robot's answer to its forces, line by line", "[sim][robot]") {
  GIVEN("a record that lacks one sample of the forces' period") {
    sim::RobotOptions options = without_noise(11);
    options.record_s = 8191 / 4960.0;
    const VirtualRobot robot(options);
    const sim::Operation operation = sim::operate(robot, RobotMotion::straight_slow);
    REQUIRE(operation.truth.forces_N.rows() == 8191);
    THEN("accelerations are forces times FRFs of an equation solver, to 1e-6") {
      const Eigen::MatrixXcd forces = lines_of(completed(operation.truth.forces_N));
      const Eigen::MatrixXcd answers = lines_of(completed(samples_of(operation.recording)));
      for (const Eigen::Index line : {9, 18, 30, 165, 500, 1200, 3000}) {
        const double frequency_Hz = double(line) * 4960 / 8192;
        const Eigen::VectorXcd expected =
            test::direct_accelerance(robot, test::on_axis(frequency_Hz)) *
            forces.row(line).transpose();
        CHECK(relative_difference(answers.row(line).transpose(), expected) < 1e-6);
      }
    }
  }
}

SCENARIO("what the paths contribute adds up to what the targets do", "[sim][robot][law]") {
  const VirtualRobot robot(without_noise(12));
  const sim::Operation operation = sim::operate(robot, RobotMotion::straight_fast);
  for (Eigen::Index target = 0; target < 3; ++target) {
    const Eigen::MatrixXd partial = sim::partial_histories(robot, operation.truth, target);
    const Eigen::VectorXd& measured =
        operation.recording.channels[std::size_t(36 + target)].samples;
    CHECK(relative_difference(partial.rowwise().sum(), measured) < 1e-10);
  }
}

SCENARIO("the article's paths lead, by 10 to 30 %, in every motion of every robot",
         "[sim][robot]") {
  if (test::too_long_under_sanitizer()) return;
  sim::RobotOptions options = short_records(static_cast<std::uint64_t>(GENERATE(range(1, 21))));
  options.record_s = 1;
  const VirtualRobot robot(options);
  for (const RobotMotion motion : sim::robot_motions) {
    const sim::OperationTruth truth = sim::operate(robot, motion).truth;
    const bool is_fast = motion == RobotMotion::straight_fast;
    const std::array<Eigen::Index, 3> leaders =  // J3 X = 6, J3 Z = 8, J4 X = 9, J5 Y = 13
        is_fast ? std::array<Eigen::Index, 3>{8, 13, 9} : std::array<Eigen::Index, 3>{6, 13, 6};
    for (Eigen::Index target = 0; target < 3; ++target) {
      Eigen::VectorXd contribution = truth.partial_rms_m_s2.col(target);
      Eigen::Index first = 0;
      const double most = contribution.maxCoeff(&first);
      contribution[first] = 0;
      CHECK(first == leaders[std::size_t(target)]);
      CHECK(most / contribution.maxCoeff() >= 1.1);
      CHECK(most / contribution.maxCoeff() <= 1.3);
    }
  }
}

SCENARIO("contributions by the truth are those of the histories over the analysed band",
         "[sim][robot]") {
  sim::RobotOptions options = without_noise(13);
  options.record_s = 20;
  const VirtualRobot robot(options);
  const sim::OperationTruth truth = sim::operate(robot, RobotMotion::five_axis_slow).truth;
  const Eigen::MatrixXd partial = sim::partial_histories(robot, truth, 2);
  for (Eigen::Index path = 0; path < 18; ++path) {
    // The record is a part of the period: broadband differs by chance, some per cent.
    CHECK(rms_between(partial.col(path), truth.band_first_Hz, truth.band_last_Hz) ==
          Approx(truth.partial_rms_m_s2(path, 2)).epsilon(0.05));
  }
}

SCENARIO("each motion has the lines that the article saw at the flange", "[sim][robot]") {
  if (test::too_long_under_sanitizer()) return;
  sim::RobotOptions options = short_records(14);
  options.record_s = 20;
  const VirtualRobot robot(options);
  const auto [motion, line_Hz] =
      GENERATE(table<RobotMotion, double>({{RobotMotion::straight_slow, 11.0},
                                           {RobotMotion::straight_slow, 18.0},
                                           {RobotMotion::straight_slow, 100.0},
                                           {RobotMotion::five_axis_slow, 13.7},
                                           {RobotMotion::straight_fast, 22.3}}));
  const sim::Operation operation = sim::operate(robot, motion);
  double nearest_Hz = 0;
  for (const sim::TrueLine& line : operation.truth.lines) {
    if (std::abs(line.frequency_Hz - line_Hz) < std::abs(nearest_Hz - line_Hz)) {
      nearest_Hz = line.frequency_Hz;
    }
  }
  CHECK(nearest_Hz == Approx(line_Hz).margin(0.03));
  CHECK(at_flange(operation.recording, nearest_Hz) >
        4 * at_flange(operation.recording, nearest_Hz + 1.3));
}

SCENARIO("a new reducer in joint 3 takes the fault's lines away and nothing else", "[sim][robot]") {
  sim::RobotOptions options = without_noise(15);
  const VirtualRobot before(options);
  options.joint3_replaced = true;
  const VirtualRobot after(options);
  const RobotMotion motion = RobotMotion::straight_slow;
  const sim::Operation old = sim::operate(before, motion), renewed = sim::operate(after, motion);
  const Eigen::MatrixXcd change = old.truth.spectrum_N - renewed.truth.spectrum_N;
  THEN("forces change in joint 3 alone, at orders of its shaft and beside the 100 Hz family") {
    Eigen::Index changed = 0;
    for (Eigen::Index line = 0; line < change.rows(); ++line) {
      for (Eigen::Index path = 0; path < 18; ++path) {
        if (change(line, path) == 0.0) continue;
        ++changed;
        CHECK(path / 3 == 2);
      }
    }
    CHECK(changed == 3 * (3 + 4 * 4));
  }
  THEN("a line of another joint stays at the flange") {
    const double other_Hz = old.truth.grid.step_Hz * double(old.truth.grid.nearest(18));
    CHECK(at_flange(renewed.recording, other_Hz) ==
          Approx(at_flange(old.recording, other_Hz)).epsilon(0.1));
  }
}

SCENARIO("with a new reducer the line of joint 3's shaft falls to less than half at the flange",
         "[sim][robot]") {
  double before = 0, after = 0;  // squares over ten robots: one may have its phases against it
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    sim::RobotOptions options = without_noise(seed);
    for (const bool is_replaced : {false, true}) {
      options.joint3_replaced = is_replaced;
      const sim::Operation operation =
          sim::operate(VirtualRobot(options), RobotMotion::straight_fast);
      const sim::PeriodGrid& grid = operation.truth.grid;
      const double shaft_Hz = grid.step_Hz * double(grid.nearest(22.3));
      (is_replaced ? after : before) += std::pow(at_flange(operation.recording, shaft_Hz), 2);
    }
  }
  CHECK(after < 0.25 * before);
}

SCENARIO("sensors add white noise of 1 % and nothing else", "[sim][robot]") {
  const Recording clean =
      sim::operate(VirtualRobot(without_noise(16)), RobotMotion::straight_slow).recording;
  const Recording noisy =
      sim::operate(VirtualRobot(short_records(16)), RobotMotion::straight_slow).recording;
  for (std::size_t i = 0; i < 42; ++i) {
    const Eigen::VectorXd noise = noisy.channels[i].samples - clean.channels[i].samples;
    CHECK(rms(noise) == Approx(0.01 * rms(clean.channels[i].samples)).epsilon(0.05));
    CHECK(std::abs(noise.mean()) < 5 * rms(noise) / std::sqrt(double(noise.size())));
    CHECK(rms_between(noise, 0, 1240) == Approx(rms_between(noise, 1240, 2480)).epsilon(0.1));
  }
}

SCENARIO("forces of one joint are partly correlated, those of two are not", "[sim][robot]") {
  const sim::OperationTruth truth =
      sim::operate(VirtualRobot(short_records(17)), RobotMotion::straight_slow).truth;
  // Broadband alone: above the 100 Hz family and its sidebands.
  const Eigen::MatrixXcd broadband =
      truth.spectrum_N.bottomRows(truth.grid.lines - truth.grid.nearest(450));
  const auto coherence = [&](Eigen::Index a, Eigen::Index b) {
    return std::norm(broadband.col(a).dot(broadband.col(b))) /
           (broadband.col(a).squaredNorm() * broadband.col(b).squaredNorm());
  };
  CHECK(coherence(6, 7) == Approx(0.4 * 0.4).epsilon(0.25));
  CHECK(coherence(6, 9) < 0.01);
  CHECK(coherence(0, 17) < 0.01);
}

SCENARIO("a recording names points and directions, and holds no force", "[sim][robot]") {
  const Recording recording =
      sim::operate(VirtualRobot(short_records(18)), RobotMotion::straight_fast).recording;
  REQUIRE(recording.channels.size() == 42);
  CHECK(recording.channels[6].info.name == "J3 active");
  CHECK(recording.channels[6].info.direction == "+X");
  CHECK(recording.channels[38].info.name == "flange");
  CHECK(recording.channels[41].info.name == "forearm");
  for (const Channel& channel : recording.channels) {
    CHECK(channel.info.unit == "m/s²");
    CHECK(channel.rate_Hz == 4960);
    CHECK(channel.samples.size() == 3 * 4960);
  }
}

SCENARIO("the same seed gives the same record on any number of threads, another seed another",
         "[sim][robot]") {
  sim::RobotOptions options = short_records(19);
  options.threads = 1;
  const auto record_of = [](const sim::RobotOptions& of) {
    return samples_of(sim::operate(VirtualRobot(of), RobotMotion::straight_slow).recording);
  };
  const Eigen::MatrixXd alone = record_of(options);
  options.threads = 3;
  CHECK((record_of(options) == alone));
  options.seed = 20;
  CHECK((record_of(options) != alone));
}
