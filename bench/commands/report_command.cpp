#include <filesystem>
#include <string>
#include <system_error>
#include <variant>
#include <vector>

#include "bench/commands/commands.hpp"
#include "bench/judging.hpp"
#include "bench/run_results.hpp"
#include "bench/sha256.hpp"
#include "bench/stored_run.hpp"

namespace rvbench::bench {
namespace {

class ReportCommand final : public Command {
 public:
  std::string name() const override { return "report"; }
  std::string summary() const override { return "rebuilds report.html of a run folder"; }
  std::string examples() const override { return "  rvbench report runs/A17/20260102T030405Z\n"; }
  std::vector<Option> options() override { return {{"RUN", "run folder", &folder_, true, {}}}; }

  int run(Console& console) override {
    const std::filesystem::path folder = folder_;
    const auto read = read_stored_run(folder);
    if (const auto* faults = std::get_if<FileFaults>(&read)) {
      return refuse_file(console, faults->first, faults->second);
    }
    const StoredRun& stored = std::get<StoredRun>(read);
    // Only the report may differ from its hash: new hashes must not bless anything else.
    const std::vector<std::string> changed = changed_files(folder);
    for (const std::string& fault : changed) complain(console, (folder / fault).string());
    if (!changed.empty()) return exit_codes::bad_file;
    try {
      write_report(folder, stored.as_judged, with_limits(stored.kinematics, stored.plan.limits));
      write_sums(folder);
    } catch (const std::system_error& error) {
      return refuse_usage(console, std::string("report: cannot be written: ") + error.what());
    }
    console.out << (folder / "report.html").string() << '\n';
    return exit_codes::done;
  }

 private:
  std::string folder_;
};

}  // namespace

std::unique_ptr<Command> make_report_command() { return std::make_unique<ReportCommand>(); }

}  // namespace rvbench::bench
