#include <catch2/catch.hpp>

#include "hal/formats/read_recordings.hpp"
#include "tests/hal/tdms_builder.hpp"

namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::ScratchFolder;
using test::Tdms;
using test::written;

Result<std::vector<Recording>> read_bytes(const std::string& bytes) {
  const ScratchFolder scratch;
  return read_recordings(written(scratch, "a.tdms", bytes));
}

std::vector<Recording> read(const std::string& bytes) {
  return test::recordings_in("a.tdms", bytes);
}

std::string complaint(const std::string& bytes) { return test::complaint_of("a.tdms", bytes); }

std::vector<double> samples(const Recording& recording, const std::string& channel) {
  const Channel* found = recording.find(channel);
  REQUIRE(found != nullptr);
  return {found->samples.data(), found->samples.data() + found->samples.size()};
}

using Numbers = std::vector<double>;
const std::string a = "/'G'/'a'", b = "/'G'/'b'";

// A segment whose writer never came back to say how long it is.
std::string without_length(std::string segment) {
  return segment.replace(12, 8, std::string(8, '\xFF'));
}

}  // namespace

TEST_CASE("TDMS: channels of both orders of bytes, with rate, start and unit", "[hal][formats]") {
  for (const auto order : {std::endian::little, std::endian::big}) {
    const Tdms tdms{order};
    const auto recordings = read(tdms.segment(
        {tdms.object("/", tdms.no_index(), {tdms.property("name", "title")}),
         tdms.object("/'G'", tdms.no_index()),
         tdms.object(a, tdms.index(10, 3),
                     {tdms.property("wf_increment", 0.001), tdms.property("wf_start_offset", 0.5),
                      tdms.property("unit_string", "g")}),
         tdms.object(b, tdms.index(2, 2))},
        tdms.numbers<double>({1, 2, 3}) + tdms.numbers<std::int16_t>({-7, 8})));
    REQUIRE(recordings.size() == 1);
    CHECK(recordings[0].status == "ok");
    CHECK(recordings[0].find("a")->rate_Hz == Approx(1000));
    CHECK(recordings[0].find("a")->start_s == 0.5);
    CHECK(recordings[0].find("a")->info.unit == "m/s²");
    CHECK(samples(recordings[0], "a")[2] == Approx(3 * 9.80665));
    CHECK(samples(recordings[0], "b") == Numbers{-7, 8});
    CHECK(recordings[0].find("b")->rate_Hz == 0);
  }
}

TEST_CASE("TDMS: segments go on with the layout of those before", "[hal][formats]") {
  const Tdms tdms;
  const std::string first =
      tdms.segment({tdms.object(a, tdms.index(3, 1)), tdms.object(b, tdms.index(3, 1))},
                   tdms.numbers<std::int32_t>({1, 2}));
  const std::string bare = tdms.segment({}, tdms.numbers<std::int32_t>({3, 4, 5, 6}), 8);
  const std::string same =
      tdms.segment({tdms.object(a, tdms.same_index())}, tdms.numbers<std::int32_t>({7, 8}), 2 | 8);
  const std::string alone =
      tdms.segment({tdms.object(b, tdms.same_index())}, tdms.numbers<std::int32_t>({9}));
  const auto recordings = read(first + bare + same + alone);
  CHECK(samples(recordings[0], "a") == Numbers{1, 3, 5, 7});
  CHECK(samples(recordings[0], "b") == Numbers{2, 4, 6, 8, 9});
}

TEST_CASE("TDMS: interleaved values, and texts that are skipped", "[hal][formats]") {
  const Tdms tdms;
  const auto woven =
      read(tdms.segment({tdms.object(a, tdms.index(2, 2)), tdms.object(b, tdms.index(9, 2))},
                        tdms.number(std::int16_t{1}) + tdms.number(1.5F) +
                            tdms.number(std::int16_t{2}) + tdms.number(2.5F),
                        2 | 4 | 8 | 0x20));
  CHECK(samples(woven[0], "a") == Numbers{1, 2});
  CHECK(samples(woven[0], "b") == Numbers{1.5, 2.5});

  const std::string texts = tdms.number(2U) + tdms.number(4U) + "onto";
  const auto beside = read(
      tdms.segment({tdms.object(a, tdms.text_index(2, 12)), tdms.object(b, tdms.index(2, 1))},
                   texts + tdms.number(std::int16_t{5}) + texts + tdms.number(std::int16_t{6})));
  REQUIRE(beside[0].channels.size() == 1);
  CHECK(samples(beside[0], "b") == Numbers{5, 6});
}

