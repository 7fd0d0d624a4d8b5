#include "bench/order_between.hpp"

#include <algorithm>
#include <cmath>

#include "bench/order_choice.hpp"
#include "bench/order_errors.hpp"

namespace rvbench::bench {
namespace {

using analysis::PeriodLines;

constexpr double passed_by_window = 1e-3;  // of the orders beside it, where speed is not quite even
constexpr Eigen::Index window_orders = 4;  // to each side

using Records = std::vector<const OrderRecord*>;

// The strongest of the orders beside it.
double beside(const PeriodLines& lines, Eigen::Index k) {
  const Eigen::Index from = std::max<Eigen::Index>(1, k + 1 - window_orders);
  const Eigen::Index to = std::min(lines.amplitude.size() - 1, k + window_orders);
  return to < from ? 0 : lines.amplitude.segment(from, to - from + 1).maxCoeff();
}

// Standard error of the amplitude there.
double error_of(const PeriodLines& lines, Eigen::Index k) {
  return std::hypot(std::sqrt(0.5) * lines.between_noise[k], passed_by_window * beside(lines, k),
                    least_of_strongest * lines.amplitude.maxCoeff());
}

bool is_clear(const Records& records, std::size_t output, Eigen::Index k) {
  const auto clear = std::ranges::count_if(records, [&](const OrderRecord* record) {
    const PeriodLines& lines = record->measured.outputs[output];
    return lines.between[k] > clearly_above_noise * std::sqrt(2) * error_of(lines, k);
  });
  return 2 * static_cast<std::size_t>(clear) > records.size();
}

// Lines of an output that a condition shows, the one of order k + ½ as k.
std::vector<int> shown_between(const sim::PlantSpec& plant, const OrderCampaign& seen,
                               std::size_t condition, std::size_t output) {
  const Records records = telling_of(condition, seen.records);
  const OrderCondition& under = seen.conditions[condition];
  const std::vector<double> timed =
      orders_of_timed(plant, under, records, seen.period_turns, output);
  std::vector<int> shown;
  for (int k = 0; k < under.orders[output]; ++k) {
    const bool follows_time =
        std::ranges::any_of(timed, [&](double at) { return std::abs(at - k - 0.5) < 1; });
    if (!follows_time && is_clear(records, output, k)) shown.push_back(k);
  }
  return shown;
}

analysis::ResidualCell cell_of(const OrderCampaign& seen, const sim::OutputSpec& output,
                               const Records& records, std::size_t o, int k) {
  const auto count = static_cast<double>(records.size());
  double apart = 0, squares = 0;
  for (const OrderRecord* record : records) {
    const PeriodLines& lines = record->measured.outputs[o];
    apart += (lines.between[k] - with_noise(0, lines.between_noise[k])) / count;
    squares += std::pow(error_of(lines, k) / count, 2);
  }
  const RecordLabels& about = records.front()->about;
  return {output.channel,
          output.unit,
          about.condition,
          analysis::LockedTo::shaft,
          (k + 0.5) / seen.period_turns,
          apart,
          std::sqrt(squares),
          about.speed,
          about.load,
          true};
}

}  // namespace

std::vector<analysis::ResidualCell> cells_between_orders(const sim::PlantSpec& plant,
                                                         const OrderCampaign& seen) {
  std::vector<analysis::ResidualCell> cells;
  for (std::size_t o = 0; o < plant.outputs.size(); ++o) {
    std::vector<int> shown;
    for (std::size_t c = 0; c < seen.conditions.size(); ++c) {
      if (!telling_of(c, seen.records).front()->about.learned_from) continue;
      for (const int k : shown_between(plant, seen, c, o)) {
        if (std::ranges::find(shown, k) == shown.end()) shown.push_back(k);
      }
    }
    for (std::size_t c = 0; c < seen.conditions.size(); ++c) {
      const Records records = telling_of(c, seen.records);
      if (!records.front()->about.learned_from) continue;
      for (const int k : shown) {
        if (k >= seen.conditions[c].orders[o]) continue;
        cells.push_back(cell_of(seen, plant.outputs[o], records, o, k));
      }
    }
  }
  return cells;
}

}  // namespace rvbench::bench
