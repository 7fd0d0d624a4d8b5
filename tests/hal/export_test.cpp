#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "tests/hal/export_fixture.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::exported;
using test::read_back;
using test::ScratchFolder;
using test::writer_of;
using test::written_as;

std::string all_of(const std::vector<std::string>& warnings) {
  std::string text;
  for (const std::string& warning : warnings) text += warning + "\n";
  return text;
}

bool has_draft(const std::filesystem::path& folder) {
  std::error_code none;
  const std::filesystem::directory_iterator files(folder, none);
  return std::any_of(begin(files), end(files),
                     [](const auto& file) { return file.path().extension() == ".part"; });
}

std::string complaint(const std::vector<Recording>& recordings, const std::string& key,
                      const std::filesystem::path& file) {
  const auto written = write_recordings(recordings, file, writer_of(key), false);
  REQUIRE_FALSE(written);
  CHECK_FALSE(has_draft(file.parent_path()));
  return written.error().where;
}

std::size_t files_in(const ScratchFolder& scratch) {
  const std::filesystem::directory_iterator files(scratch.path());
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

}  // namespace

TEST_CASE("what a format has a place for comes back from it", "[hal][formats][export]") {
  const ScratchFolder scratch;
  const Recording before = exported();
  const auto key =
      GENERATE("hdf5", "tdms", "mat5", "mat73", "flac", "uff58", "uff58b", "csv", "wav");
  CAPTURE(key);
  const formats::Holds holds = writer_of(key).holds;
  const auto written = written_as(key, scratch / "a", {before});
  REQUIRE(written.size() == 1);
  CHECK(written[0].channels == 2);
  const auto read = read_back(scratch / "a");
  REQUIRE(read.size() == 1);
  const Recording& after = read[0];
  CHECK(after.status == "ok");
  if (holds.facts) {
    CHECK(after.speed_rpm == before.speed_rpm);
    CHECK(after.planned_speed_rpm == before.planned_speed_rpm);
    CHECK(after.load_pct == before.load_pct);
    CHECK(after.torque_Nm == before.torque_Nm);
    CHECK(after.repeat == before.repeat);
  }
  if (holds.start_time) CHECK(formats::noted_start_s(after) == test::start_utc_s);
  for (const Channel& channel : before.channels) {
    CAPTURE(channel.info.name);
    const Channel* found = after.find(holds.names ? channel.info.name : "channel_1");
    REQUIRE(found != nullptr);
    CHECK(found->rate_Hz == Approx(channel.rate_Hz).epsilon(1e-12));
    CHECK(found->info.unit == (holds.units ? channel.info.unit : ""));
    if (holds.directions) CHECK(found->info.direction == channel.info.direction);
    if (holds.sensitivities && channel.info.name == "accel_1x") {
      CHECK(found->info.sensitivity == channel.info.sensitivity);
    }
    if (holds.channel_start && std::string(key) != "csv") {
      CHECK(found->start_s == channel.start_s);
    }
    if (!holds.names) break;
    REQUIRE(found->samples.size() == channel.samples.size());
    const double most_off = holds.floats ? 0 : 0.5 * channel.samples.maxCoeff() / 8388607 + 1e-15;
    CHECK((found->samples - channel.samples).cwiseAbs().maxCoeff() <= most_off);
  }
  CHECK(files_in(scratch) == 1);  // no draft is left
}

TEST_CASE("what a format has no place for is said, and nothing else", "[hal][formats][export]") {
  const ScratchFolder scratch;
  const auto warnings = [&](const std::string& key, const Recording& recording) {
    return all_of(written_as(key, scratch / (key + std::to_string(files_in(scratch))), {recording})
                      .front()
                      .warnings);
  };
  const Recording full = exported();
  CHECK(warnings("hdf5", full).empty());
  CHECK(warnings("tdms", full).empty());
  CHECK(warnings("mat5", full).empty());
  CHECK(warnings("mat73", full).empty());
  CHECK(warnings("uff58", full) == "UFF 58 has no place for sensitivities of sensors: left out\n");
  Recording told_at_length = full;
  told_at_length.status = std::string(66, 'x');
  CHECK_THAT(warnings("uff58b", told_at_length), Contains("65 bytes of the status: it is cut"));
  CHECK(warnings("tdms", told_at_length).empty());
  CHECK_THAT(warnings("csv", full), Contains("directions") && Contains("sensitivities") &&
                                        Contains("the start time") &&
                                        Contains("speed, load, torque") && !Contains("units"));
  CHECK_THAT(warnings("wav", full), Contains("names of channels") && Contains("units") &&
                                        Contains("the time of the first sample"));
  CHECK_THAT(warnings("flac", full), Contains("no sample is clipped") && !Contains("units"));

  Recording bare;
  bare.status = "ok";
  bare.channels = {{{"a", "", "", not_known}, 1000, 0, test::ramp(4, 0.1)}};
  CHECK(warnings("csv", bare).empty());
  CHECK_THAT(warnings("wav", bare), Contains("rounded to 24 bits"));  // 0.1 is no float
  bare.channels[0].rate_Hz = 4960;
  CHECK_THAT(warnings("uff58b", bare), Contains("7 digits of the sample interval"));
}

