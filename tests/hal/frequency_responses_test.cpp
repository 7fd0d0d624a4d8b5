#include <catch2/catch.hpp>
#include <cmath>

#include "hal/formats/read_frequency_responses.hpp"
#include "hal/formats/read_recordings.hpp"
#include "tests/hal/foreign_file_builder.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::ScratchFolder;
using test::Uff58;
using test::uff_set;
using test::written;
using Complex = std::complex<double>;

std::vector<FrequencyResponse> read(const std::string& bytes) {
  const ScratchFolder scratch;
  auto responses = read_frequency_responses(written(scratch, "a.uff", bytes));
  if (!responses) FAIL(responses.error().where);
  return std::move(responses).value();
}

FrequencyResponse read_one(const std::string& bytes) {
  const auto responses = read(bytes);
  REQUIRE(responses.size() == 1);
  return responses[0];
}

std::string complaint(const std::string& bytes) {
  const ScratchFolder scratch;
  const auto responses = read_frequency_responses(written(scratch, "bad.uff", bytes));
  REQUIRE_FALSE(responses);
  CHECK_THAT(responses.error().where, Contains("bad.uff: "));
  return responses.error().where;
}

bool has_note(const FrequencyResponse& response, const std::string& what) {
  for (const std::string& note : response.notes) {
    if (note.find(what) != std::string::npos) return true;
  }
  return false;
}

Uff58 accelerance() {
  Uff58 set;
  set.first = 5;
  set.step = 0.25;
  set.values = "  1.00000E+00 -2.00000E+00  3.00000E+00  4.50000E-01";
  return set;
}

// A response as LMS Test.Lab exports it, `header` added to what is needed.
std::string lms(const std::string& header, const std::string& table) {
  return "X axis quantity\tFrequency\t\t\t\nX axis unit\tHz\t\t\t\nValue type\tComplex\t\t\t\n" +
         header + table;
}
const std::string lms_table =
    " 0.0\t 1.5\t -2.0\t\t\n 0.5\t 2.5\t 0.25\t\t\n 1.0\t -1e-3\t 0\t\t\n";

}  // namespace

TEST_CASE("a universal file tells places, directions, units and lines", "[hal][formats]") {
  const FrequencyResponse response = read_one(accelerance().ascii());
  CHECK(response.response == DegreeOfFreedom{"3", "+Z"});
  CHECK(response.excitation == DegreeOfFreedom{"10", "-Z"});
  CHECK(response.response_unit == "m/s²");
  CHECK(response.excitation_unit == "N");
  CHECK(response.first_Hz == 5);
  CHECK(response.step_Hz == 0.25);
  REQUIRE(response.values.size() == 2);
  CHECK(response.values[0] == Complex(1, -2));
  CHECK(response.values[1] == Complex(3, 0.45));
  CHECK(response.coherence.size() == 0);
  CHECK_THAT(response.source, Contains("a.uff: 58 at line 2"));
  CHECK(has_note(response, "title"));
}

TEST_CASE("codes of directions: 4 is about +X, -6 about -Z, 0 none", "[hal][formats]") {
  Uff58 set = accelerance();
  set.response_direction = 4;
  set.reference_direction = -6;
  set.response = "Hub";
  CHECK(read_one(set.ascii()).response == DegreeOfFreedom{"Hub:3", "+RX"});
  CHECK(read_one(set.ascii()).excitation == DegreeOfFreedom{"10", "-RZ"});
  set.response_direction = 0;
  set.response_node = 0;
  CHECK(read_one(set.ascii()).response == DegreeOfFreedom{"Hub", ""});
}

TEST_CASE("values come in SI, whatever the file's unit, with a note", "[hal][formats]") {
  Uff58 set = accelerance();
  const auto first = [&](const std::string& over, const std::string& under) {
    set.over_unit = over;
    set.under_unit = under;
    const FrequencyResponse response = read_one(set.ascii());
    CHECK(has_note(response, "values of the file times"));
    return response.values[0].real();
  };
  CHECK(first("g", "N") == Approx(9.80665));
  CHECK(first("mm/s^2", "N") == Approx(1e-3));
  CHECK(first("m/s2", "lbf") == Approx(1 / 4.4482216152605));
  CHECK(first("in/sec^2", "lbf") == Approx(0.0254 / 4.4482216152605));
  CHECK(first("g/N", "NONE") == Approx(9.80665));
  CHECK(first("mm/s", "kN") == Approx(1e-6));
  CHECK(first("\xB5m", "N") == Approx(1e-6));  // Latin-1
}

TEST_CASE("without a spelt unit the quantity and data set 164 say it", "[hal][formats]") {
  Uff58 set = accelerance();
  set.over_unit = set.under_unit = "NONE";
  const std::string mm = uff_set(164,
                                 "         5mm (milli-newton)            2\n"
                                 "  1.00000000000000000D+03  1.00000000000000000D+03"
                                 "  1.00000000000000000D+00\n  2.7315D+02\n");
  const FrequencyResponse stated = read_one(mm + set.ascii());
  CHECK(stated.response_unit == "m/s²");
  CHECK(stated.excitation_unit == "N");
  CHECK(stated.values[0].real() == Approx(1));  // mm/s² per mN
  const FrequencyResponse unknown = read_one(set.ascii());
  CHECK(unknown.response_unit.empty());
  CHECK(has_note(unknown, "units not known"));
  CHECK(unknown.values[0] == Complex(1, -2));
}

