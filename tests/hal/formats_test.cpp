#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "hal/formats/printable.hpp"
#include "hal/formats/read_recordings.hpp"
#include "tests/hal/mat5_builder.hpp"
#include "tests/hal/recording_fixture.hpp"
#include "tests/support/this_build.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::ScratchFolder;

std::filesystem::path written(const ScratchFolder& scratch, const std::string& name,
                              const std::string& bytes) {
  std::ofstream(scratch / name, std::ios::binary) << bytes;
  return scratch / name;
}

// What is said about a file that must be refused; the text of the error.
std::string complaint(const std::filesystem::path& file) {
  const auto read = read_recordings(file);
  REQUIRE_FALSE(read);
  CHECK_THAT(read.error().where, Contains(file.filename().string()));
  return read.error().where;
}

}  // namespace

TEST_CASE("a CSV file is one recording, a channel per column, of unknown rate", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto file = written(scratch, "a.csv", "a1, \"a2\"\r\n1.5,-2e3\r\n+2,NaN\r\n\r\n");
  const auto read = read_recordings(file);
  REQUIRE(read);
  REQUIRE(read.value().size() == 1);
  const Recording& recording = read.value()[0];
  CHECK(recording.source == file.string());
  CHECK(recording.status == "ok");
  CHECK(std::isnan(recording.speed_rpm));
  REQUIRE(recording.channels.size() == 2);
  CHECK(recording.channels[0].info.name == "a1");
  CHECK(recording.channels[1].info.name == "a2");
  CHECK(recording.channels[0].rate_Hz == 0);
  CHECK(recording.channels[0].samples == Eigen::Vector2d(1.5, 2));
  CHECK(recording.channels[1].samples[0] == -2000);
  CHECK(std::isnan(recording.channels[1].samples[1]));
}

TEST_CASE("CSV dialects: semicolons, no header, a separator at the line's end", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto semicolons = read_recordings(written(scratch, "s.csv", "a;b\n1;2\n3;4\n"));
  REQUIRE(semicolons);
  CHECK(semicolons.value()[0].channels[1].samples == Eigen::Vector2d(2, 4));
  const auto headless = read_recordings(written(scratch, "h.csv", "1,2\n3,4"));
  REQUIRE(headless);
  CHECK(headless.value()[0].channels[0].info.name == "column_1");
  CHECK(headless.value()[0].channels[0].samples == Eigen::Vector2d(1, 3));
  const auto trailing = read_recordings(written(scratch, "t.csv", "\"V1\",\"V2\",\n1,2,\n3,4,\n"));
  REQUIRE(trailing);
  CHECK(trailing.value()[0].channels.size() == 2);
}

TEST_CASE("a bad CSV file is refused with the place of its fault", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto said = [&](const std::string& bytes) {
    return complaint(written(scratch, "bad.csv", bytes));
  };
  CHECK_THAT(said("a,b\n1,2\n3\n"), Contains("bad.csv: 3: 1 values, not 2"));
  CHECK_THAT(said("a,b\n1,2\n3,4,5\n"), Contains("3: 3 values, not 2"));
  CHECK_THAT(said("a,b\n1,2\n3,x7\n"), Contains("3:2: \"x7\" is not a number"));
  CHECK_THAT(said("a,b\n1e999,1\n"), Contains("2:1: \"1e999\" is not a number"));
  CHECK_THAT(said("a,b\n"), Contains("bad.csv: holds no samples"));
  CHECK_THAT(said("a,a\n1,2\n"), Contains("1:2: channel \"a\" is there twice"));
  CHECK_THAT(said("a,,b\n1,2,3\n"), Contains("1:2: a channel without name"));
  CHECK_THAT(said(std::string("a,b\n1,\0\n", 8)), Contains("2: not text"));
  CHECK_THAT(said("a,b\n1,\xFF\n1,2\n"), Contains("2:2: \"?\" is not a number"));
  CHECK_THAT(said("a,b\nx,y\n"),
             Contains("holds no samples: no line of numbers from line 1 on: \"a,b\""));
}

TEST_CASE("what is no readable file is refused", "[hal][formats]") {
  const ScratchFolder scratch;
  CHECK_THAT(complaint(scratch / "none.csv"), Contains("no such file"));
  CHECK_THAT(complaint(written(scratch, "empty.mat", "")), Contains("is empty"));
  std::filesystem::create_directory(scratch / "folder.csv");
  CHECK_THAT(complaint(scratch / "folder.csv"), Contains("is a folder"));
  CHECK_THAT(complaint(written(scratch, "x.bin", std::string("\x01\x02\0\x03", 4))),
             Contains("no known format"));
  if (::geteuid() != 0) {
    const auto file = written(scratch, "secret.csv", "a,b\n1,2\n");
    std::filesystem::permissions(file, std::filesystem::perms::none);
    CHECK_THAT(complaint(file), Contains("Permission denied"));
  }
}

