#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stop_token>
#include <utility>

#include "bench/bench_lock.hpp"
#include "bench/commands/commands.hpp"
#include "bench/commands/shaft_question.hpp"
#include "bench/drive_probe.hpp"
#include "bench/fault_lines.hpp"
#include "bench/json_text.hpp"
#include "bench/plug_test.hpp"
#include "bench/rig_factory.hpp"
#include "bench/rig_file.hpp"
#include "bench/stop_on_signal.hpp"
#include "hal/json_object.hpp"
#include "hal/steady_clock.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench {
namespace {

using Json = nlohmann::ordered_json;

// The drive to ask, and what it needs to live.
struct Probed {
  hal::Rig rig;       // of a simulated bench
  std::string where;  // "192.168.3.10:502, unit 1"
  std::string profile, about;
  std::vector<std::string> unverified;
  double timeout_s = 0;  // as configured; 0: not to be told
};

Probed open_bench(const BenchRig& bench) {
  const hal::ModbusInverterOptions& options = bench.drive.options;
  Probed probed{.rig = {},
                .where = address_of(bench.drive),
                .profile = options.profile.name,
                .about = options.profile.about,
                .unverified = options.profile.unverified,
                .timeout_s = options.response_timeout_s};
  probed.rig.clock = std::make_unique<hal::SteadyClock>();
  probed.rig.drive = std::make_unique<hal::ModbusInverter>(options, *probed.rig.clock);
  return probed;
}

Json to_json(const Probed& probed, const DriveProbe& probe) {
  Json json =
      hal::json_object({{"drive", probed.where},
                        {"profile", probed.profile},
                        {"answers", !probe.failed},
                        {"error", probe.failed ? Json(describe(*probe.failed)) : Json(nullptr)}});
  if (!probe.failed) {
    json["running"] = probe.status.running;
    json["tripped"] = probe.status.tripped;
    json["fault_code"] = probe.status.fault_code;
    json["remote"] = probe.status.remote;
    json["reading_s"] = hal::json_object({{"median", quantile_s(probe, 0.5)},
                                          {"p99", quantile_s(probe, 0.99)},
                                          {"longest", quantile_s(probe, 1)}});
    json["readings"] = probe.cycles_s.size();
    json["lost"] = probe.lost;
    json["retries"] = probe.retries;
    json["proposed_timeout_s"] = proposed_timeout_s(probe);
    json["watchdog"] = hal::json_object(
        {{"timeout_s", probe.watchdog.timeout_s}, {"stops_motor", probe.watchdog.stops_motor}});
  }
  json["unverified"] = probed.unverified;
  const std::string refusal = refusal_to_arm(probe);
  json["arms"] = refusal.empty();
  json["refusal"] = refusal.empty() ? Json(nullptr) : Json(refusal);
  return json;
}

std::string listed_keys(const std::vector<std::string>& keys) {
  std::string all;
  for (const std::string& key : keys) all += (all.empty() ? "" : ", ") + key;
  return all;
}

void print(Console& console, const Probed& probed, const DriveProbe& probe) {
  const auto line = [&](const char* name, const std::string& text) {
    console.out << fmt::format("  {:<14}{}\n", name, text);
  };
  console.out << "drive at " << probed.where << '\n';
  if (!probed.profile.empty()) line("profile", probed.profile + ": " + probed.about);
  if (probe.failed) {
    line("answers", paint(console, Tone::bad, "no: " + describe(*probe.failed)));
  } else {
    const hal::DriveStatus& status = probe.status;
    line("answers", fmt::format("{}, {}", status.running ? "running" : "stopped",
                                status.tripped ? fmt::format("fault code {}", status.fault_code)
                                               : "no fault"));
    line("obeys", status.remote ? "the wire" : "its panel");
    line("a reading", fmt::format("{:.1f} ms (median), {:.1f} ms (99 of 100), {:.1f} ms (longest)",
                                  1e3 * quantile_s(probe, 0.5), 1e3 * quantile_s(probe, 0.99),
                                  1e3 * quantile_s(probe, 1)));
    line("", fmt::format("{} read, {} lost, {} asked again", probe.cycles_s.size(), probe.lost,
                         probe.retries));
    std::string proposal = fmt::format("{:.0f} ms would do", 1e3 * proposed_timeout_s(probe));
    if (probed.timeout_s > 0) {
      proposal = fmt::format("{:.0f} ms as configured; ", 1e3 * probed.timeout_s) + proposal;
    }
    line("time-out", proposal);
    const auto [timeout_s, stops_motor] = probe.watchdog;
    line("watchdog",
         timeout_s == 0 ? "off, or cannot be read"
                        : fmt::format("{:g} s, {}", timeout_s,
                                      stops_motor ? "stops the motor" : "does not stop the motor"));
  }
  if (!probed.unverified.empty()) {
    line("unverified", listed_keys(probed.unverified));
    line("", "found in one source only: compare with the manual of the drive");
  }
  const std::string refusal = refusal_to_arm(probe);
  console.out << (refusal.empty()
                      ? paint(console, Tone::good, "A run may arm it.")
                      : paint(console, Tone::bad, "A run would refuse to arm it: " + refusal + "."))
              << '\n';
}

class ProbeCommand final : public Command {
 public:
  explicit ProbeCommand(std::filesystem::path lock_folder) : lock_folder_(std::move(lock_folder)) {}
  std::string name() const override { return "probe"; }
  std::string summary() const override {
    return "what answers at the drive's address, how fast, and whether it is safe to arm";
  }
  std::string examples() const override {
    return "  rvbench probe --rig bench_a.json\n"
           "  rvbench probe --rig bench_a.json --json\n"
           "  rvbench probe --rig bench_a.json --pull-the-plug    proves, with somebody at the\n"
           "                                     bench, that the drive stops when its link dies\n"
           "Asks the configured address only, and tells the drive to stop. Exit code 0 if a run\n"
           "may arm it, else 30.\n";
  }
  std::vector<Option> options() override {
    return {{"--rig", "rig: sim, or a rig file", &rig_, true},
            {"--readings",
             "how often its state is read; default: 200",
             &readings_,
             false,
             {},
             100000,
             10},
            {"--pull-the-plug", "turn the motor and pull its cable", &pull_the_plug_},
            {"--speed", "motor speed [rpm] for that; default: 150", &speed_rpm_},
            {"--yes", "do not ask whether the shaft may turn", &yes_},
            {"--json", "one JSON document on standard output", &json_}};
  }
  int run(Console& console) override;

