#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "analysis/frf/find_modes.hpp"
#include "analysis/frf/hammer_test.hpp"
#include "hal/types/units.hpp"
#include "tests/support/real_data.hpp"

using namespace rvbench;
using namespace rvbench::analysis;

namespace {

/// Lines "frequency, real, imaginary" below a header of words; g/N.
FrequencyResponse read_lms(const std::filesystem::path& file) {
  FrequencyResponse frf;
  frf.source = file.filename().string();
  frf.response = {"3", "-Z"};
  frf.excitation = {file.stem().string(), "-Z"};
  frf.response_unit = "m/s²";
  frf.excitation_unit = "N";
  frf.step_Hz = 1;
  std::vector<std::complex<double>> values;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    double f_Hz = 0, real = 0, imaginary = 0;
    if (!(words >> f_Hz >> real >> imaginary)) continue;
    REQUIRE(f_Hz == double(values.size()));
    values.emplace_back(units::m_s2_from_g(real), units::m_s2_from_g(imaginary));
  }
  frf.values = Eigen::Map<Eigen::VectorXcd>(values.data(), Eigen::Index(values.size()));
  return frf;
}

const FoundMode& nearest(const std::vector<FoundMode>& modes, double frequency_Hz) {
  return *std::ranges::min_element(
      modes, {}, [&](const FoundMode& mode) { return std::abs(mode.frequency_Hz - frequency_Hz); });
}

}  // namespace

// The list is the publisher's, of the peaks at 1 Hz lines.
TEST_CASE("a free beam's published modes are found in its hammer test", "[analysis][frf][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  std::vector<FrequencyResponse> responses;
  for (const auto& entry : std::filesystem::directory_iterator(*folder / "frf_ufsc/hammer")) {
    responses.push_back(read_lms(entry.path()));
    REQUIRE(responses.back().values.size() == 1025);
  }
  REQUIRE(responses.size() == 30);
  const auto modes = find_modes(responses, {.span_Hz = 800});
  for (const FoundMode& mode : modes) {
    std::string doubts;
    for (const std::string& doubt : mode.doubts) doubts += "; " + doubt;
    UNSCOPED_INFO(mode.frequency_Hz << " Hz ± " << mode.frequency_error_Hz << ", "
                                    << mode.damping_ratio << ", " << mode.stands_out_dB << " dB"
                                    << doubts);
  }
  for (const double published_Hz : {17, 69, 118, 156, 227, 266, 364, 415, 568, 642, 741}) {
    CAPTURE(published_Hz);
    CHECK(std::abs(nearest(modes, published_Hz).frequency_Hz - published_Hz) < 1);
    CHECK(nearest(modes, published_Hz).sure());
  }
  for (const double above_Hz : {878, 943}) {
    CHECK(std::abs(nearest(modes, above_Hz).frequency_Hz - above_Hz) < 3);
    CHECK_FALSE(nearest(modes, above_Hz).sure());
  }
  CHECK(std::ranges::count_if(modes, &FoundMode::sure) <= 14);  // few that nobody lists
}

// 51.2 kHz, one second: time, force in N, acceleration in m/s².
TEST_CASE("a tool holder's modes are found in one raw hit", "[analysis][frf][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  FrfRecord record{"hit", 51200, Eigen::MatrixXd(51200, 1), Eigen::MatrixXd(51200, 1)};
  std::ifstream in(*folder / "frf_ubc/Point1_Channel1_CH1.txt");
  double time_s = 0;
  for (Eigen::Index i = 0; i < 51200; ++i) {
    REQUIRE((in >> time_s >> record.excitations(i, 0) >> record.responses(i, 0)));
  }
  const FrfSetup setup{{{{"tip", "+X"}, "N"}}, {{{"tip", "+X"}, "m/s²"}}};
  const HammerOptions to_1_kHz{.limits = {.to_Hz = 1000}}, to_3_kHz{.limits = {.to_Hz = 3000}};

  const HammerResult narrow = measure_session({{setup, {record}}}, to_3_kHz).front();
  REQUIRE(narrow.hits[0].faults.size() == 1);  // a soft hit for so much
  CHECK(narrow.hits[0].faults[0].kind == HitFaultKind::narrow_spectrum);

  const HammerResult result = measure_session({{setup, {record}}}, to_1_kHz).front();
  REQUIRE(result.hits[0].accepted());
  const auto modes =
      find_modes({result.estimates.responses.at(0).response}, {.from_Hz = 500, .to_Hz = 3000});
  for (const FoundMode& mode : modes) {
    std::string doubts;
    for (const std::string& doubt : mode.doubts) doubts += "; " + doubt;
    UNSCOPED_INFO(mode.frequency_Hz << " Hz ± " << mode.frequency_error_Hz << ", "
                                    << mode.damping_ratio << ", " << mode.stands_out_dB << " dB"
                                    << doubts);
  }
  for (const double near_Hz : {1074, 1961, 2617}) {
    CAPTURE(near_Hz);
    const FoundMode& mode = nearest(modes, near_Hz);
    // within half of the half-power bandwidth: one hit, 30 to 40 dB of force lost above 2 kHz
    CHECK(std::abs(mode.frequency_Hz - near_Hz) < mode.damping_ratio * mode.frequency_Hz);
  }
}
