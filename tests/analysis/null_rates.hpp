#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace rvbench::test {

/// p-values of independent draws of noise.
struct NullDraws {
  std::vector<double> p_values;

  double share_below(double level) const {
    const auto below =
        std::count_if(p_values.begin(), p_values.end(), [level](double p) { return p < level; });
    return static_cast<double>(below) / static_cast<double>(p_values.size());
  }
};

}  // namespace rvbench::test

namespace Catch {
template <>
struct StringMaker<rvbench::test::NullDraws> {
  static std::string convert(const rvbench::test::NullDraws& draws) {
    std::ostringstream out;
    out << draws.p_values.size() << " p-values, shares";
    for (const double level : {0.001, 0.01, 0.1, 0.5, 0.9}) {
      out << ' ' << draws.share_below(level) << " below " << level << ',';
    }
    return out.str();
  }
};
}  // namespace Catch

namespace rvbench::test {

/// p-values of noise alone: how often they fall below a level, against how often they may.
///
/// Of n draws n·level fall below it, give or take 4 binomial standard deviations: a right p-value
/// fails this at one level for one choice of seeds in 16000.
class NullRates : public Catch::MatcherBase<NullDraws> {
 public:
  enum class Claim { exact, at_most };  ///< at_most: a p-value that may err to the safe side

  NullRates(Claim claim, std::vector<double> levels) : claim_(claim), levels_(std::move(levels)) {}

  bool match(const NullDraws& draws) const override {
    return std::all_of(levels_.begin(), levels_.end(), [&](double level) {
      const double share = draws.share_below(level);
      const auto count = static_cast<double>(draws.p_values.size());
      const double give = 4 * std::sqrt(level * (1 - level) / count);
      return share <= level + give && (claim_ == Claim::at_most || share >= level - give);
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
