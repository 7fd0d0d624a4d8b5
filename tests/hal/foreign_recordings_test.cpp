#include <catch2/catch.hpp>
#include <complex>

#include "hal/formats/read_frequency_responses.hpp"
#include "hal/formats/read_recordings.hpp"
#include "tests/support/real_data.hpp"

// Expected numbers are what numpy's frombuffer and loadtxt show for these files.
namespace rvbench::hal {
namespace {

using Catch::Contains;
using test::data_folder;

std::vector<Recording> read(const std::filesystem::path& file) {
  auto recordings = read_recordings(file);
  if (!recordings) FAIL(recordings.error().where);
  return std::move(recordings).value();
}

double rms(const Eigen::VectorXd& x) {
  return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

}  // namespace

TEST_CASE("one record, written as text and as bytes, reads to the same numbers",
          "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const Recording text = read(*folder / "uff/Sample_UFF58_ascii.uff")[0];
  const Recording bytes = read(*folder / "uff/Sample_UFF58b_bin.uff")[0];
  CHECK(text.status == "ok");
  CHECK(bytes.status == "ok");
  const Channel& a = text.channels.at(0);
  const Channel& b = bytes.channels.at(0);
  CHECK(a.info.name == "Mic 01");
  CHECK(a.info.unit == "Pa");
  CHECK(a.rate_Hz == Approx(65536).epsilon(1e-5));
  REQUIRE(a.samples.size() == 79292);
  REQUIRE(b.samples.size() == 79292);
  CHECK(a.samples[79291] == -4.31469e-3);
  CHECK(b.samples[79291] == Approx(-0.004314688965678215).epsilon(1e-15));
  CHECK(rms(b.samples) == Approx(0.014344562064668722).epsilon(1e-12));
  CHECK((a.samples - b.samples).cwiseAbs().maxCoeff() < 5e-7);  // half of the sixth digit
}

TEST_CASE("a Latin-1 letter in a unit, and a short last line, do no harm", "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const auto responses = read_frequency_responses(*folder / "uff/non_ascii_header.uff");
  REQUIRE(responses);
  const FrequencyResponse& response = responses.value().at(0);
  REQUIRE(response.values.size() == 6);
  CHECK(response.values[5] == std::complex<double>(3.75037, 2.93363));
  CHECK(response.response_unit == "m/s²");
  CHECK(response.excitation_unit == "N");
  CHECK(response.step_Hz == Approx(0.195313));

  const Recording record = read(*folder / "uff/time-history-not-all-columns-filled.uff")[0];
  CHECK(record.status == "ok");
  REQUIRE(record.channels.at(0).samples.size() == 13);
  CHECK(record.channels[0].samples[12] == -5.84096);
  CHECK(record.channels[0].info.name == "1x");
  CHECK(record.channels[0].info.unit == "m/s²");
  CHECK(record.channels[0].rate_Hz == Approx(20000));
}

TEST_CASE("a record that was cut off says what it declares and what it holds",
          "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const Recording record = read(*folder / "uff/dataset_milestone_in_header.uff")[0];
  CHECK_THAT(record.status, Contains("INVALID") && Contains("2508876 values declared, 42 found"));
  REQUIRE(record.channels.at(0).samples.size() == 42);
  CHECK(record.channels[0].samples[41] == 5.39653e-3);
  CHECK(record.channels[0].start_s == Approx(1.11858e-5));
}

TEST_CASE("four sensors in one binary universal file", "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const auto records = read(*folder / "uff/MPSTD#Set001_2024_10_08_10_27_07.uff");
  REQUIRE(records.size() == 1);
  REQUIRE(records[0].channels.size() == 4);
  for (const Channel& channel : records[0].channels) {
    CHECK(channel.samples.size() == 222400);
    CHECK(channel.rate_Hz == Approx(3200));
    CHECK(channel.info.direction == "+Z");
    CHECK(channel.info.unit == "m/s²");
  }
  CHECK(records[0].channels[1].samples[0] == Approx(-0.24966570734977722).epsilon(1e-14));
  CHECK(records[0].channels[3].samples[222399] == Approx(0.1336323320865631).epsilon(1e-14));
  const Recording doubles = read(*folder / "uff/binary8byte.uff")[0];
  CHECK(doubles.channels.at(0).samples[249] == Approx(0.3090193569660187 * 9.80665));
}

TEST_CASE("every universal file is read, or told to hold something else", "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  int records = 0, responses = 0, others = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder / "uff")) {
    if (entry.path().extension() != ".uff") continue;
    CAPTURE(entry.path().string());
    const auto as_record = read_recordings(entry.path());
    const auto as_response = read_frequency_responses(entry.path());
    if (as_record) {
      ++records;
    } else if (as_response) {
      ++responses;
    } else {
      ++others;
      CHECK_THAT(as_record.error().where, Contains(": holds ") && Contains(", no time record"));
      CHECK_THAT(as_response.error().where, Contains(", no frequency response"));
    }
  }
  CHECK(records + responses + others > 0);
  CHECK(records >= 6);
  CHECK(responses >= 1);
}

TEST_CASE("thirty hammer responses of a beam, with units and directions", "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder / "frf_ufsc/hammer")) {
    CAPTURE(entry.path().string());
    const auto responses = read_frequency_responses(entry.path());
    REQUIRE(responses);
    const FrequencyResponse& response = responses.value().at(0);
    ++files;
    // "FRF 3-10.txt": the response at 3 to a blow at 10.
    const std::string name = entry.path().stem().string();
    const std::string blow = name.substr(name.find('-') + 1);
    CHECK(response.response == DegreeOfFreedom{"Point:3", "-Z"});
    CHECK(response.excitation == DegreeOfFreedom{"Point:" + blow, "-Z"});
    CHECK(response.response_unit == "m/s²");
    CHECK(response.excitation_unit == "N");
    CHECK(response.values.size() == 1025);
    CHECK(response.step_Hz == Approx(1));
    CHECK(response.averages == 3);
    if (blow != "10") continue;
    CHECK(response.values[17].real() == Approx(-0.8378366231963524).epsilon(1e-9));
    CHECK(response.values[17].imag() == Approx(7.811622143123084).epsilon(1e-9));
  }
  CHECK(files == 30);
}