TEST_CASE("TDMS: raw data of a DAQ device, and digital lines", "[hal][formats]") {
  const Tdms tdms;
  const std::vector<std::string> linear = {tdms.property("NI_Scaling_Status", "unscaled"),
                                           tdms.property("NI_Number_Of_Scales", 2),
                                           tdms.property("NI_Scale[1]_Scale_Type", "Linear"),
                                           tdms.property("NI_Scale[1]_Linear_Slope", 0.5),
                                           tdms.property("NI_Scale[1]_Linear_Y_Intercept", 10.0),
                                           tdms.property("NI_Scale[1]_Linear_Input_Source", 0)};
  const auto analogue =
      read(tdms.segment({tdms.object(a, tdms.daqmx_index(2, 3, 0, 4), linear),
                         tdms.object(b, tdms.daqmx_index(2, 3, 2, 4))},
                        tdms.numbers<std::int16_t>({2, 100, 4, 200, -2, 300}), 2 | 4 | 8 | 0x80));
  CHECK(samples(analogue[0], "a") == Numbers{11, 12, 9});  // the second chunk is shorter
  CHECK(samples(analogue[0], "b") == Numbers{100, 200, 300});
  CHECK(analogue[0].notes.empty());

  const auto digital = read(tdms.segment({tdms.object(a, tdms.daqmx_index(3, 0, 0, 1, true)),
                                          tdms.object(b, tdms.daqmx_index(3, 0, 6, 1, true))},
                                         "\x01\x40\x41", 2 | 4 | 8 | 0x80));
  CHECK(samples(digital[0], "a") == Numbers{1, 0, 1});
  CHECK(samples(digital[0], "b") == Numbers{0, 1, 1});

  CHECK_THAT(complaint(tdms.segment({tdms.object(a, tdms.daqmx_index(2, 3, 3, 4))}, "12345678",
                                    2 | 4 | 8 | 0x80)),
             Contains("segment 1: /'G'/'a': DAQmx values outside of their buffer"));
}

TEST_CASE("TDMS: each DAQ device has as many rows as its own rate gives", "[hal][formats]") {
  const Tdms tdms;
  const std::vector<std::uint32_t> row_bytes{2, 4};
  const std::string one_chunk =
      tdms.numbers<std::int16_t>({1, 2, 3, 4}) + tdms.numbers<std::int32_t>({90, 91});
  const std::string last_chunk =
      tdms.numbers<std::int16_t>({5, 6}) + tdms.numbers<std::int32_t>({92});
  const auto recordings =
      read(tdms.segment({tdms.object(a, tdms.daqmx_buffer_index(4, 3, 0, row_bytes)),
                         tdms.object(b, tdms.daqmx_buffer_index(2, 5, 1, row_bytes))},
                        one_chunk + one_chunk + last_chunk, 2 | 4 | 8 | 0x80));
  CHECK(samples(recordings[0], "a") == Numbers{1, 2, 3, 4, 1, 2, 3, 4, 5, 6});
  CHECK(samples(recordings[0], "b") == Numbers{90, 91, 90, 91, 92});
}

TEST_CASE("TDMS: of a last chunk that is shorter each channel has its share", "[hal][formats]") {
  const Tdms tdms;
  const auto read_both = [&](std::uint64_t of_a, std::uint64_t of_b,
                             const std::vector<std::int16_t>& values) {
    return read(
        tdms.segment({tdms.object(a, tdms.index(2, of_a)), tdms.object(b, tdms.index(2, of_b))},
                     tdms.numbers(values)))[0];
  };
  const Recording even = read_both(2, 2, {1, 2, 3, 4, 5, 6});
  CHECK(samples(even, "a") == Numbers{1, 2, 5});
  CHECK(samples(even, "b") == Numbers{3, 4, 6});
  CHECK(even.status == "ok");
  const Recording uneven = read_both(4, 2, {1, 2, 3, 4, 8, 9, 5, 6, 7});
  CHECK(samples(uneven, "a") == Numbers{1, 2, 3, 4, 5, 6});
  CHECK(samples(uneven, "b") == Numbers{8, 9, 7});
  // One value for two channels is no whole share of each.
  const Recording torn = read_both(2, 2, {1, 2, 3, 4, 5});
  CHECK_THAT(torn.status, Contains("INVALID"));
}

