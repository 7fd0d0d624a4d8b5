#include "bench/qualification/self_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "bench/qualification/self_test_steps.hpp"
#include "hal/no_recording.hpp"
#include "sequences/bench_loop.hpp"
#include "sequences/phase_registry.hpp"
#include "sequences/plan_on_rig.hpp"

namespace rvbench::bench {
namespace {

constexpr double stale_after_s = 0.3;
constexpr double most_of_speed = 1.5;
constexpr double most_of_range = 0.9;

// One step as a phase of a plan.
class StepPhase final : public sequences::Phase {
 public:
  StepPhase(std::unique_ptr<SelfTestStep> step, const SelfTestSpec& spec, SelfTestResult& result)
      : step_(std::move(step)), spec_(spec), result_(result) {}

  std::string_view kind() const override { return step_->name(); }
  std::string to_json() const override { return "{}"; }  // it is of no plan file
  std::vector<sequences::Segment> timeline(const sequences::Specimen&) const override {
    return {step_->segment(spec_)};
  }

  std::optional<Ending> run(sequences::BenchLoop& loop, const sequences::Specimen&) override {
    loop.enter(step_->segment(spec_));
    result_.reason = "it did not come to its end";
    auto ending = step_->run(loop, spec_, result_);
    if (ending) {
      result_.word = SelfTestWord::cannot_tell;
      result_.reason = "it did not come to its end: " + ending->reason;
    }
    loop.event(fmt::format("{}: {}", step_->name(), to_string(result_.word)));
    return ending;
  }

 private:
  std::unique_ptr<SelfTestStep> step_;
  const SelfTestSpec& spec_;
  SelfTestResult& result_;
};

sequences::TestPlan plan_of(const SelfTestSpec& spec, const hal::Rig& rig) {
  sequences::TestPlan plan;
  plan.name = "self_test";
  plan.specimen = {"", spec.gear_ratio, spec.brake_torque_Nm};
  plan.acceleration_rate_Hz = rig.accelerometers->rate_Hz();
  plan.interlocks = {
      .input_speed_rpm = most_of_speed * spec.speed_rpm,
      .input_torque_Nm = spec.most_input_torque_Nm,
      .acceleration_m_s2 =
          std::min(spec.most_acceleration_m_s2, most_of_range * rig.accelerometers->range_m_s2()),
      .housing_temp_degC = spec.most_housing_temp_degC,
      .stale_after_s = stale_after_s};
  auto connect = hal::ConfigReader::from_text(R"({"phase": "connect"})", "self_test");
  plan.setup.push_back(sequences::parse_phase(connect));
  return plan;
}

bool is_well(const SelfTestResult& step, const SelfTestSpec& spec) {
  return step.word == SelfTestWord::passed ||
         (step.word == SelfTestWord::skipped && !(step.step == tap_step && spec.tap));
}

// What the sequencer's threads refer to.
struct Underway {
  SelfTestSpec spec;
  SelfTest test;
  sequences::TestPlan plan;
  hal::NoRecording nowhere;
};

}  // namespace

bool SelfTest::passed(const SelfTestSpec& spec) const {
  return ending.outcome == Outcome::pass && !steps.empty() &&
         std::ranges::all_of(steps, [&](const auto& step) { return is_well(step, spec); });
}

bool SelfTest::has_failed_step() const {
  return std::ranges::any_of(
      steps, [](const SelfTestResult& step) { return step.word == SelfTestWord::failed; });
}

std::string SelfTest::reason(const SelfTestSpec& spec) const {
  const bool is_whole = ending.outcome == Outcome::pass;
  std::string reasons = is_whole ? "" : ending.reason;
  for (const SelfTestResult& step : steps) {
    // Of one that was ended, what it did not reach is no news.
    if (is_whole ? is_well(step, spec) : step.word != SelfTestWord::failed) continue;
    reasons += (reasons.empty() ? "" : "; ") +
               fmt::format("{}: {} ({})", step.step, to_string(step.word), step.reason);
  }
  return reasons.empty() ? "every step passed" : reasons;
}

SelfTest run_self_test(const SelfTestSpec& spec, bool with_tap, hal::Rig& rig,
                       sequences::RunObserver& observer, std::stop_token stop) {
  auto bench = std::make_unique<Underway>(Underway{spec, {}, plan_of(spec, rig), {}});
  std::vector<std::unique_ptr<SelfTestStep>> steps = self_test_steps();
  bench->test.steps.resize(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    SelfTestResult& result = bench->test.steps[i];
    result.step = std::string(steps[i]->name());
    if (result.step == tap_step && !(with_tap && spec.tap)) {
      result.word = SelfTestWord::skipped;
      result.reason = spec.tap ? "nobody was there to tap" : "the rig file asks for none";
      continue;
    }
    bench->plan.main.push_back(
        std::make_unique<StepPhase>(std::move(steps[i]), bench->spec, result));
  }
  const sequences::RunSummary summary =
      sequences::run_sequence(bench->plan, rig, bench->nowhere, observer, std::move(stop));
  SelfTest test = bench->test;
  test.ending = summary.ending;
  test.must_exit = summary.supervisor_hung || summary.bus_hung || summary.observer_hung;
  if (test.must_exit) (void)bench.release();  // a thread that hangs may go on in there
  return test;
}

std::string why_not_on(const hal::Rig& rig, const SelfTestSpec& spec) {
  sequences::TestPlan plan = plan_of(spec, rig);
  auto unused = std::make_unique<SelfTestResult>();
  for (auto& step : self_test_steps()) {
    plan.main.push_back(std::make_unique<StepPhase>(std::move(step), spec, *unused));
  }
  const auto faults = sequences::faults_of_plan_on(rig, plan);
  return faults.empty() ? "" : faults.front().message;
}

}  // namespace rvbench::bench