TEST_CASE("what is no recording is told by what it looks like, whatever it is called",
          "[hal][formats]") {
  const ScratchFolder scratch;
  const auto said = [&](const char* name, const std::string& bytes) {
    return complaint(written(scratch, name, bytes));
  };
  CHECK_THAT(said("a.xlsx", "PK\x03\x04 rest"),
             Contains("Excel: unpack it, or save the table as CSV"));
  CHECK_THAT(said("a.csv", "PK\x03\x04 rest"), Contains("Excel"));
  CHECK_THAT(said("a.csv.gz", "\x1F\x8B rest"), Contains("packed by gzip"));
  CHECK_THAT(said("a.npy", "\x93NUMPY"), Contains("an array of NumPy"));
  CHECK_THAT(said("a.tdms_index", "TDSh"), Contains("take the .tdms beside it"));
}

TEST_CASE("hints go before the file, and a note tells", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto file = written(scratch, "a.csv", "a,b\n1,2\n");
  const auto read = read_recordings(file, {.rate_Hz = 12000, .speed_rpm = 1797});
  REQUIRE(read);
  CHECK(read.value()[0].channels[1].rate_Hz == 12000);
  CHECK(read.value()[0].speed_rpm == 1797);
  CHECK(read.value()[0].notes.empty());

  const auto mat = written(scratch, "a.mat",
                           test::mat5_file({test::mat5_array("x", 3, 1, {1, 2, 3}),
                                            test::mat5_array("XRPM", 1, 1, {1772})}));
  const auto corrected = read_recordings(mat, {.speed_rpm = 1750});
  REQUIRE(corrected);
  CHECK(corrected.value()[0].speed_rpm == 1750);
  REQUIRE(corrected.value()[0].notes.size() == 2);
  CHECK_THAT(corrected.value()[0].notes[1], Contains("1772"));
  const auto rounded = read_recordings(mat, {.speed_rpm = 1775});  // within 1 %
  REQUIRE(rounded);
  CHECK(rounded.value()[0].speed_rpm == 1775);
  CHECK(rounded.value()[0].notes.size() == 1);

  CHECK_THROWS_AS(read_recordings(file, {.rate_Hz = 0}), std::invalid_argument);
  CHECK_THROWS_AS(read_recordings(file, {.speed_rpm = -5}), std::invalid_argument);
}

TEST_CASE("MAT v5: the longer side of an array is time", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto read = read_recordings(
      written(scratch, "a.mat",
              test::mat5_file({test::mat5_array("wide", 2, 3, {1, 10, 2, 20, 3, 30}),
                               test::mat5_array("fs", 1, 1, {25600})})));
  REQUIRE(read);
  const Recording& recording = read.value()[0];
  REQUIRE(recording.channels.size() == 2);
  CHECK(recording.channels[0].info.name == "wide_1");
  CHECK(recording.channels[1].samples == Eigen::Vector3d(10, 20, 30));
  CHECK(recording.channels[0].rate_Hz == 25600);
  CHECK(std::isnan(recording.speed_rpm));
}

TEST_CASE("MAT v5: rates that contradict each other are not taken", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto read = read_recordings(written(
      scratch, "a.mat",
      test::mat5_file({test::mat5_array("x", 2, 1, {1, 2}), test::mat5_array("fs", 1, 1, {25600}),
                       test::mat5_array("SampFreq", 1, 1, {256000})})));
  REQUIRE(read);
  CHECK(read.value()[0].channels[0].rate_Hz == 0);
  CHECK_THAT(read.value()[0].notes.back(), Contains("neither is taken"));
}

TEST_CASE("MAT v5: of a variable that is there twice, zeros only are left out", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto zeros = test::mat5_array("Data1", 1, 3, {0, 0, 0});
  const auto data = test::mat5_array("Data1", 1, 3, {1, 2, 3});
  const auto twice = read_recordings(written(scratch, "twice.mat", test::mat5_file({zeros, data})));
  REQUIRE(twice);
  REQUIRE(twice.value()[0].channels.size() == 1);
  CHECK(twice.value()[0].channels[0].samples == Eigen::Vector3d(1, 2, 3));
  CHECK_THAT(twice.value()[0].notes.at(0), Contains("Data1 is there more than once"));

  const auto both = read_recordings(written(scratch, "both.mat", test::mat5_file({data, data})));
  REQUIRE(both);
  REQUIRE(both.value()[0].channels.size() == 2);
  CHECK(both.value()[0].channels[1].info.name == "Data1_2");
  const auto silent = read_recordings(written(scratch, "z.mat", test::mat5_file({zeros, zeros})));
  REQUIRE(silent);
  CHECK(silent.value()[0].channels.size() == 2);
}

