#include <catch2/catch.hpp>
#include <cmath>

#include "tests/hal/foreign_file_builder.hpp"

// Tables as instruments, Excel, pandas, numpy and LabVIEW write them.
namespace rvbench::hal {
namespace {

using Catch::Contains;

// The samples of each writer: a in g at 1 kHz.
const std::vector<double> a_g = {0.3, -0.8367, 1.1944, 1.4268};

Recording read_csv(const std::string& bytes) { return test::recordings_in("a.csv", bytes)[0]; }

// The first rows of a table with a column of time in s and one of a in g; decimal and separator of
// a dialect.
std::string rows(char separator = ',', char decimal = '.') {
  std::string text;
  for (std::size_t i = 0; i < a_g.size(); ++i) {
    std::string line = fmt::format("{:.3f}|{}\n", 0.001 * static_cast<double>(i), a_g[i]);
    for (char& c : line) c = c == '.' ? decimal : c == '|' ? separator : c;
    text += line;
  }
  return text;
}

// As `rows`, with a count of rows in place of the time.
std::string counted(const std::string& separator = ",") {
  std::string text;
  for (std::size_t i = 0; i < a_g.size(); ++i)
    text += fmt::format("{}{}{}\n", i, separator, a_g[i]);
  return text;
}

const Channel& acceleration(const Recording& recording) {
  const auto found = std::ranges::find_if(
      recording.channels, [](const Channel& channel) { return channel.info.unit == "m/s²"; });
  REQUIRE(found != recording.channels.end());
  return *found;
}

void check_samples(const std::string& text) {
  INFO(text);
  const Recording recording = read_csv(text);
  const Channel& channel = acceleration(recording);
  REQUIRE(channel.samples.size() == std::ssize(a_g));
  for (std::size_t i = 0; i < a_g.size(); ++i) {
    CHECK(channel.samples[static_cast<Eigen::Index>(i)] == Approx(a_g[i] * 9.80665).epsilon(1e-12));
  }
  CHECK(channel.rate_Hz == Approx(1000).epsilon(1e-9));
}

std::string utf16(const std::string& text, bool is_little, bool has_mark) {
  std::string out = !has_mark ? "" : is_little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) {
    if (is_little) out += c;
    out += '\0';
    if (!is_little) out += c;
  }
  return out;
}

}  // namespace

TEST_CASE("settings above a table are kept as a note, and give rate and unit", "[hal][formats]") {
  const std::string text = GENERATE(
      "Device,DAQ-9\nSerial,00000\nSample Interval,0.001,s\nChannel,CH1\nUnit,g\n\nIndex,CH1\n" +
          counted(),
      "Model: X1\nSampling Frequency: 1 kHz\nUnits: g\n\nSample;a\n" + counted(";"),
      "Instrument\tQ\nfs =\t1000 Hz\n\nn\ta [g]\n" + counted("\t"),
      "LabVIEW "
      "Measurement\t\nSeparator\tTab\nY_Unit_Label\tg\nX_Dimension\tTime\nDelta_X\t0.001000\n"
      "***End_of_Header***\t\t\nX_Value\tA\tComment\n" +
          rows('\t'));
  check_samples(text);
  CHECK_THAT(read_csv(text).notes.at(0) + read_csv(text).notes.at(1),
             Contains("the table begins at line"));
}

TEST_CASE("settings that contradict each other, or that may mean two things, give no rate",
          "[hal][formats]") {
  for (const char* setting : {"rate,1000\nSample Rate,2000\n", "Sample Rate,\"25,600\"\n",
                              "Sample Interval,0.001\n", "Sample Rate,1000,rpm\n", "rate,0\n"}) {
    CAPTURE(setting);
    CHECK(read_csv(std::string(setting) + "\nn,a [g]\n" + counted()).channels.at(0).rate_Hz == 0);
  }
}

TEST_CASE("comment lines are no samples, and the last may be the head", "[hal][formats]") {
  check_samples("# exported 2024-10-22\n# rate: 1000 Hz\ntime [s],acc [g]\n" + rows());
  check_samples("% time [s], acc [g]\n" + rows());
  check_samples("// by a logger\n// time_s acc_g\n" + rows(' '));
}

