#include "bench/order_errors.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::bench {
namespace {

using analysis::LockedTo;

constexpr double least_jitter = 0.01;        // of a line: what a plant's own lines are good for
constexpr double least_mean_scatter = 5e-4;  // of a mean, likewise

}  // namespace

void read_features(const OrderCondition& condition, OrderRecord& record) {
  const std::vector<OrderFeature>& features = condition.features;
  record.values.resize(Eigen::Index(features.size()));
  record.noise.resize(record.values.size());
  auto timed = record.timed.begin();
  for (std::size_t f = 0; f < features.size(); ++f) {
    const analysis::PeriodLines& lines = record.measured.outputs[features[f].output];
    const auto at = Eigen::Index(f);
    switch (features[f].locked_to) {
      case LockedTo::nothing:
        record.values[at] = lines.mean;
        record.noise[at] = 0;
        break;
      case LockedTo::shaft:
        record.values[at] = lines.amplitude[features[f].order];
        record.noise[at] = lines.noise[features[f].order];
        break;
      case LockedTo::time:
        record.values[at] = timed->amplitude;
        record.noise[at] = timed->noise;
        ++timed;
        break;
    }
  }
}

void find_errors(const std::vector<OrderCondition>& conditions, std::size_t outputs,
                 std::vector<OrderRecord>& records) {
  Eigen::VectorXd scatter = Eigen::VectorXd::Zero(Eigen::Index(outputs));
  Eigen::VectorXd freedom = scatter;
  double jitter = 0, power = 0;
  std::vector<Eigen::VectorXd> means;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const std::vector<OrderFeature>& features = conditions[c].features;
    std::vector<const OrderRecord*> repeats;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(Eigen::Index(features.size()));
    for (const OrderRecord& record : records) {
      if (record.condition != c) continue;
      repeats.push_back(&record);
      mean += record.values;
    }
    const auto count = double(repeats.size());
    mean /= count;
    means.push_back(mean);
    if (repeats.size() < 2 || !repeats.front()->about.learned_from) continue;
    for (std::size_t f = 0; f < features.size(); ++f) {
      const auto at = Eigen::Index(f);
      double squares = 0, noise = 0;
      for (const OrderRecord* record : repeats) {
        squares += std::pow(record->values[at] - mean[at], 2);
        noise += 0.5 * std::pow(record->noise[at], 2) / count;
      }
      if (features[f].locked_to == LockedTo::nothing) {
        scatter[Eigen::Index(features[f].output)] += squares;
        freedom[Eigen::Index(features[f].output)] += count - 1;
      } else if (mean[at] * mean[at] > std::pow(clearly_above_noise, 2) * noise) {
        jitter += squares / (count - 1) - noise;
        power += mean[at] * mean[at];
      }
    }
  }
  const double jitter_share =
      std::hypot(least_jitter, power > 0 ? std::sqrt(std::max(jitter / power, 0.0)) : 0);
  for (OrderRecord& record : records) {
    const std::vector<OrderFeature>& features = conditions[record.condition].features;
    const Eigen::VectorXd& mean = means[record.condition];
    record.errors.resize(record.values.size());
    for (std::size_t f = 0; f < features.size(); ++f) {
      const auto at = Eigen::Index(f);
      const auto o = Eigen::Index(features[f].output);
      if (features[f].locked_to == LockedTo::nothing) {
        const double repeated = freedom[o] > 0 ? std::sqrt(scatter[o] / freedom[o]) : 0;
        record.errors[at] = std::hypot(repeated, least_mean_scatter * mean[at]);
      } else {
        record.errors[at] = std::hypot(std::sqrt(0.5) * record.noise[at], jitter_share * mean[at]);
      }
    }
  }
}

}  // namespace rvbench::bench
