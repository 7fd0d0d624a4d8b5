#include <catch2/catch.hpp>

#include "hal/formats/even_grid.hpp"
#include "hal/formats/read_recordings.hpp"
#include "hal/formats/si_unit.hpp"
#include "tests/hal/foreign_file_builder.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;

Recording read_csv(const std::string& bytes) { return test::recordings_in("a.csv", bytes)[0]; }

// 200 lines of `first` + i · `step`, and something that is no time.
std::string table(double first, double step, double lost_at = -1) {
  std::string text;
  for (int i = 0; i < 200; ++i) {
    const double t = first + (i + (lost_at >= 0 && i >= lost_at ? 1 : 0)) * step;
    text += fmt::format("{:.6e},{}\n", t, i % 7);
  }
  return text;
}

}  // namespace

TEST_CASE("a column named as time gives the rate, and stays", "[hal][formats]") {
  const Recording named = read_csv("Time (s),x\n" + table(3, 0.002));
  CHECK(named.channels[0].rate_Hz == Approx(500).epsilon(1e-5));
  CHECK(named.channels[1].rate_Hz == Approx(500).epsilon(1e-5));
  CHECK(read_csv("x,t_ms\n0,0\n1,0.5\n2,1.0\n").channels[0].rate_Hz == Approx(2000));
}

TEST_CASE("a nameless first column is time if it rises evenly from 0", "[hal][formats]") {
  const Recording bare = read_csv(table(0, 0.001));
  CHECK(bare.channels[1].rate_Hz == Approx(1000));
  CHECK_THAT(bare.notes.at(0), Contains("rate 1000 Hz from column_1, taken as time in s"));
  CHECK(read_csv(table(0, 1)).channels[1].rate_Hz == 0);      // a count of lines
  CHECK(read_csv(table(3, 0.001)).channels[1].rate_Hz == 0);  // anything
}

TEST_CASE("a time whose unit is not stated is s only where ms would be absurd", "[hal][formats]") {
  CHECK(read_csv("time,x\n" + table(0, 0.002)).channels[1].rate_Hz == Approx(500));
  CHECK(read_csv(table(0, 0.01)).channels[1].rate_Hz == 0);
  for (const double step : {0.01, 0.1, 1.0}) {
    const Recording asked = read_csv("time,x\n" + table(0, step));
    CHECK(asked.channels[1].rate_Hz == 0);
    CHECK_THAT(asked.notes.at(0), Contains("time states no unit: its steps of"));
  }
}

TEST_CASE("times that rise unevenly say no rate", "[hal][formats]") {
  for (const double lost_at : {1.0, 100.0, 199.0}) {
    CHECK(read_csv("time,x\n" + table(0, 0.01, lost_at)).channels[1].rate_Hz == 0);
  }
  CHECK(read_csv("angle,x\n" + table(0, 0.01)).channels[1].rate_Hz == 0);
}

TEST_CASE("even steps: the rounding of a print is, a lost sample is not", "[hal][formats]") {
  using formats::even_step;
  CHECK(even_step(Eigen::VectorXd::LinSpaced(11, 0, 1)).value_or(0) == Approx(0.1));
  Eigen::VectorXd printed = Eigen::VectorXd::LinSpaced(1000, 0, 999);
  printed = (printed / 1024 * 1e5).array().round() / 1e5;
  CHECK(even_step(printed).value_or(0) == Approx(1.0 / 1024).epsilon(1e-4));
  CHECK_FALSE(even_step(Eigen::Vector3d(0, 1, 1)));
  CHECK_FALSE(even_step(Eigen::Vector3d(1, 1, 1)));
  CHECK_FALSE(even_step(Eigen::Vector3d(2, 1, 0)));
  CHECK_FALSE(even_step(Eigen::VectorXd::Zero(1)));
}

TEST_CASE("units by other spellings, what is not known is not guessed", "[hal][formats]") {
  using formats::si_unit;
  using formats::unit_ratio;
  for (const char* spelling : {"m/s^2", "m/s2", "m/s\xB2", "m/s\xC2\xB2", "(m/s^2)", " m/sec^2 "}) {
    CAPTURE(spelling);
    REQUIRE(si_unit(spelling));
    CHECK(si_unit(spelling)->symbol == "m/s²");
    CHECK(si_unit(spelling)->factor == 1);
  }
  CHECK(si_unit("g")->factor == 9.80665);
  CHECK(si_unit("lbf")->factor == Approx(4.4482216152605));
  CHECK(si_unit("N*m")->symbol == "N·m");
  CHECK_FALSE(si_unit("furlong"));
  CHECK_FALSE(si_unit("NONE"));
  CHECK_FALSE(si_unit(""));
  CHECK(unit_ratio("m/s^2/N")->response.symbol == "m/s²");
  CHECK(unit_ratio("(m/s^2)/N")->excitation.symbol == "N");
  CHECK(unit_ratio("(1/N)*(m/s\xB2)")->response.symbol == "m/s²");
  CHECK_FALSE(unit_ratio("g"));
  CHECK_FALSE(unit_ratio("(1/N)"));
  CHECK_FALSE(unit_ratio("g/furlong"));
}

}  // namespace rvbench::hal
