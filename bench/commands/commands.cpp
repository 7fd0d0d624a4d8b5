#include "bench/commands/commands.hpp"

#include <fmt/format.h>

#include <cmath>
#include <system_error>
#include <utility>

#include "hal/did_you_mean.hpp"
#include "hal/formats/printable.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

constexpr double slowest_rate_Hz = 1e-3, fastest_rate_Hz = 1e8;

}  // namespace

std::vector<std::unique_ptr<Command>> make_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(make_run_command());
  commands.push_back(make_check_command());
  commands.push_back(make_probe_command());
  commands.push_back(make_qualify_command());
  commands.push_back(make_devices_command());
  commands.push_back(make_judge_command());
  commands.push_back(make_tpa_command());
  commands.push_back(make_compare_command());
  commands.push_back(make_explain_command());
  commands.push_back(make_simulate_command());
  commands.push_back(make_import_command());
  commands.push_back(make_export_command());
  commands.push_back(make_report_command());
  commands.push_back(make_history_command());
  commands.push_back(make_gage_command());
  commands.push_back(make_chart_command());
  commands.push_back(make_trend_command());
  commands.push_back(make_rejudge_command());
  commands.push_back(make_limits_command());
  commands.push_back(make_serve_command());
  commands.push_back(make_publish_command());
  return commands;
}

int refuse_file(Console& console, const std::filesystem::path& file,
                const std::vector<hal::ConfigFault>& faults) {
  for (const hal::ConfigFault& fault : faults) {
    complain(console, "rvbench: " + hal::describe(file, fault));
  }
  return exit_codes::bad_file;
}

void remark(Console& console, const char* kind, const std::filesystem::path& file,
            const std::vector<hal::ConfigFault>& remarks) {
  for (const hal::ConfigFault& at : remarks) {
    const std::string text = hal::formats::printable(hal::describe(file, at));
    console.err << "rvbench: " << kind << ": " << text << '\n';
  }
}

int refuse_usage(Console& console, const std::string& message) {
  complain(console, "rvbench: " + message);
  return exit_codes::usage;
}

int refuse_measure(Console& console, const std::string& command, const std::string& name) {
  std::vector<std::string> names;
  for (const Measure& measure : measures()) names.emplace_back(measure.name);
  return refuse_usage(console, command + ": " + hal::in_quotes(name) + " is not measured" +
                                   hal::what_there_is(name, names));
}

std::optional<BenchLock> lock_devices(Console& console, const std::string& command,
                                      const std::vector<std::string>& devices,
                                      const std::filesystem::path& folder) {
  try {
    auto taken = BenchLock::take(devices, folder);
    if (taken.index() == 0) return std::get<0>(std::move(taken));
    refuse_usage(console, command + ": " + std::get<1>(taken));
  } catch (const std::system_error& error) {
    refuse_usage(console, command + ": the devices cannot be locked: " + error.what());
  }
  return std::nullopt;
}

bool is_positive(Console& console, const std::string& option, std::optional<double> value) {
  if (!value || (*value > 0 && std::isfinite(*value))) return true;
  refuse_usage(console, option + " must be above 0 and finite");
  return false;
}

bool is_rate(Console& console, std::optional<double> rate_Hz) {
  if (!rate_Hz || (*rate_Hz >= slowest_rate_Hz && *rate_Hz <= fastest_rate_Hz)) return true;
  refuse_usage(console,
               fmt::format("--rate must be {:g} to {:g} Hz", slowest_rate_Hz, fastest_rate_Hz));
  return false;
}

int tell_interrupted(Console& console, const std::string& command) {
  complain(console, "rvbench: " + command + ": interrupted; nothing was written");
  return exit_codes::aborted;
}

int refuse_data(Console& console, const std::string& message) {
  complain(console, "rvbench: " + message);
  return exit_codes::data_refused;
}

}  // namespace rvbench::bench
