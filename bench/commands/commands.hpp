#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_lock.hpp"
#include "bench/command.hpp"
#include "hal/config_reader.hpp"

namespace rvbench::bench {

std::unique_ptr<Command> make_run_command(
    std::filesystem::path lock_folder = BenchLock::folder_for_all());
std::unique_ptr<Command> make_check_command();
std::unique_ptr<Command> make_probe_command(
    std::filesystem::path lock_folder = BenchLock::folder_for_all());
std::unique_ptr<Command> make_qualify_command(
    std::filesystem::path lock_folder = BenchLock::folder_for_all());
std::unique_ptr<Command> make_devices_command();
std::unique_ptr<Command> make_judge_command();
std::unique_ptr<Command> make_tpa_command();
std::unique_ptr<Command> make_compare_command();
std::unique_ptr<Command> make_explain_command();
std::unique_ptr<Command> make_simulate_command();
std::unique_ptr<Command> make_import_command();
std::unique_ptr<Command> make_export_command();
std::unique_ptr<Command> make_report_command();
std::unique_ptr<Command> make_history_command();
std::unique_ptr<Command> make_gage_command();
std::unique_ptr<Command> make_chart_command();
std::unique_ptr<Command> make_trend_command();
std::unique_ptr<Command> make_rejudge_command();
std::unique_ptr<Command> make_limits_command();
std::unique_ptr<Command> make_serve_command();
std::unique_ptr<Command> make_publish_command();

/// Prints every fault of a file on standard error, one a line. @return exit_codes::bad_file
int refuse_file(Console& console, const std::filesystem::path& file,
                const std::vector<hal::ConfigFault>& faults);

/// Prints what should be known of a file that is used all the same, as "warning" or "note".
void remark(Console& console, const char* kind, const std::filesystem::path& file,
            const std::vector<hal::ConfigFault>& remarks);

/// Prints why the arguments make no sense. @return exit_codes::usage
int refuse_usage(Console& console, const std::string& message);

/// Prints that nothing of that name is measured, and what is. @return exit_codes::usage
int refuse_measure(Console& console, const std::string& command, const std::string& name);

/// Whether the value of an option is above 0 and finite, or not given; prints it if not.
bool is_positive(Console& console, const std::string& option, std::optional<double> value);

/// Whether --rate is a sample rate, 1 mHz to 100 MHz as in a campaign file, or not given; prints it
/// if not.
bool is_rate(Console& console, std::optional<double> rate_Hz);

/// Keeps other processes from these devices while it lives; prints who has them if that fails.
/// @param command  that wants them: "probe"
/// @param folder   of the locks
std::optional<BenchLock> lock_devices(Console& console, const std::string& command,
                                      const std::vector<std::string>& devices,
                                      const std::filesystem::path& folder);

/// Prints that a signal ended the command before anything was written. @return exit_codes::aborted
int tell_interrupted(Console& console, const std::string& command);

/// Prints why a recording cannot be used. @return exit_codes::data_refused
int refuse_data(Console& console, const std::string& message);

}  // namespace rvbench::bench
