#include "tests/hal/export_fixture.hpp"

// What is written under a name is found under it, and alone.
namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::exported;
using test::read_back;
using test::ScratchFolder;
using test::written_as;

std::vector<std::string> names_in(const Recording& recording) {
  std::vector<std::string> names;
  for (const Channel& channel : recording.channels) names.push_back(channel.info.name);
  return names;
}

}  // namespace

TEST_CASE("channels of one name, or of none, are written under names of their own, and told",
          "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  recording.channels.resize(1);
  recording.channels[0].info.direction = "";
  recording.channels.resize(5, recording.channels[0]);
  const std::vector<std::string> names = {"a\nb", "a?b_2", "a\rb", "", "c"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    recording.channels[i].info.name = names[i];
    recording.channels[i].samples.setConstant(static_cast<double>(i));
  }
  const auto key = GENERATE("hdf5", "tdms", "mat5", "mat73", "flac", "uff58", "uff58b", "csv");
  CAPTURE(key);
  const auto written = written_as(key, scratch / "a", {recording});
  const Recording after = read_back(scratch / "a").at(0);
  const std::vector<std::string> distinct = {"a?b", "a?b_2", "a?b_3", "channel_4", "c"};
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    CAPTURE(distinct[i]);
    const Channel* found = after.find(distinct[i]);
    REQUIRE(found != nullptr);
    CHECK(found->samples.size() == recording.channels[i].samples.size());
    CHECK(found->samples[0] == static_cast<double>(i));
  }
  const std::vector<std::string>& told = written[0].warnings;
  CHECK(std::count(told.begin(), told.end(), "there is another a?b: channel 3 is called a?b_3") ==
        1);
  CHECK(std::count(told.begin(), told.end(), "channel 4 has no name and is called channel_4") == 1);
}

TEST_CASE("no two points of a file are written to one", "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording first = exported(), second = exported();
  first.source = "groups.tdms#001";
  second.source = "groups.tdms#other";
  second.channels[0].samples.setConstant(7);
  const auto written = written_as("mat5", scratch / "p.mat", {first, second});
  REQUIRE(written.size() == 2);
  CHECK(written[0].file == scratch / "p_000.mat");
  CHECK(written[1].file == scratch / "p_001.mat");
  CHECK(read_back(scratch / "p_001.mat")[0].channels.at(0).samples[0] == 7);
}

TEST_CASE("a rate that is whole Hz but for the rounding of an interval is written so, and told",
          "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  for (Channel& channel : recording.channels) channel.rate_Hz = 25599.98399;
  const auto key = GENERATE("wav", "flac");
  const auto written = written_as(key, scratch / "a", {recording});
  CHECK(read_back(scratch / "a")[0].channels.at(0).rate_Hz == 25600);
  CHECK_THAT(written[0].warnings.back(), Contains("a rate of 25599.98399 Hz is written as 25600"));
  for (Channel& channel : recording.channels) channel.rate_Hz = 25599.9;
  CHECK_FALSE(write_recordings({recording}, scratch / "b", test::writer_of(key), false));
}

TEST_CASE("a sample beyond single precision is refused where there is no other",
          "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  recording.channels[1].samples[2] = -1e39;
  const auto refused = write_recordings({recording}, scratch / "a", test::writer_of("wav"), false);
  REQUIRE_FALSE(refused);
  CHECK_THAT(refused.error().where, Contains("input_torque: a sample of 1e+39 is beyond single"));
  written_as("tdms", scratch / "a", {recording});
  CHECK(read_back(scratch / "a")[0].find("input_torque")->samples[2] == -1e39);
}

TEST_CASE("CSV: names with quotes read back as they were written", "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  recording.channels[0].info.name = "a, \"b\"";
  recording.channels[1].info.name = "\"";
  written_as("csv", scratch / "a.csv", {recording});
  const Recording after = read_back(scratch / "a.csv")[0];
  CHECK(names_in(after) == std::vector<std::string>{"time_s", "a, \"b\"", "\""});
}

}  // namespace rvbench::hal
