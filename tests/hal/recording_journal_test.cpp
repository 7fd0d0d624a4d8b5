#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <thread>

#include "hal/formats/read_recordings.hpp"
#include "hal/hdf5/journal.hpp"
#include "tests/hal/recording_fixture.hpp"
#include "tests/support/bytes_in.hpp"

namespace rvbench::hal {
namespace {

using test::acceleration_block;
using test::bytes_in;
using test::ScratchFolder;
using test::torque_block;

constexpr int scans = 60;
constexpr int blocks = 4;

void put_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

struct Left {
  std::string file, journal;
};

// What a writer of three points leaves that dies within the second.
Left left_behind() {
  const ScratchFolder scratch;
  const auto made = RecordingWriter::create(scratch / "r.h5", test::layout_of(3, 2));
  REQUIRE(made);
  RecordingWriter& writer = *made.value();
  REQUIRE(writer.note(0.5, "°C"));
  for (int point = 0; point < 2; ++point) {
    for (int block = 0; block < blocks; ++block) {
      REQUIRE(writer.append(point, acceleration_block(1, block * scans, scans, 2)));
      REQUIRE(writer.append(point, torque_block(1.5, block * scans, scans)));
    }
    if (point == 0) REQUIRE(writer.end_point({0, 1, "unsettled", 604.5, 2.5, 0.0001, 0.002}));
  }
  return {bytes_in(scratch / "r.h5"), bytes_in(scratch / "r.h5.journal")};
}

// Samples of whole blocks from the first on, and nothing else. @return how many
Eigen::Index check_samples(RecordingReader& reader, int point) {
  const Result<Recording> read = reader.read(point);
  REQUIRE(read);
  const Eigen::VectorXd& second = read.value().find("accel_2")->samples;
  const Eigen::VectorXd& angle = read.value().find(channel_names::input_angle)->samples;
  REQUIRE(second.size() % scans == 0);
  REQUIRE(angle.size() % scans == 0);
  for (int i = 0; i < second.size(); ++i) REQUIRE(second[i] == test::acceleration_m_s2(i, 1));
  for (int i = 0; i < angle.size(); ++i) REQUIRE(angle[i] == test::angle_rad(i));
  return second.size() + angle.size();
}

constexpr Eigen::Index all_samples = 2 * blocks * scans;

}  // namespace

TEST_CASE("a recording is made anew from its journal, whatever is beside it", "[hal][recording]") {
  const ScratchFolder scratch;
  const Left left = left_behind();
  put_bytes(scratch / "r.h5.journal", left.journal);
  SECTION("torn") { put_bytes(scratch / "r.h5", left.file.substr(0, left.file.size() / 2)); }
  SECTION("zeros") { put_bytes(scratch / "r.h5", std::string(left.file.size(), '\0')); }
  SECTION("nothing") {}
  SECTION("half of an earlier repair as well") {
    put_bytes(scratch / "r.h5", left.file);
    put_bytes(scratch / "r.h5.draft", left.file.substr(0, 5000));
  }
  REQUIRE(repair_recording(scratch / "r.h5"));
  CHECK_FALSE(std::filesystem::exists(scratch / "r.h5.journal"));
  CHECK_FALSE(std::filesystem::exists(scratch / "r.h5.draft"));
  const auto opened = RecordingReader::open(scratch / "r.h5");
  REQUIRE(opened);
  RecordingReader& reader = *opened.value();
  CHECK(reader.layout().points.size() == 3);
  CHECK(reader.layout().acceleration_channels[1].direction == "-Z");
  CHECK(reader.layout().software == "rvbench test");
  REQUIRE(reader.events().size() == 1);
  CHECK(reader.events()[0] == std::pair<double, std::string>(0.5, "°C"));
  REQUIRE(reader.results().size() == 1);
  CHECK(check_samples(reader, 0) == all_samples);
  CHECK(check_samples(reader, 1) == all_samples);
  const Result<Recording> ended = reader.read(0);
  REQUIRE(ended);
  CHECK(ended.value().status == "unsettled");
  CHECK(ended.value().speed_rpm == 604.5);
  CHECK(ended.value().find("accel_1")->start_s == 1);
  CHECK(ended.value().find(channel_names::input_angle)->start_s == 1.5);
  const Result<Recording> begun = reader.read(1);
  REQUIRE(begun);
  CHECK(begun.value().status == "interrupted");
}

TEST_CASE("of a journal that was cut or changed, all is good that came before",
          "[hal][recording]") {
  const ScratchFolder scratch;
  const std::string journal = left_behind().journal;
  const std::size_t result = journal.find("unsettled");  // of the first point
  REQUIRE(result != std::string::npos);
  Eigen::Index before = 0;
  for (std::size_t at = 0; at <= journal.size(); at += 997) {
    CAPTURE(at);
    const bool is_cut = at % 2 == 0 || at < result;  // before a result: see below
    std::string damaged = is_cut ? journal.substr(0, at) : journal;
    if (!is_cut) damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    put_bytes(scratch / "r.h5", "HDF");
    put_bytes(scratch / "r.h5.journal", damaged);
    const Status repaired = repair_recording(scratch / "r.h5");
    if (at < 300) continue;  // the layout: nothing was ever recorded
    REQUIRE(repaired);
    const auto opened = RecordingReader::open(scratch / "r.h5");
    REQUIRE(opened);
    const Eigen::Index samples =
        check_samples(*opened.value(), 0) + check_samples(*opened.value(), 1);
    CHECK(samples >= before);
    before = samples;
  }
  CHECK(before > all_samples);
}

TEST_CASE("a journal that was damaged before a point's result is left alone", "[hal][recording]") {
  const ScratchFolder scratch;
  const Left left = left_behind();
  const std::size_t result = left.journal.find("unsettled");
  REQUIRE(result != std::string::npos);
  for (std::size_t at = 0; at < result; at += 997) {
    CAPTURE(at);
    std::string damaged = left.journal;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    put_bytes(scratch / "r.h5", left.file);
    put_bytes(scratch / "r.h5.journal", damaged);
    const Status repaired = repair_recording(scratch / "r.h5");
    REQUIRE_FALSE(repaired);
    CHECK(repaired.error().where.find("journal: damaged at byte ") != std::string::npos);
    CHECK(bytes_in(scratch / "r.h5") == left.file);
    CHECK(bytes_in(scratch / "r.h5.journal") == damaged);
    CHECK_FALSE(std::filesystem::exists(scratch / "r.h5.draft"));
  }
}

TEST_CASE("a recording that was left without its journal is repaired as it is",
          "[hal][recording]") {
  const ScratchFolder scratch;
  put_bytes(scratch / "r.h5", left_behind().file);
  REQUIRE(repair_recording(scratch / "r.h5"));
  const auto opened = RecordingReader::open(scratch / "r.h5");
  REQUIRE(opened);
  CHECK(check_samples(*opened.value(), 0) == all_samples);
}

TEST_CASE("who reads a recording after a crash reads what its journal has", "[hal][formats]") {
  const ScratchFolder scratch;
  const Left left = left_behind();
  put_bytes(scratch / "r.h5", left.file.substr(0, left.file.size() / 2));
  put_bytes(scratch / "r.h5.journal", left.journal);
  const auto read = read_recordings(scratch / "r.h5");
  REQUIRE(read);
  REQUIRE(read.value().size() == 2);  // the third was never begun
  CHECK(read.value()[0].find("accel_1")->samples.size() == blocks * scans);
  CHECK_THAT(read.value()[0].notes.back(), Catch::Contains("made anew"));
}

TEST_CASE("any number may look at once whether a journal was left behind", "[hal][recording]") {
  const ScratchFolder scratch;
  const std::filesystem::path journal = scratch / "r.h5.journal";
  put_bytes(journal, left_behind().journal);
  const int looking = ::open(journal.c_str(), O_RDONLY | O_CLOEXEC);
  REQUIRE(::flock(looking, LOCK_SH | LOCK_NB) == 0);  // as another program just does
  CHECK(hdf5::is_left_behind(journal));
  SECTION("and who repairs waits for them a moment") {
    std::jthread leaving([looking] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      ::close(looking);
    });
    CHECK(repair_recording(scratch / "r.h5"));
  }
  SECTION("but not for ever") {
    const Status repaired = repair_recording(scratch / "r.h5");
    REQUIRE_FALSE(repaired);
    CHECK_THAT(repaired.error().where, Catch::Contains("in use by another program"));
    ::close(looking);
  }
}

TEST_CASE("a journal is there until its recording is closed", "[hal][recording]") {
  const ScratchFolder scratch;
  put_bytes(scratch / "r.h5.journal", "of a recording that was never begun");
  const auto made = RecordingWriter::create(scratch / "r.h5", test::layout_of(1, 2));
  REQUIRE(made);
  CHECK(std::filesystem::file_size(scratch / "r.h5.journal") > 100);
  REQUIRE(made.value()->close());
  CHECK_FALSE(std::filesystem::exists(scratch / "r.h5.journal"));
  CHECK(repair_recording(scratch / "r.h5"));
}

}  // namespace rvbench::hal
