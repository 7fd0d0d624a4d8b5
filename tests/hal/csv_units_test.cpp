#include <catch2/catch.hpp>

#include "hal/formats/column_name.hpp"
#include "hal/formats/printable.hpp"
#include "hal/formats/read_recordings.hpp"
#include "tests/hal/foreign_file_builder.hpp"

// What the head of a column says of its unit.
namespace rvbench::hal {
namespace {

using Catch::Contains;

// A table whose first column, of 1 and 3, has this head.
Recording headed(const std::string& head) {
  INFO(head);
  return test::recordings_in("a.csv", head + ",other\n1,2\n3,4\n2,2\n")[0];
}

}  // namespace

TEST_CASE("a column in a known unit comes in SI, with a note", "[hal][formats]") {
  const auto [head, name, unit, factor] =
      GENERATE(table<std::string, std::string, std::string, double>(
          {{"a [g]", "a", "m/s²", 9.80665},
           {"a [mg]", "a", "m/s²", 9.80665e-3},
           {"a (G)", "a", "m/s²", 9.80665},
           {"a (g's)", "a", "m/s²", 9.80665},
           {"a_g", "a_g", "m/s²", 9.80665},
           {"a / g", "a", "m/s²", 9.80665},
           {"\"a, g\"", "a", "m/s²", 9.80665},
           {"a / mm/s²", "a", "m/s²", 1e-3},
           {"a (mm/s²)", "a", "m/s²", 1e-3},
           {"a [in/s²]", "a", "m/s²", 0.0254},
           {"a_mm/s2", "a_mm/s2", "m/s²", 1e-3},
           {"v [mm/s]", "v", "m/s", 1e-3},
           {"v mm/s", "v mm/s", "m/s", 1e-3},
           {"x_um", "x_um", "m", 1e-6},
           {"a [mV]", "a", "V", 1e-3},
           {"input_angle [deg]", "input_angle", "rad", 3.14159265358979 / 180},
           {"n_rpm", "n_rpm", "rad/s", 3.14159265358979 / 30}}));
  const Recording recording = headed(head);
  const Channel& channel = recording.channels[0];
  CAPTURE(head);
  CHECK(channel.info.name == name);
  CHECK(channel.info.unit == unit);
  CHECK(channel.samples[1] == Approx(3 * factor).epsilon(1e-12));
  REQUIRE(recording.notes.size() == 1);
  CHECK_THAT(recording.notes[0],
             Contains(name + ": values of the file times ") && Contains(": into " + unit));
  CHECK(recording.channels[1].info.unit.empty());
  CHECK(recording.channels[1].samples == Eigen::Vector3d(2, 4, 2));
}

TEST_CASE("a column in SI, or in a unit that is not known, comes as it is", "[hal][formats]") {
  const auto [head, name, unit] =
      GENERATE(table<std::string, std::string, std::string>({{"a [m/s²]", "a", "m/s²"},
                                                             {"a (m/s^2)", "a", "m/s²"},
                                                             {"a_m/s²", "a_m/s²", "m/s²"},
                                                             {"T [°C]", "T", "°C"},
                                                             {"T_degC", "T_degC", "°C"},
                                                             {"T (degF)", "T", "°F"},
                                                             {"a [V]", "a", "V"},
                                                             {"d [furlong]", "d", "furlong"},
                                                             {"p [g rms]", "p", "g rms"},
                                                             {"duty [%]", "duty", "%"}}));
  const Recording recording = headed(head);
  CAPTURE(head);
  CHECK(recording.channels[0].info.name == name);
  CHECK(recording.channels[0].info.unit == unit);
  CHECK(recording.channels[0].samples == Eigen::Vector3d(1, 3, 2));
  CHECK(recording.notes.empty());
}

TEST_CASE("what of a head cannot be shown is told", "[hal][formats]") {
  const Recording recording = headed("a\x01 \xB2x");
  CHECK(recording.channels[0].info.name == "a? ?x");
  CHECK(recording.notes == std::vector<std::string>{formats::was_not_printable});
}

TEST_CASE("a name drops the unit that its values are no longer in", "[hal][formats]") {
  using formats::name_in_unit;
  CHECK(name_in_unit("a_mm/s2", "m/s²") == "a");
  CHECK(name_in_unit("v mm/s", "m/s") == "v");
  CHECK(name_in_unit("n_rpm", "rad/s") == "n");
  CHECK(name_in_unit("a [g]", "m/s²") == "a");  // a head that another column has as well
  CHECK(name_in_unit("a_m/s2", "m/s²") == "a_m/s2");
  CHECK(name_in_unit("a_mm/s2", "") == "a_mm/s2");  // of values that nobody has converted
  CHECK(name_in_unit("a_mm/s2", "V") == "a_mm/s2");
  CHECK(name_in_unit("_mm/s2", "m/s²") == "_mm/s2");
  CHECK(name_in_unit("[g]", "m/s²") == "[g]");
  CHECK(name_in_unit("accel_1x", "m/s²") == "accel_1x");
}

TEST_CASE("a head that names no unit has none", "[hal][formats]") {
  const std::string head = GENERATE("a", "g", "accel_in", "a_rad", "a (drive end)", "a [x]", "a[1]",
                                    "a [-Z]", "time [s]", "time_ms", "t [us]", "a []");
  const Recording recording = headed(head);
  CAPTURE(head);
  CHECK(recording.channels[0].info.name == head);
  CHECK(recording.channels[0].info.unit.empty());
  CHECK(recording.channels[0].samples == Eigen::Vector3d(1, 3, 2));
  CHECK(recording.notes.empty());
}

TEST_CASE("names that only their units tell apart stay as they are", "[hal][formats]") {
  const test::ScratchFolder scratch;
  const auto read =
      read_recordings(test::written(scratch, "a.csv", "a [g],a [V],b [g]\n1,2,3\n4,5,6\n"));
  REQUIRE(read);
  const Recording& recording = read.value()[0];
  CHECK(recording.channels[0].info.name == "a [g]");
  CHECK(recording.channels[1].info.name == "a [V]");
  CHECK(recording.channels[2].info.name == "b");
  CHECK(recording.channels[0].samples[0] == Approx(9.80665));
}

TEST_CASE("a duration that does not rise is no clock, and in s", "[hal][formats]") {
  const Recording recording = headed("period [ms]");
  CHECK(recording.channels[0].info.name == "period");
  CHECK(recording.channels[0].info.unit == "s");
  CHECK(recording.channels[0].samples[1] == Approx(0.003));
}

}  // namespace rvbench::hal
