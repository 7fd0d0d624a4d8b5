#include "tests/proof/seal/slide_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "tests/proof/seal/noise.hpp"
#include "tests/proof/seal/write_text.hpp"

namespace seal {
namespace {

constexpr Eigen::Index highest_bin = 400;  // the way and what it does lie far below

}  // namespace

void write_records(const std::filesystem::path& folder, const SlideChannels& channels,
                   const std::vector<SlideRecord>& records) {
  nlohmann::json campaign{{"campaign", "one axis"}, {"files", nlohmann::json::array()}};
  for (std::size_t i = 0; i < records.size(); ++i) {
    const SlideRecord& record = records[i];
    const std::string name = fmt::format("record_{}.csv", i + 1);
    std::string rows = channels.input + ',' + channels.output + '\n';
    for (Eigen::Index k = 0; k < record.input.size(); ++k) {
      rows += fmt::format("{:.8g},{:.8g}\n", record.input[k], record.output[k]);
    }
    write_text(folder / name, rows);
    nlohmann::json about{{"condition", record.condition}};
    if (!record.programme.empty()) about["programme"] = record.programme;
    campaign["files"].push_back(
        {{"file", name}, {"rate_Hz", channels.rate_Hz}, {"records", {about}}});
  }
  write_text(folder / "campaign.json", campaign.dump(2) + '\n');
}

SlideChain chain_of(const CasePlan& plan, double rate_Hz, Draw& draw) {
  const std::string like = plan.kind == "null" ? plan.effects.front() : "usual";
  if (like == "clean") return {};
  const double gain = 1 + draw.uniform(-0.02, 0.02), delay_s = draw.uniform(-1, 1) / rate_Hz;
  return {gain, delay_s, draw.uniform(0, like == "strong" ? 1 : 0.5)};
}

double middle_snr_dB(const std::vector<Eigen::VectorXd>& change, double slope, double rate_Hz) {
  std::vector<double> best_of;
  for (const Eigen::VectorXd& record : change) {
    double& best = best_of.emplace_back(0);
    Eigen::VectorXcd spectrum;
    Eigen::FFT<double>().fwd(spectrum, record);
    const auto count = static_cast<double>(record.size());
    for (Eigen::Index k = 1; k < std::min(highest_bin, record.size() / 2); ++k) {
      const double frequency_Hz = static_cast<double>(k) * rate_Hz / count;
      const double expected = noise_density(slope, frequency_Hz, rate_Hz) * count * rate_Hz / 2;
      best = std::max(best, std::norm(spectrum[k]) / expected);
    }
  }
  const auto middle = best_of.begin() + std::ptrdiff_t(best_of.size() / 2);
  std::ranges::nth_element(best_of, middle);
  return 10 * std::log10(*middle);
}

nlohmann::json quantity(double value, const char* unit, const nlohmann::json& tolerance_pct) {
  return {{"value", value}, {"unit", unit}, {"tolerance_pct", tolerance_pct}};
}

double noise_under(const std::vector<HiddenSlide>& hidden, const CasePlan& plan) {
  const double least_dB = std::ranges::min(hidden, {}, &HiddenSlide::shown_dB).shown_dB;
  return std::pow(10, (least_dB - plan.snr_dB) / 20);
}

nlohmann::json answer_of(const std::vector<HiddenSlide>& hidden, const std::string& body,
                         const CasePlan& plan, double noise) {
  nlohmann::json effects = nlohmann::json::array();
  for (const HiddenSlide& one : hidden) {
    effects.push_back({{"name", one.effect.name},
                       {"also", one.effect.also},
                       {"bodies", {body}},
                       {"anywhere", false},
                       {"parameter", one.effect.parameter},
                       {"value", one.value},
                       {"concealment_dB", plan.concealment_dB},
                       {"snr_dB", one.shown_dB - 20 * std::log10(noise)}});
  }
  return {{"effects", effects}, {"noise", noise}};
}

double rms(const Eigen::VectorXd& x) {
  return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

}  // namespace seal
