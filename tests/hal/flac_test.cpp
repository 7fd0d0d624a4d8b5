#include <cstdlib>

#include "tests/hal/export_fixture.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::exported;
using test::ScratchFolder;
using test::written_as;

std::string replaced(std::string bytes, const std::string& what, const std::string& by) {
  const std::size_t at = bytes.find(what);
  REQUIRE(at != bytes.npos);
  return bytes.replace(at, what.size(), by);
}

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
