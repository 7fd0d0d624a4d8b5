#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "bench/simulated_recording.hpp"
#include "hal/formats/choose_writer.hpp"
#include "hal/formats/read_recordings.hpp"
#include "hal/formats/write_recordings.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Contains;
using rvbench::test::ScratchFolder;
using test::CommandAnswer;

// Two points of a run, with torque and angle.
std::string run_in(const ScratchFolder& scratch) {
  std::vector<Recording> points(2);
  for (int i = 0; i < 2; ++i) {
    Recording& point = points[static_cast<std::size_t>(i)];
    point.planned_speed_rpm = 605;
    point.load_pct = 50.0 * i;
    for (const char* name : {"input_torque", "input_angle"}) {
      point.channels.push_back(
          {{name, "", "", not_known}, 1000, 0, Eigen::VectorXd::LinSpaced(64, 0, i + 1)});
    }
  }
  const auto file = scratch / "recording.h5";
  REQUIRE(write_hdf5(file, points));
  return file.string();
}

std::string table_in(const ScratchFolder& scratch, const std::string& text) {
  const auto file = scratch / "table.csv";
  std::ofstream(file) << text;
  return file.string();
}

// Samples at 2000 Hz under this head, `lost` of them missing in the middle.
std::string timed_in(const ScratchFolder& scratch, const std::string& head, int rows, int lost) {
  std::string text = head;
  for (int i = 0; i < rows + lost; ++i) {
    const bool is_there = i < rows / 2 || i >= rows / 2 + lost;
    if (is_there) text += fmt::format("{},{}\n", i / 2000.0, i % 7);
  }
  return table_in(scratch, text);
}

}  // namespace

TEST_CASE("import makes a point of each recording, with its start from the times",
          "[bench][import]") {
  const ScratchFolder scratch;
  const std::string out = (scratch / "all.h5").string();
  const std::string table = table_in(scratch, "time_s,a [g]\n5,0\n5.5,1\n6,2\n");
  const CommandAnswer answer =
      test::rvbench({"import", table, table, "--speed", "605", "--out", out});
  INFO(answer.err);
  REQUIRE(answer.code == 0);
  CHECK_THAT(answer.out, Contains("all.h5: 2 channels"));
  CHECK_THAT(answer.err, Contains("note: ") && Contains("times 9.80665"));
  const auto read = hal::read_recordings(out);
  REQUIRE(read);
  REQUIRE(read.value().size() == 2);
  const Recording& second = read.value()[1];
  REQUIRE(second.channels.size() == 1);
  CHECK(second.channels[0].info.unit == "m/s²");
  CHECK(second.channels[0].rate_Hz == 2);
  CHECK(second.channels[0].start_s == 5);
  CHECK(second.channels[0].samples[2] == 2 * 9.80665);
  CHECK(second.speed_rpm == 605);
  CHECK(second.status == "ok");

  CHECK(test::rvbench({"import", table, "--out", out}).code == 2);
  CHECK(test::rvbench({"import", table, "--out", out, "--force"}).code == 0);
  CHECK(hal::read_recordings(out).value().size() == 1);
}

TEST_CASE("what is written tells of its source what is true of the source alone",
          "[bench][import][export]") {
  const ScratchFolder scratch;
  const std::string out = (scratch / "all.h5").string(), again = (scratch / "again.h5").string();
  const std::string table =
      table_in(scratch, "time_s;a_mm/s2;a [g];b_mm/s2\n0,0;1;1;1\n0,5;1000;1;2\n1,0;1;1;3\n");
  const CommandAnswer answer = test::rvbench({"import", table, "--rate", "2", "--out", out});
  INFO(answer.err);
  REQUIRE(answer.code == 0);
  CHECK_THAT(answer.err, Contains("a_mm/s2 is called a_2: its values are in m/s²") &&
                             Contains("b_mm/s2 is called b: its values are in m/s²"));
  REQUIRE(test::rvbench({"export", out, "--to", again}).code == 0);
  for (const std::string& file : {out, again}) {
    const Recording read = hal::read_recordings(file).value().at(0);
    REQUIRE(read.channels.size() == 3);
    CHECK(read.channels[0].info.name == "a_2");
    CHECK(read.channels[0].samples[1] == 1);
    CHECK(read.channels[2].info.name == "b");
    REQUIRE_FALSE(read.notes.empty());
    CHECK(read.notes[0] == "read from " + table + ": numbers have a decimal comma");
    for (const std::string& note : read.notes) {
      CHECK_THAT(note, Catch::StartsWith("read from " + table + ": "));
    }
  }
}

