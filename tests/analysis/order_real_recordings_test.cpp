#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "analysis/order/line_families.hpp"
#include "analysis/order/line_phase.hpp"
#include "analysis/order/order_spectrum.hpp"
#include "analysis/order/sidebands.hpp"
#include "analysis/order/standing_lines.hpp"
#include "hal/formats/read_recordings.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using namespace rvbench::analysis;

namespace {

Recording read_one(const std::filesystem::path& file) {
  auto read = hal::read_recordings(file);
  REQUIRE(read);
  return std::move(read).value().front();
}

std::optional<LinePhase> follow(const Channel& x, double rate_Hz, const RidgeSearch& search,
                                double band_Hz) {
  const auto ridge = line_ridge(x.samples, rate_Hz, search);
  return ridge ? line_phase(x.samples, rate_Hz, *ridge, band_Hz) : std::nullopt;
}

Spectrum orders_of(const Channel& x, double rate_Hz, const LinePhase& line, double order) {
  const auto angle = angle_of_line(line, x.start_s, order);
  REQUIRE(angle);
  return order_spectrum(x.samples, rate_Hz, x.start_s, *angle);
}

std::vector<StandingLine> lines_of(const Spectrum& spectrum, double highest_order) {
  const auto last = static_cast<Eigen::Index>(highest_order / spectrum.resolution);
  return standing_lines(spectrum, line_floor(spectrum, 0), last, 1e-3 / double(last));
}

bool stands_at(const std::vector<StandingLine>& lines, double place) {
  return std::ranges::any_of(
      lines, [&](const StandingLine& line) { return std::abs(line.place - place) < 1; });
}

}  // namespace

// The rig is published as turning at 2000 rpm with a pinion of 23 teeth; no tachometer is given.
TEST_CASE("the gear rig's shaft is followed by its mesh, and its strangers are listed",
          "[analysis][order][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  const int channel = GENERATE(1, 2, 3, 4);
  CAPTURE(channel);
  const auto record =
      read_one(*folder / ("gear0/3027_217_Data_Chan" + std::to_string(channel) + ".mat"));
  const Channel& x = record.channels[0];
  const auto mesh = follow(x, 25600, {700, 830, 1, 0.5}, 12);
  REQUIRE(mesh);
  const double shaft_Hz = mesh->mean_frequency_Hz() / 23;
  CHECK(shaft_Hz == Approx(2000.0 / 60).epsilon(5e-4));

  const Spectrum spectrum = orders_of(x, 25600, *mesh, 23);
  std::vector<FamilyLine> lines;
  for (const StandingLine& line : lines_of(spectrum, 100)) {
    const double order = line.place * spectrum.resolution;
    // The shaft explains whole and half orders: what turns at half its speed is not told.
    const bool of_shaft = std::abs(2 * order - std::round(2 * order)) < spectrum.resolution;
    if (lines.size() < 150) lines.push_back({order, line.amplitude, of_shaft});
  }
  const auto families = line_families(lines, {0.5 * spectrum.resolution, 0.3, 12, {1, 0.5}});
  // 171.56 Hz and its harmonics, ± 39.58 Hz around mesh lines: to half a line, 0.045 Hz.
  const auto has = [&](double spacing_Hz) {
    return std::ranges::any_of(families, [&](const LineFamily& family) {
      return std::abs(family.spacing * shaft_Hz - spacing_Hz) < 0.045;
    });
  };
  CHECK(has(171.56));
  CHECK(has(39.58));
  CHECK(families.size() <= 3);
}

// No file states this rig's sampling rate: speeds are turns per sample, and orders are ratios.
TEST_CASE("two meshes of a gearbox tell the same shaft speed", "[analysis][order][data]") {
  if (test::too_long_under_sanitizer()) return;
  const auto folder = test::data_folder();
  if (!folder) return;
  const std::string name = GENERATE(as<std::string>{}, "h30hz0", "h30hz30", "h30hz60", "h30hz90",
                                    "b30hz00", "b30hz30", "b30hz60", "b30hz90");
  CAPTURE(name);
  const auto record = read_one(*folder / "oedi" / (name + ".csv"));
  std::vector<double> second_mesh, first_mesh;
  for (const Channel& x : record.channels) {
    // Near 32/3 and 32 orders of a shaft of about 0.007 turns per sample.
    if (const auto line = follow(x, 1, {0.0725, 0.0762, 16384, 1e-8}, 0.0012)) {
      second_mesh.push_back(line->mean_frequency_Hz() / (32.0 / 3));
    }
    if (const auto line = follow(x, 1, {0.2195, 0.2262, 16384, 1e-8}, 0.0012)) {
      first_mesh.push_back(line->mean_frequency_Hz() / 32);
    }
  }
  REQUIRE(second_mesh.size() >= 2);
  REQUIRE(first_mesh.size() >= 1);
  for (const double second : second_mesh) {
    for (const double first : first_mesh) CHECK(second == Approx(first).epsilon(5e-4));
  }
}

// Nothing is told but where to look for a strong line: between 0.03 and 0.2 cycles per sample. On
// the third sensor that is a mesh, in all records.
TEST_CASE("a gearbox of unknown rate shows its shafts and the orders of its teeth",
          "[analysis][order][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  const std::string name = GENERATE(as<std::string>{}, "h30hz0", "h30hz30", "h30hz60", "h30hz90",
                                    "b30hz00", "b30hz30", "b30hz60", "b30hz90");
  CAPTURE(name);
  const auto record = read_one(*folder / "oedi" / (name + ".csv"));
  const auto mesh = follow(record.channels[2], 1, {0.03, 0.2, 16384, 1e-8}, 0.0012);
  REQUIRE(mesh);

  // Its own cycle for a turn: all that is found is a ratio to it.
  const Spectrum ratios = orders_of(record.channels[2], 1, *mesh, 1);
  std::vector<FamilyLine> lines;
  for (const StandingLine& line : lines_of(ratios, 5)) {
    if (lines.size() < 150)
      lines.push_back({line.place * ratios.resolution, line.amplitude, false});
  }
  const auto families = line_families(lines, {0.6 * ratios.resolution, 0.012, 3, {}});
  REQUIRE(families.size() >= 2);
  // 32 teeth of the intermediate shaft; and 80 that no kinematics tells of, of the output's wheel.
  CHECK(families[0].spacing == Approx(1.0 / 32).margin(1e-5));
  CHECK(families[1].spacing == Approx(1.0 / 80).margin(1e-5));

  // The motor's shaft has three turns for one of the intermediate: lines known for it in records
  // of this rig stand in one channel or the other.
  std::vector<double> wanted{2, 32.0 / 3, 64.0 / 3, 32, 128.0 / 3};
  const double teeth = std::round(1 / families[0].spacing);
  for (const Channel& x : record.channels) {
    const Spectrum spectrum = orders_of(x, 1, *mesh, teeth / 3);
    const auto standing = lines_of(spectrum, 60);
    std::erase_if(wanted,
                  [&](double order) { return stands_at(standing, order / spectrum.resolution); });
  }
  CAPTURE(wanted);
  CHECK(wanted.empty());
}
