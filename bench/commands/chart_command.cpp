#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>
#include <variant>

#include "bench/commands/commands.hpp"
#include "bench/out_folder.hpp"
#include "bench/station/chart_file.hpp"
#include "bench/station/chart_json.hpp"
#include "bench/station/chart_page.hpp"
#include "bench/station/chart_text.hpp"
#include "bench/text_file.hpp"

namespace rvbench::bench {
namespace {

const std::vector<analysis::ControlRule>& rules_of(const std::string& name) {
  return name == "western_electric" ? analysis::western_electric_rules() : analysis::nelson_rules();
}

// Puts what could be told into its place. @return why it could not
template <typename T>
std::string take(std::variant<T, std::string> told, T& place) {
  if (auto* why = std::get_if<std::string>(&told)) return std::move(*why);
  place = std::get<T>(std::move(told));
  return "";
}

class ChartCommand final : public Command {
 public:
  std::string name() const override { return "chart"; }
  std::string summary() const override { return "control charts, and capability against limits"; }
  std::string examples() const override {
    return "  rvbench chart golden.csv --baseline 20\n"
           "  rvbench chart lost_motion.csv --upper 1 --out charted\n"
           "FILE has a value in each row, in the order of time:\n"
           "  time,value [arcmin]\n"
           "  2026-01-31T08:00,0.79\n"
           "A column run (a serial number, say) may stand in place of time.\n";
  }
  std::vector<Option> options() override {
    return {{"FILE", "CSV: time or run, value", &file_, true},
            {"--lower", "least value that is allowed: for Cpk and Ppk", &limits_.lower},
            {"--upper", "greatest value that is allowed: likewise", &limits_.upper},
            {"--baseline",
             "the first so many values make the chart, the others are held against it; default: "
             "all make it",
             &baseline_,
             false,
             {},
             UINT32_MAX,
             std::uint64_t(analysis::least_baseline)},
            {"--rules",
             "patterns that are asked for; default: " + rules_,
             &rules_,
             false,
             {"nelson", "western_electric"}},
            {"--out", "folder for chart.json and chart.html; default: none are written", &out_},
            {"--json", "one JSON document on standard output", &json_}};
  }

  int run(Console& console) override;

 private:
  int check_options(Console& console, OutFolder& folder) const;
  // By the first so many values. @return why there is none
  std::string make_chart(Eigen::Index first, ChartAnswer& answer) const;
  // A folder that has chart.json has all.
  void write_out(const ChartAnswer& answer) const {
    const std::filesystem::path folder = out_;
    write_file(folder / "chart.html", make_chart_page(answer));
    write_file(folder / "chart.json", chart_to_json(answer));
  }

  std::string file_;
  analysis::SpecificationLimits limits_;
  std::optional<std::uint64_t> baseline_;
  std::string rules_ = "nelson";
  std::string out_;
  bool json_ = false;
};

int ChartCommand::check_options(Console& console, OutFolder& folder) const {
  const auto& [lower, upper] = limits_;
  if ((lower && !std::isfinite(*lower)) || (upper && !std::isfinite(*upper))) {
    return refuse_usage(console, "chart: --lower and --upper must be finite");
  }
  if (lower && upper && !(*lower < *upper)) {
    return refuse_usage(console, "chart: --lower must be below --upper");
  }
  if (out_.empty()) return exit_codes::done;
  const std::string why = folder.make(out_, {"plan.json", "chart.json", "chart.html"});
  return why.empty() ? exit_codes::done
                     : refuse_usage(console, "chart: --out " + out_ + ": " + why);
}

std::string ChartCommand::make_chart(Eigen::Index first, ChartAnswer& answer) const {
  const Eigen::VectorXd& values = answer.data.values;
  analysis::ChartBaseline baseline;
  std::string why = take(analysis::baseline_of(values.head(first)), baseline);
  if (!why.empty()) return why;
  if (!(baseline.sigma > 0)) {
    return "the values of the baseline are all alike: too coarse for a chart";
  }
  why = take(analysis::chart_of(values, baseline, rules_of(rules_)), answer.chart);
  if (why.empty()) why = take(analysis::ewma_of(values, baseline), answer.ewma);
  if (!why.empty() || (!limits_.lower && !limits_.upper)) return why;
  return take(analysis::capability_of(values, limits_), answer.capability.emplace());
}

int ChartCommand::run(Console& console) {
  OutFolder folder;
  if (const int refused = check_options(console, folder); refused != exit_codes::done) {
    return refused;
  }
  auto data = read_chart_file(file_);
  if (!data) return refuse_data(console, "chart: " + data.error().where);
  ChartAnswer answer{file_, std::move(data).value(), {}, {}, limits_, {}};
  const Eigen::VectorXd& values = answer.data.values;
  const auto first = baseline_ ? Eigen::Index(*baseline_) : values.size();
  if (first > values.size()) {
    return refuse_data(console, fmt::format("chart: {}: {} values, and --baseline asks for {}",
                                            file_, values.size(), first));
  }
  if (const std::string why = make_chart(first, answer); !why.empty()) {
    return refuse_data(console, "chart: " + file_ + ": " + why);
  }
  try {
    if (!out_.empty()) write_out(answer);
  } catch (const std::system_error& error) {
    return refuse_usage(console, std::string("chart: --out: ") + error.what());
  }
  if (json_) {
    console.out << chart_to_json(answer);
  } else {
    print_chart(console, answer);
    if (!out_.empty()) console.out << "\nReport: " << out_ << "/chart.html\n";
  }
  return exit_codes::done;
}

}  // namespace

std::unique_ptr<Command> make_chart_command() { return std::make_unique<ChartCommand>(); }

}  // namespace rvbench::bench
