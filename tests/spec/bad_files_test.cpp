#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/text_file.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::ScratchFolder;

// No crash: neither a signal nor a sanitizer's report.
void check_civil(const Answer& answer) {
  CHECK(answer.code >= 0);
  CHECK_THAT(answer.err, !Contains("Sanitizer") && !Contains("runtime error"));
  CHECK_THAT(answer.err, !Contains("internal error"));
}

}  // namespace

TEST_CASE("a broken file is refused with its line, whatever it is for", "[spec][bad_files]") {
  const ScratchFolder scratch;
  bench::write_file(scratch.path() / "bad.json", "{\"main\": [\n1,");
  for (const std::vector<std::string>& words : {
           std::vector<std::string>{"run", "bad.json", "--rig", "sim", "--serial", "A"},
           {"run", "quick", "--rig", "bad.json", "--serial", "A"},
           {"judge", "any.csv", "--kinematics", "bad.json"},
           {"check", "bad.json"},
       }) {
    CAPTURE(words);
    const Answer answer = test::rvbench(scratch.path(), words);
    check_civil(answer);
    CHECK(answer.code == 3);
    CHECK(answer.out.empty());
    CHECK_THAT(answer.err, Contains("bad.json:2: "));
  }
}

TEST_CASE("what is no file is refused by name", "[spec][bad_files]") {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch.path() / "folder.json");
  std::filesystem::create_directory(scratch.path() / "folder.h5");
  bench::write_file(scratch.path() / "secret.json", "{}");
  std::filesystem::permissions(scratch.path() / "secret.json", std::filesystem::perms::none);
  const auto refused = [&](const std::vector<std::string>& arguments, int code,
                           const std::string& told) {
    const Answer answer = test::rvbench(scratch.path(), arguments);
    INFO(arguments.back());
    check_civil(answer);
    CHECK(answer.code == code);
    CHECK_THAT(answer.err, Contains(told));
  };
  refused({"check", "nowhere.json"}, 3, "nowhere.json: cannot be read: No such file");
  refused({"check", "folder.json"}, 3, "folder.json: no run folder: it holds no plan.json");
  refused({"run", "folder.json", "--rig", "sim", "--serial", "A"}, 3,
          "folder.json: cannot be read: it is a folder");
  refused({"run", "quick", "--rig", "folder.json", "--serial", "A"}, 3,
          "folder.json: cannot be read: it is a folder");
  refused({"run", "quick", "--rig", "nowhere.json", "--serial", "A"}, 3,
          "nowhere.json: cannot be read: No such file");
  refused({"judge", "folder.h5", "--kinematics", "rv20e"}, 20, "folder.h5: is a folder");
  refused({"judge", "nowhere.h5", "--kinematics", "rv20e"}, 20, "nowhere.h5: no such file");
  refused({"judge", "/dev/zero", "--kinematics", "rv20e"}, 20, "/dev/zero: is no file");
  refused({"check", "/dev/zero"}, 3, "/dev/zero: cannot be read: it is no regular file");
  refused({"report", "nowhere"}, 3, "nowhere/plan.json: cannot be read: No such file");
  // What cannot even be looked at, as in a folder that is closed to us: true for root, too.
  std::filesystem::create_symlink("loop.json", scratch.path() / "loop.json");
  const std::string endless(300, 'x');
  for (const auto& [name, told] : {std::pair<std::string, std::string>{"loop.json", "Too many"},
                                   {endless, "File name too long"}}) {
    refused({"check", name}, 3, name + ": cannot be read: " + told);
    refused({"run", name, "--rig", "sim", "--serial", "A"}, 3, name + ": cannot be read: " + told);
    refused({"run", "quick", "--rig", name, "--serial", "A"}, 3, ": cannot be read: " + told);
    refused({"judge", "any.csv", "--kinematics", name}, 3, name + ": cannot be read: " + told);
  }
  if (::geteuid() != 0) {  // nothing is unreadable for root
    refused({"check", "secret.json"}, 3, "secret.json: cannot be read: Permission denied");
  }
}

}  // namespace rvbench