TEST_CASE("import asks for what it must not guess", "[bench][import]") {
  const ScratchFolder scratch;
  const std::string out = (scratch / "out.h5").string();
  const std::string table = table_in(scratch, "a,b\n1,2\n3,4\n");
  const CommandAnswer answer = test::rvbench({"import", table, "--out", out});
  CHECK(answer.code == 20);
  CHECK_THAT(answer.err, Contains("table.csv: a: its sample rate is not known; give it with "
                                  "--rate HZ"));
  CHECK_FALSE(std::filesystem::exists(out));
  CHECK(test::rvbench({"import", table, "--rate", "1000", "--out", out}).code == 0);
  const CommandAnswer ending = test::rvbench({"import", table, "--out", out + ".csv"});
  CHECK(ending.code == 2);
  CHECK_THAT(ending.err, Contains("must end in .h5"));
  const CommandAnswer absent = test::rvbench({"import", table + "x", "--out", out, "--force"});
  CHECK(absent.code == 20);
  CHECK_THAT(absent.err, Contains("no such file"));
  const CommandAnswer nowhere = test::rvbench(
      {"import", table, "--rate", "1000", "--out", (scratch / "none/out.h5").string()});
  CHECK(nowhere.code == 2);
  CHECK_THAT(nowhere.err, Contains("none/out.h5: No such file or directory"));
}

TEST_CASE("rows that miss in a time are not written on as one record, whatever rate is given",
          "[bench][import][export]") {
  const ScratchFolder scratch;
  const auto [head, name] = GENERATE(table<std::string, std::string>(
      {{"time [s],a\n", "time [s]"}, {"t_s,a\n", "t_s"}, {"", "column_1"}}));
  CAPTURE(name);
  const std::string file = timed_in(scratch, head, 800, 20);
  for (const auto& words :
       {std::vector<std::string>{"import", file, "--out", (scratch / "a.h5").string()},
        {"export", file, "--to", (scratch / "a.wav").string()}}) {
    std::vector<std::string> rated = words;
    rated.insert(rated.end(), {"--rate", "2000"});
    for (const auto& asked : {words, rated}) {
      const CommandAnswer answer = test::rvbench(asked);
      CHECK(answer.code == 20);
      CHECK_THAT(answer.err, Contains("table.csv: " + name +
                                      " only rises, as time does, but unevenly: about 20 samples "
                                      "are missing behind its sample 400 (0.1995); part the file"));
    }
  }
  CHECK_FALSE(std::filesystem::exists(scratch / "a.h5"));
  CHECK_FALSE(std::filesystem::exists(scratch / "a.wav"));
}

TEST_CASE("a gap in a time of few rows is one as well", "[bench][import]") {
  const ScratchFolder scratch;
  const std::string out = (scratch / "a.h5").string();
  const auto import = [&](int lost) {
    return test::rvbench({"import", timed_in(scratch, "time [s],a\n", 20, lost), "--rate", "2000",
                          "--out", out, "--force"});
  };
  CHECK_THAT(import(1).err, Contains("samples are missing behind its sample 10 (0.0045)"));
  CHECK(import(0).code == 0);
  CHECK(hal::read_recordings(out).value()[0].channels.size() == 1);
  // Few numbers without a name may rise by chance.
  const std::string nameless = table_in(scratch, "1,2\n2,5\n3,4\n9,1\n");
  CHECK(test::rvbench({"import", nameless, "--rate", "9", "--out", out, "--force"}).code == 0);
}

TEST_CASE("a time that falls is refused at the place", "[bench][export]") {
  const ScratchFolder scratch;
  std::string text = "time [s],a\n";
  for (int i = 0; i < 800; ++i) text += fmt::format("{},{}\n", i % 500, i % 7);
  const CommandAnswer answer = test::rvbench(
      {"export", table_in(scratch, text), "--rate", "1", "--to", (scratch / "a.wav").string()});
  CHECK(answer.code == 20);
  CHECK_THAT(answer.err, Contains("does not only rise: 0 follows 499 in sample 501; part the"));
}

TEST_CASE("what rises unevenly and is no time is written, and told", "[bench][import]") {
  const ScratchFolder scratch;
  const std::string out = (scratch / "a.h5").string();
  const CommandAnswer answer = test::rvbench(
      {"import", timed_in(scratch, "count,a\n", 800, 20), "--rate", "2000", "--out", out});
  CHECK(answer.code == 0);
  CHECK_THAT(answer.err, Contains("note: ") && Contains("count only rises, as time does, but") &&
                             Contains("about 20 samples are missing behind its sample 400"));
  CHECK(hal::read_recordings(out).value()[0].channels.size() == 2);
}