TEST_CASE("several points and clocks go into files of their own where they must",
          "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording first = exported(), second = exported();
  second.source = "recording.h5#013";
  second.channels[1].rate_Hz = 1000;
  CHECK(written_as("tdms", scratch / "all.tdms", {first, second}).size() == 1);
  const auto points = read_back(scratch / "all.tdms");
  REQUIRE(points.size() == 2);
  CHECK_THAT(points[1].source, Contains("all.tdms#point_001"));
  CHECK(points[1].find("input_torque")->rate_Hz == 1000);
  CHECK(written_as("hdf5", scratch / "all.h5", {first, second}).size() == 1);
  CHECK(read_back(scratch / "all.h5").size() == 2);

  const auto mat = written_as("mat5", scratch / "p.mat", {first, second});
  REQUIRE(mat.size() == 2);
  CHECK(mat[1].file == scratch / "p_013.mat");
  const auto wav = written_as("wav", scratch / "p.wav", {first, second});
  REQUIRE(wav.size() == 3);
  CHECK(wav[0].file == scratch / "p_012.wav");
  CHECK(wav[1].file == scratch / "p_013_1.wav");
  CHECK(wav[2].file == scratch / "p_013_2.wav");
  CHECK(read_back(scratch / "p_013_2.wav")[0].channels.at(0).rate_Hz == 1000);

  Recording wide = exported();
  wide.channels.resize(1);
  for (int i = 2; i <= 12; ++i) {
    wide.channels.push_back(wide.channels[0]);
    wide.channels.back().info.name = "accel_" + std::to_string(i);
  }
  CHECK(written_as("flac", scratch / "w.flac", {wide}).size() == 2);  // eight at the most
  CHECK(read_back(scratch / "w_2.flac")[0].channels.size() == 4);
}

TEST_CASE("text that would break a line is written as one, and told", "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  recording.channels[0].info.name = "a\n    -1\nb";
  recording.channels[1].info.name = std::string("c\0d\x7F", 4);
  recording.channels[1].info.direction = "+\rY";
  recording.status = "INVALID:\tcut\noff";
  const auto key = GENERATE("hdf5", "tdms", "mat5", "mat73", "flac", "uff58", "uff58b", "csv");
  CAPTURE(key);
  const auto written = written_as(key, scratch / "a", {recording});
  CHECK_THAT(all_of(written[0].warnings),
             Contains("characters of names or other text that cannot be shown stand as ?"));
  const Recording after = read_back(scratch / "a")[0];
  CHECK(after.find("a?    -1?b") != nullptr);
  REQUIRE(after.find("c?d?") != nullptr);
  CHECK(after.find("c?d?")->samples.isApprox(recording.channels[1].samples, 1e-6));  // FLAC rounds
  if (after.status != "ok") CHECK(after.status == "INVALID:?cut?off");
}

TEST_CASE("what cannot be written so is refused with words", "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  recording.channels[1].rate_Hz = 0;
  CHECK_THAT(complaint({recording}, "hdf5", scratch / "a.h5"),
             Contains("recording.h5#012: input_torque: its sample rate is not known") &&
                 Contains("--rate HZ"));
  recording.channels[1].rate_Hz = 610.35;
  CHECK_THAT(complaint({recording}, "wav", scratch / "a.wav"),
             Contains("whole Hz only, and this is 610.35 Hz: write HDF5"));
  recording = exported();
  recording.channels[0].samples[3] = not_known;
  CHECK_THAT(complaint({recording}, "flac", scratch / "a.flac"),
             Contains("accel_1x: 1 of its samples are lost"));
  recording = exported();
  for (Channel& channel : recording.channels) channel.rate_Hz = 2e6;
  CHECK_THAT(complaint({recording}, "flac", scratch / "a.flac"), Contains("that FLAC takes"));
  CHECK(files_in(scratch) == 0);
  CHECK_THROWS_AS(write_recordings({}, scratch / "a.wav", writer_of("wav"), false),
                  std::invalid_argument);
}

