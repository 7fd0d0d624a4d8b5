#include "analysis/quality/record_quality.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/quality/heard.hpp"
#include "analysis/quality/iepe_bias.hpp"
#include "analysis/rv_reducer.hpp"
#include "tests/analysis/order_signals.hpp"

using namespace rvbench;
using Catch::Matchers::Contains;
using test::tone;

namespace {

constexpr double rate_Hz = 4960;
constexpr Eigen::Index count = 20 * 4960;

// Channels of a bench: its shaft, its mesh with sidebands, structure-borne and sensors' noise.
struct Bench {
  double speed_Hz = 605.0 / 60;
  double period_turns = 1;
  std::vector<Channel> channels;

  explicit Bench(double speed, std::size_t sensors = 4) : speed_Hz(speed) {
    const double mesh_Hz = 1080.0 / 121 * speed;
    for (std::size_t i = 0; i < sensors; ++i) {
      const double path = 0.3 + 0.4 * double(i);
      const auto seed = unsigned(10 * i);
      const Eigen::VectorXd x =
          path * (0.2 * tone(speed, count, rate_Hz) + tone(mesh_Hz, count, rate_Hz) +
                  0.2 * tone(mesh_Hz + speed, count, rate_Hz) +
                  0.05 * test::resonant(test::white_noise(count, 7), 0.2, 0.03)) +
          0.01 * test::white_noise(count, seed);
      channels.push_back(
          {{"accel_" + std::to_string(i + 1) + "x", "m/s²", "+X", not_known}, rate_Hz, 0, x});
    }
  }

  Eigen::VectorXd& operator[](std::size_t i) { return channels[i].samples; }

  // "accel_2x: mains hum ...", one line each; those that do not invalidate in brackets.
  std::string complaints() const {
    Recording record;
    record.speed_rpm = speed_Hz * 60;
    record.channels = channels;
    std::vector<const Channel*> all;
    for (const Channel& c : channels) all.push_back(&c);
    Kinematics kinematics;
    kinematics.period_turns = period_turns;
    kinematics.orders = {{"shaft", 1, "", "motor", ""},
                         {"mesh", 1080.0 / 121, "", "sun_gear", "", true}};
    std::string text;
    for (const auto& notes :
         analysis::record_quality(all, *analysis::ShaftAngle::of(record), kinematics, not_known)) {
      for (const analysis::QualityNote& note : notes) {
        const std::string line = note.where + ": " + note.what;
        text += (note.invalidates ? line : "(" + line + ")") + "\n";
      }
    }
    return text;
  }

  using Kinematics = analysis::Kinematics;
};

// What a ground loop adds: the grid's voltage with its odd harmonics.
Eigen::VectorXd hum(double grid_Hz, double size) {
  return size * (tone(grid_Hz, count, rate_Hz, 0.3) + 0.4 * tone(3 * grid_Hz, count, rate_Hz, 1) +
                 0.2 * tone(5 * grid_Hz, count, rate_Hz, 2));
}

double rms_of(const Eigen::VectorXd& x) { return test::rms(x.array() - x.mean()); }

}  // namespace

TEST_CASE("channels of a bench that runs have nothing to be complained of", "[analysis][quality]") {
  for (const double rpm : {605.0, 1210.0, 1815.0, 3000.0}) {
    CAPTURE(rpm);
    CHECK(Bench(rpm / 60).complaints() == "");
  }
}

TEST_CASE("three zeros in a row are nothing, a hundred are noted", "[analysis][quality]") {
  Bench bench(605.0 / 60);
  bench[1].segment(50000, 3).setZero();
  CHECK(bench.complaints() == "");
  bench[1].segment(50000, 100).setZero();
  CHECK_THAT(
      bench.complaints(),
      Contains("(accel_2x: stood still: 100 samples in a row are the same from 10.081 s on"));
}

TEST_CASE("what is of no known unit is told without one", "[analysis][quality]") {
  Bench bench(605.0 / 60);
  bench.channels[0].info.unit = "";
  bench[0] += 50 * Eigen::VectorXd::LinSpaced(count, 0, 1) * rms_of(bench[0]);
  const std::string said = bench.complaints();
  CHECK_THAT(said, Contains("accel_1x: drift: its mean moves by ") && Contains(" rms: ") &&
                       !Contains("  ") && !Contains(" ,"));
}