TEST_CASE("a bad MAT file is refused with the variable of its fault", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto said = [&](const std::string& bytes) {
    return complaint(written(scratch, "bad.mat", bytes));
  };
  const std::string good = test::mat5_array("x", 3, 1, {1, 2, 3});
  CHECK_THAT(said("MATLAB"), Contains("shorter than the header"));
  CHECK_THAT(said(std::string(200, 'x')), Contains("not a MAT v5 file"));
  CHECK_THAT(said(test::mat5_file({})), Contains("holds no samples"));
  CHECK_THAT(said(test::mat5_file({test::mat5_array("x", 1, 1, {4})})),
             Contains("holds no samples"));
  CHECK_THAT(said(test::mat5_file({good}).substr(0, 190)),
             Contains("variable at byte 128: claims"));
  CHECK_THAT(said(test::mat5_file({good, test::mat5_array("y", 250'000'000, 1, {1, 2, 3})})),
             Contains("y: has 3 values, its size says 250000000"));
  CHECK_THAT(said(test::mat5_file({test::mat5_array("y", -1, 1, {1})})),
             Contains("y: has a negative size"));
  CHECK_THAT(said(test::mat5_file({test::mat5_array("y", 300, 300, std::vector<double>(90000))})),
             Contains("y: 300 x 300 is no set of signals"));
}

TEST_CASE("MAT v5: an array of complex numbers is told as such", "[hal][formats]") {
  const ScratchFolder scratch;
  const std::string complex = test::mat5_complex_array("y", {1, 2, 3}, {0, 1, 0});
  CHECK_THAT(complaint(written(scratch, "y.mat", test::mat5_file({complex}))),
             Contains("holds no samples; y is complex, as no vibration is"));
  const auto both = read_recordings(written(
      scratch, "xy.mat", test::mat5_file({test::mat5_array("x", 3, 1, {1, 2, 3}), complex})));
  REQUIRE(both);
  REQUIRE(both.value()[0].channels.size() == 1);
  REQUIRE(both.value()[0].notes.size() == 1);
  CHECK_THAT(both.value()[0].notes[0], Contains("y is complex"));
}

TEST_CASE("MAT v5: what is not needed is listed, and loses nothing", "[hal][formats]") {
  const ScratchFolder scratch;
  const std::string acc = test::mat5_array("acc", 3, 1, {1, 2, 3});
  const auto notes_beside = [&](const std::string& other) {
    const auto read = read_recordings(written(
        scratch, "a.mat", test::mat5_file({other, acc, test::mat5_array("fs", 1, 1, {1000})})));
    if (!read) FAIL(read.error().where);
    REQUIRE(read.value()[0].channels.size() == 1);
    CHECK(read.value()[0].channels[0].samples == Eigen::Vector3d(1, 2, 3));
    CHECK(read.value()[0].channels[0].rate_Hz == 1000);
    return read.value()[0].notes.back();
  };
  const std::string one = test::mat5_array("", 1, 1, {7});
  const std::string empty = test::mat5_element(14, "");
  CHECK(notes_beside(test::mat5_text("title", "m/s\xC2\xB2", 4)) == "left out: title (text)");
  CHECK_THAT(notes_beside(test::mat5_text("title", "m/s\xC2\xB2", 5)),
             Contains("left out: title (text of another length"));
  CHECK_THAT(notes_beside(test::mat5_structure("s", 2, {"k"}, {one})), Contains("rate_Hz from fs"));
  CHECK(notes_beside(test::mat5_structure("s", 2, {"a", "b"}, {one, acc})) ==
        "left out: s.b (in a structure)");
  CHECK(notes_beside(test::mat5_variable(1, "c", one + empty, 2)) == "left out: c (cell array)");
  CHECK(notes_beside(test::mat5_variable(16, "f", one)) == "left out: f (function handle)");
  CHECK(notes_beside(test::mat5_structure("s", 8, {"f"}, {test::mat5_variable(16, "", one)})) ==
        "left out: s.f (function handle)");
  const std::string bytes(8, '\1');
  CHECK(notes_beside(test::mat5_variable(0x200 + 9, "on", test::mat5_element(2, bytes), 8)) ==
        "left out: on (logical values)");
}