TEST_CASE("a lost sample stays one where there is a value for it", "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  recording.channels[0].samples[3] = not_known;
  const auto key = GENERATE("hdf5", "tdms", "mat5", "mat73", "uff58", "uff58b", "csv", "wav");
  CAPTURE(key);
  written_as(key, scratch / "a", {recording});
  const Recording read = read_back(scratch / "a")[0];
  const Channel* after = read.find(std::string(key) == "wav" ? "channel_1" : "accel_1x");
  REQUIRE(after != nullptr);
  CHECK(std::isnan(after->samples[3]));
  CHECK(after->samples[4] == 0);
}

TEST_CASE("a file is replaced by --force alone", "[hal][formats][export]") {
  const ScratchFolder scratch;
  const auto file = scratch / "a.csv";
  std::ofstream(file) << "mine";
  CHECK_THAT(complaint({exported()}, "csv", file), Contains("a.csv: exists; --force replaces it"));
  CHECK(test::bytes_in(file) == "mine");
  REQUIRE(write_recordings({exported()}, file, writer_of("csv"), true));
  CHECK_THAT(test::bytes_in(file), Catch::StartsWith("time_s,accel_1x [m/s²],"));
  std::filesystem::create_directory(scratch / "b.csv");
  CHECK_THAT(complaint({exported()}, "csv", scratch / "b.csv"), Contains("is no regular file"));

  // One name of several is taken: none is written.
  std::ofstream(scratch / "p_013.csv") << "mine";
  Recording second = exported();
  second.source = "recording.h5#013";
  CHECK_THAT(complaint({exported(), second}, "csv", scratch / "p.csv"), Contains("p_013.csv"));
  CHECK_FALSE(std::filesystem::exists(scratch / "p_012.csv"));
}

TEST_CASE("two drafts of one name are two files, and the first to be finished has the name",
          "[hal][formats][export]") {
  const ScratchFolder scratch;
  formats::FileDraft first(scratch / "a.csv", false), second(scratch / "a.csv", false);
  REQUIRE(first.begin());
  REQUIRE(second.begin());
  CHECK(first.path() != second.path());
  REQUIRE(second.write("second"));
  REQUIRE(first.write("first"));
  REQUIRE(first.finish());
  const Status late = second.finish();
  REQUIRE_FALSE(late);
  CHECK_THAT(late.error().where, Contains("a.csv: File exists"));
  CHECK(test::bytes_in(scratch / "a.csv") == "first");
}

TEST_CASE("a draft follows no link that lies in its way", "[hal][formats][export]") {
  const ScratchFolder scratch;
  const auto other = scratch / "other", file = scratch / "a.csv";
  std::ofstream(other) << "mine";
  std::filesystem::create_symlink(other, file.string() + ".part");
  formats::FileDraft before(file, false);
  REQUIRE(before.begin());
  // The names of a process's drafts are counted: "a.csv.4711-1.part".
  const std::string path = before.path().string();
  const std::size_t dash = path.rfind('-');
  const int number = std::stoi(path.substr(dash + 1));
  std::filesystem::create_symlink(other,
                                  path.substr(0, dash + 1) + std::to_string(number + 1) + ".part");
  REQUIRE(write_recordings({exported()}, file, writer_of("csv"), false));
  CHECK(test::bytes_in(other) == "mine");
  CHECK_THAT(test::bytes_in(file), Catch::StartsWith("time_s,"));
}

TEST_CASE("a folder that is not there is told by name", "[hal][formats][export]") {
  const ScratchFolder scratch;
  CHECK_THAT(complaint({exported()}, "tdms", scratch / "none/a.tdms"),
             Contains("none/a.tdms: No such file or directory"));
}

TEST_CASE("a full disk is told, and leaves nothing behind", "[hal][formats][export]") {
  const ScratchFolder scratch;
  const auto key = GENERATE("hdf5", "tdms", "mat73", "wav");
  CAPTURE(key);
  Recording recording = exported();
  for (Channel& channel : recording.channels) channel.samples = test::ramp(100000, 0.25);
  const auto file = scratch / "a";
  const formats::Writer writer = writer_of(key);
  const pid_t child = ::fork();
  if (child == 0) {
    // A limit on the file's size stands for a disk of that size: the same calls fail.
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1 << 16, 1 << 16};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto written = write_recordings({recording}, file, writer, false);
    if (written) ::_exit(1);
    const std::string& why = written.error().where;
    const bool tells =
        why.find(file.string() + ": ") == 0 && why.find("File too large") != why.npos;
    ::_exit(tells ? 0 : 2);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(files_in(scratch) == 0);
}

}  // namespace rvbench::hal