TEST_CASE("58b: both orders of bytes, both lengths give the same numbers", "[hal][formats]") {
  const std::vector<double> numbers = {1, -2, 3, 0.45};
  for (const int order : {1, 2}) {
    const auto endian = order == 1 ? std::endian::little : std::endian::big;
    Uff58 single = accelerance(), twice = accelerance();
    single.values = twice.values = "";
    twice.data_type = 6;
    for (const double number : numbers) {
      single.values += test::packed(static_cast<float>(number), endian);
      twice.values += test::packed(number, endian);
    }
    CHECK(read_one(single.binary(order)).values[1].imag() == Approx(0.45).epsilon(1e-7));
    CHECK(read_one(twice.binary(order)).values[1] == Complex(3, 0.45));
    CHECK_THAT(complaint(twice.binary(order, 1)), Contains("VAX floating point is not read"));
    CHECK_THAT(complaint(twice.binary(order, 3)), Contains("IBM floating point"));
  }
  Uff58 set = accelerance();
  CHECK_THAT(complaint(set.binary(7)), Contains("byte order 7"));
}

TEST_CASE("binary values that look like a line of a universal file do no harm", "[hal][formats]") {
  Uff58 set = accelerance();
  set.declared = 2;
  set.values = "\n    -1\n        ";  // 16 bytes: two complex values
  REQUIRE(set.values.size() == 16);
  CHECK(read(set.binary(1) + set.binary(1)).size() == 2);
}

TEST_CASE("a coherence goes to the response of its degrees of freedom", "[hal][formats]") {
  Uff58 other = accelerance(), coherence = accelerance();
  other.reference_node = 11;
  coherence.type = 6;
  coherence.data_type = 2;
  coherence.values = "  9.90000E-01  5.00000E-01";
  const auto responses = read(coherence.ascii() + other.ascii() + accelerance().ascii());
  REQUIRE(responses.size() == 2);
  CHECK(responses[0].coherence.size() == 0);
  CHECK(responses[1].coherence == Eigen::Vector2d(0.99, 0.5));

  coherence.reference_node = 99;
  const FrequencyResponse alone = read_one(accelerance().ascii() + coherence.ascii());
  CHECK(alone.coherence.size() == 0);
  CHECK(has_note(alone, "a coherence of none that is here"));
  coherence.reference_node = 10;
  coherence.values = "  9.90000E-01  1.50000E+00";
  CHECK(has_note(read_one(accelerance().ascii() + coherence.ascii()), "not within 0 to 1"));
}

TEST_CASE("frequencies given one by one are taken if they rise evenly", "[hal][formats]") {
  Uff58 set = accelerance();
  set.is_even = false;
  set.declared = 3;
  set.values = " 2.0 1.0 0.0 2.5 2.0 0.0 3.0 3.0 0.5";
  const FrequencyResponse even = read_one(set.ascii());
  CHECK(even.first_Hz == 2);
  CHECK(even.step_Hz == 0.5);
  CHECK(even.values[2] == Complex(3, 0.5));
  set.values = " 2.0 1.0 0.0 2.5 2.0 0.0 3.5 3.0 0.5";
  CHECK_THAT(complaint(set.ascii()), Contains("frequencies rise unevenly"));
}

TEST_CASE("a frequency in rad/s is one in Hz times 2 pi, a time is none", "[hal][formats]") {
  Uff58 set = accelerance();
  set.abscissa_unit = "rad/s";
  CHECK(read_one(set.ascii()).first_Hz == Approx(5 / 6.283185307).epsilon(1e-9));
  for (const char* unit : {"s", "orders"}) {
    set.abscissa = 0;
    set.abscissa_unit = unit;
    CHECK_THAT(complaint(set.ascii()), Contains("over what is no frequency"));
  }
}

TEST_CASE("what is no frequency response is not taken for one", "[hal][formats]") {
  Uff58 set = accelerance();
  set.type = 9;
  CHECK_THAT(complaint(set.ascii()),
             Contains("power spectral density (58), no frequency response"));
  CHECK_THAT(complaint(uff_set(15, "") + uff_set(2411, "")),
             Contains("holds geometry (15, 2411), no frequency response"));
  set = accelerance();
  set.data_type = 2;
  set.declared = 4;
  CHECK_THAT(complaint(set.ascii()), Contains("lacks the phase"));
  CHECK_THAT(complaint("a,b\n1,2\n"), Contains("no known format of frequency responses"));
  CHECK_FALSE(read_frequency_responses("/nowhere/a.uff"));
}

