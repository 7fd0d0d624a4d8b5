#include "bench/vibration_speed.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "analysis/explain/explanation.hpp"
#include "bench/twin.hpp"
#include "sim/plant_json.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench::bench {
namespace {

using analysis::ExplainVerdict;
using Catch::Matchers::Contains;
using nlohmann::json;

constexpr double synchronous = 0.01;  // turns per sample
constexpr int samples = 60000;

// Kloss, solved for the slip: a motor whose pull-out torque is 2.5 times the rated one, at 2 % of
// slip.
double kloss_slip(double load_pct) {
  if (load_pct == 0) return 0;
  const double steepness = 2.5 / (load_pct / 100);
  return 0.02 * (steepness - std::sqrt(steepness * steepness - 1));
}

double never(double) { return 0; }

// Vibration of a two-stage gearbox (teeth at 32/3 and 32 per turn) whose speed wanders by 0.01 %.
// @param deaf_from  sample after which the sensors hear nothing but noise for 40 turns
void write_vibration(const std::string& path, double slip, unsigned seed, int deaf_from = samples) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gaussian;
  std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
  const double orders[] = {1, 32.0 / 3, 64.0 / 3, 32};
  double phases[2][4];
  for (auto& channel : phases) {
    for (double& each : channel) each = phase(random);
  }
  std::ofstream file(path);
  file << "a1,a2\n";
  double turns = 0;
  for (int i = 0; i < samples; ++i) {
    turns += synchronous * (1 - slip + 1e-4 * std::sin(i / 3000.0 + seed));
    double a[2];
    for (int c = 0; c < 2; ++c) {
      a[c] = gaussian(random);
      for (int k = 0; k < 4 && (i < deaf_from || i > deaf_from + 4000); ++k) {
        a[c] += std::cos(2 * std::numbers::pi * orders[k] * turns + phases[c][k]);
      }
    }
    file << a[0] << ',' << a[1] << '\n';
  }
}

json read_as(const std::string& reference) {
  return {{"kinematics", "two_stage"},
          {"turns_per_sample", 0.0101},
          {"relative_to", reference},
          {"nominal_Hz", 30}};
}

// Two days of three loads each; the others are predicted.
CampaignOrRefusal two_days(const test::ScratchFolder& scratch, double (*slip)(double)) {
  json campaign{{"campaign", "two days"}, {"files", json::array()}};
  unsigned seed = 0;
  for (const std::string day : {"monday", "tuesday"}) {
    for (const int load_pct : {0, 40, 80, 100}) {
      const std::string name = day + std::to_string(load_pct);
      write_vibration(scratch / (name + ".csv"), slip(load_pct), ++seed);
      campaign["files"].push_back(
          {{"file", name + ".csv"},
           {"speed_from_vibration", read_as(day + "0.csv")},
           {"constants", {{"load", {{"value", load_pct}, {"unit", "%"}}}}},
           {"records", {{{"condition", name}, {"use", load_pct == 100 ? "predict" : "learn"}}}}});
    }
  }
  std::ofstream(scratch / "c.json") << campaign.dump();
  return read_campaign(scratch / "c.json");
}

std::unique_ptr<Twin> twin_of(const CampaignOrRefusal& read) {
  if (const auto* refusal = std::get_if<1>(&read)) FAIL(refusal->faults.front().message);
  const auto plant = sim::read_plant("oedi_gearbox");
  REQUIRE(plant.index() == 0);
  auto made = make_twin(std::get<0>(plant), std::get<Campaign>(read));
  if (const auto* refusal = std::get_if<1>(&made)) FAIL(refusal->faults.front().message);
  return std::get<0>(std::move(made));
}

// A campaign of one file; the keys given here change how its speed is read.
CampaignOrRefusal one_file(const test::ScratchFolder& scratch, const json& changes,
                           const json& rate = json::object()) {
  write_vibration(scratch / "one.csv", 0, 1);
  json how = read_as("one.csv");
  how.merge_patch(changes);
  json file{{"file", "one.csv"}, {"speed_from_vibration", how}};
  file.merge_patch(rate);
  std::ofstream(scratch / "c.json") << json{{"campaign", "one"}, {"files", {file}}}.dump();
  return read_campaign(scratch / "c.json");
}

std::string why_not(const CampaignOrRefusal& read) {
  REQUIRE(read.index() == 1);
  CHECK(std::get<Refusal>(read).of_recordings);
  return std::get<Refusal>(read).faults.front().message;
}

}  // namespace

