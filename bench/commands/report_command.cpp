#include <filesystem>
#include <system_error>
#include <utility>
#include <variant>

#include "bench/commands/commands.hpp"
#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/report/pdf/pdf_report.hpp"
#include "bench/report/report.hpp"
#include "bench/run_results.hpp"
#include "bench/run_start.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {
namespace {

// Only what is made anew may differ from its hash: new hashes must not bless anything else.
bool is_sound(Console& console, const std::filesystem::path& folder, bool with_pdf) {
  bool sound = true;
  for (const std::string& fault : verify_sums(folder)) {
    if (fault.starts_with("report.html:")) continue;
    if (with_pdf && fault.starts_with("report.pdf:")) continue;
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

constexpr const char* lacks_characters =
    "some characters are in no font of this machine and are boxes with their codes: install one "
    "that has them (Debian: fonts-droid-fallback or fonts-noto-cjk for Chinese and Japanese)";

struct Judged {
  Judgement judgement;
  analysis::Kinematics kinematics;
};

// What a run came to; refused if it has not come to its end, or if its files are not as it left
// them.
std::variant<Judged, int> judged_run(Console& console, const std::filesystem::path& folder,
                                     bool with_pdf) {
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
  auto judgement = judgement_from_json(text.value_or(""));
  if (!judgement) {
    return refuse_file(console, folder / "verdict.json",
                       {{0, "", text ? "is no verdict" : "cannot be read"}});
  }
  if (!is_sound(console, folder, with_pdf)) return exit_codes::bad_file;
  return Judged{std::move(*judgement),
                with_limits(of_specimen(std::get<0>(kinematics), test.specimen), test.limits)};
}

class ReportCommand final : public Command {
 public:
  std::string name() const override { return "report"; }
  std::string summary() const override { return "rebuilds the reports of a run folder"; }
  std::string examples() const override {
    return "  rvbench report runs/A17/20260102T030405Z                    report.html\n"
           "  rvbench report runs/A17/20260102T030405Z --pdf              and report.pdf\n"
           "  rvbench report runs/A17/20260102T030405Z --pdf --out A17.pdf    a copy of it\n"
           "rvbench check tells whether either was changed since.\n";
  }
  std::vector<Option> options() override {
    return {{"RUN", "run folder", &folder_, true, {}},
            {"--pdf", "report.pdf as well: a page for the verdict, and an appendix", &pdf_},
            {"--out", "with --pdf: a copy of report.pdf in this file", &out_}};
  }

  int run(Console& console) override {
    if (!out_.empty() && !pdf_) {
      return refuse_usage(console, "report: --out is where a copy of report.pdf goes: add --pdf");
    }
    const std::filesystem::path folder = folder_;
    const auto judged = judged_run(console, folder, pdf_);
    if (judged.index() == 1) return std::get<1>(judged);
    const auto& [judgement, kinematics] = std::get<0>(judged);
    try {
      const ReportInput input = report_input(folder, judgement, kinematics);
      std::string paper;
      if (pdf_) {
        auto made = make_pdf_report(input);
        if (const auto* why = std::get_if<std::string>(&made)) {
          return refuse_usage(console, "report: no report.pdf: " + *why);
        }
        const PdfReport& report = std::get<PdfReport>(made);
        if (report.lacks_characters) {
          remark(console, "warning", folder / "report.pdf", {{0, "", lacks_characters}});
        }
        paper = report.bytes;
      }
      write_reports(folder, make_report(input), paper);
    } catch (const std::system_error& error) {
      return refuse_usage(console, std::string("report: cannot be written: ") + error.what());
    }
    console.out << (folder / (pdf_ ? "report.pdf" : "report.html")).string() << '\n';
    return exit_codes::done;
  }

 private:
  // Its copy first: what names no place to write to leaves the folder as it is.
  void write_reports(const std::filesystem::path& folder, const std::string& html,
                     const std::string& paper) const {
    if (!out_.empty()) write_file(out_, paper);
    write_file(folder / "report.html", html);
    if (pdf_) write_file(folder / "report.pdf", paper);
    write_sums(folder);
  }

  std::string folder_, out_;
  bool pdf_ = false;
};

}  // namespace

std::unique_ptr<Command> make_report_command() { return std::make_unique<ReportCommand>(); }

}  // namespace rvbench::bench
