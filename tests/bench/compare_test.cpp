#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "bench/compare_page.hpp"
#include "bench/compare_text.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"

// `compare` on recordings of any other program.
namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;
using test::rvbench;

constexpr double rate_Hz = 2000;

// A motor at 1800 rpm with lines at its order and at the outer race's.
struct Motor {
  double shaft = 0.5, outer = 0.1;
  double length_s = 8;
  std::string channel = "accel_1x";
  double unit = 1;  // of the file
};

void write_csv(const std::filesystem::path& file, const Motor& motor, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0, 0.1);
  const auto tone = [](double order, double t_s) {
    return std::cos(2 * std::numbers::pi * order * 30 * t_s);
  };
  std::ofstream out(file);
  out << motor.channel << '\n';
  for (int i = 0; i < motor.length_s * rate_Hz; ++i) {
    const double vibration =
        motor.shaft * tone(1, i / rate_Hz) + motor.outer * tone(3.58, i / rate_Hz) + noise(engine);
    out << vibration / motor.unit << '\n';
  }
}

// A folder of so many recordings.
std::string repeats(const ScratchFolder& scratch, const std::string& name, const Motor& motor,
                    unsigned count, unsigned seed) {
  const std::filesystem::path folder = scratch.path() / name;
  std::filesystem::create_directories(folder);
  for (unsigned i = 0; i < count; ++i) {
    write_csv(folder / (std::to_string(i) + ".csv"), motor, 100 * seed + i);
  }
  return folder.string();
}

CommandAnswer compare(const std::string& a, const std::string& b,
                      std::vector<std::string> more = {}) {
  std::vector<std::string> words{"compare", a,      b,        "--kinematics", "cwru_6205",
                                 "--speed", "1800", "--rate", "2000"};
  words.insert(words.end(), more.begin(), more.end());
  return rvbench(words);
}

nlohmann::json told(const CommandAnswer& answer) { return nlohmann::json::parse(answer.out); }

}  // namespace

TEST_CASE("compare names the line that changed, and by how much", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = repeats(scratch, "a", {}, 3, 1);
  const std::string b = repeats(scratch, "b", {.outer = 0.2}, 3, 2);
  const CommandAnswer answer = compare(a, b);
  INFO(answer.err);
  CHECK(answer.code == 0);
  CHECK_THAT(answer.out, Contains("CHANGED  Most changed: bearing outer (spall)") &&
                             Contains("drive end bearing_outer by +6.") &&
                             Contains("did not change: in half of them a change above"));
  const auto json = told(compare(a, b, {"--json"}));
  CHECK(json.at("verdict") == "changed");
  CHECK(json.at("families").at(0).at("component") == "bearing_outer");
  CHECK(json.at("families").at(0).at("cells_changed") >= 1);
  CHECK(json.at("families").at(0).at("cells_changed") <= json.at("families").at(0).at("cells"));
  CHECK(json.at("method").at("seen_p") == 1e-4);
  CHECK(json.at("method").at("found_p") == 0.01);
  const auto& line = json.at("changed").at(0);
  CHECK(line.at("quantity") == "drive end bearing_outer");
  CHECK(line.at("median_dB").get<double>() ==
        Approx(6.02).margin(2 * line.at("strongest").at("uncertainty95_dB").get<double>()));
  CHECK(json.at("points").at(0).at("records") == nlohmann::json({{"a", 3}, {"b", 3}}));
  CHECK(json.at("data_sha256").size() == 6);
}

TEST_CASE("compare of two draws of one motor says that nothing changed", "[bench]") {
  const ScratchFolder scratch;
  const CommandAnswer answer =
      compare(repeats(scratch, "a", {}, 3, 1), repeats(scratch, "b", {}, 3, 2));
  CHECK(answer.code == 0);
  CHECK_THAT(
      answer.out,
      Contains("NOT CHANGED  From A to B nothing is known to have changed by more than 1 dB"));
}

TEST_CASE("compare of one recording each says what its scatter is worth", "[bench]") {
  const ScratchFolder scratch;
  write_csv(scratch.path() / "a.csv", {}, 1);
  write_csv(scratch.path() / "b.csv", {.shaft = 1}, 2);
  const CommandAnswer answer =
      compare((scratch.path() / "a.csv").string(), (scratch.path() / "b.csv").string());
  CHECK(answer.code == 0);
  CHECK_THAT(answer.out, Contains("motor shaft by +6.0 dB") &&
                             Contains("what differs from start to start is not in it"));
}

