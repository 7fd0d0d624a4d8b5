#include "bench/same_recording.hpp"

#include <catch2/catch.hpp>

namespace rvbench::bench {
namespace {

JudgedPoint point_of(const std::vector<double>& rms) {
  JudgedPoint point;
  for (const double value : rms) {
    analysis::ChannelExamination channel;
    channel.rms = value;
    channel.peak = 4 * value;
    channel.kurtosis = 3 + value / 100;
    point.examination.channels.push_back(channel);
  }
  return point;
}

}  // namespace

TEST_CASE("a copy is known by its samples", "[bench][sound]") {
  const JudgedPoint point = point_of({1.1, 1.2, 1.3});
  CHECK(are_of_one_recording(point, point));
  CHECK_FALSE(are_of_one_recording(point, point_of({1.11, 1.21, 1.31})));
}

TEST_CASE("a copy with fewer digits or other channels is one", "[bench][sound]") {
  const JudgedPoint point = point_of({1.1, 1.2, 1.3});
  CHECK(are_of_one_recording(point, point_of({1.100001, 1.200001, 1.299999})));
  CHECK(are_of_one_recording(point, point_of({1.2})));
  CHECK(are_of_one_recording(point_of({1.2, 1.3}), point));
}

TEST_CASE("one channel that two records share makes them no copies, and silence none",
          "[bench][sound][null]") {
  CHECK_FALSE(are_of_one_recording(point_of({1.1, 1.2}), point_of({1.1, 1.4})));
  CHECK_FALSE(are_of_one_recording(point_of({0, 0}), point_of({0, 0})));
  CHECK_FALSE(are_of_one_recording(point_of({}), point_of({})));
}

TEST_CASE("one point among many is enough", "[bench][sound]") {
  Judgement one, other;
  one.points = {point_of({1.1}), point_of({2.2})};
  other.points = {point_of({2.2})};
  CHECK(share_a_recording(one, other));
  other.points = {point_of({3.3})};
  CHECK_FALSE(share_a_recording(one, other));
}

}  // namespace rvbench::bench
