#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "tests/hal/export_fixture.hpp"
#include "tests/support/replaced.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::exported;
using test::replaced;
using test::ScratchFolder;
using test::written_as;

Result<std::vector<Recording>> read_bytes(const std::filesystem::path& file,
                                          const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
  return read_recordings(file);
}

std::string flac_of(const ScratchFolder& scratch, Eigen::Index samples) {
  Recording recording = exported();
  for (Channel& channel : recording.channels) {
    channel.samples = Eigen::VectorXd::LinSpaced(samples, 0, 100).array().sin();
  }
  written_as("flac", scratch / "whole.flac", {recording});
  return test::bytes_in(scratch / "whole.flac");
}

// The remainder of a division in binary, as RFC 9639 has it.
std::string crc_of(const std::string& bytes, unsigned width, unsigned polynomial) {
  unsigned crc = 0;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned>(static_cast<unsigned char>(byte)) << (width - 8);
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc >> (width - 1) & 1U) != 0 ? crc << 1U ^ polynomial : crc << 1U;
    }
    crc &= (1U << width) - 1;
  }
  std::string code;
  for (unsigned shift = width; shift > 0; shift -= 8) {
    code += static_cast<char>(crc >> (shift - 8) & 0xFFU);
  }
  return code;
}

// Blocks of 65 535 samples of 16 bits, at 48 kHz; how many in all is not stated.
std::string silent_head() {
  return "fLaC" + std::string("\x80\0\0\x22\xFF\xFF\xFF\xFF", 8) + std::string(6, '\0') +
         std::string("\x0B\xB8\x00\xF0", 4) + std::string(20, '\0');
}

// 65 535 zeros of 16 bits at 48 kHz, in 14 bytes.
std::string silent_frame(char number) {
  std::string bytes = std::string("\xFF\xF8\x7A\x08") + number + "\xFF\xFE";
  bytes += crc_of(bytes, 8, 0x07) + std::string(3, '\0');
  return bytes + crc_of(bytes, 16, 0x8005);
}

}  // namespace

TEST_CASE("FLAC: without a step that means something, full scale is 1", "[hal][formats]") {
  const ScratchFolder scratch;
  written_as("flac", scratch / "a.flac", {exported()});
  const std::string bytes = test::bytes_in(scratch / "a.flac");
  const auto read = read_bytes(scratch / "b.flac", replaced(bytes, "step_1=", "stop_1="));
  REQUIRE(read);
  const Channel& foreign = read.value()[0].channels[0];
  CHECK(foreign.samples[9] == 8388607 / 8388608.0);  // the peak, one step below full scale
  CHECK(foreign.info.unit.empty());
  CHECK(foreign.rate_Hz == 5000);
  CHECK_THAT(read.value()[0].notes.back(), Contains("accel_1x: full scale is 1"));
  CHECK(read.value()[0].channels[1].info.unit == "N·m");
}

TEST_CASE("FLAC: silence is exact, and so are signals of very unequal size", "[hal][formats]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  recording.channels[0].samples.setZero();
  recording.channels[1].samples = 1e-9 * Eigen::VectorXd::LinSpaced(10, -1, 1);
  written_as("flac", scratch / "a.flac", {recording});
  const Recording after = test::read_back(scratch / "a.flac")[0];
  CHECK(after.channels[0].samples.isZero(0));
  CHECK(after.channels[1].samples[0] == Approx(-1e-9).epsilon(1e-12));
}

TEST_CASE("FLAC: what is damaged or cut off is INVALID, and says so", "[hal][formats]") {
  const ScratchFolder scratch;
  const std::string whole = flac_of(scratch, 20000);
  const auto cut = read_bytes(scratch / "cut.flac", whole.substr(0, whole.size() / 2));
  REQUIRE(cut);
  CHECK_THAT(cut.value()[0].status, Contains("INVALID: 20000 samples per channel declared, "));
  CHECK(cut.value()[0].channels[0].samples.size() < 20000);
  std::string damaged = whole;
  damaged[whole.size() / 2] = static_cast<char>(damaged[whole.size() / 2] ^ 1);
  const auto flipped = read_bytes(scratch / "flipped.flac", damaged);
  REQUIRE(flipped);
  CHECK_THAT(flipped.value()[0].status, Catch::StartsWith("INVALID: "));
}

TEST_CASE("FLAC: frames that are not there are lost samples, not silence", "[hal][formats]") {
  const ScratchFolder scratch;
  const std::string whole = flac_of(scratch, 20000);
  // Frames of 4096 samples begin so: of varying size or not, then their number.
  const auto frame = [&whole](char number) {
    const std::size_t at = whole.find(std::string("\xFF\xF8"));
    REQUIRE(at != whole.npos);
    const std::string code = whole.substr(at, 4);
    const std::size_t found = whole.find(code + number, at);
    REQUIRE(found != whole.npos);
    return found;
  };
  std::string gapped = whole.substr(0, frame(1)) + whole.substr(frame(3));
  const auto read = read_bytes(scratch / "gap.flac", gapped);
  REQUIRE(read);
  const Recording& recording = read.value()[0];
  CHECK_THAT(recording.status,
             Catch::StartsWith("INVALID: ") && Contains(" samples are missing behind sample 4096"));
  const Eigen::VectorXd& samples = recording.channels[0].samples;
  REQUIRE(samples.size() == 20000);
  CHECK(samples.segment(4096, 8192).array().isNaN().all());
  const Eigen::VectorXd signal = Eigen::VectorXd::LinSpaced(20000, 0, 100).array().sin();
  for (Eigen::Index i = 0; i < 20000; ++i) {
    if (!std::isnan(samples[i])) REQUIRE(samples[i] == Approx(signal[i]).margin(1e-6));
  }
  CHECK_FALSE(std::isnan(samples[0]));
  CHECK_FALSE(std::isnan(samples[19999]));
}

TEST_CASE("FLAC: a gap too long to be filled is INVALID, too", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto read =
      read_bytes(scratch / "gap.flac", silent_head() + silent_frame(0) + silent_frame(1) +
                                           silent_frame(100) + silent_frame(101));
  REQUIRE(read);
  const Recording& recording = read.value()[0];
  CHECK(recording.status ==
        fmt::format("INVALID: {} samples are missing behind sample {}", 99 * 65535, 2 * 65535));
}

TEST_CASE("FLAC: a file of some kilobytes claims no gigabytes", "[hal][formats]") {
  const ScratchFolder scratch;
  std::string bytes = silent_head();
  for (int i = 0; i < 100; ++i) bytes += silent_frame(static_cast<char>(i));
  const auto read = read_bytes(scratch / "silence.flac", bytes);
  REQUIRE_FALSE(read);
  CHECK_THAT(read.error().where, Contains("silence.flac: more than 5") && Contains(" samples"));
}

TEST_CASE("FLAC: what holds no samples is refused with words", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto complaint = [&](const std::string& bytes) {
    const auto read = read_bytes(scratch / "bad.flac", bytes);
    REQUIRE_FALSE(read);
    return read.error().where;
  };
  CHECK_THAT(complaint("fLaC"), Contains("bad.flac: holds no frame of samples"));
  CHECK_THAT(complaint("fLaX"), Contains("does not begin as a FLAC file does"));
}

}  // namespace rvbench::hal