TEST_CASE("a least change is as large as the user says", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = repeats(scratch, "a", {}, 3, 1);
  const std::string b = repeats(scratch, "b", {.shaft = 0.6}, 3, 2);  // 1.6 dB
  CHECK_THAT(compare(a, b).out, Contains("motor shaft by +1.6 dB"));
  CHECK_THAT(compare(a, b, {"--least", "3"}).out, !Contains("motor shaft by"));
}

TEST_CASE("one sensor by two names is one channel if the user says so", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = repeats(scratch, "a", {}, 3, 1);
  const std::string b = repeats(scratch, "b", {.outer = 0.2, .channel = "DE_130"}, 3, 2);
  const std::string out = (scratch.path() / "compared").string();
  const CommandAnswer answer = compare(a, b, {"--same", "accel_1x=DE_130", "--out", out});
  CHECK(answer.code == 0);
  CHECK_THAT(answer.out, Contains("drive end bearing_outer by +6."));
  CHECK_THAT(read_file(out + "/compare.html").value_or(""), Contains("B, after: accel_1x"));
  for (const char* wrong : {"accel_1x", "=DE_130", "accel_1x="}) {
    CHECK(compare(a, b, {"--same", wrong}).code == 2);
  }
  const CommandAnswer absent = compare(a, b, {"--same", "accel_1x=DE_131"});
  CHECK(absent.code == 2);
  CHECK_THAT(absent.err, Contains("has no channel DE_131"));
  CHECK(compare(a, b, {"--same", "accel_2x=DE_130"}).code == 2);
  const CommandAnswer twice =
      compare(a, b, {"--same", "accel_1x=DE_130", "--same", "accel_1x=DE_130"});
  CHECK(twice.code == 2);
  CHECK_THAT(twice.err, Contains("accel_1x is given twice"));
}

TEST_CASE("a name of A that B has for another sensor is not given twice", "[bench]") {
  const ScratchFolder scratch;
  const auto write = [&](const char* name, const char* channels, unsigned seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> noise(0, 0.1);
    std::ofstream out(scratch.path() / name);
    out << channels << '\n';
    for (int i = 0; i < 8 * rate_Hz; ++i) {
      const double first = noise(engine);
      out << first << ',' << 10 * noise(engine) << '\n';
    }
    return (scratch.path() / name).string();
  };
  const std::string a = write("a.csv", "s1,s2", 1), b = write("b.csv", "s1,s2", 2);
  const CommandAnswer merged = compare(a, b, {"--same", "s1=s2"});
  CHECK(merged.code == 2);
  CHECK_THAT(merged.err, Contains("has both s1 and s2"));
  const CommandAnswer swapped = compare(a, b, {"--same", "s1=s2", "--same", "s2=s1", "--json"});
  REQUIRE(swapped.code == 0);
  const nlohmann::json answer = told(swapped);
  for (const auto& change : answer.at("points").at(0).at("changes")) {
    if (change.at("quantity") != "rms") continue;
    const double by_dB = change.at("channel") == "s1" ? 20 : -20;
    CHECK(change.at("change_dB").get<double>() == Approx(by_dB).margin(1));
  }
}

TEST_CASE("one motor in g and in m/s² is one motor", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = repeats(scratch, "a", {.channel = "accel_1x [m/s²]"}, 3, 1);
  const Motor in_g{.channel = "accel_1x [g]", .unit = 9.80665};
  const CommandAnswer same = compare(a, repeats(scratch, "b", in_g, 3, 2));
  INFO(same.err << same.out);
  CHECK(same.code == 0);
  CHECK_THAT(same.out, Contains("NOT CHANGED"));
  Motor spoilt = in_g;
  spoilt.outer = 0.2;
  const CommandAnswer other = compare(a, repeats(scratch, "c", spoilt, 3, 2));
  CHECK_THAT(other.out, Contains("drive end bearing_outer by +6.") && !Contains("unit"));
}

TEST_CASE("a unit that only one side states is told", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = repeats(scratch, "a", {.channel = "accel_1x [m/s²]"}, 3, 1);
  const std::string b = repeats(scratch, "b", {}, 3, 2);
  CHECK_THAT(compare(a, b).out, Contains("accel_1x: compared, but not every file states its unit"));
  CHECK_THAT(compare(b, repeats(scratch, "c", {}, 3, 3)).out, !Contains("states its unit"));
}

TEST_CASE("a column that is no acceleration is not compared as one", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = repeats(scratch, "a", {.channel = "accel_1x [V]"}, 3, 1);
  const std::string b = repeats(scratch, "b", {.channel = "accel_1x [V]"}, 3, 2);
  const CommandAnswer answer = compare(a, b);
  CHECK(answer.code == 20);
  CHECK_THAT(answer.err, Contains("no acceleration"));
}

