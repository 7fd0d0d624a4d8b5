#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <variant>
#include <vector>

#include "bench/commands/commands.hpp"
#include "bench/file_kind.hpp"
#include "bench/judging.hpp"
#include "bench/ledger.hpp"
#include "bench/report/pdf/pdf_report.hpp"
#include "bench/report/report.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_results.hpp"
#include "bench/run_start.hpp"
#include "bench/sha256.hpp"
#include "bench/stored_run.hpp"
#include "bench/text_file.hpp"
#include "hal/formats/file_draft.hpp"

namespace rvbench::bench {
namespace {

// Only what is made anew may differ from its hash: new hashes must not bless anything else.
bool is_sound(Console& console, const std::filesystem::path& folder, bool with_pdf) {
  bool sound = true;
  for (const std::string& fault : changed_files(folder)) {
    if (with_pdf && fault.starts_with("report.pdf:")) continue;
    complain(console, (folder / fault).string());
    sound = false;
  }
  return sound;
}

constexpr const char* lacks_characters =
    "some characters are in no font of this machine and are boxes with their codes: install one "
    "that has them (Debian: fonts-droid-fallback or fonts-noto-cjk for Chinese and Japanese)";

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
            {"--out", "with --pdf: a copy of report.pdf in this file", &out_},
            {"--force", "replace the file that --out names", &force_}};
  }

  int run(Console& console) override {
    if (!out_.empty() && !pdf_) {
      return refuse_usage(console, "report: --out is where a copy of report.pdf goes: add --pdf");
    }
    if (const std::string why = why_not_out(); !why.empty()) {
      return refuse_usage(console, "report: --out: " + why);
    }
    const std::filesystem::path folder = folder_;
    const auto read = read_stored_run(folder);
    if (const auto* faults = std::get_if<FileFaults>(&read)) {
      return refuse_file(console, faults->first, faults->second);
    }
    if (!is_sound(console, folder, pdf_)) return exit_codes::bad_file;
    const StoredRun& stored = std::get<StoredRun>(read);
    try {
      const ReportInput input = report_input(folder, stored.as_judged,
                                             with_limits(stored.kinematics, stored.plan.limits));
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
      const std::optional<FileLock> alone = lock_run(folder);
      if (!alone) return refuse_file(console, folder, {{0, "", still_at_work}});
      if (const Status copied = write_copy(paper); !copied) {
        return refuse_usage(console, "report: --out: " + copied.error().where);
      }
      write_reports(folder, make_report(input), paper);
    } catch (const std::system_error& error) {
      return refuse_usage(console, std::string("report: cannot be written: ") + error.what());
    }
    console.out << (folder / (pdf_ ? "report.pdf" : "report.html")).string() << '\n';
    return exit_codes::done;
  }

 private:
  // Empty: a copy may go there. The files of a run are its own, whoever asks.
  std::string why_not_out() const {
    if (out_.empty()) return "";
    const std::filesystem::path place = std::filesystem::absolute(out_).parent_path();
    if (!is_absent(place / "plan.json")) {
      return out_ + ": " + place.string() + " is a run folder, which holds report.pdf itself";
    }
    for (const char* name : {result_database_name, ledger_name}) {
      if (is_absent(place / name) && is_absent(place.parent_path() / name)) continue;
      return out_ + ": " + place.string() + " is a folder of runs";
    }
    const Status free = hal::formats::check_place(out_, force_);
    return free ? "" : free.error().where;
  }

  // Before anything of the run: what names no place to write to leaves its folder as it is.
  Status write_copy(const std::string& paper) const {
    if (out_.empty()) return Done{};
    hal::formats::FileDraft draft(out_, force_);
    Status done = draft.begin();
    if (done) done = draft.write(paper);
    return done ? draft.finish() : done;
  }

  void write_reports(const std::filesystem::path& folder, const std::string& html,
                     const std::string& paper) const {
    write_file(folder / "report.html", html);
    if (pdf_) write_file(folder / "report.pdf", paper);
    std::vector<std::string> made = {"report.html"};
    if (pdf_) made.emplace_back("report.pdf");
    renew_sums(folder, made);
  }

  std::string folder_, out_;
  bool pdf_ = false, force_ = false;
};

}  // namespace

std::unique_ptr<Command> make_report_command() { return std::make_unique<ReportCommand>(); }

}  // namespace rvbench::bench
