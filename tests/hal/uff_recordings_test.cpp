#include <catch2/catch.hpp>
#include <cmath>

#include "hal/formats/read_recordings.hpp"
#include "tests/hal/export_fixture.hpp"
#include "tests/hal/foreign_file_builder.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::ScratchFolder;
using test::Uff58;
using test::uff_set;
using test::written;

std::vector<Recording> read(const std::string& bytes) {
  return test::recordings_in("a.uff", bytes);
}

std::string complaint(const std::string& bytes) { return test::complaint_of("bad.uff", bytes); }

Uff58 time_response() {
  Uff58 set;
  set.type = 1;
  set.data_type = 2;
  set.declared = 7;
  set.step = 5e-5;
  set.abscissa = 17;
  set.abscissa_unit = "s";
  set.under = 0;
  set.under_unit = "NONE";
  set.values =
      " -3.81956E+00 -3.56616E+00 -2.98987E+00 -2.62207E+00 -3.22879E+00 -3.63712E+00\n"
      " -5.84096E+00";  // the last line of a table need not be full
  return set;
}

}  // namespace

TEST_CASE("a time response of a universal file is a channel", "[hal][formats]") {
  const std::vector<Recording> recordings = read(time_response().ascii());
  REQUIRE(recordings.size() == 1);
  CHECK(recordings[0].status == "ok");
  REQUIRE(recordings[0].channels.size() == 1);
  const Channel& channel = recordings[0].channels[0];
  CHECK(channel.info.name == "3");
  CHECK(channel.info.direction == "+Z");
  CHECK(channel.info.unit == "m/s²");
  CHECK(channel.rate_Hz == Approx(20000));
  REQUIRE(channel.samples.size() == 7);
  CHECK(channel.samples[0] == -3.81956);
  CHECK(channel.samples[6] == -5.84096);
}

TEST_CASE("FORTRAN's numbers: touching, with D, without a letter", "[hal][formats]") {
  Uff58 set = time_response();
  set.values = "-3.81956E+000-3.56616E+000 1.5D+03 1.5d-3 2.50000-101 nan -1.25E-400";
  const Eigen::VectorXd x = read(set.ascii())[0].channels[0].samples;
  REQUIRE(x.size() == 7);
  CHECK(x[0] == -3.81956);
  CHECK(x[1] == -3.56616);
  CHECK(x[2] == 1500);
  CHECK(x[3] == 1.5e-3);
  CHECK(x[4] == 2.5e-101);
  CHECK(std::isnan(x[5]));
  CHECK(x[6] == 0);
}

TEST_CASE("channels measured at once are one recording, the same sensor later is another",
          "[hal][formats]") {
  Uff58 other = time_response(), longer = time_response(), later = time_response();
  other.response_node = 4;
  other.over_unit = "g";
  later.date = "02-Jan-26 10:00:00";
  const auto together = read(time_response().ascii() + other.ascii());
  REQUIRE(together.size() == 1);
  REQUIRE(together[0].channels.size() == 2);
  CHECK(together[0].channels[1].info.name == "4");
  CHECK(together[0].channels[1].info.unit == "m/s²");
  CHECK(together[0].channels[1].samples[6] == Approx(-5.84096 * 9.80665));

  longer.declared = 8;
  longer.values += " 1.0";
  const auto apart = read(time_response().ascii() + longer.ascii() + later.ascii());
  REQUIRE(apart.size() == 3);
  CHECK_THAT(apart[2].source, Contains("a.uff#3"));

  const auto twice = read(time_response().ascii() + later.ascii());
  CHECK(twice.size() == 2);
  Uff58 up = time_response();
  up.response_direction = 1;
  const auto directions = read(time_response().ascii() + up.ascii() + up.ascii());
  REQUIRE(directions.size() == 1);
  CHECK(directions[0].channels[0].info.name == "3:+Z");
  CHECK(directions[0].channels[1].info.name == "3:+X");
  CHECK(directions[0].channels[2].info.name == "3:+X_2");
}

TEST_CASE("a time response that is cut off is INVALID, and says what is there", "[hal][formats]") {
  Uff58 set = time_response();
  set.declared = 2508876;
  const auto cut = read(set.ascii());
  REQUIRE(cut.size() == 1);
  CHECK_THAT(cut[0].status, Contains("INVALID") && Contains("2508876 values declared, 7 found"));
  CHECK(cut[0].channels[0].samples.size() == 7);

  // Without its end the last number may be a part of one.
  const std::string whole = time_response().ascii();
  const auto torn = read(whole.substr(0, whole.find("096E+00\n    -1")));
  CHECK_THAT(torn[0].status, Contains("7 values declared, 6 found"));
}

