#include "tests/survival/small_run.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <stop_token>
#include <system_error>
#include <utility>

#include "bench/acceptance.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/run_start.hpp"
#include "hal/mirror_rig.hpp"
#include "hal/types/units.hpp"
#include "tests/support/passing_devices.hpp"
#include "tests/support/plan_of.hpp"
#include "tests/survival/disk_calls.hpp"
#include "tests/survival/rig_in_real_time.hpp"
#include "tests/survival/watched_recording.hpp"

namespace rvbench::test {
namespace {

// A busy computer may hold up a run in real time: staleness is tested elsewhere.
const std::string plan_text = R"({
  "name": "survival", "acceleration_rate_Hz": 2480,
  "specimen": {"kinematics": "gear0", "gear_ratio": 12, "rated_output_torque_Nm": 20},
  "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                 "housing_temp_degC": 60, "stale_after_s": 2},
  "setup": [{"phase": "connect"},
            {"phase": "warm_up", "duration_s": 1, "speed_rpm": 1800, "load_pct": 50}],
  "main": [{"phase": "matrix", "speeds_rpm": [1800], "loads_pct": [25, 50, 100],
            "settling": {"hold_s": 0.5, "timeout_s": 10}, "record": {"output_turns": 6}}],
  "teardown": {"standstill_timeout_s": 10}
})";

// Adds what a good unit sounds like: noise, and weak lines of shaft and teeth.
class Housing final : public PassingAccelerometers {
 public:
  Housing(std::unique_ptr<hal::Accelerometers> silent, const hal::MirrorWorld& world)
      : PassingAccelerometers(std::move(silent)), world_(world), channels_(behind_->channels()) {
    channels_.resize(3);  // enough, and quicker to judge
  }

  const std::vector<ChannelInfo>& channels() const override { return channels_; }

 protected:
  void show(hal::AccelerationBlock& block) override {
    block.scans.conservativeResize(block.scans.rows(), Eigen::Index(channels_.size()));
    for (Eigen::Index i = 0; i < block.scans.rows(); ++i) {
      turns_ += world_.speed_rpm() / 60 / rate_Hz();
      const double angle_rad = units::two_pi * turns_;
      const double hum = 0.2 * std::sin(angle_rad) + 0.4 * std::sin(23 * angle_rad + 1);
      for (Eigen::Index c = 0; c < block.scans.cols(); ++c) {
        block.scans(i, c) += static_cast<float>(hum + 0.1 * noise());
      }
    }
  }

 private:
  // Within ±1, by the numbers of L'Ecuyer's 64-bit congruential generator (Knuth's MMIX).
  double noise() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11U) / 4503599627370496.0 - 1;
  }

  const hal::MirrorWorld& world_;
  std::vector<ChannelInfo> channels_;
  double turns_ = 0;
  std::uint64_t state_ = 1;
};

hal::Rig small_rig(double pace) {
  hal::MirrorOptions options;
  options.gear_ratio = 12;
  options.ramp_rpm_s = 5000;
  options.acceleration_rate_Hz = 2480;
  hal::Rig rig = hal::make_mirror_rig(options);
  rig.accelerometers =
      std::make_unique<Housing>(std::move(rig.accelerometers), hal::mirror_world(rig));
  return pace > 0 ? in_real_time(std::move(rig), pace) : std::move(rig);
}

std::optional<bench::RunPlace> place_of(const std::filesystem::path& root,
                                        const sequences::TestPlan& plan, bool resume) {
  const bench::ResolvedFiles resolved{
      {"rig.json", R"({"rig": "mirror"})"},
      {"kinematics.json", bench::kinematics_text(plan.specimen.kinematics)},
      {"plan.json", sequences::plan_to_json(plan)}};
  if (!resume) return bench::begin_run(root, small_run_serial, resolved);
  auto found = bench::resume_run(root, small_run_serial, resolved);
  if (found.index() == 1) return std::nullopt;
  return std::get<0>(std::move(found));
}

std::optional<bench::RunPlace> find_place(const std::filesystem::path& root,
                                          const sequences::TestPlan& plan, bool resume) {
  try {
    return place_of(root, plan, resume);
  } catch (const std::system_error& error) {
    throw NoRunFolder(error.what());
  }
}

}  // namespace

std::optional<SmallRunEnd> make_small_run(const std::filesystem::path& root,
                                          const SmallRunOptions& options) {
  const sequences::TestPlan plan = plan_of(plan_text);
  hal::Rig rig = small_rig(options.pace);
  std::optional<bench::RunPlace> place = find_place(root, plan, options.resume);
  if (!place) return std::nullopt;
  if (options.witnessed) tell("made");
  std::ostringstream nowhere;
  bench::Console console{nowhere, nowhere};
  bench::ProgressBar bar(console, bench::ProgressBar::Style::silent);
  bench::RunFacts facts;
  facts.serial = small_run_serial;
  facts.plan = plan.name;
  facts.software = "survival";
  bench::Acceptance acceptance{plan, std::get<0>(bench::read_kinematics(plan.specimen.kinematics)),
                               place->folder, facts};
  acceptance.begin_recording = [&](const auto& file, const auto& layout) {
    auto made = hal::RecordingWriter::create(file, layout, options.recording);
    if (!options.witnessed || !made) return made;
    return decltype(made)(watched(std::move(made).value(), file));
  };
  SmallRunEnd end;
  end.judgement = bench::run_acceptance(std::move(acceptance), rig, bar, {});
  end.folder = place->folder;
  rig.clock->wait_until(rig.clock->now_s() + 5);
  (void)rig.drive->read();  // the shaft as it is by then
  end.at_rest = hal::mirror_world(rig).speed_rpm() == 0;
  return end;
}

}  // namespace rvbench::test
