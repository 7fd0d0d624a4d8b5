#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>
#include <string>

#include "analysis/spectrum.hpp"

namespace Catch {
template <>
struct StringMaker<rvbench::analysis::Spectrum> {
  static std::string convert(const rvbench::analysis::Spectrum& s) {
    Eigen::Index top = 0;
    const double peak = s.amplitude.maxCoeff(&top);
    std::ostringstream out;
    out << "spectrum of " << s.amplitude.size() << " lines, highest " << peak << " at "
        << s.axis(top);
    return out.str();
  }
};
}  // namespace Catch

namespace rvbench::test {

/// The highest line lies within half a line of `where` on the axis.
class PeaksAt : public Catch::MatcherBase<analysis::Spectrum> {
 public:
  explicit PeaksAt(double where) : where_(where) {}

  bool match(const analysis::Spectrum& s) const override {
    Eigen::Index top = 0;
    s.amplitude.maxCoeff(&top);
    return std::abs(s.axis(top) - where_) <= s.resolution / 2;
  }
  std::string describe() const override {
    return "peaks within half a line of " + std::to_string(where_);
  }

 private:
  double where_;
};

/// No line within [from, to] on the axis is above `most`.
class IsBelow : public Catch::MatcherBase<analysis::Spectrum> {
 public:
  IsBelow(double most, double from, double to) : most_(most), from_(from), to_(to) {}

  bool match(const analysis::Spectrum& s) const override {
    for (Eigen::Index line = 0; line < s.amplitude.size(); ++line) {
      const bool inside = s.axis(line) >= from_ && s.axis(line) <= to_;
      if (inside && !(s.amplitude[line] <= most_)) return false;
    }
    return true;
  }
  std::string describe() const override {
    std::ostringstream out;
    out << "is below " << most_ << " from " << from_ << " to " << to_;
    return out.str();
  }

 private:
  double most_, from_, to_;
};

}  // namespace rvbench::test
