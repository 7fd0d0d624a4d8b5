#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "hal/formats/read_recordings.hpp"
#include "tests/hal/foreign_file_builder.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::packed;
using test::riff_chunk;
using test::ScratchFolder;
using test::written;

Result<std::vector<Recording>> read_bytes(const std::string& bytes) {
  const ScratchFolder scratch;
  return read_recordings(written(scratch, "a.wav", bytes));
}

Recording read(const std::string& bytes) {
  const auto recordings = read_bytes(bytes);
  if (!recordings) FAIL(recordings.error().where);
  REQUIRE(recordings.value().size() == 1);
  return recordings.value()[0];
}

std::string format(std::uint16_t encoding, std::uint16_t channels, std::uint16_t bits,
                   std::uint32_t rate_Hz = 48000) {
  const auto frame = static_cast<std::uint16_t>(channels * bits / 8);
  return packed(encoding) + packed(channels) + packed(rate_Hz) + packed(rate_Hz * frame) +
         packed(frame) + packed(bits);
}

std::string wav(const std::string& format, const std::string& data, std::int64_t declared = -1) {
  const std::string chunks = riff_chunk("fmt ", format) + riff_chunk("data", data, declared);
  return "RIFF" + packed(static_cast<std::uint32_t>(chunks.size() + 4)) + "WAVE" + chunks;
}

const std::string two_samples = packed(std::int16_t{16384}) + packed(std::int16_t{-32768});

}  // namespace

TEST_CASE("WAV: full scale is 1, channels take turns", "[hal][formats]") {
  const Recording recording = read(wav(format(1, 2, 16), two_samples + two_samples));
  REQUIRE(recording.channels.size() == 2);
  CHECK(recording.status == "ok");
  CHECK(recording.channels[0].info.name == "channel_1");
  CHECK(recording.channels[0].info.unit.empty());
  CHECK(recording.channels[0].rate_Hz == 48000);
  CHECK(recording.channels[0].samples == Eigen::Vector2d(0.5, 0.5));
  CHECK(recording.channels[1].samples == Eigen::Vector2d(-1, -1));
  CHECK_THAT(recording.notes.at(0), Contains("full scale is 1"));
}

TEST_CASE("WAV: PCM of 8, 24, 32 bits and floating point", "[hal][formats]") {
  const auto first = [](const std::string& bytes) { return read(bytes).channels[0].samples[0]; };
  CHECK(first(wav(format(1, 1, 8), std::string("\xC0\0", 2))) == 0.5);  // unsigned, 128 is none
  CHECK(first(wav(format(1, 1, 24), std::string("\0\0\xC0", 3))) == -0.5);
  CHECK(first(wav(format(1, 1, 32), packed(std::int32_t{1 << 29}))) == 0.25);
  CHECK(first(wav(format(3, 1, 32), packed(1.75F))) == 1.75);
  CHECK(first(wav(format(3, 1, 64), packed(-1e-9))) == -1e-9);
}

TEST_CASE("WAV: the extensible form names its encoding further behind", "[hal][formats]") {
  const std::string guid =
      packed(std::uint16_t{1}) + std::string("\0\0\0\0\x10\0\x80\0\0\xAA\0\x38\x9B\x71", 14);
  const std::string extended = format(0xFFFE, 1, 16) + packed(std::uint16_t{22}) +
                               packed(std::uint16_t{16}) + packed(std::uint32_t{4}) + guid;
  CHECK(read(wav(extended, two_samples)).channels[0].samples == Eigen::Vector2d(0.5, -1));
}

TEST_CASE("WAV: other chunks are passed over, one of odd length with its padding",
          "[hal][formats]") {
  const std::string chunks = riff_chunk("LIST", "odd") + std::string(1, '\0') +
                             riff_chunk("fmt ", format(1, 1, 16)) +
                             riff_chunk("data", two_samples) + riff_chunk("junk", "more");
  CHECK(read("RIFF" + packed(1000U) + "WAVE" + chunks).channels[0].samples.size() == 2);
}

TEST_CASE("WAV: a second chunk of samples follows the first", "[hal][formats]") {
  const std::string chunks = riff_chunk("fmt ", format(1, 1, 16)) +
                             riff_chunk("data", two_samples) + riff_chunk("junk", "xy") +
                             riff_chunk("data", packed(std::int16_t{8192}));
  const Recording recording =
      read("RIFF" + packed(static_cast<std::uint32_t>(chunks.size() + 4)) + "WAVE" + chunks);
  CHECK(recording.status == "ok");
  CHECK(recording.channels.at(0).samples == Eigen::Vector3d(0.5, -1, 0.25));
  CHECK_THAT(recording.notes.back(), Contains("2 chunks of samples"));
}

