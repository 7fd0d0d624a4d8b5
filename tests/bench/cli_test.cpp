#include "bench/cli.hpp"

#include <catch2/catch.hpp>
#include <sstream>
#include <stdexcept>

#include "tests/bench/answers.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;

// A command that only tells what it was given.
class Echo final : public Command {
 public:
  std::string name() const override { return "judge"; }
  std::string summary() const override { return "echoes"; }
  std::string examples() const override { return "  rvbench judge a.mat --rate 12000"; }
  std::vector<Option> options() override {
    return {{"REC", "files", &files_, true, {}},
            {"--rate", "Hz", &rate_Hz_, false, {}},
            {"--seed", "number", &seed_, false, {}},
            {"--by", "name", &by_, false, {}},
            {"--point", "names", &points_, false, {}},
            {"--json", "machine output", &json_, false, {}},
            {"--catalogue", "which", &catalogue_, false, {"derived", "published"}}};
  }
  int run(Console& console) override {
    if (catalogue_ == "published") throw std::runtime_error("out of luck");
    for (const std::string& file : files_) console.out << file << ' ';
    if (rate_Hz_) console.out << *rate_Hz_;
    if (seed_) console.out << ' ' << *seed_;
    return json_ ? 10 : 0;
  }

 private:
  std::vector<std::string> files_, points_;
  std::optional<double> rate_Hz_;
  std::optional<std::uint64_t> seed_;
  bool json_ = false;
  std::string catalogue_, by_;
};

test::CommandAnswer ask(const std::vector<std::string>& arguments) {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<Echo>());
  return test::answer_of(arguments, commands);
}

}  // namespace

TEST_CASE("arguments reach the command and its exit code comes back", "[bench]") {
  const test::CommandAnswer answer = ask(
      {"judge", "a.mat", "b.mat", "--rate", "12000", "--seed", "18446744073709551615", "--json"});
  CHECK(answer.code == 10);
  CHECK(answer.out == "a.mat b.mat 12000 18446744073709551615");
  CHECK(answer.err.empty());
}

TEST_CASE("help names every command, and examples", "[bench]") {
  CHECK(ask({"--help"}).code == 0);
  CHECK_THAT(ask({"--help"}).out, Contains("judge"));
  CHECK(ask({"judge", "--help"}).code == 0);
  CHECK_THAT(ask({"judge", "--help"}).out, Contains("rvbench judge a.mat --rate 12000"));
}

TEST_CASE("arguments that make no sense end with 2 and a hint on standard error", "[bench]") {
  const auto refused = [](const std::vector<std::string>& arguments, const char* hint) {
    const test::CommandAnswer answer = ask(arguments);
    INFO(answer.err);
    CHECK(answer.code == 2);
    CHECK(answer.out.empty());
    CHECK_THAT(answer.err, Contains(hint));
  };
  refused({}, "Usage");
  refused({"jugde"}, "did you mean \"judge\"?");
  refused({"judge", "a.mat", "--rat", "5"}, "did you mean \"--rate\"?");
  refused({"judge", "a.mat", "--rat=5"}, "did you mean \"--rate\"?");
  refused({"judge"}, "REC");
  refused({"judge", "a.mat", "--rate", "fast"}, "--rate");
  refused({"judge", "a.mat", "--seed", "-1"}, "--seed");
  refused({"judge", "a.mat", "--catalogue", "other"}, "--catalogue");
}

TEST_CASE("a number is decimal, whole and nothing else", "[bench]") {
  for (const std::string right : {"12000", "+12000", "12e3", "12000.", "1.2e+4"}) {
    CAPTURE(right);
    CHECK(ask({"judge", "a.mat", "--rate", right}).out == "a.mat 12000");
    CHECK(ask({"judge", "a.mat", "--rate=" + right}).out == "a.mat 12000");
  }
  CHECK(ask({"judge", "a.mat", "--rate", "-.5"}).out == "a.mat -0.5");
  for (const std::string wrong : {"0x10", "0x1p4", " 5", "5 ", "5\n", "\t5", "nan", "inf", "-inf",
                                  "1e999", "5,5", "1'000", "5Hz", "+-5", "++5", "+", "."}) {
    CAPTURE(wrong);
    const test::CommandAnswer answer = ask({"judge", "a.mat", "--rate", wrong});
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("judge: --rate: must be a decimal number, not \""));
  }
  for (const char* option : {"--rate", "--seed"}) {
    const test::CommandAnswer answer = ask({"judge", "a.mat", option, ""});
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains(std::string(option) + ": must be a ") && Contains("not \"\""));
  }
}

TEST_CASE("what an option has of text is one line that somebody can have written", "[bench]") {
  for (const std::string& right : {std::string("A. Müller"), std::string(4096, 'x')}) {
    CHECK(ask({"judge", "a.mat", "--by", right, "--point", right}).code == 0);
  }
  const auto [wrong, why] = GENERATE(table<std::string, std::string>(
      {{"", "must not be empty"},
       {"  ", "must not be empty"},
       {"A.\nMüller", "must be free of control characters"},
       {"A.\x1b[31m", "must be free of control characters"},
       {"A.\x7f", "must be free of control characters"},
       {std::string(100000, 'x'), "must not be longer than 4096 bytes"}}));
  for (const std::string option : {"--by", "--point"}) {
    const test::CommandAnswer answer = ask({"judge", "a.mat", option, wrong});
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("judge: " + option + ": " + why));
    CHECK(answer.err.size() < 400);
  }
  // A file is what it is called.
  CHECK(ask({"judge", "a\nb.mat"}).out == "a\nb.mat ");
}

TEST_CASE("an answer that cannot be written is no success", "[bench]") {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--help"}, {"judge", "--help"}, {"judge", "a.mat"}}) {
    std::ostringstream out;
    std::ostringstream err;
    out.setstate(std::ios::badbit);  // as on a full disk
    Console console{out, err};
    std::vector<std::unique_ptr<Command>> commands;
    commands.push_back(std::make_unique<Echo>());
    CHECK(run_cli(words, commands, console) == 1);
    CHECK_THAT(err.str(), Contains("standard output cannot be written"));
  }
}

TEST_CASE("a verdict that cannot be written is none, a fault of the bench stays one", "[bench]") {
  struct Coded final : Command {
    explicit Coded(int c) : code(c) {}
    std::string name() const override { return "coded"; }
    std::string summary() const override { return ""; }
    std::string examples() const override { return ""; }
    std::vector<Option> options() override { return {}; }
    int run(Console& console) override {
      console.out << "what it came to\n";
      return code;
    }
    int code;
  };
  const auto [code, left] = GENERATE(table<int, int>(
      {{0, 1}, {10, 1}, {20, 1}, {2, 2}, {3, 3}, {30, 30}, {40, 40}, {50, 50}, {60, 60}}));
  CAPTURE(code);
  std::ostringstream out;
  std::ostringstream err;
  out.setstate(std::ios::badbit);
  Console console{out, err};
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<Coded>(code));
  CHECK(run_cli({"coded"}, commands, console) == left);
}

TEST_CASE("what a file or a user has of control characters does not reach the terminal",
          "[bench]") {
  const test::CommandAnswer answer = ask({"ju\x1b[31mdge"});
  CHECK(answer.code == 2);
  CHECK(answer.err.find('\x1b') == std::string::npos);
}

TEST_CASE("an exception is an internal error, never a verdict", "[bench]") {
  const test::CommandAnswer answer = ask({"judge", "a.mat", "--catalogue", "published"});
  CHECK(answer.code == 1);
  CHECK_THAT(answer.err, Contains("out of luck"));
}

}  // namespace rvbench::bench