TEST_CASE("MAT v5: a structure that holds the record is opened", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto structure = [](const std::string& name, std::vector<double> samples, double rate) {
    const int count = static_cast<int>(samples.size());
    return test::mat5_structure(
        name, 8, {"sr", "gs", "load", "edges"},
        {test::mat5_array("", 1, 1, {rate}), test::mat5_array("", count, 1, samples),
         test::mat5_array("", 1, 1, {270}), test::mat5_array("", 1, 2, {0, 1})});
  };
  const auto one = read_recordings(
      written(scratch, "a.mat", test::mat5_file({structure("bearing", {1, 2, 3}, 1000)})));
  REQUIRE(one);
  REQUIRE(one.value().size() == 1);
  REQUIRE(one.value()[0].channels.size() == 1);
  CHECK(one.value()[0].channels[0].info.name == "bearing.gs");
  CHECK(one.value()[0].channels[0].rate_Hz == 1000);
  CHECK(one.value()[0].channels[0].samples == Eigen::Vector3d(1, 2, 3));
  CHECK(one.value()[0].notes.back() == "left out: bearing.edges (shorter than the record)");

  const auto two = read_recordings(written(
      scratch, "b.mat",
      test::mat5_file({structure("run1", {1, 2, 3}, 1000), structure("run2", {4, 5, 6}, 2000)})));
  REQUIRE(two);
  REQUIRE(two.value().size() == 2);
  CHECK_THAT(two.value()[1].source, Contains("b.mat#run2"));
  CHECK(two.value()[1].channels[0].rate_Hz == 2000);
  CHECK(two.value()[1].channels[0].samples == Eigen::Vector3d(4, 5, 6));
}

TEST_CASE("MAT v5: arrays of two speeds are two points", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto read =
      read_recordings(written(scratch, "a.mat",
                              test::mat5_file({test::mat5_array("X098_DE_time", 3, 1, {1, 2, 3}),
                                               test::mat5_array("X099_DE_time", 2, 1, {4, 5}),
                                               test::mat5_array("X098RPM", 1, 1, {1797}),
                                               test::mat5_array("X099RPM", 1, 1, {1772})})));
  REQUIRE(read);
  REQUIRE(read.value().size() == 2);
  CHECK(read.value()[0].speed_rpm == 1797);
  CHECK(read.value()[1].speed_rpm == 1772);
  CHECK(read.value()[1].channels.at(0).samples == Eigen::Vector2d(4, 5));
}

TEST_CASE("HDF5 still says why after a MAT file was read", "[hal][formats]") {
  const ScratchFolder scratch;
  const auto mat =
      written(scratch, "a.mat", test::mat5_file({test::mat5_array("x", 2, 1, {1, 2})}));
  REQUIRE(read_recordings(mat));
  const auto made = RecordingWriter::create(scratch / "none/r.h5", test::layout_of(1, 1));
  REQUIRE_FALSE(made);
  CHECK_THAT(made.error().where, Contains("create: No such file or directory"));
}

TEST_CASE("rvbench's own recordings come through the same door", "[hal][formats]") {
  const ScratchFolder scratch;
  {
    const auto made = RecordingWriter::create(scratch / "r.h5", test::layout_of(3, 2));
    REQUIRE(made);
    REQUIRE(made.value()->append(1, test::acceleration_block(0, 0, 50, 2)));
    REQUIRE(made.value()->end_point({1, 0, "ok", 604, 2}));
  }
  const auto read = read_recordings(scratch / "r.h5");
  REQUIRE(read);
  REQUIRE(read.value().size() == 1);  // the points never begun hold nothing
  CHECK(read.value()[0].source == (scratch / "r.h5").string() + "#001");
  CHECK(read.value()[0].speed_rpm == 604);
  CHECK(read.value()[0].find("accel_1")->rate_Hz == 4960);
}

TEST_CASE("a damaged heap of texts in an HDF5 file is refused, not followed", "[hal][formats]") {
  const std::string corpus = (test::source_dir() / "tests/fuzz/corpus/recording/").string();
  CHECK(read_recordings(corpus + "tiny.h5"));  // texts of variable length, as h5py writes them
  const auto read = read_recordings(corpus + "heap_of_texts.h5");
  REQUIRE_FALSE(read);
  CHECK_THAT(describe(read.error()), Contains("heap_of_texts.h5: ") &&
                                         Contains("damaged: a heap of texts at byte ") &&
                                         Contains("holds more than it has room for"));
}

TEST_CASE("foreign text is made printable", "[hal][formats]") {
  using formats::printable;
  CHECK(printable("m/s²") == "m/s²");
  CHECK(printable("a\nb") == "a?b");
  CHECK(printable("\xB2") == "?");
  CHECK(printable("\xC0\x80") == "??");       // overlong
  CHECK(printable("\xED\xA0\x80") == "???");  // a surrogate
  CHECK(printable("\xF0\x9F\x94\xA9") == "🔩");
  CHECK(printable("\xF0\x9F") == "??");  // cut off
}

}  // namespace rvbench::hal
