#include "analysis/spectral_lines.hpp"

#include <catch2/catch.hpp>

#include "analysis/rv_reducer.hpp"
#include "tests/analysis/order_signals.hpp"

using namespace rvbench;
using analysis::Kinematics;
using analysis::ShaftAngle;
using analysis::spectral_lines;
using analysis::SpectralLine;
using Catch::Matchers::Contains;
using test::OrderSignals;
using test::reddened;

namespace {

const OrderSignals turning{.speed_Hz = 30, .rate_Hz = 1920, .count = 30977};  // 4 output turns
constexpr double mesh = 1080.0 / 121;

Kinematics rv20e() { return analysis::rv_reducer("RV-20E", {9, 27, 2, 39, 40}, {}); }

std::vector<SpectralLine> lines_of(const Eigen::VectorXd& x) {
  return spectral_lines(turning.channel(x), turning.angle(), rv20e());
}

}  // namespace

TEST_CASE("a sine in noise has its order, its frequency and its amplitude", "[analysis][lines]") {
  const double amplitude = GENERATE(0.2, 1.0, 20.0);
  const auto seed = GENERATE(1U, 2U, 3U);
  const auto lines = lines_of(amplitude * turning.tone(mesh) + turning.noise(seed));
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].order == Approx(mesh).margin(0.1 / 484));
  CHECK(lines[0].frequency_Hz == Approx(mesh * 30).margin(0.1 / 484 * 30));
  // Noise of 1 moves a Hann line by √(6/n)/√2 = 0.0098, one standard deviation.
  CHECK(lines[0].amplitude == Approx(amplitude).margin(4 * 0.0098));
  CHECK(lines[0].meaning == "sun-planet mesh");
}

TEST_CASE("the p-value of a sine is that of its power over the noise", "[analysis][lines]") {
  // Power a² over a floor of 6·variance/n, which 100 lines give: within the 4 standard deviations
  // that noise moves the line.
  const double a = 0.2;
  analysis::Kinematics no_gears;
  const auto lines = spectral_lines(turning.channel(a * turning.tone(9) + turning.noise(4)),
                                    turning.angle(), no_gears);
  REQUIRE(lines.size() == 1);
  const auto n = static_cast<double>(turning.count);
  const auto log_p = [&](double amplitude) {
    return -100 * std::log1p(amplitude * amplitude * n / 6 / 100);
  };
  CHECK(std::log(lines[0].p_value) < log_p(a - 0.045));
  CHECK(std::log(lines[0].p_value) > log_p(a + 0.045));
}

TEST_CASE("noise alone has no lines", "[analysis][lines][null]") {
  // One spectrum in 1000 may show one: of 100, more than 2 once in 6500 choices of seeds.
  std::size_t white = 0;
  std::size_t red = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    white += lines_of(turning.noise(seed)).size();
    red += lines_of(reddened(turning.noise(seed), 0.99)).size();
  }
  CHECK(white <= 2);
  CHECK(red <= 2);
}

TEST_CASE("sidebands of a mesh are called by the shaft that makes them", "[analysis][lines]") {
  const auto lines = lines_of(turning.modulated(mesh, 39.0 / 121, 0.6) + 0.1 * turning.noise(5));
  REQUIRE(lines.size() == 3);
  CHECK(lines[0].meaning == "sun-planet mesh");
  CHECK(lines[0].amplitude == Approx(1).epsilon(0.01));
  for (const SpectralLine& side : {lines[1], lines[2]}) {
    CHECK(side.amplitude == Approx(0.3).epsilon(0.01));
    CHECK_THAT(side.meaning, Contains("sun-planet mesh") && Contains("crank in housing"));
  }
}

TEST_CASE("a line that no part makes is listed without a meaning", "[analysis][lines]") {
  const double stray = 862.5 / 121;
  const auto lines =
      lines_of(turning.tone(mesh) + 0.3 * turning.tone(stray) + 0.1 * turning.noise(6));
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].meaning == "sun-planet mesh");
  CHECK(lines[1].order == Approx(stray).margin(0.1 / 484));
  CHECK(lines[1].meaning == "");
}

TEST_CASE("mains hum is no gear line", "[analysis][lines]") {
  // At 1785.5 rpm: at 605, 1210 and 1815 rpm 50 Hz is order 600/121, 300/121 and 200/121 exactly.
  const OrderSignals slipping{.speed_Hz = 1785.5 / 60, .rate_Hz = 1920, .count = 33000};
  const double hum_Hz = GENERATE(50.0, 100.0);
  const auto lines =
      spectral_lines(slipping.channel(slipping.tone(mesh) +
                                      0.2 * test::tone(hum_Hz, slipping.count, slipping.rate_Hz) +
                                      0.1 * slipping.noise(7)),
                     slipping.angle(), rv20e());
  REQUIRE(lines.size() == 2);
  CHECK(lines[1].frequency_Hz == Approx(hum_Hz).margin(0.02));
  CHECK(lines[1].meaning == "");
}

TEST_CASE("a motor that slips 1 % keeps its orders: the speed is measured", "[analysis][lines]") {
  const OrderSignals slipping{.speed_Hz = 29.7, .rate_Hz = 1920, .count = 31500};
  const Eigen::VectorXd x = slipping.tone(mesh) + 0.1 * slipping.noise(8);
  Recording record = slipping.recording(x);
  record.planned_speed_rpm = 1800;

  SECTION("by the angle") {
    record.speed_rpm = 1800;
    const auto lines = spectral_lines(record.channels[0], *ShaftAngle::of(record), rv20e());
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].meaning == "sun-planet mesh");
  }
  SECTION("by its mean") {
    record.channels.pop_back();
    record.speed_rpm = 29.7 * 60;
    const auto lines = spectral_lines(record.channels[0], *ShaftAngle::of(record), rv20e());
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].meaning == "sun-planet mesh");
  }
  SECTION("at nominal speed it would be another line") {
    record.channels.pop_back();
    record.speed_rpm = 1800;
    const auto lines = spectral_lines(record.channels[0], *ShaftAngle::of(record), rv20e());
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].meaning != "sun-planet mesh");
  }
}

TEST_CASE("only the strongest lines are listed, and those of a part", "[analysis][lines]") {
  Eigen::VectorXd x = 0.1 * turning.noise(9) + 0.2 * turning.tone(1);
  for (int i = 0; i < 8; ++i) x += (1 + 0.1 * i) * turning.tone(5.0371 + 1.31 * i, i);
  const auto lines = spectral_lines(turning.channel(x), turning.angle(), rv20e(), 5);
  REQUIRE(lines.size() == 6);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    CHECK(lines[i].amplitude < lines[i - 1].amplitude);
  }
  CHECK(lines[5].meaning == "input shaft");
}

TEST_CASE("a record shorter than the gear train's period has no lines", "[analysis][lines]") {
  Channel c = turning.channel(turning.tone(mesh).head(7000));
  CHECK(spectral_lines(c, turning.angle(), rv20e()).empty());
}
