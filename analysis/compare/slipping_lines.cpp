#include "analysis/compare/slipping_lines.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

// Where its lines stand. A line of two parts is the one's that has it to itself.
void tell(const SlippingComb& comb, std::vector<SlippingLine>& lines) {
  for (std::size_t i = 0; i < comb.quantities().size(); ++i) {
    SlippingLine& line = lines[comb.quantities()[i]];
    const bool taken = comb.is_taken(i);
    if (std::isnan(line.order) || (line.taken && !taken)) {
      line = {comb.place_of(i), comb.p_value(), taken};
    }
  }
}

// A peak of the one at which a line of the other stands as well is neither's.
void give_up_shared(const SlippingComb& one, const SlippingComb& other, const SpectralPeaks& peaks,
                    std::vector<SlippingLine>& lines) {
  for (std::size_t i = 0; i < one.quantities().size(); ++i) {
    const auto peak = peaks.at(one.place_of(i), 0);
    if (peak && other.shares({*peak})) lines[one.quantities()[i]].taken = true;
  }
}

SignaturePair pair_of(const SlippingComb& one, const SlippingComb& other) {
  return std::minmax(one.signature(), other.signature());
}

// Whether one repeats a whole number of times while the other does once: 9 and 1, not 2.5 and 1.
bool repeat_together(const Kinematics& kinematics, const SignaturePair& pair) {
  const auto [low, high] = std::minmax(
      {kinematics.signatures[pair.first].order, kinematics.signatures[pair.second].order});
  const double times = std::round(high / low);
  return times > 1 && std::abs(high - times * low) < 1e-6 * high;
}

double stray_of(const Signature& signature) {
  return std::max(signature.slip, signature.tolerance);
}

// Of all lines of parts that may stray.
double highest_order(const Kinematics& kinematics, const std::vector<Quantity>& quantities) {
  double highest = 0;
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    if (!(stray_of(kinematics.signatures[s]) > 0)) continue;
    for (const Quantity& line : quantities) {
      if (line.is_in(s)) highest = std::max(highest, line.order);
    }
  }
  return highest;
}

std::vector<Peak> of_input_shaft(const SpectralPeaks& peaks, double speed_error) {
  std::vector<Peak> found;
  for (double order = 1; peaks.reaches(order); ++order) {
    if (const auto peak = peaks.at(order, speed_error)) found.push_back(*peak);
  }
  return found;
}

}  // namespace

SlippingLines find_slipping_lines(const Kinematics& kinematics,
                                  const std::vector<Quantity>& quantities, const Spectrum& spectrum,
                                  const LineFloor& floor, double blocks, double speed_error) {
  const SpectralPeaks peaks(spectrum, floor, blocks);
  const std::vector<Peak> of_shaft = of_input_shaft(peaks, speed_error);
  const double highest = highest_order(kinematics, quantities);
  std::vector<SlippingComb> waiting;
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    const Signature& signature = kinematics.signatures[s];
    const double stray = stray_of(signature);
    if (stray > 0) {
      waiting.emplace_back(s, signature, stray + speed_error, quantities, highest, peaks, of_shaft);
    }
  }

  SlippingLines found{std::vector<SlippingLine>(quantities.size()), {}};
  std::vector<SlippingComb> shown;
  while (!waiting.empty()) {
    const auto surest = std::ranges::min_element(waiting, {}, &SlippingComb::p_value);
    const SlippingComb first = *surest;
    waiting.erase(surest);
    tell(first, found.lines);
    const std::vector<Peak> explained = first.found();
    if (explained.empty()) continue;
    for (const SlippingComb& earlier : shown) {
      const SignaturePair pair = pair_of(earlier, first);
      if (std::ranges::find(found.unparted, pair) != found.unparted.end()) continue;
      if (repeat_together(kinematics, pair)) found.unparted.push_back(pair);
      give_up_shared(earlier, first, peaks, found.lines);
    }
    shown.push_back(first);
    for (SlippingComb& other : waiting) {
      if (other.shares(explained)) {
        found.unparted.push_back(pair_of(first, other));
      } else {
        other.leave_out(explained);
      }
    }
  }
  return found;
}

}  // namespace rvbench::analysis
