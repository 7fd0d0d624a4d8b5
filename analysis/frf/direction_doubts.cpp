#include "analysis/frf/direction_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "analysis/frf/reciprocity.hpp"
#include "analysis/frf/signed_axis.hpp"

namespace rvbench::analysis {

namespace {

constexpr double agrees = 0.8;
constexpr double usual_lean_rad = 0.1;  // of a hammer, and of what a sensor hears across its axis

using Place = std::pair<std::string, std::string>;  // point, axis

Place place_of(const DegreeOfFreedom& place) {
  return {place.point, axis_of(place.direction).axis};
}

std::string name_of(const Place& place) { return place.first + " " + place.second; }

class DirectionCheck {
 public:
  DirectionCheck(const std::vector<FrequencyResponse>& responses, const FrfBand& band)
      : responses_(responses), band_(band), pairs_(reciprocal_pairs(responses, band)) {}

  std::vector<DirectionDoubt> doubts() {
    doubt_driving_points();
    doubt_swapped_axes();
    doubt_signs();
    doubt_the_rest();
    return std::move(doubts_);
  }

 private:
  void add(DirectionDoubtKind kind, const Place& place, const std::string& other_axis, double score,
           std::string reason) {
    doubts_.push_back({kind, {place.first, place.second}, other_axis, score, std::move(reason)});
  }

  void doubt_driving_points() {
    for (const FrequencyResponse& frf : responses_) {
      const auto point = check_driving_point(frf, band_, {});
      if (!point || point->word != DrivingPointWord::reversed) continue;
      const Place place = place_of(frf.response);
      if (!reversed_.insert(place).second) continue;
      add(DirectionDoubtKind::reversed_sign, place, "", point->positive_share,
          fmt::format("{}: {:.0f} % of the driving point's mobility is positive: hammer or sensor "
                      "is reversed",
                      name_of(place), 100 * point->positive_share));
    }
  }

  Place first_of(const ReciprocalPair& pair) const {
    return place_of(responses_[pair.first].response);
  }
  Place second_of(const ReciprocalPair& pair) const {
    return place_of(responses_[pair.first].excitation);
  }

  // Response at (point, axis) to a force at `other`, against the answer of `other` to a force at
  // (point, by_axis); NaN if either was not measured.
  double score_across(const Place& at, const std::string& by_axis, const Place& other) const {
    const FrequencyResponse *there = nullptr, *back = nullptr;
    for (const FrequencyResponse& frf : responses_) {
      const Place response = place_of(frf.response), excitation = place_of(frf.excitation);
      if (response == at && excitation == other) there = &frf;
      if (response == other && excitation == Place{at.first, by_axis}) back = &frf;
    }
    return there && back ? std::abs(reciprocity(*there, *back, band_).band_score) : not_a_score;
  }

  // All other places must say so.
  bool is_swapped(const std::string& point, const std::string& a, const std::string& b) const {
    int told = 0;
    for (const ReciprocalPair& pair : pairs_) {
      for (const auto& [at, other] : {std::pair{first_of(pair), second_of(pair)},
                                      std::pair{second_of(pair), first_of(pair)}}) {
        if (at.first != point || other.first == point) continue;
        if (at.second != a && at.second != b) continue;
        const std::string& across = at.second == a ? b : a;
        const double crossed = score_across(at, across, other);
        if (crossed == not_a_score) continue;
        const double straight = std::abs(pair.reciprocity.band_score);
        if (crossed < agrees || straight >= agrees) return false;
        ++told;
      }
    }
    return told >= 2;
  }

  void doubt_swapped_axes() {
    std::map<std::string, std::set<std::string>> axes;
    for (const ReciprocalPair& pair : pairs_) {
      for (const Place& place : {first_of(pair), second_of(pair)}) {
        axes[place.first].insert(place.second);
      }
    }
    for (const auto& [point, of_point] : axes) {
      for (auto a = of_point.begin(); a != of_point.end(); ++a) {
        for (auto b = std::next(a); b != of_point.end(); ++b) {
          if (!is_swapped(point, *a, *b)) continue;
          swapped_.insert({point, *a});
          swapped_.insert({point, *b});
          add(DirectionDoubtKind::swapped_axes, {point, *a}, *b, agrees,
              fmt::format("{}: {} and {} seem exchanged, of its sensor or of the hammer", point, *a,
                          *b));
        }
      }
    }
  }

