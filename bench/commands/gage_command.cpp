#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "bench/commands/commands.hpp"
#include "bench/out_folder.hpp"
#include "bench/station/gage_file.hpp"
#include "bench/station/gage_json.hpp"
#include "bench/station/gage_page.hpp"
#include "bench/station/gage_text.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

class GageCommand final : public Command {
 public:
  std::string name() const override { return "gage"; }
  std::string summary() const override { return "gage repeatability and reproducibility (R&R)"; }
  std::string examples() const override {
    return "  rvbench gage study.csv\n"
           "  rvbench gage study.csv --tolerance 0.5 --out gage\n"
           "FILE has a reading in each row, in any order:\n"
           "  part,operator,trial,value [mm]\n"
           "  1,Li,1,20.13\n"
           "  1,Li,2,20.15\n"
           "Every operator reads every part equally often, as 10 parts, 3 operators, 3 trials.\n";
  }
  std::vector<Option> options() override {
    return {{"FILE", "CSV: part, operator, trial, value", &file_, true},
            {"--tolerance", "width between both limits, in the unit of the values", &tolerance_},
            {"--out", "folder for gage.json and gage.html; default: none are written", &out_},
            {"--json", "one JSON document on standard output", &json_}};
  }

  int run(Console& console) override {
    if (!is_positive(console, "--tolerance", tolerance_)) return exit_codes::usage;
    OutFolder folder;
    if (!out_.empty()) {
      const std::string why = folder.make(out_, {"plan.json", "gage.json", "gage.html"});
      if (!why.empty()) return refuse_usage(console, "gage: --out " + out_ + ": " + why);
    }
    auto data = read_gage_file(file_);
    if (!data) return refuse_data(console, "gage: " + data.error().where);
    GageAnswer answer{file_, std::move(data).value(), {}, tolerance_};
    auto study = analysis::study_gage(answer.data.readings, answer.confidence);
    if (const auto* why = std::get_if<std::string>(&study)) {
      return refuse_data(console, "gage: " + file_ + ": " + *why);
    }
    answer.study = std::get<0>(std::move(study));
    if (tolerance_ &&
        !std::isfinite(analysis::share_of_tolerance(answer.study.gage, *tolerance_))) {
      return refuse_usage(console,
                          "gage: --tolerance is too small to be held against the readings");
    }
    try {
      if (!out_.empty()) write_out(answer);
    } catch (const std::system_error& error) {
      return refuse_usage(console, std::string("gage: --out: ") + error.what());
    }
    if (json_) {
      console.out << gage_to_json(answer);
    } else {
      print_gage(console, answer);
      if (!out_.empty()) console.out << "\nReport: " << out_ << "/gage.html\n";
    }
    return exit_codes::done;
  }

 private:
  // A folder that has gage.json has all.
  void write_out(const GageAnswer& answer) const {
    const std::filesystem::path folder = out_;
    write_file(folder / "gage.html", make_gage_page(answer));
    write_file(folder / "gage.json", gage_to_json(answer));
  }

  std::string file_;
  std::optional<double> tolerance_;
  std::string out_;
  bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_gage_command() { return std::make_unique<GageCommand>(); }

}  // namespace rvbench::bench