TEST_CASE("what rises in seconds is time under any name, and what rises in radians is told",
          "[bench][import][export]") {
  const ScratchFolder scratch;
  const auto file = scratch / "gap.h5";
  const auto [name, unit, rows] = GENERATE(table<std::string, std::string, int>(
      {{"Timestamp", "s", 400}, {"Zeit", "s", 20}, {"shaft_angle", "rad", 400}}));
  CAPTURE(name, rows);
  Recording recording;
  recording.status = "ok";
  Eigen::VectorXd rising = Eigen::VectorXd::LinSpaced(rows, 0, (rows - 1) / 2000.0);
  rising.tail(rows / 2).array() += 0.01;
  recording.channels = {
      {{"accel_1x", "m/s²", "", not_known}, 2000, 0, Eigen::VectorXd::Random(rows)},
      {{name, unit, "", not_known}, 2000, 0, rising}};
  REQUIRE(hal::write_recordings({recording}, file, *hal::formats::choose_writer(file), false));
  const CommandAnswer answer =
      test::rvbench({"export", file.string(), "--to", (scratch / "a.csv").string()});
  CHECK(answer.code == (unit == "s" ? 20 : 0));
  CHECK_THAT(answer.err, Contains(fmt::format("missing behind its sample {}", rows / 2)) &&
                             Contains(unit == "s" ? "gap.h5" : "note: "));
}

TEST_CASE("export writes all points, or those that are asked for", "[bench][export]") {
  const ScratchFolder scratch;
  const std::string run = run_in(scratch);
  const auto into = [&](const std::string& name, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"export", run, "--to", (scratch / name).string()});
    return test::rvbench(more);
  };
  const CommandAnswer all = into("all.tdms");
  INFO(all.err);
  REQUIRE(all.code == 0);
  CHECK(all.err.empty());  // nothing is lost, nothing is said
  CHECK_THAT(all.out, Contains("all.tdms: 4 channels"));
  CHECK(hal::read_recordings(scratch / "all.tdms").value().size() == 2);

  REQUIRE(into("p.mat").code == 0);
  CHECK(std::filesystem::exists(scratch / "p_000.mat"));
  CHECK(hal::read_recordings(scratch / "p_001.mat").value()[0].load_pct == 50);
  REQUIRE(into("one", {"--format", "mat73", "--point", "1"}).code == 0);
  CHECK(hal::read_recordings(scratch / "one").value()[0].load_pct == 50);

  const CommandAnswer wav = into("p.wav", {"--point", "001"});
  REQUIRE(wav.code == 0);
  CHECK(std::filesystem::exists(scratch / "p.wav"));
  CHECK_THAT(wav.err, Contains("warning: WAV has no place for units: left out"));
  const CommandAnswer absent = into("q.wav", {"--point", "7"});
  CHECK(absent.code == 2);
  CHECK_THAT(absent.err, Contains("has no point 7; it has 000, 001"));
}

TEST_CASE("export refuses what it cannot name or must not replace", "[bench][export]") {
  const ScratchFolder scratch;
  const std::string run = run_in(scratch);
  const CommandAnswer unknown = test::rvbench({"export", run, "--to", "a.xyz"});
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.err, Contains("no ending that says a format") && Contains("uff58b"));
  const CommandAnswer itself = test::rvbench({"export", run, "--to", run, "--force"});
  CHECK(itself.code == 2);
  CHECK_THAT(itself.err, Contains("is what it would be made from"));
  const CommandAnswer into_itself = test::rvbench({"import", run, "--out", run, "--force"});
  CHECK(into_itself.code == 2);
  CHECK_THAT(into_itself.err, Contains("is what it would be made from"));
  const CommandAnswer folder =
      test::rvbench({"export", run, "--to", scratch.path().string(), "--format", "csv"});
  CHECK(folder.code == 2);
  CHECK_THAT(folder.err, Contains("is a folder"));
  const std::string out = (scratch / "a.uff").string();
  REQUIRE(test::rvbench({"export", run, "--point", "0", "--to", out}).code == 0);
  const CommandAnswer again = test::rvbench({"export", run, "--point", "0", "--to", out});
  CHECK(again.code == 2);
  CHECK_THAT(again.err, Contains("a.uff: exists; --force replaces it"));
  CHECK(test::rvbench({"export", run, "--point", "0", "--to", out, "--force"}).code == 0);
}

}  // namespace rvbench::bench