TEST_CASE("slip is found from vibration alone, and predicts a load not seen", "[bench][explain]") {
  if (test::too_long_under_sanitizer()) return;
  const test::ScratchFolder scratch;
  const auto read = two_days(scratch, kloss_slip);
  const auto twin = twin_of(read);
  const analysis::Explanation found = analysis::explain(*twin);
  INFO(found.reason);
  CHECK(found.verdict == ExplainVerdict::named);
  REQUIRE(found.effects.size() == 1);
  CHECK(found.effects[0].name == "slip");
  // The slope at the foot of the curve is 0.4 %; up to 80 % of the load it bends by 2.6 %.
  CHECK(found.effects[0].parameters[0].value == Approx(0.00405).epsilon(0.02));
  for (const auto& record :
       twin->compare(found.selection.fit.effects, found.selection.fit.values)) {
    if (!record.learned_from) {
      CHECK(std::abs((record.measured - record.simulated).mean()) < 1e-4);
    }
  }
}

TEST_CASE("a drive that keeps its speed leaves nothing out", "[bench][explain][null]") {
  if (test::too_long_under_sanitizer()) return;
  const test::ScratchFolder scratch;
  const auto read = two_days(scratch, never);
  const analysis::Explanation found = analysis::explain(*twin_of(read));
  INFO(found.reason);
  CHECK(found.verdict == ExplainVerdict::null);
}

TEST_CASE("a speed is relative to another record, and what was done is told", "[bench][explain]") {
  const test::ScratchFolder scratch;
  const auto read = one_file(scratch, json::object());
  REQUIRE(read.index() == 0);
  const Campaign& campaign = std::get<Campaign>(read);
  const Channel& speed = *campaign.records[0].recording.find("speed");
  CHECK(speed.info.unit == "1");
  CHECK(speed.samples.mean() == Approx(1).margin(1e-4));
  // 15 turns apart at a nominal 30 Hz; the block is told in turns at the speed that is looked near.
  CHECK(speed.rate_Hz == Approx(30 / 15.0).epsilon(0.02));
  REQUIRE(campaign.notes.size() == 1);
  CHECK_THAT(campaign.notes[0], Contains("30 turns") && Contains("no sample rate is documented") &&
                                    Contains("NOT_RESOLVABLE"));
}

TEST_CASE("a short silence of the sensors is bridged, and told", "[bench][explain]") {
  const test::ScratchFolder scratch;
  write_vibration(scratch / "one.csv", 0, 1, 30000);
  std::ofstream(scratch / "c.json")
      << json{{"campaign", "one"},
              {"files", {{{"file", "one.csv"}, {"speed_from_vibration", read_as("one.csv")}}}}}
             .dump();
  const auto read = read_campaign(scratch / "c.json");
  REQUIRE(read.index() == 0);
  const Campaign& campaign = std::get<Campaign>(read);
  for (const CampaignRecord& record : campaign.records) {
    const Eigen::VectorXd& speed = record.recording.find("speed")->samples;
    CHECK((speed.array() - 1).abs().maxCoeff() < 5e-4);
  }
  REQUIRE(campaign.notes.size() == 2);
  CHECK_THAT(campaign.notes[0], Contains("bridged by straight lines"));
}

TEST_CASE("speed itself is told where the rate is known, and refused where it is not",
          "[bench][explain]") {
  const test::ScratchFolder scratch;
  const json absolute{{"relative_to", nullptr}, {"nominal_Hz", nullptr}};
  const auto read = one_file(scratch, absolute, {{"rate_Hz", 2500}});
  REQUIRE(read.index() == 0);
  const Channel& speed = *std::get<Campaign>(read).records[0].recording.find("speed");
  CHECK(speed.info.unit == "rad/s");
  CHECK(speed.samples.mean() == Approx(2 * std::numbers::pi * 25).epsilon(1e-4));
  CHECK_THAT(why_not(one_file(scratch, absolute)), Contains("NOT_RESOLVABLE"));
}

TEST_CASE("a speed that cannot be had is refused with its reason", "[bench][explain]") {
  const test::ScratchFolder scratch;
  CHECK_THAT(why_not(one_file(scratch, {{"turns_per_sample", 0.0125}})),
             Contains("do not show the lines of two_stage"));
  CHECK_THAT(why_not(one_file(scratch, {{"kinematics", "no_such"}})), Contains("no_such"));
  CHECK_THAT(why_not(one_file(scratch, {{"relative_to", "absent.csv"}})), Contains("absent.csv"));
  CHECK_THAT(why_not(one_file(scratch, {{"block_turns", 500}})), Contains("shorter than"));
  CHECK_THAT(why_not(one_file(scratch, {{"block_turns", 1}, {"turns_per_sample", 0.02}})),
             Contains("too few samples"));
  CHECK_THAT(why_not(one_file(scratch, {{"nominal_Hz", nullptr}})), Contains("nominal_Hz"));
}

}  // namespace rvbench::bench
