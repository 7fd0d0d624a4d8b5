#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <vector>

#include "analysis/quality.hpp"
#include "analysis/quality/record_quality.hpp"
#include "bench/kinematics_file.hpp"
#include "hal/formats/read_recordings.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/under_sanitizer.hpp"

// Channels that others recorded: sound machines and broken ones, none with a broken cable.
namespace rvbench {
namespace {

using Catch::Matchers::Contains;

struct Source {
  std::string folder;
  std::string kinematics;
  double speed_rpm;
};

const Source cwru{"cwru", "cwru_6205", 1797};
const Source gear0{"gear0", "gear0", 2000};
const Source oedi{"oedi", "two_stage", 1800};

// cwru states no rate, nor does oedi: there, that at which its shaft turns at its nominal 30 Hz.
double rate_of(const std::filesystem::path& file) {
  if (file.parent_path().filename() == "oedi") return 4285;
  return file.stem() == "normal_0" ? 48000 : 12000;
}

Recording read(const std::filesystem::path& file, const Source& source) {
  auto recordings = hal::read_recordings(file);
  INFO(file);
  REQUIRE(recordings);
  Recording recording = std::move(recordings.value().front());
  for (Channel& channel : recording.channels) {
    if (!(channel.rate_Hz > 0)) channel.rate_Hz = rate_of(file);
  }
  if (std::isnan(recording.speed_rpm)) recording.speed_rpm = source.speed_rpm;
  return recording;
}

// Every recording of a folder; gear0 has a file for each channel of one.
std::vector<Recording> all_of(const std::filesystem::path& data, const Source& source) {
  std::vector<Recording> recordings;
  for (const auto& entry : std::filesystem::directory_iterator(data / source.folder)) {
    Recording one = read(entry.path(), source);
    if (source.folder == "gear0" && !recordings.empty()) {
      for (Channel& c : one.channels) recordings.front().channels.push_back(std::move(c));
    } else {
      recordings.push_back(std::move(one));
    }
  }
  return recordings;
}

// "DE_time: mains hum ...", one line each.
std::string complaints(const Recording& recording, const Source& source) {
  const auto kinematics = bench::read_kinematics(source.kinematics);
  REQUIRE(kinematics.index() == 0);
  const auto channels = analysis::acceleration_channels(recording);
  REQUIRE_FALSE(channels.empty());
  const auto angle = analysis::ShaftAngle::of(recording);
  REQUIRE(angle);
  std::string text;
  for (const auto& notes :
       analysis::record_quality(channels, *angle, std::get<0>(kinematics), not_known)) {
    for (const auto& note : notes) text += note.where + ": " + note.what + "\n";
  }
  return text;
}

double rms_of(const Channel& c) { return test::rms(c.samples.array() - c.samples.mean()); }

// A bearing with a bad ball, as if the file said that it was recorded in g.
Recording bad_ball(const std::filesystem::path& data) {
  Recording recording = read(data / "cwru/B007_0.mat", cwru);
  for (Channel& c : recording.channels) c.info.unit = "g";
  return recording;
}

}  // namespace

TEST_CASE("no channel of a real recording is called bad, of sound machines and of broken ones",
          "[bench][data]") {
  if (test::too_long_under_sanitizer()) return;
  const auto folder = test::data_folder();
  if (!folder) return;
  const Source source = GENERATE(cwru, gear0, oedi);
  const std::vector<Recording> recordings = all_of(*folder, source);
  CHECK(recordings.size() >= (source.folder == "gear0" ? 1u : 8u));
  for (const Recording& recording : recordings) {
    INFO(recording.source);
    CHECK(complaints(recording, source) == "");
  }
}

TEST_CASE("what is put into one channel of a real recording is found there", "[bench][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  Recording recording = bad_ball(*folder);
  CHECK(complaints(recording, cwru) == "");
  Channel& c = recording.channels.at(1);
  const double rms = rms_of(c);
  const Eigen::Index n = c.samples.size();
  std::string what;
  SECTION("hum of a third of its rms") {
    const double size = 0.3 * rms * std::sqrt(2);
    c.samples += size * (test::tone(50.02, n, c.rate_Hz) + 0.4 * test::tone(150.06, n, c.rate_Hz) +
                         0.3 * test::tone(250.1, n, c.rate_Hz));
    what = "mains hum: 50.02 Hz";
  }
  SECTION("a jump of 40 times its rms") {
    c.samples[n / 2] += 40 * rms;
    what = "spikes: 1 ";
  }
  SECTION("a drift of 12 times its rms") {
    c.samples += 12 * rms / double(n) * Eigen::VectorXd::LinSpaced(n, 0, double(n));
    what = "drift";
  }
  SECTION("the front end's noise alone, 1/200 of it") {
    c.samples = rms / 200 * test::white_noise(n, 1);
    what = "IEPE bias";
  }
  SECTION("one side cut off, with a hundredth of its samples") {
    std::vector<double> rising(c.samples.begin(), c.samples.end());
    std::ranges::nth_element(rising, rising.begin() + n / 100);
    c.samples = c.samples.cwiseMax(rising[std::size_t(n / 100)]);
    what = "clipped: 12";  // of 121 thousand samples
  }
  CHECK_THAT(complaints(recording, cwru), Contains(c.info.name + ": " + what) &&
                                              !Contains(recording.channels[0].info.name + ":") &&
                                              !Contains(recording.channels[2].info.name + ":"));
}

}  // namespace rvbench
