#include "bench/order_cells.hpp"

#include <cmath>
#include <string>

namespace rvbench::bench {
namespace {

using analysis::LockedTo;

constexpr double one_line = 1.5;  // orders of a period: neighbours show one another

double place_of(const OrderFeature& feature, double period_turns) {
  return feature.locked_to == LockedTo::shaft ? feature.order / period_turns : feature.frequency_Hz;
}

std::vector<Twin::Noise> noise_of(const std::vector<sim::OutputSpec>& outputs, std::size_t angle,
                                  const OrderScatter& scatter) {
  std::vector<Twin::Noise> all;
  const auto add = [&](const std::string& channel, const char* of, const std::string& unit,
                       double value) {
    if (!std::isnan(value)) all.push_back({channel, of, unit, value});
  };
  for (std::size_t o = 0; o < outputs.size(); ++o) {
    const auto& [channel, unit] = std::pair(outputs[o].channel, outputs[o].unit);
    const bool is_speed = o == angle;
    add(channel, "mean, from record to record", is_speed ? "rad/s" : unit, scatter.of_means[o]);
    if (is_speed) continue;
    add(channel, "line, from record to record", "%", 100 * scatter.of_lines);
    add(channel, "line, by noise beside it", unit, scatter.beside_lines[o]);
  }
  return all;
}

// Mean of a condition's records, and its standard error.
struct Apart {
  Eigen::VectorXd mean, standard_error;
};

Apart apart_from(const Eigen::VectorXd& expected, const OrderCondition& condition,
                 const std::vector<const OrderRecord*>& records) {
  const auto count = static_cast<double>(records.size());
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(expected.size()), squares = mean;
  for (const OrderRecord* record : records) {
    mean += (record->values - shown_by(expected, condition, *record)) / count;
    squares += record->errors.cwiseAbs2() / (count * count);
  }
  return {mean, squares.cwiseSqrt()};
}

}  // namespace

Twin::Cells order_cells(const std::vector<sim::OutputSpec>& outputs, const OrderCampaign& seen,
                        const OrderScatter& scatter, const std::vector<Eigen::VectorXd>& expected) {
  Twin::Cells cells{{}, one_line / seen.period_turns, noise_of(outputs, seen.angle, scatter)};
  for (std::size_t c = 0; c < expected.size(); ++c) {
    const OrderCondition& condition = seen.conditions[c];
    const auto records = telling_of(c, seen.records);
    if (!records.front()->about.learned_from) continue;
    const Apart apart = apart_from(expected[c], condition, records);
    for (std::size_t f = 0; f < condition.features.size(); ++f) {
      const OrderFeature& feature = condition.features[f];
      const sim::OutputSpec& output = outputs[feature.output];
      const bool is_speed = feature.output == seen.angle;
      const auto at = static_cast<Eigen::Index>(f);
      const RecordLabels& about = records.front()->about;
      const bool is_new =
          feature.locked_to != LockedTo::nothing && expected[c][at] < records.front()->noise[at];
      cells.all.push_back({output.channel, is_speed ? "rad/s" : output.unit, about.condition,
                           feature.locked_to, place_of(feature, seen.period_turns), apart.mean[at],
                           apart.standard_error[at], about.speed, about.load, is_new});
    }
  }
  return cells;
}

}  // namespace rvbench::bench
