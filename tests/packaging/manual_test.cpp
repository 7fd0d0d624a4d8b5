#include <catch2/catch.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "bench/cli.hpp"
#include "bench/manual/bash_completion.hpp"
#include "bench/manual/man_page.hpp"
#include "bench/manual/roff_text.hpp"
#include "bench/text_file.hpp"
#include "tests/packaging/installed.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::bash;
using test::ScratchFolder;
using Commands = std::vector<std::unique_ptr<bench::Command>>;

// A command with an option of each kind, whose words are traps for roff.
class Weigh final : public bench::Command {
 public:
  std::string name() const override { return "weigh"; }
  std::string summary() const override { return ".5 of it, or 'all'"; }
  std::string examples() const override { return "  rvbench weigh a.csv   C:\\a m/s²\n"; }
  std::vector<bench::Option> options() override {
    return {{"FILE", "what to weigh", &files_, true},
            {"--scale", "which scale", &scale_, false, {"coarse", "fine"}},
            {"--tare", "in grams", &tare_g_, true},
            {"--json", "as JSON", &json_}};
  }
  int run(bench::Console&) override { return 0; }

 private:
  std::vector<std::string> files_;
  std::string scale_;
  std::optional<double> tare_g_;
  bool json_ = false;
};

Commands one_command() {
  Commands commands;
  commands.push_back(std::make_unique<Weigh>());
  return commands;
}

// What man shows of a page, and what either of two programs has against it.
std::string shown(const ScratchFolder& folder, const std::string& page) {
  bench::write_file(folder / "page.1", page);
  return bash(folder.path(), "groff -man -Tutf8 -P-c -P-b -P-u page.1").out;
}
std::string complaints(const ScratchFolder& folder, const std::string& page) {
  bench::write_file(folder / "page.1", page);
  const test::Answer groff = bash(folder.path(), "groff -ww -man -Tutf8 page.1 >/dev/null");
  return groff.err + bash(folder.path(), "mandoc -T lint -W warning page.1").out;
}

// What bash offers after these words.
std::string completed(const ScratchFolder& folder, const Commands& commands,
                      const std::string& words) {
  bench::write_file(folder / "rvbench",
                    bench::bash_completion(commands, {{"FILE", {"x.csv"}}, {"--tare", {"box"}}}));
  return bash(folder.path(), "source ./rvbench; COMP_WORDS=(" + words +
                                 "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _rvbench; "
                                 "echo -n ${COMPREPLY[@]}")
      .out;
}

std::set<std::string> exit_codes_in(const std::string& text, const std::string& pattern) {
  const std::regex code(pattern);
  std::set<std::string> codes;
  for (std::sregex_iterator at(text.begin(), text.end(), code), end; at != end; ++at) {
    codes.insert((*at)[1]);
  }
  return codes;
}

}  // namespace

TEST_CASE("text stays as it is, whatever roff makes of its signs", "[packaging]") {
  CHECK(bench::roff_text("a-b \\ m/s²") == "a\\-b \\e m/s\\[u00B2]");
  CHECK(bench::roff_text(".5\n.6 7.8") == "\\&.5\n\\&.6 7.8");
  CHECK(bench::roff_text("") == "");
  CHECK(bench::roff_paragraph("  two \n .words ") == "two .words\n");
}

TEST_CASE("a page shows a command's options as the command states them", "[packaging]") {
  const ScratchFolder folder;
  const std::string page = bench::man_page(one_command(), "1.2.3", "2026-01-02");
  CHECK(complaints(folder, page) == "");
  CHECK_THAT(complaints(folder, page + ".Sh\n"), Contains("Sh"));
  const std::string text = shown(folder, page);
  CHECK_THAT(text, Contains("RVBENCH(1)") && Contains("rvbench 1.2.3") && Contains("2026-01-02"));
  CHECK_THAT(text, Contains("rvbench weigh FILE ...") && Contains("--tare NUMBER [OPTIONS]"));
  CHECK_THAT(text, Contains("--scale coarse|fine") && Contains("--json") && Contains("as JSON"));
  CHECK_THAT(text, Contains(".5 of it, or 'all'") && Contains("in grams (required)"));
  CHECK_THAT(text, Contains("rvbench weigh a.csv   C:\\a m/s²"));
}

TEST_CASE("the manual tells of every command, and of the exit codes of --help", "[packaging]") {
  const ScratchFolder folder;
  const Commands commands = bench::make_commands();
  const std::string page = bench::man_page(commands, "1", "2026-01-02");
  CHECK(complaints(folder, page) == "");
  for (const auto& command : commands) {
    CHECK_THAT(page, Contains(".SS " + command->name() + "\n"));
    for (const bench::Option& option : command->options()) {
      CHECK_THAT(page, Contains(bench::roff_text(option.name)));
    }
  }
  std::ostringstream help, err;
  bench::Console console{help, err};
  bench::run_cli({"--help"}, commands, console);
  const std::string codes = help.str().substr(help.str().find("Exit codes:"));
  CHECK(exit_codes_in(codes, "([0-9]+) [A-Za-z]") ==
        exit_codes_in(page.substr(page.find("EXIT STATUS")), "fB([0-9]+)\\\\fR"));
}

TEST_CASE("bash completes commands, options and values, and leaves files to itself",
          "[packaging]") {
  const ScratchFolder folder;
  const Commands commands = one_command();
  CHECK(completed(folder, commands, "rvbench we") == "weigh");
  CHECK(completed(folder, commands, "rvbench ''") == "weigh --help --version");
  CHECK(completed(folder, commands, "rvbench weigh --") == "--help --scale --tare --json");
  CHECK(completed(folder, commands, "rvbench weigh a.csv --s") == "--scale");
  CHECK(completed(folder, commands, "rvbench weigh --scale f") == "fine");
  CHECK(completed(folder, commands, "rvbench weigh --scale = f") == "fine");
  CHECK(completed(folder, commands, "rvbench weigh --scale =") == "coarse fine");
  CHECK(completed(folder, commands, "rvbench weigh x") == "x.csv");
  CHECK(completed(folder, commands, "rvbench weigh --json ''") == "x.csv");
  CHECK(completed(folder, commands, "rvbench weigh --tare ''") == "box");
  CHECK(completed(folder, commands, "rvbench weigh --tare -") == "");
  CHECK(completed(folder, commands, "rvbench weigh a") == "");
  CHECK(completed(folder, commands, "rvbench lift --") == "");
}

TEST_CASE("what is installed completes the commands that there are", "[packaging]") {
  const test::Installed installed;
  const std::string script = installed.text_of("share/bash-completion/completions/rvbench");
  const std::string offer =
      "source share/bash-completion/completions/rvbench; COMP_CWORD=2; "
      "COMP_WORDS=(rvbench run ";
  CHECK_THAT(bash(installed / "", offer + "--); _rvbench; echo ${COMPREPLY[@]}").out,
             Contains("--serial"));
  CHECK(bash(installed / "", offer + "qu); _rvbench; echo ${COMPREPLY[@]}").out == "quick\n");
  for (const auto& command : bench::make_commands()) {
    CHECK_THAT(script, Contains(' ' + command->name() + ") words="));
  }
}

}  // namespace rvbench