TEST_CASE("a response that is cut off, or has more than it declares, is refused",
          "[hal][formats]") {
  Uff58 set = accelerance();
  set.declared = 3;
  CHECK_THAT(complaint(set.ascii()), Contains("3 values declared, 2 found"));
  set.declared = 1;
  CHECK_THAT(complaint(set.ascii()), Contains("1 values declared, 2 found"));
  set.declared = 2000000000;
  CHECK_THAT(complaint(set.ascii()), Contains("2000000000 values declared, 2 found"));
  set.declared = -4;
  CHECK_THAT(complaint(set.ascii()), Contains("-4 values"));
}

TEST_CASE("faults of a header are told with line and column", "[hal][formats]") {
  Uff58 set = accelerance();
  set.data_type = 3;
  CHECK_THAT(complaint(set.ascii()), Contains("9: data type 3"));
  set = accelerance();
  set.step = 0;
  CHECK_THAT(complaint(set.ascii()), Contains("9: abscissa in steps of 0"));
  set = accelerance();
  set.values = " 1.0 2.0 three 4.0";
  CHECK_THAT(complaint(set.ascii()), Contains("14: \"three 4.0\" is not a number"));
  std::string bytes = accelerance().ascii();
  bytes.replace(bytes.find("         3   3"), 14, "         x   3");
  CHECK_THAT(complaint(bytes), Contains("8:42: \"x\" is not a number"));
}

TEST_CASE("no number in a line is NaN, with a note", "[hal][formats]") {
  Uff58 set = accelerance();
  set.values = " NaN 0.0 1.0 -Inf";
  const FrequencyResponse response = read_one(set.ascii());
  CHECK(std::isnan(response.values[0].real()));
  CHECK(std::isnan(response.values[1].imag()));
  CHECK(has_note(response, "2 lines are no number"));
}

TEST_CASE("lines may end as on another system, or the last not at all", "[hal][formats]") {
  Uff58 set = accelerance();
  set.newline = "\r\n";
  CHECK(read_one(set.ascii()).values[1] == Complex(3, 0.45));
  const std::string whole = accelerance().ascii();
  CHECK(read_one(whole.substr(0, whole.size() - 1)).values.size() == 2);
  CHECK(read_one("\n\n" + whole).values.size() == 2);
}

TEST_CASE("LMS text: places, averages, units, lines", "[hal][formats]") {
  const FrequencyResponse response = read_one(lms(
      "Number of lines\t3\t\t\t\nY axis quantity\tAccelerationOverForce\t\t\t\n"
      "Y axis unit\tg/N\t\t\t\nReference point id\tPoint:10\t\t\t\n"
      "Reference point direction\t-Z\t\t\t\nPoint id\tPoint:3\t\t\t\nPoint direction\t+X\t\t\t\n"
      "Function class\tFRF\t\t\t\nSpan\t800 Hz\t\t\t\nNumber of averages\t3\t\t\t\n",
      lms_table));
  CHECK(response.response == DegreeOfFreedom{"Point:3", "+X"});
  CHECK(response.excitation == DegreeOfFreedom{"Point:10", "-Z"});
  CHECK(response.response_unit == "m/s²");
  CHECK(response.excitation_unit == "N");
  CHECK(response.first_Hz == 0);
  CHECK(response.step_Hz == 0.5);
  CHECK(response.averages == 3);
  REQUIRE(response.values.size() == 3);
  CHECK(response.values[1].real() == Approx(2.5 * 9.80665));
  CHECK(response.values[1].imag() == Approx(0.25 * 9.80665));
  CHECK(has_note(response, "Span: 800 Hz"));
}

TEST_CASE("LMS text that is no frequency response is refused with words", "[hal][formats]") {
  const std::string frf = "Function class\tFRF\t\t\t\n";
  CHECK_THAT(complaint(lms("Function class\tCoherence\t\t\t\n", lms_table)),
             Contains("holds Coherence, no frequency response"));
  CHECK_THAT(complaint(lms(frf + "Number of lines\t1025\t\t\t\n", lms_table)),
             Contains("1025 lines declared, 3 found"));
  CHECK_THAT(complaint(lms(frf + "Value type\tReal\t\t\t\n", lms_table)),
             Contains("values are Real, not complex"));
  CHECK_THAT(complaint(lms(frf, "0\t1\t1\n1\t1\t1\n3\t1\t1\n")), Contains("do not rise evenly"));
  CHECK_THAT(complaint(lms(frf, "0\t1\t1\n1\t1\n")), Contains("6: not frequency, real"));
}

TEST_CASE("a small universal file cut off at any byte is no worse than refused", "[hal][formats]") {
  const ScratchFolder scratch;
  Uff58 binary = accelerance();
  binary.values = test::packed(1.0F) + test::packed(2.0F) + test::packed(3.0F) + test::packed(4.0F);
  const std::string bytes = accelerance().ascii() + binary.binary(1);
  int read_in_full = 0;
  for (std::size_t length = 1; length < bytes.size(); ++length) {
    const auto file = written(scratch, fmt::format("{}.uff", length), bytes.substr(0, length));
    const auto responses = read_frequency_responses(file);
    if (responses && responses.value().size() == 2) ++read_in_full;
    std::filesystem::remove(file);
  }
  // The second one is whole from its last value on: what follows is a line of its own.
  CHECK(read_in_full == 8);
}

}  // namespace rvbench::hal
