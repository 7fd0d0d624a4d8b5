#include "tests/packaging/installed.hpp"

#include <catch2/catch.hpp>
#include <regex>
#include <sstream>
#include <string>

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::bash;
using test::Installed;

}  // namespace

TEST_CASE("cmake --install leaves program, manual, completion, service, rules and examples",
          "[packaging]") {
  const Installed installed;
  for (const char* file :
       {"bin/rvbench", "share/man/man1/rvbench.1.gz", "share/bash-completion/completions/rvbench",
        "lib/systemd/system/rvbench.service", "lib/systemd/system/rvbench-publish.service",
        "lib/udev/rules.d/70-rvbench.rules", "lib/sysusers.d/rvbench.conf",
        "share/rvbench/rigs/rv20e_bench.json", "share/rvbench/kinematics/rv20e.json",
        "share/rvbench/plans/quick.json", "share/rvbench/plants/rv20e_bench.json",
        "share/rvbench/drives/delta_ms300.json", "share/doc/rvbench/README.md",
        "share/doc/rvbench/guide/first_pass.md", "share/doc/rvbench/guide/your_bench.md",
        "share/doc/rvbench/examples/station.json", "share/doc/rvbench/copyright"}) {
    INFO(file);
    CHECK(std::filesystem::is_regular_file(installed / file));
  }
  const test::Answer version = bash(installed / "", "bin/rvbench --version");
  CHECK(version.code == 0);
  CHECK_THAT(version.out, Contains("rvbench 0."));
  CHECK_THAT(installed.text_of("lib/systemd/system/rvbench.service"),
             Contains("ExecStart=" + (installed / "bin/rvbench").string() + " serve "));
  THEN("the shipped machines and rigs are sound") {
    const test::Answer checked =
        bash(installed / "", "bin/rvbench check share/rvbench/{rigs,kinematics,plans,plants}/*");
    INFO(checked.err);
    CHECK(checked.code == 0);
  }
  THEN("nothing of the tests or of the build is among them") {
    CHECK(bash(installed / "", "find . -name '*.a' -o -name '*test*' -o -name '*.cpp'").out == "");
  }
}

TEST_CASE("udev rules are pairs of key and value, each of an operator that udev knows",
          "[packaging]") {
  const std::regex rule(R"re(([A-Z_]+(\{[A-Za-z_]+\})?(==|!=|=|\+=|:=)"[^"]*"))re"
                        R"re((, [A-Z_]+(\{[A-Za-z_]+\})?(==|!=|=|\+=|:=)"[^"]*")*)re");
  const Installed installed;
  for (const char* file :
       {"lib/udev/rules.d/70-rvbench.rules", "share/doc/rvbench/examples/80-my-bench.rules"}) {
    const std::string text =
        std::regex_replace(installed.text_of(file), std::regex("\\\\\n *"), "");
    std::istringstream lines(text);
    int rules = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.empty() || line[0] == '#') continue;
      INFO(file << ": " << line);
      CHECK(std::regex_match(line, rule));
      ++rules;
    }
    CHECK(rules >= 2);
  }
  CHECK_FALSE(std::regex_match(R"(SUBSYSTEM="tty" GROUP=="rvbench")", rule));
}

}  // namespace rvbench
