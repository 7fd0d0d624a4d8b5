#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "hal/formats/read_recordings.hpp"
#include "hal/types/units.hpp"
#include "tests/support/real_data.hpp"

// Small files that were once read wrongly, or refused for no good reason. What each holds is stated
// by its README.
namespace rvbench::hal {
namespace {

using test::data_folder;

constexpr double g_m_s2 = units::standard_gravity_m_s2;

struct Input {
  const char* name;
  const char* channel;
  double rate_Hz;  // that has to be given; NaN: the file states it
  double scale;    // m/s² per unit of the file; 1 where it states none
};

Recording read_input(const char* name, double rate_Hz = not_known) {
  const auto folder = data_folder();
  REQUIRE(folder);
  auto read = read_recordings(*folder / "inputs" / name, {.rate_Hz = rate_Hz});
  if (!read) FAIL(read.error().where);
  REQUIRE(read.value().size() == 1);
  return std::move(read).value().front();
}

std::vector<double> samples(const Recording& recording, const char* channel) {
  const Channel* found = recording.find(channel);
  REQUIRE(found != nullptr);
  return {found->samples.begin(), found->samples.end()};
}

}  // namespace

TEST_CASE("small files of many writers hold two sines at 1 kHz", "[hal][formats][data]") {
  if (!data_folder()) return;
  const Input input = GENERATE(values<Input>({
      {"units_row_below_head.csv", "acc", not_known, g_m_s2},
      {"settings_before_table.csv", "CH1", not_known, g_m_s2},
      {"comment_lines_before_head.csv", "acc", not_known, g_m_s2},
      {"excel_separator_line.csv", "acc", not_known, g_m_s2},
      {"index_column_without_name.csv", "acc", 1000, g_m_s2},
      {"blanks_between_numbers.txt", "column_2", not_known, 1},
      {"date_and_time_columns.csv", "acc", not_known, g_m_s2},
      {"unit_G_in_round_brackets.csv", "Acceleration", not_known, g_m_s2},
      {"time_in_milliseconds_unstated.csv", "acc", 1000, g_m_s2},
      {"text_not_ascii.mat", "acc", not_known, 1},
      {"struct_of_one_short_field.mat", "acc", not_known, 1},
      {"struct_holds_the_record.mat", "bearing.gs", not_known, 1},
      {"units_in_ascii.h5", "acc", not_known, g_m_s2},
  }));
  CAPTURE(input.name);
  const Recording recording = read_input(input.name, input.rate_Hz);
  REQUIRE(recording.find(input.channel) != nullptr);
  const Channel& a = *recording.find(input.channel);
  CHECK(recording.status == "ok");
  CHECK(a.rate_Hz == Approx(1000));
  REQUIRE(a.samples.size() == 64);
  if (input.scale != 1) CHECK(a.info.unit == "m/s²");
  for (Eigen::Index i = 0; i < a.samples.size(); ++i) {
    const double t_s = static_cast<double>(i) / 1000;
    const double truth =
        2 * std::sin(units::two_pi * 50 * t_s) + 0.3 * std::cos(units::two_pi * 120 * t_s);
    CHECK(a.samples[i] / input.scale == Approx(truth).margin(6e-5));  // four decimals
  }
}

TEST_CASE("a speed beside the samples is the shaft's", "[hal][formats][data]") {
  if (!data_folder()) return;
  const Recording recording = read_input("units_in_ascii.h5");
  CHECK(recording.find("acc")->info.unit == "m/s²");
  CHECK(recording.speed_rpm == Approx(600));
}

TEST_CASE("TDMS as recorders write it", "[hal][formats][data]") {
  if (!data_folder()) return;
  const Recording unequal = read_input("tdms_unequal_rates.tdms", 1000);
  CHECK(samples(unequal, "a") == std::vector<double>{1, 1, 1, 1});
  CHECK(samples(unequal, "b") == std::vector<double>{9, 9});
  const Recording shorter = read_input("tdms_short_last_chunk.tdms", 1000);
  CHECK(samples(shorter, "channel1") == std::vector<double>{1, 2, 5});
  CHECK(samples(shorter, "channel2") == std::vector<double>{3, 4, 6});
}

TEST_CASE("a thousands mark in quotes is a property of the table", "[hal][formats][data]") {
  if (!data_folder()) return;
  const Recording recording = read_input("thousands_in_quotes.csv", 1000);
  const Channel& v = recording.channels.front();
  CHECK(v.info.unit == "m/s²");
  REQUIRE(v.samples.size() >= 4);
  CHECK((1e3 * v.samples.head(4)).isApprox(Eigen::Vector4d(644, 1218, 987, 703)));
}

}  // namespace rvbench::hal