TEST_CASE("times of their own are a rate if they rise evenly", "[hal][formats]") {
  Uff58 set = time_response();
  set.is_even = false;
  set.declared = 3;
  set.abscissa_unit = "ms";
  set.values = " 0.0 1.0 0.5 2.0 1.0 3.0";
  const Channel channel = read(set.ascii())[0].channels[0];
  CHECK(channel.rate_Hz == Approx(2000));
  CHECK(channel.samples == Eigen::Vector3d(1, 2, 3));
  set.values = " 0.0 1.0 0.5 2.0 1.5 3.0";
  CHECK_THAT(complaint(set.ascii()), Contains("times rise unevenly: samples are missing"));
}

TEST_CASE("what is no time response is told instead", "[hal][formats]") {
  Uff58 frf;
  frf.values = " 1.0 2.0 3.0 4.0";
  CHECK_THAT(complaint(frf.ascii()), Contains("frequency response (58), no time record"));
  CHECK_THAT(complaint(uff_set(15, "") + uff_set(2412, "") + uff_set(55, "")),
             Contains("holds geometry (15, 2412), results at nodes (55), no time record"));
  Uff58 set = time_response();
  set.data_type = 5;
  CHECK_THAT(complaint(set.ascii()), Contains("58 at line 2: a time response of complex values"));
  set = time_response();
  set.abscissa_unit = "Hz";
  CHECK_THAT(complaint(set.ascii()), Contains("over what is no time"));
}

TEST_CASE("a universal file of one line without end is no worse than refused", "[hal][formats]") {
  std::string bytes = "    -1\n    58\n" + time_response().header() + std::string(1 << 20, '1');
  CHECK_THAT(complaint(bytes), Contains("holds no samples"));  // one number, cut off
  bytes = "    -1\n    58\n" + std::string(1 << 20, 'x');
  CHECK_FALSE(complaint(bytes).empty());
}

TEST_CASE("UFF: what is known of a recording, and that it is none to trust, comes back",
          "[hal][formats][export]") {
  const test::ScratchFolder scratch;
  Recording before = test::exported();
  before.speed_rpm = 604.51234567890123;
  before.planned_speed_rpm = 604.98765432109876;
  before.torque_Nm = -1.2345678901234567;
  before.status = "INVALID: accel_1x: 2.5 s are missing";
  before.notes.clear();
  formats::note_start(test::start_utc_s + 0.9, before);
  const auto key = GENERATE("uff58", "uff58b");
  test::written_as(key, scratch / "a.uff", {before});
  const auto read = test::read_back(scratch / "a.uff");
  REQUIRE(read.size() == 1);
  const Recording& after = read[0];
  CHECK(after.status == before.status);
  CHECK(after.speed_rpm == before.speed_rpm);
  CHECK(after.planned_speed_rpm == before.planned_speed_rpm);
  CHECK(after.load_pct == before.load_pct);
  CHECK(after.torque_Nm == before.torque_Nm);
  CHECK(after.repeat == before.repeat);
  CHECK(formats::noted_start_s(after) == test::start_utc_s + 0.9);
  for (const std::string& note : after.notes) CHECK_THAT(note, !Catch::Contains("_rpm="));
}

TEST_CASE("UFF: fields count bytes, and a direction that has no code is told",
          "[hal][formats][export]") {
  const test::ScratchFolder scratch;
  Recording before = test::exported();
  before.channels[0].info.name = "Lager_ä";
  before.channels[0].info.unit = "µε/s";
  before.channels[1].info.direction = "+RZ";
  CHECK_THAT(test::written_as("uff58", scratch / "a.uff", {before})[0].warnings.back(),
             !Catch::Contains("directions"));
  const Recording after = test::read_back(scratch / "a.uff")[0];
  REQUIRE(after.find("Lager_ä") != nullptr);
  CHECK(after.find("Lager_ä")->info.direction == "-Y");
  CHECK(after.find("Lager_ä")->info.unit == "µε/s");
  CHECK(after.find("input_torque")->info.direction == "+RZ");

  before.channels[0].info.direction = "radial";
  const auto warnings = test::written_as("uff58", scratch / "b.uff", {before})[0].warnings;
  CHECK(std::count(warnings.begin(), warnings.end(),
                   "UFF 58 has no place for directions other than along or about an axis: left "
                   "out") == 1);
}

}  // namespace rvbench::hal