TEST_CASE("a hammer record of a tool has its rate from its column of times",
          "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const Recording record = read(*folder / "frf_ubc/Point1_Channel1_CH1.txt")[0];
  REQUIRE(record.channels.size() == 3);
  CHECK(record.channels[1].rate_Hz == Approx(51200).epsilon(1e-6));
  CHECK(record.channels[1].samples.size() == 51200);
  CHECK(record.channels[1].samples.maxCoeff() == 249.7397);  // N
  CHECK(record.channels[2].samples.maxCoeff() == 667.1147);  // m/s²
  CHECK_THAT(record.notes.at(0), Contains("column_1, taken as time in s"));
}

TEST_CASE("TDMS files of several makers open", "[hal][formats][data]") {
  const auto folder = data_folder();
  if (!folder) return;
  const Recording raw = read(*folder / "tdms/raw1.tdms")[0];
  REQUIRE(raw.channels.size() == 7);
  const double volts = 0.0003051850947599719;  // per count, as its scaling says
  CHECK(raw.find("First  Channel")->samples[0] == Approx(-603 * volts));
  CHECK(raw.find("Seventh Cha")->samples[1999] == Approx(16629 * volts));

  const Recording big = read(*folder / "tdms/big_endian.tdms")[0];
  REQUIRE(big.channels.size() == 2);
  CHECK(big.channels[0].rate_Hz == Approx(1000));
  CHECK(big.channels[0].samples.size() == 3500);
  CHECK(big.channels[1].samples[3499] == Approx(0.8446644287207723).epsilon(1e-14));

  const auto digital = read(*folder / "tdms/Digital_Input.tdms");
  const Channel& line = digital.at(0).channels.at(0);
  CHECK(line.samples.size() == 20000);
  CHECK(line.samples.maxCoeff() <= 1);
  CHECK(line.rate_Hz == Approx(2000));
  const Recording times = read(*folder / "tdms/raw_timestamps.tdms")[0];
  CHECK(times.channels.at(0).rate_Hz == Approx(1000));
  CHECK(times.channels[0].samples.size() == 128);
}

}  // namespace rvbench::hal