TEST_CASE("copies of a recording are no repeats", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = repeats(scratch, "a", {}, 1, 1), b = repeats(scratch, "b", {}, 1, 2);
  for (const std::string& side : {a, b}) {
    for (const char* copy : {"1.csv", "2.csv"}) {
      std::filesystem::copy_file(side + "/0.csv", side + "/" + copy);
    }
  }
  const CommandAnswer answer = compare(a, b, {"--json"});
  REQUIRE(answer.code == 0);
  const auto json = told(answer);
  CHECK(json.at("verdict") != "changed");
  CHECK(json.at("points").at(0).at("records") == nlohmann::json({{"a", 1}, {"b", 1}}));
  CHECK(json.at("data_sha256").size() == 2);
  REQUIRE(json.at("left_out").size() == 4);
  CHECK(json.at("left_out").at(0).at("where") == a + "/1.csv");
  CHECK(json.at("left_out").at(0).at("why") == "a copy of " + a + "/0.csv, no repeat");
}

TEST_CASE("one recording by two names cannot have changed, and that is the answer", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = (scratch.path() / "a.csv").string();
  const std::string b = (scratch.path() / "b.csv").string();
  write_csv(a, {}, 1);
  std::filesystem::copy_file(a, b);
  const std::string same = "A and B are the same recording: nothing can have changed.";
  const auto json = told(compare(a, b, {"--json"}));
  CHECK(json.at("verdict") == "not_changed");
  CHECK(json.at("sentence") == same);
  CHECK(json.at("left_out").at(0).at("why").get<std::string>().find(a) != std::string::npos);
  CHECK_THAT(compare(a, b).out, Contains(same));
  std::filesystem::remove(b);
  write_csv(b, {}, 2);
  CHECK_THAT(compare(a, b).out, !Contains("same recording"));
}

TEST_CASE("of several recordings the one that is in A as well is told", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = repeats(scratch, "a", {}, 2, 1), b = repeats(scratch, "b", {}, 2, 2);
  const std::string told_of_one = "1 of the 2 records of B is in A as well";
  CHECK_THAT(compare(a, b).out, !Contains(told_of_one));
  std::filesystem::copy_file(a + "/0.csv", b + "/0.csv",
                             std::filesystem::copy_options::overwrite_existing);
  CHECK_THAT(compare(a, b).out, Contains(told_of_one) && !Contains("A and B are the same"));
}

TEST_CASE("records too short for lines say so in the answer, with the length it takes", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = (scratch.path() / "a.csv").string();
  const std::string b = (scratch.path() / "b.csv").string();
  const auto compared_of = [&](double length_s) {
    write_csv(a, {.length_s = length_s}, 1);
    write_csv(b, {.length_s = length_s}, 2);
    return compare(a, b).out;
  };
  CHECK_THAT(compared_of(1),
             Contains("From A to B no level is known to have changed by more than 1 dB.") &&
                 Contains("Lines were not compared, only levels: to part them a record must last "
                          "2.13 s at 1800 rpm, and one lasts 1 s."));
  CHECK_THAT(compared_of(8),
             Contains("nothing is known to have changed") && !Contains("Lines were not compared"));
}

TEST_CASE("why it cannot be told is said as it is", "[bench]") {
  analysis::Comparison comparison;
  comparison.quantities = {{"rms"}};
  analysis::Change change;
  change.seen = true;
  comparison.changes = {change};
  CHECK_THAT(compare_reservation(comparison),
             Contains("Of 1 it cannot be told: no scatter is known of them.") &&
                 Contains("too short for parts, or repeats agree to the last digit"));
  comparison.changes.front().source = analysis::ScatterSource::repeats;
  comparison.changes.front().freedom = 4;
  CHECK_THAT(compare_reservation(comparison),
             Contains("Of 1 it cannot be told: their scatter would hide 6 dB.") &&
                 !Contains("no scatter is known"));
}

TEST_CASE("compare writes a page that stands for itself, and not over an older one", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = repeats(scratch, "a", {}, 2, 1);
  const std::string b = repeats(scratch, "b", {.outer = 0.3}, 2, 2);
  const std::string out = (scratch.path() / "compared").string();
  const CommandAnswer answer = compare(a, b, {"--out", out});
  CHECK(answer.code == 0);
  CHECK_THAT(answer.out, Contains("Report: " + out + "/compare.html"));
  const std::string page = read_file(out + "/compare.html").value_or("");
  for (const char* part :
       {"Before and after: CWRU bearing rig", "CHANGED", "cell high", "A, before: accel_1x",
        "B, after: accel_1x", "drive end bearing_outer"}) {
    CAPTURE(part);
    CHECK((page.find(part) != std::string::npos));
  }
  CHECK((page.find("http") == page.find("http://www.w3.org")));  // no link but SVG's namespace
  CHECK(nlohmann::json::accept(read_file(out + "/compare.json").value_or("")));
  const CommandAnswer again = compare(a, b, {"--out", out});
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Contains("holds a compare.json already"));
}

