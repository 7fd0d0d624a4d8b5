#include "analysis/tpa/operating_spectra.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <limits>

#include "hal/types/units.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Catch::Matchers::Contains;
using Eigen::Index;

namespace {

constexpr double rate_Hz = 1000;
const LineGrid grid{5, 0.5, 100};

Channel channel(const std::string& point, const std::string& direction, Eigen::VectorXd samples) {
  return {{point, "m/s²", direction}, rate_Hz, 0, std::move(samples)};
}

Recording of(std::vector<Channel> channels) {
  Recording recording;
  recording.source = "drive.h5";
  recording.channels = std::move(channels);
  return recording;
}

std::string all(const std::vector<std::string>& faults) {
  std::string text;
  for (const auto& fault : faults) text += fault + "\n";
  return text;
}

}  // namespace

TEST_CASE("a tone on a line reads its amplitude and its phase at each block's start", "[tpa]") {
  // 20 Hz repeats within the hop of 1 s, so that all blocks see one phase.
  const auto taken = operating_spectra(
      of({channel("J1", "+X", 3 * test::tone(20, 6000, rate_Hz, 0.7))}), {{"J1", "+X"}}, grid);
  REQUIRE(taken.faults.empty());
  const OperatingSpectra& spectra = *taken.spectra;
  REQUIRE(spectra.values.columns == 5);
  const Index line = 30;
  REQUIRE(grid.frequency_Hz(line) == 20);
  for (Index block = 0; block < 5; ++block) {
    CHECK(std::abs(spectra.values[line](0, block) - std::polar(3., 0.7)) < 1e-12);
    CHECK(std::abs(spectra.values[line + 1](0, block)) == Approx(1.5));
    CHECK(std::abs(spectra.values[line + 2](0, block)) < 1e-12);
  }
}

TEST_CASE("the phase of a tone that does not repeat within a hop turns from block to block",
          "[tpa]") {
  const auto taken = operating_spectra(of({channel("J1", "+X", test::tone(20.25, 6000, rate_Hz))}),
                                       {{"J1", "+X"}}, grid);
  const auto line = (*taken.spectra).values[30];
  CHECK(std::arg(line(0, 1) / line(0, 0)) == Approx(units::two_pi * 0.25));
}

TEST_CASE("powers of the lines add up to the mean square, of tones and of noise", "[tpa]") {
  const Index samples = 400000;
  const Eigen::VectorXd x = GENERATE(0, 1) == 0
                                ? Eigen::VectorXd(test::tone(20.2, samples, rate_Hz))
                                : Eigen::VectorXd(test::white_noise(samples, 4));
  const LineGrid whole{0.5, 0.5, 998};
  const auto taken = operating_spectra(of({channel("J1", "+X", x)}), {{"J1", "+X"}}, whole);
  const LineMatrices& values = (*taken.spectra).values;
  const double mean_square =
      values.values.squaredNorm() / double(values.columns) * mean_square_per_power;
  CHECK(mean_square == Approx(x.squaredNorm() / double(samples)).epsilon(0.02));
}

TEST_CASE("a channel along -X is that along +X with the other sign", "[tpa]") {
  const Eigen::VectorXd x = test::white_noise(6000, 1);
  const auto there = operating_spectra(of({channel("J1", "+X", x)}), {{"J1", "+X"}}, grid);
  const auto back = operating_spectra(of({channel("J1", "-X", -x)}), {{"J1", "X"}}, grid);
  CHECK((*back.spectra).places[0].direction == "+X");
  CHECK((*back.spectra).values.values == (*there.spectra).values.values);
}

TEST_CASE("all that is wrong with an operating record is named at once", "[tpa]") {
  const Eigen::VectorXd x = test::white_noise(6000, 1);
  Recording recording = of({channel("J1", "+X", x), channel("J1", "+Y", x.head(2000)),
                            channel("J1", "+Z", x), channel("J2", "+X", x), channel("J2", "+X", x),
                            channel("J3", "+X", x), channel("J3", "+Y", x)});
  recording.channels[2].rate_Hz = 2000;
  recording.channels[5].samples[17] = std::numeric_limits<double>::quiet_NaN();
  recording.channels[6].start_s = 0.25;
  SECTION("places that are not there, or are there twice") {
    const auto taken =
        operating_spectra(recording, {{"J1", "+X"}, {"J2", "+X"}, {"J9", "+X"}}, grid);
    CHECK_FALSE(taken.spectra);
    CHECK_THAT(all(taken.faults), Contains("J2 +X: 2 channels") && Contains("J9 +X: no channel"));
  }
  SECTION("channels that do not go together") {
    const auto taken = operating_spectra(
        recording, {{"J1", "+X"}, {"J1", "+Y"}, {"J1", "+Z"}, {"J3", "+X"}, {"J3", "+Y"}}, grid);
    CHECK_FALSE(taken.spectra);
    CHECK_THAT(all(taken.faults), Contains("J1 +Y: 2000 samples, not 6000") &&
                                      Contains("J1 +Z: 2000 samples a second, not 1000") &&
                                      Contains("J3 +X: a sample that is not finite") &&
                                      Contains("J3 +Y: begins 0.25 s later"));
  }
}

TEST_CASE("a record that has no blocks on the FRFs' lines is refused with the reason", "[tpa]") {
  const auto faults = [](Index samples, const LineGrid& lines) {
    const auto record = of({channel("J1", "+X", test::white_noise(samples, 1))});
    return all(operating_spectra(record, {{"J1", "+X"}}, lines).faults);
  };
  CHECK_THAT(faults(2900, grid), Contains("2.9 s are too short for two blocks of 2 s"));
  CHECK_THAT(faults(6000, {5, 0.5, 1200}), Contains("lines up to 604.5 Hz, of 1000 samples"));
  CHECK_THAT(faults(6000, {5.2, 0.5, 100}), Contains("no lines 0.5 Hz apart from 5.2 Hz on"));
  CHECK(faults(3000, grid).empty());
}

TEST_CASE("a question about blocks that makes no sense is the caller's bug", "[tpa]") {
  const auto record = of({channel("J1", "+X", test::white_noise(6000, 1))});
  CHECK_THROWS_AS(operating_spectra(record, {}, grid), std::invalid_argument);
  CHECK_THROWS_AS(operating_spectra(record, {{"J1", "+X"}}, {5, 0, 100}), std::invalid_argument);
  CHECK_THROWS_AS(operating_spectra(record, {{"J1", "+X"}}, grid, 1), std::invalid_argument);
}
