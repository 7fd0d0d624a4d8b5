#include "hal/formats/shaft_channels.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "hal/types/units.hpp"

namespace rvbench::hal::formats {
namespace {

Channel channel(const char* name, const char* unit, Eigen::VectorXd samples) {
  return {{name, unit, "", not_known}, 1000, 0, std::move(samples)};
}

Eigen::VectorXd turning(double turns) {
  return Eigen::VectorXd::LinSpaced(2000, 0, units::two_pi * turns);
}

}  // namespace

TEST_CASE("a channel of speed gives the speed where none is stated", "[hal][formats]") {
  Recording recording;
  Eigen::VectorXd speed = Eigen::VectorXd::Constant(100, units::rad_s_from_rpm(1797));
  speed[3] = not_known;
  speed[4] = 0;  // an outlier
  recording.channels = {channel("n", "rad/s", speed)};
  use_shaft_channels(recording);
  CHECK(recording.speed_rpm == Approx(1797));
  recording.speed_rpm = 1210;
  use_shaft_channels(recording);
  CHECK(recording.speed_rpm == 1210);
}

TEST_CASE("a shaft that stands, or swings, gives no speed", "[hal][formats][null]") {
  Recording recording;
  recording.channels = {channel("n", "rad/s", Eigen::VectorXd::Zero(50)),
                        channel("swing", "rad/s", (20 + 10 * turning(3).array().sin()).matrix()),
                        channel("a", "m/s²", turning(3))};
  use_shaft_channels(recording);
  CHECK(std::isnan(recording.speed_rpm));
}

TEST_CASE("the one angle that turns on is the input shaft's", "[hal][formats]") {
  Recording recording;
  recording.channels = {channel("encoder", "rad", turning(20)),
                        channel("tilt", "rad", 0.1 * turning(1).array().sin())};
  CHECK(name_input_angle(recording));
  CHECK(recording.channels[0].info.name == channel_names::input_angle);
  CHECK(recording.channels[1].info.name == "tilt");
  CHECK_FALSE(name_input_angle(recording));
}

TEST_CASE("of two angles that turn on none is chosen", "[hal][formats]") {
  Recording recording;
  recording.channels = {channel("fast", "rad", turning(20)), channel("slow", "rad", turning(2))};
  CHECK_FALSE(name_input_angle(recording));
  CHECK(recording.channels[0].info.name == "fast");
  REQUIRE(recording.notes.size() == 1);
  CHECK(recording.notes[0] == "fast and slow both turn on: call one of them input_angle");
}

}  // namespace rvbench::hal::formats
