#include "hal/recording_file.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "tests/hal/recording_fixture.hpp"

namespace rvbench::hal {
namespace {

using test::acceleration_block;
using test::layout_of;
using test::ScratchFolder;
using test::torque_block;

// Three points planned, the second of them recorded: two channels, torque and angle.
void write_second_point(const std::filesystem::path& file) {
  RecordingLayout layout = layout_of(3, 2);
  layout.points[1] = {1210, 75, 2};
  const auto made = RecordingWriter::create(file, layout);
  REQUIRE(made);
  RecordingWriter& writer = *made.value();
  REQUIRE(writer.append(1, acceleration_block(12.5, 0, 100, 2)));
  REQUIRE(writer.append(1, torque_block(12.503, 0, 30)));
  REQUIRE(writer.append(1, acceleration_block(12.6, 100, 9000, 2)));
  REQUIRE(writer.append(1, torque_block(12.533, 30, 10)));
  REQUIRE(writer.note(12.7, "drive: one retry"));
  REQUIRE(writer.end_point({1, 12.5, "unsettled", 1208.5, 4.25, 0.0001, 0.002}));
  REQUIRE(writer.close());
}

}  // namespace

TEST_CASE("what is known of a recording is read back", "[hal][recording]") {
  const ScratchFolder scratch;
  write_second_point(scratch / "r.h5");
  const auto opened = RecordingReader::open(scratch / "r.h5");
  REQUIRE(opened);
  RecordingReader& reader = *opened.value();
  CHECK(reader.layout().software == "rvbench test");
  CHECK(reader.layout().points.size() == 3);
  CHECK(reader.layout().acceleration_rate_Hz == 4960);
  CHECK(reader.layout().acceleration_range_m_s2 == 500);
  CHECK(reader.layout().torque_rate_Hz == 1000);
  CHECK(reader.layout().acceleration_channels[1].name == "accel_2");
  CHECK(reader.layout().acceleration_channels[1].unit == "m/s²");
  CHECK(reader.layout().acceleration_channels[1].direction == "-Z");
  CHECK(reader.layout().acceleration_channels[1].sensitivity == 0.01);
  REQUIRE(reader.events().size() == 1);
  CHECK(reader.events()[0] == std::pair<double, std::string>(12.7, "drive: one retry"));
  REQUIRE(reader.results().size() == 1);
  CHECK(reader.results()[0].point == 1);
}

TEST_CASE("what was written is read back, point by point", "[hal][recording]") {
  const ScratchFolder scratch;
  write_second_point(scratch / "r.h5");
  const auto opened = RecordingReader::open(scratch / "r.h5");
  REQUIRE(opened);
  const Result<Recording> read = opened.value()->read(1);
  REQUIRE(read);
  const Recording& recording = read.value();
  CHECK(recording.source == (scratch / "r.h5").string() + "#001");
  CHECK(recording.planned_speed_rpm == 1210);
  CHECK(recording.load_pct == 75);
  CHECK(recording.repeat == 2);
  CHECK(recording.status == "unsettled");
  CHECK(recording.speed_rpm == 1208.5);
  CHECK(recording.torque_Nm == 4.25);
  for (const Channel& channel : recording.channels) {
    CHECK(channel.time_uncertainty_s == (is_of_shaft(channel.info) ? 0.002 : 0.0001));
  }

  const Channel* second = recording.find("accel_2");
  REQUIRE(second != nullptr);
  CHECK(second->rate_Hz == 4960);
  CHECK(second->start_s == 12.5);
  REQUIRE(second->samples.size() == 9100);
  for (int i : {0, 99, 100, 4095, 4096, 9099}) {
    CAPTURE(i);
    CHECK(second->samples[i] == test::acceleration_m_s2(i, 1));
  }
  const Channel* angle = recording.find(channel_names::input_angle);
  REQUIRE(angle != nullptr);
  CHECK(angle->start_s == 12.503);
  REQUIRE(angle->samples.size() == 40);
  CHECK(angle->samples[39] == test::angle_rad(39));
  CHECK(recording.find(channel_names::input_torque)->samples[30] ==
        static_cast<double>(static_cast<float>(test::torque_Nm(30))));
}

TEST_CASE("a lost sample is read back as lost", "[hal][recording]") {
  const ScratchFolder scratch;
  const auto made = RecordingWriter::create(scratch / "r.h5", layout_of(1, 2));
  REQUIRE(made);
  RecordingWriter& writer = *made.value();
  AccelerationBlock block = acceleration_block(0, 0, 10, 2);
  block.scans.row(3).setConstant(std::nanf(""));
  TorqueBlock torque = torque_block(0, 0, 10);
  torque.samples[7] = TorqueSample{};
  REQUIRE(writer.append(0, block));
  REQUIRE(writer.append(0, torque));
  REQUIRE(writer.close());

  const auto opened = RecordingReader::open(scratch / "r.h5");
  REQUIRE(opened);
  const Result<Recording> read = opened.value()->read(0);
  REQUIRE(read);
  CHECK(read.value().find("accel_1")->samples.array().isNaN().count() == 1);
  CHECK(std::isnan(read.value().find("accel_1")->samples[3]));
  CHECK(std::isnan(read.value().find(channel_names::input_angle)->samples[7]));
  CHECK(std::isnan(read.value().find(channel_names::input_torque)->samples[7]));
  CHECK(read.value().status == "interrupted");
}

TEST_CASE("the angle keeps its resolution over a long test", "[hal][recording]") {
  const ScratchFolder scratch;
  auto made = RecordingWriter::create(scratch / "r.h5", layout_of(1, 1));
  REQUIRE(made);
  const double after_two_hours_rad = 1815.0 / 60 * 2 * 3.141592653589793 * 7200 + 1e-4;
  TorqueBlock block;
  block.samples = {{1.0, after_two_hours_rad}};
  REQUIRE(made.value()->append(0, block));
  REQUIRE(made.value()->close());
  const auto opened = RecordingReader::open(scratch / "r.h5");
  REQUIRE(opened);
  const Result<Recording> read = opened.value()->read(0);
  REQUIRE(read);
  CHECK(read.value().find(channel_names::input_angle)->samples[0] == after_two_hours_rad);
}

TEST_CASE("a recording is never overwritten", "[hal][recording]") {
  const ScratchFolder scratch;
  REQUIRE(RecordingWriter::create(scratch / "r.h5", layout_of(1, 1)));
  const auto again = RecordingWriter::create(scratch / "r.h5", layout_of(1, 1));
  REQUIRE_FALSE(again);
  CHECK_THAT(again.error().where, Catch::Contains("r.h5: create: "));
  CHECK(RecordingReader::open(scratch / "r.h5"));
}

TEST_CASE("the writer refuses what its caller got wrong", "[hal][recording]") {
  const ScratchFolder scratch;
  RecordingLayout no_rate = layout_of(1, 1);
  no_rate.acceleration_rate_Hz = 0;
  CHECK_THROWS_AS(RecordingWriter::create(scratch / "x.h5", no_rate), std::invalid_argument);
  CHECK_THROWS_AS(RecordingWriter::create(scratch / "x.h5", RecordingLayout{}),
                  std::invalid_argument);

  const auto made = RecordingWriter::create(scratch / "r.h5", layout_of(2, 2));
  REQUIRE(made);
  RecordingWriter& writer = *made.value();
  CHECK_THROWS_AS(writer.append(2, acceleration_block(0, 0, 1, 2)), std::invalid_argument);
  CHECK_THROWS_AS(writer.append(-1, acceleration_block(0, 0, 1, 2)), std::invalid_argument);
  CHECK_THROWS_AS(writer.append(0, acceleration_block(0, 0, 1, 3)), std::invalid_argument);
  CHECK_THROWS_AS(writer.end_point({0, 0, std::string(32, 'x'), 0, 0}), std::invalid_argument);
  REQUIRE(writer.append(0, acceleration_block(0, 0, 1, 2)));
  CHECK_THROWS_AS(writer.append(1, acceleration_block(0, 0, 1, 2)), std::invalid_argument);
  REQUIRE(writer.end_point({0, 0, "ok", 605, 1}));
  CHECK_THROWS_AS(writer.append(0, acceleration_block(0, 0, 1, 2)), std::invalid_argument);
  CHECK(writer.append(1, acceleration_block(0, 0, 1, 2)));
}

TEST_CASE("after close() nothing more is taken", "[hal][recording]") {
  const ScratchFolder scratch;
  const auto made = RecordingWriter::create(scratch / "r.h5", layout_of(1, 1));
  REQUIRE(made);
  REQUIRE(made.value()->close());
  CHECK(made.value()->close());
  const Status late = made.value()->append(0, acceleration_block(0, 0, 1, 1));
  REQUIRE_FALSE(late);
  CHECK_THAT(late.error().where, Catch::Contains("is closed"));
}

TEST_CASE("an event too long for its row is cut between two characters", "[hal][recording]") {
  const ScratchFolder scratch;
  const auto made = RecordingWriter::create(scratch / "r.h5", layout_of(1, 1));
  REQUIRE(made);
  std::string text(254, 'x');
  text += "°C";  // its first character lies across the border at 255 bytes
  REQUIRE(made.value()->note(1, text));
  REQUIRE(made.value()->close());
  const auto opened = RecordingReader::open(scratch / "r.h5");
  REQUIRE(opened);
  CHECK(opened.value()->events().at(0).second == std::string(254, 'x'));
}

}  // namespace rvbench::hal