TEST_CASE("Excel's first line names the separator", "[hal][formats]") {
  check_samples("\xEF\xBB\xBFsep=;\nTime [s];acc [g]\n" + rows(';', ','));
  check_samples("sep=,\r\nTime [s],acc [g]\r\n" + rows());
  check_samples("sep=\t\nTime [s]\tacc [g]\n" + rows('\t', ','));
}

TEST_CASE("a row of units stands below the names", "[hal][formats]") {
  check_samples("Time,acc\n(s),(g)\n" + rows());
  check_samples("Time;acc\n[s];[g]\n" + rows(';', ','));
  check_samples("Recorder 7\n\nTime\tacc\ns\tg\n\n" + rows('\t'));
}

TEST_CASE("a column that counts the rows is left out", "[hal][formats]") {
  for (const char* head : {",a [g]\n", "Index,a [g]\n", "#,a [g]\n", "a [g],b [V]\n"}) {
    CAPTURE(head);
    const std::string data =
        std::string(head) == "a [g],b [V]\n" ? "1,0.3,5\n2,-0.8367,6\n" : counted();
    const Recording recording = read_csv(head + data);
    CHECK(recording.channels[0].info.name == "a");
    CHECK(recording.channels[0].samples[1] == Approx(a_g[1] * 9.80665));
    CHECK_THAT(recording.notes.at(0), Contains("counts the rows: left out"));
  }
  CHECK(read_csv("speed,a\n1,2\n2,3\n").channels.size() == 2);
}

TEST_CASE("blanks part the cells of a table", "[hal][formats]") {
  const Recording bare =
      test::recordings_in("a.txt", "  1.0e+00   2.5e-01\n -2.0e+00\t 5.0e-01\n")[0];
  CHECK(bare.channels.at(0).samples == Eigen::Vector2d(1, -2));
  CHECK(bare.channels.at(1).samples == Eigen::Vector2d(0.25, 0.5));
  check_samples("time_s acc_g\n" + rows(' '));
  check_samples("# time_s  acc_g\n" + rows(' ', ','));
  CHECK(test::recordings_in("a.txt", "1\n2\n3\n")[0].channels.at(0).samples ==
        Eigen::Vector3d(1, 2, 3));
}

TEST_CASE("dates and times of the rows give the rate and the start", "[hal][formats]") {
  const auto [head, first, rest] = GENERATE(table<std::string, std::string, std::string>({
      {"Date,Time,acc [g]\n", "2026-01-31,10:30:25.", ""},
      {"stamp,acc [g]\n", "2026-01-31T10:30:25.", "Z"},
      {"stamp;acc [g]\n", "2026-01-31 10:30:25,", ""},
      {"stamp,acc [g]\n", "31.01.2026 10:30:25.", ""},
      {"stamp,acc [g]\n", "01/31/2026 10:30:25.", " AM"},
      {"stamp,acc [g]\n", "31-Jan-2026 10:30:25.", ""},
      {"Date Time acc_g\n", "2026-01-31 10:30:25.", ""},
      {"Date\tTime\tacc [g]\n", "31/01/26\t10:30:25.", ""},
  }));
  const char separator = head.find(';') != head.npos    ? ';'
                         : head.find('\t') != head.npos ? '\t'
                         : head.find(',') != head.npos  ? ','
                                                        : ' ';
  std::string text = head;
  for (std::size_t i = 0; i < a_g.size(); ++i) {
    text += fmt::format("{}{:03}{}{}{}\n", first, i, rest, separator, a_g[i]);
  }
  check_samples(text);
  CHECK_THAT(fmt::format("{}", fmt::join(read_csv(text).notes, "\n")),
             Contains("started 2026-01-31T10:30:25"));
}

TEST_CASE("a date that can be read in two ways is asked for", "[hal][formats]") {
  CHECK_THAT(test::complaint_of("a.csv", "d,a\n01/02/2026 10:00:00,1\n01/02/2026 10:00:01,2\n"),
             Contains("01/02/2026 is 1 feb or 2 jan") && Contains("--dates"));
  CHECK(
      read_csv("d,a\n01/01/2026 10:00:00.000,1\n01/01/2026 10:00:00.001,2\n").channels[0].rate_Hz ==
      Approx(1000));
}

TEST_CASE("a time of day goes on over midnight", "[hal][formats]") {
  const Recording recording =
      read_csv("time of day,a\n23:59:59.999,1\n00:00:00.000,2\n00:00:00.001,3\n");
  CHECK(recording.channels.back().rate_Hz == Approx(1000));
}