TEST_CASE("mains hum of a sixth of the rms is found in the channel that has it",
          "[analysis][quality]") {
  const double grid_Hz = GENERATE(49.85, 50.0, 50.13, 59.9, 60.0);
  const double rpm = GENERATE(605.0, 1815.0);
  CAPTURE(grid_Hz, rpm);
  Bench bench(rpm / 60);
  bench[2] += hum(grid_Hz, 0.2 * rms_of(bench[2]));
  CHECK_THAT(bench.complaints(), Contains("accel_3x: mains hum") && !Contains("accel_1x") &&
                                     !Contains("accel_2x") && !Contains("accel_4x"));
}

TEST_CASE("a twentieth of the rms spoils nothing", "[analysis][quality]") {
  Bench bench(605.0 / 60);
  bench[2] += hum(50, 0.05 * rms_of(bench[2]));
  CHECK(bench.complaints() == "");
}

TEST_CASE("50 Hz that all sensors hear is vibration", "[analysis][quality]") {
  Bench bench(605.0 / 60);
  for (std::size_t i = 0; i < 4; ++i) bench[i] += hum(50, rms_of(bench[i]));
  CHECK(bench.complaints() == "");
}

TEST_CASE("a motor that pulls its stator at twice the grid is heard, not hum",
          "[analysis][quality]") {
  Bench bench(605.0 / 60);
  bench[2] += rms_of(bench[2]) * (tone(100, count, rate_Hz) + 0.3 * tone(200, count, rate_Hz));
  CHECK(bench.complaints() == "");
  // Nor are traces of other lines enough beside it.
  bench[2] += hum(50, 0.1 * rms_of(bench[2]));
  CHECK(bench.complaints() == "");
}

TEST_CASE("a line without the harmonics of a grid is no hum", "[analysis][quality]") {
  Bench bench(605.0 / 60);
  bench[1] += tone(50.03, count, rate_Hz);
  CHECK(bench.complaints() == "");
  bench[1] += tone(150.4, count, rate_Hz);  // three times 50.13
  CHECK(bench.complaints() == "");
}

TEST_CASE("a shaft near the grid's frequency shows itself, not the grid", "[analysis][quality]") {
  // Unbalanced and misaligned, and one sensor sits on its bearing.
  const double speed_Hz = GENERATE(49.9, 50.0, 60.05);
  CAPTURE(speed_Hz);
  Bench bench(speed_Hz);
  bench[0] += hum(speed_Hz, 3);
  CHECK(bench.complaints() == "");
}

TEST_CASE("order 5 at 605 rpm is 0.4 Hz from the grid, and harmonics of the shaft no hum",
          "[analysis][quality]") {
  const double speed_Hz = GENERATE(605.0 / 60, 10.0, 10.02);  // 50.4, 50.0, 50.1 Hz
  CAPTURE(speed_Hz);
  Bench bench(speed_Hz);
  bench[0] += hum(5 * speed_Hz, 3);
  CHECK(bench.complaints() == "");
}

TEST_CASE("what ten seconds cannot part from order 5 is not called hum", "[analysis][quality]") {
  Bench bench(605.0 / 60);
  bench[1] += hum(50, 1);
  for (Channel& c : bench.channels) c.samples = c.samples.head(9 * 4960).eval();
  CHECK(bench.complaints() == "");
}

TEST_CASE("of two channels nobody knows which one is right", "[analysis][quality]") {
  Bench bench(605.0 / 60, 2);
  bench[1] += hum(50, 1);
  bench.channels[0].samples = 1e-4 * test::white_noise(count, 9);
  CHECK(bench.complaints() == "");
}

TEST_CASE("a sensor that hears a machine louder hears all of it louder", "[analysis][quality]") {
  Bench bench(605.0 / 60);
  for (std::size_t i = 0; i < 4; ++i) bench[i] += hum(50, 0.3 * rms_of(bench[i]));
  bench[3] *= 40;
  CHECK(bench.complaints() == "");
}