TEST_CASE("TDMS: scalings count though their number is not stated", "[hal][formats]") {
  const Tdms tdms;
  const auto recordings =
      read(tdms.segment({tdms.object(a, tdms.index(3, 3),
                                     {tdms.property("NI_Scale[0]_Scale_Type", "Linear"),
                                      tdms.property("NI_Scale[0]_Linear_Slope", 0.5),
                                      tdms.property("NI_Scale[0]_Linear_Y_Intercept", 10.0)})},
                        tdms.numbers<std::int32_t>({2, 4, -2})));
  CHECK(samples(recordings[0], "a") == Numbers{11, 12, 9});
}

TEST_CASE("TDMS: scalings by polynomial, table and one of another", "[hal][formats]") {
  const Tdms tdms;
  const auto scaled = [&](std::vector<std::string> properties, int scales) {
    properties.push_back(tdms.property("NI_Number_Of_Scales", scales));
    return read(tdms.segment({tdms.object(a, tdms.index(10, 3), properties)},
                             tdms.numbers<double>({0, 1, 2.5})))[0];
  };
  const std::vector<std::string> polynomial = {
      tdms.property("NI_Scale[0]_Scale_Type", "Polynomial"),
      tdms.property("NI_Scale[0]_Polynomial_Coefficients_Size", 3),
      tdms.property("NI_Scale[0]_Polynomial_Coefficients[0]", 1.0),
      tdms.property("NI_Scale[0]_Polynomial_Coefficients[1]", 2.0),
      tdms.property("NI_Scale[0]_Polynomial_Coefficients[2]", 4.0)};
  CHECK(samples(scaled(polynomial, 1), "a") == Numbers{1, 7, 31});

  std::vector<std::string> chain = polynomial;
  chain.push_back(tdms.property("NI_Scale[1]_Scale_Type", "Subtract"));
  chain.push_back(tdms.property("NI_Scale[1]_Subtract_Left_Operand_Input_Source", -1.0));
  CHECK_THAT(scaled(polynomial, 1).status, Contains("ok"));
  chain.back() = tdms.property("NI_Scale[1]_Subtract_Left_Operand_Input_Source", 4294967295.0);
  chain.push_back(tdms.property("NI_Scale[1]_Subtract_Right_Operand_Input_Source", 0));
  CHECK(samples(scaled(chain, 2), "a") == Numbers{1, 6, 28.5});  // right minus left

  std::vector<std::string> table = {tdms.property("NI_Scale[0]_Scale_Type", "Table"),
                                    tdms.property("NI_Scale[0]_Table_Scaled_Values_Size", 2),
                                    tdms.property("NI_Scale[0]_Table_Pre_Scaled_Values_Size", 2)};
  for (const int i : {0, 1}) {
    table.push_back(tdms.property(fmt::format("NI_Scale[0]_Table_Scaled_Values[{}]", i), 2.0 * i));
    table.push_back(
        tdms.property(fmt::format("NI_Scale[0]_Table_Pre_Scaled_Values[{}]", i), 100.0 * i));
  }
  CHECK(samples(scaled(table, 1), "a") == Numbers{0, 50, 100});
  CHECK(samples(scaled({tdms.property("NI_Scaling_Status", "scaled")}, 1), "a") ==
        Numbers{0, 1, 2.5});
}

TEST_CASE("TDMS: a channel that cannot be scaled is left out, and said to be", "[hal][formats]") {
  const Tdms tdms;
  const auto with = [&](const std::vector<std::string>& properties) {
    return tdms.segment(
        {tdms.object(a, tdms.index(10, 1), properties), tdms.object(b, tdms.index(10, 1))},
        tdms.numbers<double>({1, 2}));
  };
  const auto rtd = read(with(
      {tdms.property("NI_Number_Of_Scales", 1), tdms.property("NI_Scale[0]_Scale_Type", "RTD")}));
  REQUIRE(rtd[0].channels.size() == 1);
  CHECK_THAT(rtd[0].notes.at(0), Contains("a is left out: a scaling of the kind RTD"));
  const auto endless = read(
      with({tdms.property("NI_Number_Of_Scales", 1), tdms.property("NI_Scale[0]_Scale_Type", "Add"),
            tdms.property("NI_Scale[0]_Add_Left_Operand_Input_Source", 0),
            tdms.property("NI_Scale[0]_Add_Right_Operand_Input_Source", 0)}));
  CHECK_THAT(endless[0].notes.at(0), Contains("ask for each other"));
  const auto spectrum = read(with({tdms.property("wf_xunit_string", "Hz")}));
  CHECK_THAT(spectrum[0].notes.at(0), Contains("a is left out: over Hz, not time"));
}

