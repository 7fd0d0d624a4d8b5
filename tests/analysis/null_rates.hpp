#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace rvbench::test {

/// p-values of noise alone: how often they fall below a level, against how often they may.
///
/// Of n draws n·level fall below it, give or take 4 binomial standard deviations: a right p-value
/// fails this at one level for one choice of seeds in 16000.
class NullRates : public Catch::MatcherBase<std::vector<double>> {
 public:
  enum class Claim { exact, at_most };  ///< at_most: a p-value that may err to the safe side

  NullRates(Claim claim, std::vector<double> levels) : claim_(claim), levels_(std::move(levels)) {}

  bool match(const std::vector<double>& p_values) const override {
    return std::all_of(levels_.begin(), levels_.end(), [&](double level) {
      const auto draws = static_cast<double>(p_values.size());
      const auto below = static_cast<double>(
          std::count_if(p_values.begin(), p_values.end(), [level](double p) { return p < level; }));
      const double give = 4 * std::sqrt(draws * level * (1 - level));
      const bool few_enough = below <= draws * level + give;
      return few_enough && (claim_ == Claim::at_most || below >= draws * level - give);
    });
  }
  std::string describe() const override {
    std::ostringstream out;
    out << (claim_ == Claim::exact ? "fall" : "at most fall") << " as often as stated below";
    for (const double level : levels_) out << ' ' << level;
    return out.str();
  }

 private:
  Claim claim_;
  std::vector<double> levels_;
};

inline NullRates UniformBelow(std::vector<double> levels) {
  return {NullRates::Claim::exact, std::move(levels)};
}
inline NullRates NoOftenerThanStated(std::vector<double> levels) {
  return {NullRates::Claim::at_most, std::move(levels)};
}

}  // namespace rvbench::test
