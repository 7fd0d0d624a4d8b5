#include <sstream>

#include "tests/hal/export_fixture.hpp"
#include "tests/hal/tdms_builder.hpp"
#include "tests/support/real_data.hpp"

// Field by field: against what the formats' descriptions say, and against files of their makers.
namespace rvbench::hal {
namespace {

using test::bytes_in;
using test::data_folder;
using test::exported;
using test::packed;
using test::ScratchFolder;
using test::Tdms;
using test::written_as;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.ends_with('\r')) line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

// The type of the first property of that name; its order of bytes is that of the file.
std::uint32_t property_type(const std::string& bytes, const std::string& name, std::endian order) {
  const std::string length = packed(static_cast<std::uint32_t>(name.size()), order);
  const std::size_t at = bytes.find(length + name);
  REQUIRE(at != bytes.npos);
  std::string code = bytes.substr(at + 4 + name.size(), 4);
  if (order != std::endian::native) code = std::string(code.rbegin(), code.rend());
  std::uint32_t type = 0;
  std::memcpy(&type, code.data(), 4);
  return type;
}

// The header lines of the first data set 58 or 58b, its number first.
std::vector<std::string> header_58(const std::string& bytes) {
  const std::size_t at = bytes.find("    58");
  REQUIRE(at != bytes.npos);
  std::vector<std::string> lines = lines_of(bytes.substr(at, 2000));
  lines.resize(12);
  return lines;
}

// A field of FORTRAN's columns, the first is 1; without blanks.
std::string field(const std::string& line, std::size_t first, std::size_t last) {
  const std::string text = line.substr(std::min(first - 1, line.size()), last - first + 1);
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == text.npos ? "" : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

}  // namespace

TEST_CASE("TDMS: one segment, byte by byte", "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  recording.channels.resize(1);
  recording.channels[0].info.name = "it's";
  recording.channels[0].samples = Eigen::Vector2d(1.5, -2);
  written_as("tdms", scratch / "a.tdms", {recording});

  const Tdms tdms;
  const std::string start = tdms.text("wf_start_time") + packed(0x44U) + packed(std::uint64_t{0}) +
                            packed(std::int64_t{1476442277LL + 2082844800LL});
  const std::string expected = tdms.segment(
      {tdms.object("/", tdms.no_index()),
       tdms.object("/'recording'", tdms.no_index(),
                   {tdms.property("load_pct", 50.0), tdms.property("planned_speed_rpm", 605.0),
                    tdms.property("repeat", 2.0), tdms.property("speed_rpm", 604.5),
                    tdms.property("torque_Nm", 1.25), tdms.property("rvbench_status", "ok"),
                    tdms.property("start_time", "2016-10-14T10:51:17.000000Z")}),
       tdms.object(
           "/'recording'/'it''s'", tdms.index(9, 2),
           {start, tdms.property("wf_start_offset", 2.5), tdms.property("wf_increment", 1.0 / 5000),
            tdms.property("wf_samples", 2), tdms.property("wf_xname", "Time"),
            tdms.property("wf_xunit_string", "s"), tdms.property("unit_string", "m/s²"),
            tdms.property("sensitivity", 0.0125), tdms.property("direction", "-Y")})},
      packed(1.5F) + packed(-2.0F));
  CHECK(bytes_in(scratch / "a.tdms") == expected);
}

TEST_CASE("TDMS: properties of a waveform have the types that LabVIEW gives them",
          "[hal][formats][export][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const ScratchFolder scratch;
  written_as("tdms", scratch / "a.tdms", {exported()});
  const std::string ours = bytes_in(scratch / "a.tdms");
  const std::string real = bytes_in(*folder / "tdms/big_endian.tdms");
  for (const char* name : {"wf_start_time", "wf_start_offset", "wf_increment", "wf_samples",
                           "wf_xname", "wf_xunit_string"}) {
    CAPTURE(name);
    CHECK(property_type(ours, name, std::endian::little) ==
          property_type(real, name, std::endian::big));
  }
  const std::string digital = bytes_in(*folder / "tdms/Digital_Input.tdms");
  CHECK(property_type(ours, "unit_string", std::endian::little) ==
        property_type(digital, "unit_string", std::endian::little));
}

TEST_CASE("UFF 58: each line as its definition says", "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  recording.channels[0].samples = Eigen::VectorXd::LinSpaced(5, 1.5, -2.5);
  recording.channels[1].samples = Eigen::VectorXd::LinSpaced(5, 0, 1);
  written_as("uff58", scratch / "a.uff", {recording});
  const std::vector<std::string> lines = lines_of(bytes_in(scratch / "a.uff"));
  const std::vector<std::string> expected = {
      "    -1",
      "   164",
      "         1SI: Meter (newton)           2",
      "  1.0000000000000000D+00  1.0000000000000000D+00  1.0000000000000000D+00",
      "  2.7315000000000000D+02",
      "    -1",
      "    -1",
      "    58",
      "accel_1x",
      "NONE",
      "14-Oct-16 10:51:17",
      "speed_rpm=604.5 load_pct=50 torque_Nm=1.25 repeat=2 planned_speed_rpm=605",
      "rvbench_status=ok",
      "    1         0    0         0 accel_1x           0  -2 NONE               0   0",
      "         4         5         1 2.500000E+00 2.000000E-04 0.000000E+00",
      "        17    0    0    0 Time                 s                   ",
      "        12    1    0    0 NONE                 m/s^2               ",
      "         0    0    0    0 NONE                 NONE                ",
      "         0    0    0    0 NONE                 NONE                ",
      "  1.500000000000E+00  5.000000000000E-01 -5.000000000000E-01 -1.500000000000E+00",
      " -2.500000000000E+00",
      "    -1",
      "    -1",
      "    58",
      "input_torque"};
  REQUIRE(lines.size() > expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(lines[i] == expected[i]);
  }
  // A name of more than ten letters stands in the text alone.
  CHECK(lines[29].substr(31, 10) == "NONE      ");
  CHECK(test::read_back(scratch / "a.uff")[0].find("input_torque") != nullptr);
}

TEST_CASE("UFF 58b: a record of a logger, read and written anew, has the same fields",
          "[hal][formats][export][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const ScratchFolder scratch;
  const auto file = *folder / "uff/MPSTD#Set001_2024_10_08_10_27_07.uff";
  const std::vector<Recording> read = test::read_back(file);
  written_as("uff58b", scratch / "a.uff", {read.at(0)});
  const std::vector<std::string> ours = header_58(bytes_in(scratch / "a.uff"));
  const std::vector<std::string> real = header_58(bytes_in(file));
  const auto agree = [&](std::size_t line, std::size_t first, std::size_t last) {
    CAPTURE(line, first);
    CHECK(field(ours[line], first, last) == field(real[line], first, last));
  };
  agree(0, 1, 7);                                               // 58b
  agree(0, 8, 13);                                              // little endian
  agree(0, 14, 19);                                             // IEEE 754
  agree(0, 20, 31);                                             // lines of text before the bytes
  CHECK(field(ours[0], 32, 43) == std::to_string(2 * 889600));  // doubles
  agree(3, 1, 18);                                              // the date
  agree(6, 1, 5);                                               // a time response
  agree(6, 52, 55);                                             // direction of the response
  agree(6, 77, 80);                                             // of the reference: none
  agree(7, 11, 20);                                             // how many values
  agree(7, 21, 30);                                             // evenly spaced
  CHECK(std::stod(field(ours[7], 31, 43)) == std::stod(field(real[7], 31, 43)));
  CHECK(std::stod(field(ours[7], 44, 56)) == std::stod(field(real[7], 44, 56)));
  agree(8, 1, 10);   // time
  agree(8, 27, 46);  // its name
  agree(8, 48, 67);  // its unit
  agree(9, 1, 10);   // acceleration
  for (std::size_t line : {10u, 11u}) {
    agree(line, 1, 10);
    agree(line, 27, 46);
    agree(line, 48, 67);
  }
  const Recording again = test::read_back(scratch / "a.uff").at(0);
  REQUIRE(again.channels.size() == read[0].channels.size());
  CHECK(again.channels[3].samples == read[0].channels[3].samples);
  CHECK(again.channels[3].info.unit == "m/s²");
}

TEST_CASE("WAV: floating point of 32 bits, with its count of samples", "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  for (Channel& channel : recording.channels) channel.samples = Eigen::Vector2d(1.5, -2);
  written_as("wav", scratch / "a.wav", {recording});
  const std::string format = packed(std::uint16_t{3}) + packed(std::uint16_t{2}) + packed(5000U) +
                             packed(40000U) + packed(std::uint16_t{8}) + packed(std::uint16_t{32}) +
                             packed(std::uint16_t{0});
  const std::string data = packed(1.5F) + packed(1.5F) + packed(-2.0F) + packed(-2.0F);
  const std::string chunks = test::riff_chunk("fmt ", format) +
                             test::riff_chunk("fact", packed(2U)) + test::riff_chunk("data", data);
  CHECK(bytes_in(scratch / "a.wav") ==
        "RIFF" + packed(static_cast<std::uint32_t>(chunks.size() + 4)) + "WAVE" + chunks);
}

TEST_CASE("CSV: time, and heads with units", "[hal][formats][export]") {
  const ScratchFolder scratch;
  Recording recording = exported();
  recording.channels[0].info.name = "a, \"b\"";
  for (Channel& channel : recording.channels) {
    channel.rate_Hz = 2;
    channel.samples = Eigen::Vector2d(0.1, not_known);
  }
  written_as("csv", scratch / "a.csv", {recording});
  CHECK(bytes_in(scratch / "a.csv") ==
        "time_s,\"a, \"\"b\"\" [m/s²]\",input_torque [N·m]\n2.5,0.1,0.1\n3,nan,nan\n");
}

}  // namespace rvbench::hal