TEST_CASE("a channel of an open cable is white, and 1/100 of its neighbours",
          "[analysis][quality]") {
  Bench bench(605.0 / 60);
  const double neighbours = rms_of(bench[1]);
  bench[3] = neighbours / 150 * test::white_noise(count, 8);
  CHECK_THAT(bench.complaints(), Contains("accel_4x: IEPE bias: only white noise") &&
                                     !Contains("accel_1x") && !Contains("accel_2x"));
  SECTION("one of 1/50 may be a quiet place") {
    bench[3] *= 3;
    CHECK(bench.complaints() == "");
  }
  SECTION("one that still hears the mesh is only quiet") {
    bench[3] *= 0.4;
    bench[3] += 0.006 * neighbours * tone(1080.0 / 121 * bench.speed_Hz, count, rate_Hz);
    CHECK(bench.complaints() == "");
  }
  SECTION("noise that a structure has shaped was heard") {
    bench[3] = 1e-4 * test::resonant(test::white_noise(count, 8), 0.2, 0.03);
    CHECK(bench.complaints() == "");
  }
  SECTION("of channels whose units nobody stated sizes mean nothing") {
    for (Channel& c : bench.channels) c.info.unit = "";
    CHECK(bench.complaints() == "");
  }
}

TEST_CASE("the bias of an open cable is seen where it was recorded", "[analysis][quality]") {
  Bench bench(605.0 / 60);
  Channel& c = bench.channels[1];
  c.info.sensitivity = 0.0102;  // 100 mV/g
  c.samples.array() += 11 / c.info.sensitivity;
  CHECK(bench.complaints() == "");
  c.samples.array() += 13 / c.info.sensitivity;
  CHECK_THAT(bench.complaints(), Contains("accel_2x: IEPE bias: 24.0 V"));
  CHECK(analysis::open_cable_bias_V(c) == Approx(24).margin(0.1));
  Channel with_gap = c;
  with_gap.samples[7] = not_known;
  CHECK_FALSE(analysis::open_cable_bias_V(with_gap).has_value());
  // Gravity under a sensitivity that someone stated in mV is no bias.
  c.samples.array() -= 24 / c.info.sensitivity - 2;
  c.info.sensitivity = 10.2;
  CHECK(bench.complaints() == "");
}

TEST_CASE("a drifting channel is named", "[analysis][quality]") {
  Bench bench(605.0 / 60);
  const Eigen::VectorXd t = test::times_s(count, rate_Hz);
  bench[0] += 12 * rms_of(bench[0]) / 19 * t;
  CHECK_THAT(bench.complaints(), Contains("accel_1x: drift") && !Contains("accel_2x"));
}

TEST_CASE("a spike in a channel is named with its place", "[analysis][quality]") {
  Bench bench(605.0 / 60);
  bench[1][49600] += 50;
  CHECK_THAT(bench.complaints(),
             Contains("accel_2x: spikes: 1 ") && Contains("10.000 s") && !Contains("accel_1x"));
}

TEST_CASE("jumps as often as parts meet may be strikes that were sampled too slowly",
          "[analysis][quality]") {
  Bench bench(605.0 / 60);
  for (Eigen::Index i = 400; i < count; i += 1500) bench[1][i] += 50;
  CHECK(bench.complaints() == "");
}

TEST_CASE("a spectrum is summed up by its noise", "[analysis][quality]") {
  const Channel white{{"a", "m/s²", "", not_known}, rate_Hz, 0, test::white_noise(count, 1)};
  const analysis::Heard h = analysis::heard(white);
  CHECK(h.rms == Approx(std::sqrt(0.4 / 0.5)).epsilon(0.02));  // from 20 Hz to 0.4 of the rate
  CHECK(h.noise == Approx(h.rms).epsilon(0.03));
  CHECK(h.evenness > 0.7);
  CHECK(analysis::heard({white.info, rate_Hz, 0, test::reddened(white.samples, 0.9)}).evenness <
        0.05);
  const Channel sine{white.info, rate_Hz, 0, 3 * tone(50.03, count, rate_Hz)};
  CHECK(analysis::rms_at(analysis::heard(sine).spectrum, 50.03) ==
        Approx(3 / std::sqrt(2)).epsilon(0.02));
  CHECK(analysis::rms_at(analysis::heard(sine).spectrum, 3000) == 0);
}