TEST_CASE("columns of hours, minutes and seconds are time", "[hal][formats]") {
  std::string bare, named = "hour,minute,second,ms,a [g]\n";
  for (int i = 0; i < 20; ++i) {
    bare += fmt::format("9,59,59,{},{}\n", 999900 - 1000 + 50 * i, i % 3);
    named += fmt::format("9,59,{},{},{}\n", 58 + (i + 995) / 1000, (i + 995) % 1000, i % 3);
  }
  CHECK(read_csv(bare).channels.back().rate_Hz == Approx(20000));
  CHECK(read_csv(named).channels.back().rate_Hz == Approx(1000));
  CHECK(read_csv("9,59,59,1,7\n9,59,59,5,8\n9,59,59,6,9\n").channels.size() == 5);  // no clock
}

TEST_CASE("UTF-16 is text as well, with or without its mark", "[hal][formats]") {
  for (const bool is_little : {true, false}) {
    for (const bool has_mark : {true, false}) {
      check_samples(utf16("Time [s],acc [g]\r\n" + rows(), is_little, has_mark));
    }
  }
}

TEST_CASE("a blank cell or NA is a lost sample", "[hal][formats]") {
  for (const char* lost : {"", "NA", "NaN", "null", "#N/A", "-", "inf"}) {
    const Recording recording = read_csv(fmt::format("a,b\n1,5\n{},6\n3,7\n", lost));
    CAPTURE(lost);
    CHECK(std::isnan(recording.channels.at(0).samples[1]));
    CHECK(recording.channels[0].samples[2] == 3);
    CHECK(recording.channels.at(1).samples == Eigen::Vector3d(5, 6, 7));
  }
  CHECK(std::isnan(read_csv("a;b\n1;2\n3;\n").channels.at(1).samples[1]));
  CHECK(read_csv("a,b\n1,\n2,\n").channels.at(1).samples.array().isNaN().all());
  CHECK(read_csv("a,\n1,\n2,\n").channels.size() == 1);
}

TEST_CASE("a row that does not fit is named by its line, below the settings as well",
          "[hal][formats]") {
  CHECK_THAT(test::complaint_of("a.csv", "Device,Q\n\nt [s],a\n0,1\n1,x7\n2,3\n3,4\n"),
             Contains("a.csv: 5:2: \"x7\" is not a number"));
  CHECK_THAT(test::complaint_of("a.csv", "t [s],a\n0,1\n1,2,3\n2,3\n3,4\n"),
             Contains("a.csv: 3: 3 values, not 2"));
  CHECK_THAT(test::complaint_of("a.csv", "Dear colleague,\nplease find attached 3 files.\n"),
             Contains("a.csv: holds no samples: no line of numbers from line 1 on"));
}

TEST_CASE("what a user states of a table overrides what is found", "[hal][formats]") {
  const test::ScratchFolder scratch;
  const auto read = [&](const std::string& bytes, formats::TableHints hints) {
    auto recordings = read_recordings(test::written(scratch, "a.csv", bytes), {.table = hints});
    REQUIRE(recordings);
    return std::move(recordings).value()[0];
  };
  const std::string thousands = "a;b\n1,218;2\n644;2\n";
  CHECK(read(thousands, {.decimal = '.'}).channels[0].samples == Eigen::Vector2d(1218, 644));
  CHECK(read(thousands, {.decimal = ','}).channels[0].samples == Eigen::Vector2d(1.218, 644));
  const std::string ambiguous = "d,a\n01/02/2026 10:00:00.000,1\n01/02/2026 10:00:00.001,2\n";
  const auto start = [&](formats::DateOrder order) {
    return read(ambiguous, {.dates = order}).notes.at(0);
  };
  CHECK_THAT(start(formats::DateOrder::day_month), Contains("started 2026-02-01"));
  CHECK_THAT(start(formats::DateOrder::month_day), Contains("started 2026-01-02"));
  const std::string two_heads = "sensor,7\nchannel,8\n1,2\n3,4\n";
  CHECK(read(two_heads, {.head_line = 2}).channels[0].info.name == "channel");
  CHECK(read("1;2,5\n3;4,5\n", {.separator = ';'}).channels[1].samples ==
        Eigen::Vector2d(2.5, 4.5));
}

}  // namespace rvbench::hal
