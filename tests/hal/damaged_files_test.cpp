#include <zlib.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "hal/formats/read_recordings.hpp"
#include "tests/hal/mat5_builder.hpp"
#include "tests/hal/recording_fixture.hpp"
#include "tests/support/bytes_in.hpp"

// None of these may crash, hang or allocate by a false claim; run them under asan, too. Whether a
// damaged file is refused depends on where it was hit: samples carry no checksum.
namespace rvbench::hal {
namespace {

using test::ScratchFolder;

Result<std::vector<Recording>> read_bytes(const std::filesystem::path& file,
                                          const std::string& bytes) {
  std::filesystem::remove(file);  // a file written anew is not flushed at once: seconds less
  std::ofstream(file, std::ios::binary) << bytes;
  return read_recordings(file);
}

// Reads the file cut off at many lengths. Returns how many of them were refused.
int cut_everywhere(const std::filesystem::path& file, const std::string& bytes, int cuts) {
  int refused = 0;
  for (int i = 0; i < cuts; ++i) {
    const std::size_t length =
        bytes.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(cuts);
    if (!read_bytes(file, bytes.substr(0, length))) ++refused;
  }
  return refused;
}

// Reads the file with one byte changed, each of `first` bytes and then at random places.
void flip_everywhere(const std::filesystem::path& file, const std::string& bytes, std::size_t first,
                     int at_random) {
  std::mt19937 random(20250117);
  for (std::size_t i = 0; i < first + static_cast<std::size_t>(at_random); ++i) {
    const std::size_t at = i < std::min(first, bytes.size()) ? i : random() % bytes.size();
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ static_cast<char>(1U << (random() % 8)));
    CAPTURE(at);
    const auto read = read_bytes(file, damaged);
    if (!read) CHECK_FALSE(read.error().where.empty());
  }
}

std::string structure(const std::string& name, const std::string& field, double value) {
  std::string names = field;
  names.resize(32);
  return test::mat5_element(14, test::mat5_element(6, test::mat5_word(2) + test::mat5_word(0)) +
                                    test::mat5_element(5, test::mat5_word(1) + test::mat5_word(1)) +
                                    test::mat5_element(1, name) + test::mat5_word(4U << 16U | 5U) +
                                    test::mat5_word(32) + test::mat5_element(1, names) +
                                    test::mat5_array("", 1, 1, {value}));
}

std::string compressed(const std::string& variable) {
  uLongf size = compressBound(variable.size());
  std::string bytes(size, '\0');
  REQUIRE(compress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                   reinterpret_cast<const Bytef*>(variable.data()), variable.size()) == Z_OK);
  bytes.resize(size);
  return test::mat5_word(15) + test::mat5_word(static_cast<std::uint32_t>(size)) + bytes;
}

std::string small_recording(const ScratchFolder& scratch) {
  const auto made = RecordingWriter::create(scratch / "whole.h5", test::layout_of(2, 2));
  REQUIRE(made);
  for (int point : {0, 1}) {
    REQUIRE(made.value()->append(point, test::acceleration_block(0, 0, 600, 2)));
    REQUIRE(made.value()->append(point, test::torque_block(0, 0, 100)));
    REQUIRE(made.value()->end_point({point, 0, "ok", 605, 1}));
  }
  REQUIRE(made.value()->note(1, "an event"));
  REQUIRE(made.value()->close());
  return test::bytes_in(scratch / "whole.h5");
}

}  // namespace

TEST_CASE("a damaged MAT file is refused or read, never fatal", "[hal][formats]") {
  const ScratchFolder scratch;
  const std::string array = test::mat5_array("signal", 40, 1, std::vector<double>(40, 1.5));
  const std::string header = structure("Head", "SampFreq", 25600);
  const std::string plain = test::mat5_file({array, header});
  const auto whole = read_bytes(scratch / "a.mat", plain);
  REQUIRE(whole);
  CHECK(whole.value()[0].channels[0].rate_Hz == 25600);
  // Between the two variables, and between one and its padding, the file is whole.
  CHECK(cut_everywhere(scratch / "a.mat", plain, static_cast<int>(plain.size())) >=
        static_cast<int>(plain.size()) - 16);
  flip_everywhere(scratch / "a.mat", plain, plain.size(), 2000);
}

TEST_CASE("a damaged compressed MAT file is refused", "[hal][formats]") {
  const ScratchFolder scratch;
  const std::string array = test::mat5_array("signal", 40, 1, std::vector<double>(40, 1.5));
  const std::string packed = test::mat5_file({compressed(array)});
  REQUIRE(read_bytes(scratch / "a.mat", packed));
  CHECK(cut_everywhere(scratch / "a.mat", packed, static_cast<int>(packed.size())) ==
        static_cast<int>(packed.size()));
  for (std::size_t at = 136; at < packed.size(); ++at) {
    CAPTURE(at);
    std::string damaged = packed;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    const auto read = read_bytes(scratch / "a.mat", damaged);
    // zlib's own checksum finds each change but that of a bit which means nothing.
    if (read) CHECK(read.value()[0].channels[0].samples == Eigen::VectorXd::Constant(40, 1.5));
  }
}

TEST_CASE("a damaged recording is refused or read, never fatal", "[hal][formats]") {
  const ScratchFolder scratch;
  const std::string bytes = small_recording(scratch);
  CHECK(cut_everywhere(scratch / "a.h5", bytes, 300) == 300);
  flip_everywhere(scratch / "a.h5", bytes, 700, 700);
}

TEST_CASE("a recording that was cut off after a power failure cannot pass for a whole one",
          "[hal][recording]") {
  const ScratchFolder scratch;
  const std::string bytes = small_recording(scratch);
  for (int tenth = 0; tenth < 10; ++tenth) {
    CAPTURE(tenth);
    std::string left = bytes.substr(0, bytes.size() * static_cast<std::size_t>(tenth) / 10);
    if (left.size() > 11) left[11] = 5;  // as the writer marks a file: open for SWMR writing
    std::ofstream(scratch / "r.h5", std::ios::binary | std::ios::trunc) << left;
    CHECK_FALSE(repair_recording(scratch / "r.h5"));
    CHECK_FALSE(read_recordings(scratch / "r.h5"));
  }
}

TEST_CASE("a damaged CSV file is refused or read, never fatal", "[hal][formats]") {
  const ScratchFolder scratch;
  std::string bytes = "a1,a2,a3\n";
  for (int i = 0; i < 50; ++i) bytes += "1.25,-3.5e-2," + std::to_string(i) + "\n";
  REQUIRE(read_bytes(scratch / "a.csv", bytes));
  CHECK(cut_everywhere(scratch / "a.csv", bytes, static_cast<int>(bytes.size())) > 0);
  flip_everywhere(scratch / "a.csv", bytes, bytes.size(), 500);
}

}  // namespace rvbench::hal