TEST_CASE("TDMS: times are seconds since the first", "[hal][formats]") {
  for (const auto order : {std::endian::little, std::endian::big}) {
    const Tdms tdms{order};
    const auto time = [&](std::int64_t seconds, std::uint64_t fraction) {
      return order == std::endian::little ? tdms.number(fraction) + tdms.number(seconds)
                                          : tdms.number(seconds) + tdms.number(fraction);
    };
    const auto recordings = read(
        tdms.segment({tdms.object(a, tdms.index(0x44, 2))},
                     time(3700000000, 0x4000000000000000) + time(3700000001, 0x8000000000000000)));
    CHECK(samples(recordings[0], "a") == Numbers{0.25, 1.5});
    CHECK(recordings[0].find("a")->info.unit == "s");
  }
}

TEST_CASE("TDMS: groups are recordings of their own", "[hal][formats]") {
  const Tdms tdms;
  const auto recordings = read(tdms.segment({tdms.object("/'first'/'x'", tdms.index(10, 1)),
                                             tdms.object("/'it''s'/'x'", tdms.index(10, 1))},
                                            tdms.numbers<double>({1, 2})));
  REQUIRE(recordings.size() == 2);
  CHECK_THAT(recordings[0].source, Contains("a.tdms#first"));
  CHECK_THAT(recordings[1].source, Contains("a.tdms#it's"));
  CHECK(samples(recordings[1], "x") == Numbers{2});
}

TEST_CASE("TDMS: a last segment that was never finished is read as far as it goes",
          "[hal][formats]") {
  const Tdms tdms;
  const std::string segment =
      tdms.segment({tdms.object(a, tdms.index(10, 2))}, tdms.numbers<double>({1, 2, 3}) + "torn");
  const auto recordings = read(without_length(segment));
  CHECK(recordings[0].status == "ok");
  CHECK(samples(recordings[0], "a") == Numbers{1, 2, 3});
  CHECK_THAT(recordings[0].notes.at(0), Contains("a: 4 values declared, 3 found"));
  CHECK_THAT(recordings[0].notes.at(1), Contains("unfinished"));
}

TEST_CASE("TDMS: a file that was cut off is INVALID, and says what is there", "[hal][formats]") {
  const Tdms tdms;
  const std::string whole =
      tdms.segment({tdms.object(a, tdms.index(10, 4))}, tdms.numbers<double>({1, 2, 3, 4}));
  const auto cut = read(whole.substr(0, whole.size() - 8));
  CHECK(cut[0].status == "INVALID: a: 4 values declared, 3 found");
  CHECK(samples(cut[0], "a") == Numbers{1, 2, 3});
  CHECK(read(whole + "TDSm")[0].status == "INVALID: the file is cut off");
  for (std::size_t length = 1; length < whole.size(); ++length) {
    const auto recordings = read_bytes(whole.substr(0, length));
    if (recordings) CHECK_THAT(recordings.value()[0].status, Contains("INVALID"));
  }
}

TEST_CASE("TDMS: counts that lie claim no memory", "[hal][formats]") {
  const Tdms tdms;
  const std::string raw = tdms.numbers<double>({1});
  const std::uint64_t most = ~std::uint64_t{0};
  CHECK(read(tdms.segment({tdms.object(a, tdms.index(10, most))}, raw))[0].channels.size() == 1);
  CHECK_FALSE(read_bytes(tdms.segment({tdms.object(a, tdms.text_index(most, most))}, raw)));
  CHECK_THAT(complaint(tdms.segment({tdms.object(a, tdms.index(0x99, 1))}, raw)),
             Contains("unknown type 0x99"));
  CHECK_THAT(complaint(tdms.segment({tdms.object(a, tdms.same_index())}, raw)),
             Contains("none before"));
  CHECK_THAT(complaint("TDSh" + std::string(40, '\0')), Contains("the index of a TDMS file"));
  CHECK_THAT(complaint(tdms.segment({}, "") + std::string(40, 'x')),
             Contains("segment 2: no segment begins here"));
}

}  // namespace rvbench::hal