 private:
  int probe_bench(Console& console, const BenchRig& bench);
  int probe(Console& console, const Probed& probed);

  const std::filesystem::path lock_folder_;
  std::string rig_;
  std::optional<std::uint64_t> readings_;
  std::optional<double> speed_rpm_;
  bool pull_the_plug_ = false;
  bool yes_ = false;
  bool json_ = false;
};

int ProbeCommand::run(Console& console) {
  if (!is_positive(console, "probe: --speed", speed_rpm_)) return exit_codes::usage;
  auto file = read_rig(rig_, {});
  if (file.index() == 1) return refuse_file(console, rig_, std::get<1>(file));
  const RigFile& rig = std::get<0>(file);
  if (std::holds_alternative<ReplayRig>(rig)) {
    return refuse_file(console, rig_,
                       with_lines(rig_, {{0, "/rig", "a recording has no drive to ask"}}));
  }
  remark(console, "warning", rig_, remarks_on(rig_).warnings);
  if (const auto* bench = std::get_if<BenchRig>(&rig)) return probe_bench(console, *bench);
  auto made = make_rig(rig_, {});
  if (made.index() == 1) return refuse_file(console, rig_, std::get<1>(made));
  return probe(console, {.rig = std::get<0>(std::move(made)),
                         .where = "the simulated bench",
                         .profile = "",
                         .about = "",
                         .unverified = {},
                         .timeout_s = 0});
}

int ProbeCommand::probe_bench(Console& console, const BenchRig& bench) {
  const auto lock = lock_devices(console, name(), devices_of(bench.drive), lock_folder_);
  return lock ? probe(console, open_bench(bench)) : exit_codes::usage;
}

int ProbeCommand::probe(Console& console, const Probed& probed) {
  const double max_rpm = probed.rig.drive->limits().max_speed_rpm;
  const PlugTestOptions options{.speed_rpm = speed_rpm_.value_or(PlugTestOptions().speed_rpm)};
  if (options.speed_rpm > max_rpm) {
    return refuse_usage(console, fmt::format("probe: --speed is {:g} rpm, the drive does {:g}",
                                             options.speed_rpm, max_rpm));
  }
  const StopOnSignal signals;
  const std::string why = pull_the_plug_ && !yes_ ? why_not_to_turn(console, signals.token()) : "";
  if (signals.token().stop_requested()) return exit_codes::aborted;
  if (!why.empty()) return refuse_usage(console, "probe: " + why);
  const DriveProbe probe =
      probe_drive(*probed.rig.drive, static_cast<int>(readings_.value_or(200)), signals.token());
  Json json = to_json(probed, probe);
  if (!json_) print(console, probed, probe);
  bool passed = refusal_to_arm(probe).empty();
  if (pull_the_plug_ && passed) {
    // The shaft turns: it waits for no terminal that has been stopped.
    const auto tell = [&](const std::string& what) {
      if (takes_a_line(console)) console.err << "  > " << what << std::endl;
    };
    const PlugTest test =
        pull_the_plug(*probed.rig.drive, *probed.rig.clock, options, tell, signals.token());
    passed = test.passed;
    json["plug_pulled"] = hal::json_object({{"passed", test.passed}, {"finding", test.finding}});
    if (!json_) {
      console.out << (test.passed
                          ? paint(console, Tone::good, "Plug pulled: " + test.finding + ".")
                          : paint(console, Tone::bad, "Plug test failed: " + test.finding + "."))
                  << '\n';
    }
  }
  if (json_) console.out << json_text(json);
  if (signals.token().stop_requested()) return exit_codes::aborted;
  return passed ? exit_codes::done : exit_code({Outcome::error, ErrorKind::device_lost, ""});
}

}  // namespace

std::unique_ptr<Command> make_probe_command(std::filesystem::path lock_folder) {
  return std::make_unique<ProbeCommand>(std::move(lock_folder));
}

}  // namespace rvbench::bench
