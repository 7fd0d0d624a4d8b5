#include "bench/order_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rvbench::bench {
namespace {

using analysis::LockedTo;

constexpr double plants_own = 0.01;          // of a line: what a plant's own lines are good for
constexpr double least_mean_scatter = 5e-4;  // of a mean, likewise

Eigen::VectorXd mean_of(const std::vector<const OrderRecord*>& records) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(records.front()->values.size());
  for (const OrderRecord* record : records) mean += record->values;
  return mean / static_cast<double>(records.size());
}

// Adds up, over repeats of conditions that are learned from, what each part of the errors is told
// by.
class ScatterSums {
 public:
  explicit ScatterSums(std::size_t outputs) : of_(outputs) {}

  void add(const OrderCondition& condition, const std::vector<const OrderRecord*>& repeats) {
    const Eigen::VectorXd mean = mean_of(repeats);
    const auto count = static_cast<double>(repeats.size());
    for (std::size_t f = 0; f < condition.features.size(); ++f) {
      const auto at = static_cast<Eigen::Index>(f);
      Sums& of = of_[condition.features[f].output];
      double squares = 0, noise = 0;
      for (const OrderRecord* record : repeats) {
        squares += std::pow(record->values[at] - mean[at], 2);
        noise += 0.5 * std::pow(record->noise[at], 2) / count;
      }
      if (condition.features[f].locked_to == LockedTo::nothing) {
        of.squares += squares;
        of.freedom += count - 1;
        continue;
      }
      of.noise += noise;
      ++of.lines;
      const bool is_clear = mean[at] * mean[at] > std::pow(clearly_above_noise, 2) * noise;
      if (count < 2 || !is_clear) continue;
      jitter_ += squares / (count - 1) - noise;
      power_ += mean[at] * mean[at];
    }
  }

  OrderScatter told() const {
    OrderScatter scatter;
    for (const Sums& of : of_) {
      scatter.of_means.push_back(of.freedom > 0 ? std::sqrt(of.squares / of.freedom) : not_known);
      scatter.beside_lines.push_back(of.lines > 0 ? std::sqrt(of.noise / of.lines) : not_known);
    }
    if (power_ > 0) scatter.of_lines = std::sqrt(std::max(jitter_ / power_, 0.0));
    return scatter;
  }

 private:
  struct Sums {
    double squares = 0, freedom = 0;  // of means
    double noise = 0, lines = 0;
  };
  std::vector<Sums> of_;  // each output
  double jitter_ = 0, power_ = 0;
};

// Of each output.
std::vector<double> strongest_lines(const OrderRecord& record) {
  std::vector<double> strongest;
  for (const analysis::PeriodLines& lines : record.measured.outputs) {
    strongest.push_back(lines.amplitude.size() > 0 ? lines.amplitude.maxCoeff() : 0);
  }
  return strongest;
}

double or_none(double scatter) { return std::isnan(scatter) ? 0 : scatter; }

// Standard deviation of an amplitude that shows so much on average among noise of this rms
// amplitude: noise alone scatters less than it does along a strong line.
// Source  Rice, Bell Syst. Tech. J. 24, 46-156 (1945): its ends are exact, 6 % off between
double scatter_among_noise(double shown, double noise) {
  if (!(noise > 0)) return 0;
  const double alone = 1 - std::numbers::pi / 4, along_line = 0.5;  // of noise^2
  const double above = std::max(std::pow(shown / noise, 2) - std::numbers::pi / 4, 0.0);
  return noise * std::sqrt(along_line - (along_line - alone) * std::exp(-above));
}

}  // namespace

std::vector<const OrderRecord*> telling_of(std::size_t condition,
                                           const std::vector<OrderRecord>& records) {
  std::vector<const OrderRecord*> all, learned;
  for (const OrderRecord& record : records) {
    if (record.condition != condition) continue;
    all.push_back(&record);
    if (record.about.learned_from) learned.push_back(&record);
  }
  return learned.empty() ? all : learned;
}

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
      case LockedTo::programme: break;  // steady turning has none
    }
  }
}

Eigen::VectorXd shown_by(Eigen::VectorXd features, const OrderCondition& condition,
                         const OrderRecord& record) {
  for (Eigen::Index f = 0; f < features.size(); ++f) {
    if (condition.features[std::size_t(f)].locked_to == LockedTo::nothing) continue;
    features[f] = with_noise(features[f], record.noise[f]);
  }
  return features;
}

OrderScatter scatter_of(const std::vector<OrderCondition>& conditions, std::size_t outputs,
                        const std::vector<OrderRecord>& records) {
  ScatterSums sums(outputs);
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const auto repeats = telling_of(c, records);
    if (repeats.front()->about.learned_from) sums.add(conditions[c], repeats);
  }
  return sums.told();
}

void find_errors(const std::vector<OrderCondition>& conditions, const OrderScatter& scatter,
                 std::vector<OrderRecord>& records) {
  const double of_lines = or_none(scatter.of_lines);
  std::vector<Eigen::VectorXd> means;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    means.push_back(mean_of(telling_of(c, records)));
  }
  for (OrderRecord& record : records) {
    const std::vector<OrderFeature>& features = conditions[record.condition].features;
    // What is off in all repeats alike, they tell no better than one of them.
    const double alike = std::sqrt(double(telling_of(record.condition, records).size()));
    const Eigen::VectorXd& mean = means[record.condition];
    record.errors.resize(record.values.size());
    const std::vector<double> strongest = strongest_lines(record);
    for (std::size_t f = 0; f < features.size(); ++f) {
      const auto at = static_cast<Eigen::Index>(f);
      record.errors[at] =
          features[f].locked_to == LockedTo::nothing
              ? std::hypot(or_none(scatter.of_means[features[f].output]),
                           alike * least_mean_scatter * mean[at])
              : std::hypot(scatter_among_noise(mean[at], record.noise[at]), of_lines * mean[at],
                           alike * std::hypot(plants_own * mean[at],
                                              least_of_strongest * strongest[features[f].output]));
    }
  }
}

}  // namespace rvbench::bench
