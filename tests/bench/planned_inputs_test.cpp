#include "bench/planned_inputs.hpp"

#include <catch2/catch.hpp>

#include "bench/simulated_recording.hpp"
#include "bench/text_file.hpp"
#include "hal/formats/read_recordings.hpp"
#include "sim/plant_json.hpp"
#include "sim/rv_plant.hpp"
#include "tests/sim/plant_texts.hpp"
#include "tests/sim/rv_train.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

constexpr double rate_Hz = 496;

// A point of a run: what it was planned to be, and a transducer's channel.
Recording point(double speed_rpm, double load_pct, Eigen::Index samples = 248) {
  Recording recording;
  recording.planned_speed_rpm = speed_rpm;
  recording.load_pct = load_pct;
  recording.repeat = 2;
  recording.channels = {
      {{"input_torque", "N·m", "", not_known}, rate_Hz, 30, Eigen::VectorXd::Zero(samples)},
      {{"input_angle", "rad", "", not_known}, rate_Hz, 30, Eigen::VectorXd::Zero(samples)}};
  return recording;
}

// What the plant makes of a point, without the lead-in.
Recording simulated(const sim::PlantSpec& plant, const Recording& like) {
  const DrivenBy driven = *planned_inputs(plant, like, 167);
  Recording made = like;
  made.channels = test::run_of(plant, driven.channels);
  for (Channel& channel : made.channels) drop_lead_in(channel, driven.lead_in);
  return made;
}

}  // namespace

TEST_CASE("a point's plan says what drove it", "[bench]") {
  const DrivenBy driven = *planned_inputs(sim::rv20e_bench(), point(605, 50), 167);
  const Channel& supply = *find_channel(driven.channels, "supply");
  const Channel& brake = *find_channel(driven.channels, "brake_torque");
  CHECK(supply.samples.minCoeff() == Approx(2 * 605.0 / 60));
  CHECK(supply.samples.maxCoeff() == supply.samples.minCoeff());
  CHECK(brake.samples.minCoeff() == Approx(83.5));
  CHECK(supply.info.unit == "Hz");
  CHECK(supply.samples.size() == 248 + driven.lead_in);
  CHECK(supply.start_s + static_cast<double>(driven.lead_in) / rate_Hz == Approx(30));
}

TEST_CASE("what no plan says is not made up", "[bench]") {
  CHECK_FALSE(planned_inputs(sim::rv20e_bench(), point(not_known, 50), 167));
  CHECK_FALSE(planned_inputs(sim::rv20e_bench(), point(605, not_known), 167));
  CHECK_FALSE(planned_inputs(sim::rv20e_bench(), Recording{}, 167));
  const auto emps = std::get<sim::PlantSpec>(sim::read_plant("emps"));
  CHECK_FALSE(planned_inputs(emps, point(605, 50), 167));
}

TEST_CASE("a channel that was recorded goes before the plan", "[bench]") {
  Recording recording = point(605, 50);
  recording.channels.push_back(recording.channels.front());
  recording.channels.back().info.name = "supply";
  const DrivenBy driven = what_drove(sim::rv20e_bench(), recording, 167);
  CHECK(driven.lead_in == 0);
  CHECK(find_channel(driven.channels, "supply")->samples == recording.channels.back().samples);
  const Channel* brake = find_channel(driven.channels, "brake_torque");  // which nobody recorded
  REQUIRE(brake != nullptr);
  CHECK(brake->samples.size() == recording.channels.back().samples.size());
  CHECK(brake->samples.maxCoeff() == Approx(83.5));
}

TEST_CASE("records of a run are driven by its plan, in step with what was recorded", "[bench]") {
  Campaign campaign;
  campaign.records.resize(2);
  campaign.records[0].recording = point(605, 50, 4960);
  campaign.records[1].recording.channels = point(605, 50).channels;  // of no plan
  add_planned_inputs(sim::rv20e_bench(), campaign);
  const CampaignRecord& record = campaign.records[0];
  CHECK(record.lead_in == 992);  // two seconds of it
  for (const char* name : {"supply", "brake_torque"}) {
    const Channel* channel = record.recording.find(name);
    REQUIRE(channel != nullptr);
    CHECK(channel->samples.size() == 4960);
    CHECK(channel->start_s == record.recording.find("input_torque")->start_s);
  }
  CHECK(campaign.records[1].recording.channels.size() == 2);
  CHECK(campaign.records[1].lead_in == 0);

  const Campaign driven = campaign;
  add_planned_inputs(sim::rv20e_bench(), campaign);  // it has them now
  CHECK(campaign.records[0].recording.channels.size() ==
        driven.records[0].recording.channels.size());
}

TEST_CASE("100 % load is what the plan beside the recording says", "[bench]") {
  const rvbench::test::ScratchFolder scratch;
  const auto brake_Nm = [&] {
    const double rated_Nm = rated_torque_beside_Nm(scratch / "recording.h5");
    const auto driven = what_drove(sim::rv20e_bench(), point(605, 50), rated_Nm);
    return find_channel(driven.channels, "brake_torque")->samples[0];
  };
  CHECK(brake_Nm() == Approx(83.5));
  write_file(scratch / "plan.json", R"({
    "name": "half", "specimen": {"kinematics": "rv20e", "gear_ratio": 121,
                                 "rated_output_torque_Nm": 100},
    "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                   "housing_temp_degC": 60, "stale_after_s": 0.3},
    "setup": [{"phase": "connect"}],
    "main": [{"phase": "matrix", "speeds_rpm": [605], "loads_pct": [50],
              "record": {"output_turns": 4}}]})");
  CHECK(brake_Nm() == Approx(50));
}

TEST_CASE("a simulated point is in steady motion from its first sample", "[bench]") {
  const auto even = test::rv_plant({.supply_Hz = 1});
  const double speed_rpm = GENERATE(605, 1815), load_pct = GENERATE(0, 150);
  const Recording made = simulated(even, point(speed_rpm, load_pct));
  const Eigen::VectorXd& torque = made.find("input_torque")->samples;
  CHECK(torque.maxCoeff() - torque.minCoeff() < 1e-6 * torque.mean());
}

TEST_CASE("simulated points read back from rvbench's own format", "[bench]") {
  const rvbench::test::ScratchFolder scratch;
  const Recording made = simulated(sim::rv20e_bench(), point(605, 100));
  REQUIRE(write_hdf5(scratch / "sim.h5", {made, made}));
  const auto read = hal::read_recordings(scratch / "sim.h5");
  REQUIRE(read);
  REQUIRE(read.value().size() == 2);
  const Recording& again = read.value().back();
  CHECK(again.planned_speed_rpm == 605);
  CHECK(again.load_pct == 100);
  CHECK(again.repeat == 2);
  CHECK(again.status == "ok");
  CHECK(again.find("input_angle")->samples == made.find("input_angle")->samples);
  CHECK(again.find("input_torque")->samples.isApprox(made.find("input_torque")->samples, 1e-6));
  CHECK(again.find("input_torque")->rate_Hz == rate_Hz);
  CHECK(again.speed_rpm < 605);  // slip
  CHECK(again.speed_rpm > 0.97 * 605);
  CHECK_FALSE(write_hdf5(scratch / "sim.h5", {made}));  // never overwritten
  CHECK_FALSE(write_hdf5(scratch / "no.h5", {Recording{}}));
}

}  // namespace rvbench::bench
