#include "bench/out_folder.hpp"

#include <catch2/catch.hpp>

#include "bench/text_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using rvbench::test::ScratchFolder;

TEST_CASE("of a folder that nothing came of nothing is left", "[bench]") {
  const ScratchFolder scratch;
  const auto there = scratch.path() / "there", out = there / "a" / "b";
  std::filesystem::create_directory(there);
  {
    OutFolder folder;
    CHECK(folder.make(out, {"verdict.json"}).empty());
    CHECK(std::filesystem::is_directory(out));
  }
  CHECK(std::filesystem::is_empty(there));
  {
    OutFolder folder;
    CHECK(folder.make(there, {}).empty());
  }
  CHECK(std::filesystem::is_directory(there));
}

TEST_CASE("a folder that holds a result stays, and the next one is refused", "[bench]") {
  const ScratchFolder scratch;
  const auto out = scratch.path() / "a" / "b";
  {
    OutFolder folder;
    REQUIRE(folder.make(out, {"verdict.json"}).empty());
    write_file(out / "verdict.json", "{}");
  }
  CHECK(read_file(out / "verdict.json") == "{}");
  OutFolder again;
  CHECK(again.make(out, {"report.html", "verdict.json"}) ==
        "holds a verdict.json already: give another folder");
}

TEST_CASE("where no folder can be made it is said, and none is left", "[bench]") {
  const ScratchFolder scratch;
  write_file(scratch.path() / "file", "");
  {
    OutFolder folder;
    CHECK(folder.make(scratch.path() / "file" / "a", {}) == "Not a directory");
  }
  CHECK(read_file(scratch.path() / "file") == "");
}

}  // namespace rvbench::bench