  bool is_explained(const ReciprocalPair& pair) const {
    return swapped_.contains(first_of(pair)) || swapped_.contains(second_of(pair));
  }

  // A place reversed by most of its pairs, once those of places already known are turned.
  void doubt_signs() {
    while (true) {
      std::map<Place, std::pair<int, int>> votes;  // reversed, all
      for (const ReciprocalPair& pair : pairs_) {
        if (is_explained(pair)) continue;
        const double score = turned(pair);
        for (const Place& place : {first_of(pair), second_of(pair)}) {
          votes[place].first += score < -agrees ? 1 : 0;
          ++votes[place].second;
        }
      }
      const auto worst = std::ranges::max_element(votes, {}, [](const auto& vote) {
        return double(vote.second.first) / vote.second.second;
      });
      if (worst == votes.end() || worst->second.second < 2 ||
          2 * worst->second.first <= worst->second.second || reversed_.contains(worst->first)) {
        return;
      }
      reversed_.insert(worst->first);
      add(DirectionDoubtKind::reversed_sign, worst->first, "", -1,
          fmt::format("{}: {} of {} reciprocal pairs are equal but for the sign: hammer or sensor "
                      "is reversed",
                      name_of(worst->first), worst->second.first, worst->second.second));
    }
  }

  // Whether a pair differs by no more than hits and sensors that lean make of the largest response
  // between its points: weak pairs beside strong ones differ by more than they are.
  bool is_lean(const ReciprocalPair& pair) const {
    const double powers = band_power(responses_[pair.first]) + band_power(responses_[pair.second]);
    const double apart = powers * (1 - turned(pair));
    const std::string &one = first_of(pair).first, &other = second_of(pair).first;
    double largest = 0;
    for (const FrequencyResponse& frf : responses_) {
      const bool is_between = (frf.response.point == one && frf.excitation.point == other) ||
                              (frf.response.point == other && frf.excitation.point == one);
      if (is_between) largest = std::max(largest, band_power(frf));
    }
    return apart < 2 * usual_lean_rad * usual_lean_rad * largest;
  }

  double band_power(const FrequencyResponse& frf) const {
    double power = 0;
    for (Eigen::Index line = 0; line < frf.values.size(); ++line) {
      const double frequency_Hz = frf.frequency_Hz(line);
      if (frequency_Hz < band_.from_Hz || frequency_Hz > band_.to_Hz) continue;
      power += std::norm(frf.values[line]);
    }
    return power;
  }

  double turned(const ReciprocalPair& pair) const {
    const int turns =
        int(reversed_.contains(first_of(pair))) + int(reversed_.contains(second_of(pair)));
    return turns == 1 ? -pair.reciprocity.band_score : pair.reciprocity.band_score;
  }

  void doubt_the_rest() {
    for (const ReciprocalPair& pair : pairs_) {
      const double score = turned(pair);
      if (is_explained(pair) || score > agrees || is_lean(pair)) continue;
      const Place one = first_of(pair), other = second_of(pair);
      const bool is_reversed = score < -agrees;
      add(is_reversed ? DirectionDoubtKind::reversed_sign : DirectionDoubtKind::not_reciprocal, one,
          other.second, score,
          fmt::format("{} and {}: reciprocity of {:.2f}{}", name_of(one), name_of(other), score,
                      is_reversed ? ": one of the two is reversed" : ""));
    }
  }

  static constexpr double not_a_score = -1;

  const std::vector<FrequencyResponse>& responses_;
  const FrfBand& band_;
  std::vector<ReciprocalPair> pairs_;
  std::set<Place> reversed_, swapped_;
  std::vector<DirectionDoubt> doubts_;
};

}  // namespace

std::vector<DirectionDoubt> direction_doubts(const std::vector<FrequencyResponse>& responses,
                                             const FrfBand& band) {
  return DirectionCheck(responses, band).doubts();
}

}  // namespace rvbench::analysis