TEST_CASE("compare refuses what cannot be compared, and says why", "[bench]") {
  const ScratchFolder scratch;
  const std::string a = repeats(scratch, "a", {}, 2, 1);
  SECTION("no channel of the same name") {
    const CommandAnswer answer = compare(a, repeats(scratch, "b", {.channel = "accel_2x"}, 2, 2));
    CHECK(answer.code == 20);
    CHECK_THAT(answer.err, Contains("accel_1x: only A has it") &&
                               Contains("no channel in common that can be compared"));
  }
  SECTION("no machine") {
    const CommandAnswer answer = rvbench({"compare", a, a, "--speed", "1800", "--rate", "2000"});
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("give its machine with --kinematics"));
  }
  SECTION("no such file") { CHECK(compare(a, (scratch.path() / "none.csv").string()).code == 20); }
  SECTION("a folder without recordings") {
    std::filesystem::create_directories(scratch.path() / "empty");
    const CommandAnswer answer = compare(a, (scratch.path() / "empty").string());
    CHECK(answer.code == 20);
    CHECK_THAT(answer.err, Contains("holds no recording"));
  }
  SECTION("a folder of run folders") {
    const std::filesystem::path runs = scratch.path() / "runs";
    std::filesystem::create_directories(runs / "A17" / "20260102T030405Z");
    write_file(runs / "results.db", "");
    write_file(runs / "A17" / "20260102T030405Z" / "plan.json", "{}");
    for (const auto& parent : {runs, runs / "A17"}) {
      const CommandAnswer answer = compare(a, parent.string());
      CHECK(answer.code == 20);
      CHECK_THAT(answer.err,
                 Contains("is a parent of run folders") && Contains("A17/20260102T030405Z"));
    }
  }
  SECTION("a folder that may not be read") {
    const std::filesystem::path folder = scratch.path() / "closed";
    std::filesystem::create_directories(folder);
    std::filesystem::permissions(folder, std::filesystem::perms::none);
    std::error_code why;
    const std::filesystem::directory_iterator reads(folder, why);
    const CommandAnswer answer = compare(a, folder.string());
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
    CHECK(answer.code == 20);  // the superuser reads it: then it holds no recording
    CHECK_THAT(answer.err, Contains(why ? "Permission denied" : "holds no recording"));
  }
  SECTION("a file that is none") {
    write_file(scratch.path() / "b.csv", "\x01\x02 nonsense");
    CHECK(compare(a, (scratch.path() / "b.csv").string()).code == 20);
  }
  SECTION("a kinematics file that is none") {
    write_file(scratch.path() / "k.json", "{");
    const CommandAnswer answer = rvbench({"compare", a, a, "--speed", "1800", "--rate", "2000",
                                          "--kinematics", (scratch.path() / "k.json").string()});
    CHECK(answer.code == 3);
  }
  SECTION("a run folder whose machine is damaged") {
    const std::filesystem::path run = scratch.path() / "run";
    std::filesystem::create_directories(run);
    write_file(run / "plan.json", "{}");
    write_file(run / "kinematics.json", "{");
    const CommandAnswer answer = compare(a, run.string());
    CHECK(answer.code == 3);
    CHECK_THAT(answer.err, Contains("kinematics.json"));
  }
  SECTION("a least change that would hide all") {
    CHECK(compare(a, a, {"--least", "7"}).code == 2);
    CHECK(compare(a, a, {"--least", "-1"}).code == 2);
  }
}

TEST_CASE("what was not compared is on the page, and markup in names is text", "[bench]") {
  analysis::Comparison comparison;
  comparison.only_b = {{605, 50, {0}}};
  comparison.left_out = {{"<b>point 3</b>", "dead"}};
  CompareFacts facts;
  facts.a = "<script>";
  const std::string page = make_compare_page(
      comparison, facts, [](std::size_t, const auto&) { return std::optional<SpectrumPair>(); });
  CHECK_THAT(page, Contains("605 rpm, 50 % load: only in B") &&
                       Contains("&lt;b&gt;point 3&lt;/b&gt;") && !Contains("<script>"));
}

}  // namespace rvbench::bench
