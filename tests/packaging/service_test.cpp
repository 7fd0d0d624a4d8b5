#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "bench/command.hpp"
#include "bench/text_file.hpp"
#include "tests/packaging/installed.hpp"
#include "tests/support/this_build.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::bash;
using test::Installed;
using test::ScratchFolder;

constexpr const char* unit = "lib/systemd/system/rvbench.service";
constexpr const char* publishing_unit = "lib/systemd/system/rvbench-publish.service";

// In tenths, as systemd counts it there: of 10, where 10 is a program that may do anything.
Answer exposure_within_2_5(const ScratchFolder& folder, const std::string& text) {
  bench::write_file(folder / "rvbench.service", text);
  return bash(folder.path(),
              "systemd-analyze security --no-pager --offline=true --threshold=25 "
              "$PWD/rvbench.service");
}

}  // namespace

TEST_CASE("the services' units are such that systemd understands", "[packaging]") {
  const Installed installed;
  const std::string verify = "systemd-analyze verify --man=no --recursive-errors=no ";
  for (const char* one : {unit, publishing_unit}) {
    CAPTURE(one);
    const Answer answer = bash(installed / "", verify + one);
    CHECK(answer.code == 0);
    CHECK(answer.err == "");
  }
  THEN("a word that it does not know would be told") {
    bench::write_file(installed / unit, installed.text_of(unit) + "[Service]\nProtectAll=yes\n");
    CHECK_THAT(bash(installed / "", verify + unit).err, Contains("ProtectAll"));
  }
}

TEST_CASE("the services may do little: an exposure of at most 2.5", "[packaging]") {
  const Installed installed;
  const ScratchFolder folder;
  const std::string text = installed.text_of(unit);
  CHECK(exposure_within_2_5(folder, text).code == 0);
  CHECK(exposure_within_2_5(folder, installed.text_of(publishing_unit)).code == 0);
  THEN("also with the devices of a network let in") {
    const std::string more = installed.text_of("share/doc/rvbench/examples/devices.conf");
    CHECK(exposure_within_2_5(folder, text + more).code == 0);
  }
  THEN("a service that nobody hardened is beyond it") {
    CHECK(exposure_within_2_5(folder, "[Service]\nExecStart=/bin/true\n").code != 0);
  }
}

TEST_CASE("the service leaves the supervisor its priority", "[packaging]") {
  const Installed installed;
  const std::string text = installed.text_of(unit);
  const auto source = bench::read_file(test::source_dir() / "hal/real_time.cpp");
  REQUIRE(source);
  CHECK_THAT(*source, Contains("constexpr int priority = 40;"));
  CHECK_THAT(text, Contains("LimitRTPRIO=40\n") && Contains("RestrictRealtime=no\n"));
  // What pthread_setschedparam() calls.
  CHECK_THAT(bash(installed / "", "systemd-analyze syscall-filter @resources").out,
             Contains("sched_setscheduler"));
  CHECK_THAT(text, !Contains("~@resources"));
}

TEST_CASE("the services are given options that their commands have", "[packaging]") {
  const Installed installed;
  const std::string text = installed.text_of(GENERATE(unit, publishing_unit));
  std::istringstream words(text.substr(text.find("\nExecStart=")));
  std::string program, name;
  words >> program >> name;
  for (const auto& command : bench::make_commands()) {
    if (command->name() != name) continue;
    std::string known;
    for (const bench::Option& option : command->options()) known += option.name + ' ';
    std::string line;
    std::getline(words, line);
    std::istringstream options(line);
    for (std::string word; options >> word;) {
      if (word.starts_with("--")) CHECK_THAT(known, Contains(word + ' '));
    }
    return;
  }
  FAIL("no command " << name);
}

TEST_CASE("the example of a station file is a station file, its runs where the service may write",
          "[packaging]") {
  const Installed installed;
  const std::string file = "share/doc/rvbench/examples/station.json";
  const Answer checked = bash(installed / "", "bin/rvbench check " + file);
  CHECK(checked.err == "");
  CHECK(checked.code == 0);
  const auto station = nlohmann::json::parse(installed.text_of(file));
  CHECK(station.at("runs") == "/var/lib/rvbench/runs");
  CHECK_THAT(installed.text_of(unit), Contains("\nStateDirectory=rvbench\n"));
}

TEST_CASE("installing makes a user who cannot log in, and its group", "[packaging]") {
  const Installed installed;
  const ScratchFolder root;
  const Answer answer = bash(root.path(), "mkdir etc && systemd-sysusers --root=$PWD " +
                                              (installed / "lib/sysusers.d/rvbench.conf").string() +
                                              " && cat etc/passwd etc/group");
  INFO(answer.err);
  CHECK(answer.code == 0);
  CHECK_THAT(answer.out, Contains(":/var/lib/rvbench:/usr/sbin/nologin\n"));
  CHECK_THAT(answer.out, Contains("\nrvbench:x:"));
}

}  // namespace rvbench
