#include <filesystem>
#include <system_error>

#include "bench/commands/commands.hpp"
#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/run_results.hpp"
#include "bench/run_start.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {
namespace {

// Only the report may differ from its hash: new hashes must not bless anything else.
bool is_sound(Console& console, const std::filesystem::path& folder) {
  bool sound = true;
  for (const std::string& fault : verify_sums(folder)) {
    if (fault.starts_with("report.html:")) continue;
    complain(console, (folder / fault).string());
    sound = false;
  }
  return sound;
}

// The machine as it was when the run began; what the plan names may have changed since.
std::string machine_of(const std::filesystem::path& folder, const sequences::TestPlan& test) {
  const std::filesystem::path own = folder / "kinematics.json";
  return std::filesystem::exists(own) ? own.string() : test.specimen.kinematics;
}

class ReportCommand final : public Command {
 public:
  std::string name() const override { return "report"; }
  std::string summary() const override { return "rebuilds report.html of a run folder"; }
  std::string examples() const override { return "  rvbench report runs/A17/20260102T030405Z\n"; }
  std::vector<Option> options() override { return {{"RUN", "run folder", &folder_, true, {}}}; }

  int run(Console& console) override {
    const std::filesystem::path folder = folder_;
    const auto plan = sequences::read_plan(folder / "plan.json");
    if (plan.index() == 1) return refuse_file(console, folder / "plan.json", std::get<1>(plan));
    const sequences::TestPlan& test = std::get<0>(plan);
    const std::string machine = machine_of(folder, test);
    const auto kinematics = read_kinematics(machine);
    if (kinematics.index() == 1) return refuse_file(console, machine, std::get<1>(kinematics));
    if (is_at_work(folder)) return refuse_file(console, folder, {{0, "", still_at_work}});
    const auto text = read_file(folder / "verdict.json");
    if (!text && !has_sums(folder)) {
      return refuse_file(
          console, folder,
          {{0, "", "the run has not come to its end: rvbench run --resume goes on with it"}});
    }
    const auto judgement = judgement_from_json(text.value_or(""));
    if (!judgement) {
      return refuse_file(console, folder / "verdict.json",
                         {{0, "", text ? "is no verdict" : "cannot be read"}});
    }
    if (!is_sound(console, folder)) return exit_codes::bad_file;
    try {
      write_report(folder, *judgement,
                   with_limits(of_specimen(std::get<0>(kinematics), test.specimen), test.limits));
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