TEST_CASE("WAV: a length that lies is told, and nothing is made up", "[hal][formats]") {
  const Recording cut = read(wav(format(1, 1, 16), two_samples, 2000000000));
  CHECK(cut.status == "INVALID: 1000000000 samples per channel declared, 2 found");
  CHECK(cut.channels[0].samples.size() == 2);
  const Recording streamed = read(wav(format(1, 1, 16), two_samples, 0xFFFFFFFF));
  CHECK(streamed.status == "ok");
  CHECK_THAT(streamed.notes.at(1), Contains("length is not stated"));
  CHECK_THAT(read(wav(format(1, 1, 16), two_samples, 0)).status, Contains("0 samples per channel"));
  const std::string large = riff_chunk(
      "ds64", packed(std::uint64_t{0}) + packed(std::uint64_t{4}) + packed(std::uint64_t{2}));
  CHECK(read("RF64" + packed(0xFFFFFFFFU) + "WAVE" + large + riff_chunk("fmt ", format(1, 1, 16)) +
             riff_chunk("data", two_samples + "more", 0xFFFFFFFF))
            .channels[0]
            .samples.size() == 2);
}

TEST_CASE("WAV: what cannot be read is refused with words", "[hal][formats]") {
  const auto complaint = [](const std::string& bytes) {
    const auto recordings = read_bytes(bytes);
    REQUIRE_FALSE(recordings);
    return recordings.error().where;
  };
  CHECK_THAT(complaint(wav(format(2, 1, 4), "data")), Contains("encoding 2 of 4 bits"));
  CHECK_THAT(complaint(wav(format(1, 0, 16), "data")), Contains("0 channels"));
  CHECK_THAT(complaint(wav(format(1, 1, 16, 0), "data")), Contains("sample rate of 0"));
  CHECK_THAT(complaint("RIFF" + packed(4U) + "WAVE" + riff_chunk("data", "data")),
             Contains("no chunk \"fmt \""));
  CHECK_THAT(complaint("RIFF" + packed(4U) + "WAVE" + riff_chunk("fmt ", format(1, 1, 16))),
             Contains("no chunk \"data\""));
}

TEST_CASE("WAV: cut off at any byte it is no worse than refused", "[hal][formats]") {
  const std::string bytes = wav(format(1, 1, 16), two_samples);
  int invalid = 0;
  for (std::size_t length = 1; length < bytes.size(); ++length) {
    const auto recordings = read_bytes(bytes.substr(0, length));
    if (recordings && recordings.value()[0].status != "ok") ++invalid;
  }
  CHECK(invalid == 2);  // one of two samples is there
}

TEST_CASE("an infinity is a lost sample, and counted", "[hal][formats]") {
  const float infinity = std::numeric_limits<float>::infinity();
  const Recording recording = read(
      wav(format(3, 1, 32), packed(1.5F) + packed(infinity) + packed(-infinity) + packed(-2.0F)));
  const Eigen::VectorXd& samples = recording.channels[0].samples;
  REQUIRE(samples.size() == 4);
  CHECK(samples[0] == 1.5);
  CHECK(std::isnan(samples[1]));
  CHECK(std::isnan(samples[2]));
  CHECK(samples[3] == -2);
  CHECK(recording.status == "ok");
  CHECK(recording.notes.back() == "2 samples are infinite, as nothing measured is: taken as lost");
}

TEST_CASE("a file of more samples than there is memory for is refused by name", "[hal][formats]") {
  if (test::under_sanitizer) return;  // they end a program that asks for too much
  const ScratchFolder scratch;
  const auto file = written(scratch, "huge.wav", wav(format(1, 1, 8), "", 0));
  std::filesystem::resize_file(file, std::uintmax_t{1} << 29U);  // takes no room on the disk
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{1U << 29U, 1U << 29U};
    ::setrlimit(RLIMIT_AS, &limit);
    const auto read = read_recordings(file);
    const bool is_refused =
        !read && read.error().code == IoErrc::bad_data &&
        read.error().where == file.string() + ": holds more samples than there is memory for";
    ::_exit(is_refused ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

}  // namespace rvbench::hal
