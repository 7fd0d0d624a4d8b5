#include "bench/text_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "hal/formats/file_draft.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

std::size_t files_in(const std::filesystem::path& folder) {
  const std::filesystem::directory_iterator all(folder);
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

// The name that the next draft of this process would have had of `file`, "a.json.4711-2.part".
std::filesystem::path next_draft_of(const std::filesystem::path& file) {
  hal::formats::FileDraft draft(file, true);
  REQUIRE(draft.begin());
  const std::string name = draft.path().string();
  const std::size_t number = name.rfind('-') + 1;
  return name.substr(0, number) + std::to_string(std::stoi(name.substr(number)) + 1) + ".part";
}

}  // namespace

TEST_CASE("a text takes the place of the one before, and leaves nothing else", "[bench]") {
  const ScratchFolder scratch;
  const auto file = scratch / "a.json";
  for (const std::string text : {"a long first text", "second", ""}) {
    write_file(file, text);
    CHECK(read_file(file) == text);
    CHECK(files_in(scratch.path()) == 1);
  }
}

TEST_CASE("a text is not written through what lies where it is drafted", "[bench]") {
  const ScratchFolder scratch;
  const auto file = scratch / "a.json", other = scratch / "other";
  std::ofstream(other) << "mine";
  const auto next = next_draft_of(file);
  for (const std::filesystem::path& way : {std::filesystem::path(file.string() + ".draft"), next}) {
    std::filesystem::create_symlink(other, way);
  }
  write_file(file, "text");
  CHECK(read_file(file) == "text");
  CHECK(read_file(other) == "mine");
  CHECK(std::filesystem::is_symlink(next));
}

TEST_CASE("a draft that a kill has left is in nobody's way", "[bench]") {
  const ScratchFolder scratch;
  const auto file = scratch / "a.json";
  const auto left = next_draft_of(file);
  std::ofstream(left) << "half";
  std::filesystem::create_directory(file.string() + ".draft");
  write_file(file, "text");
  CHECK(read_file(file) == "text");
  CHECK(read_file(left) == "half");
  CHECK(drafted_file(left) == file);
  CHECK(drafted_file(scratch / "a.json.draft") == file);
  CHECK(drafted_file(file).empty());
  CHECK(drafted_file(scratch / "a.part").empty());
}

TEST_CASE("a text that cannot be written leaves the old one, and says why", "[bench]") {
  const ScratchFolder scratch;
  const auto file = scratch / "a.json";
  write_file(file, "old");
  SECTION("no room") {
    const test::FileSizeLimit limit(2);
    CHECK_THROWS_WITH(write_file(file, "new text"), file.string() + ": File too large");
    CHECK(read_file(file) == "old");
    CHECK(files_in(scratch.path()) == 1);
  }
  SECTION("no folder") {
    CHECK_THROWS_WITH(write_file(scratch / "none" / "a.json", "new"),
                      Contains("none/a.json: No such file or directory"));
  }
  SECTION("no file") {
    std::filesystem::create_directory(scratch / "folder");
    CHECK_THROWS_WITH(write_file(scratch / "folder", "new"), Contains("folder: Is a directory"));
    REQUIRE(mkfifo((scratch / "pipe").c_str(), 0600) == 0);
    CHECK_THROWS_WITH(write_file(scratch / "pipe", "new"), Contains("pipe: File exists"));
    CHECK(std::filesystem::is_fifo(scratch / "pipe"));
  }
}

}  // namespace rvbench::bench
