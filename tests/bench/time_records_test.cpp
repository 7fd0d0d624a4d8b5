#include "bench/time_records.hpp"

#include <catch2/catch.hpp>

#include "sim/term_library.hpp"
#include "tests/bench/moved_slide.hpp"

using namespace rvbench;
using namespace rvbench::bench;
using test::MovedSlide;

namespace {

// Two records of one programme, of so many seconds, the second one with each so many-th sample.
TimeRecords repeats(double first_s, double second_s, Eigen::Index each) {
  Campaign campaign;
  for (const double length_s : {first_s, second_s}) {
    MovedSlide slide;
    slide.length_s = length_s;
    campaign.records.push_back(slide.campaign().records[0]);
  }
  campaign.records[1].name = "again";
  for (Channel& channel : campaign.records[1].recording.channels) {
    const Eigen::Index size = channel.samples.size() / each;
    const Eigen::VectorXd thinned = Eigen::VectorXd::NullaryExpr(
        size, [&](Eigen::Index i) { return channel.samples[i * each]; });
    channel.samples = thinned;
    channel.rate_Hz /= static_cast<double>(each);
  }
  auto read = time_records(MovedSlide::plant(), campaign, sim::standard_terms());
  if (auto* refusal = std::get_if<Refusal>(&read)) FAIL(refusal->faults.front().message);
  return std::get<TimeRecords>(std::move(read));
}

double begins_s(const TimeRecord& record) {
  return static_cast<double>(record.first) / record.excitation.rate_Hz();
}

double ends_s(const TimeRecord& record) {
  return static_cast<double>(record.last) / record.excitation.rate_Hz();
}

}  // namespace

TEST_CASE("repeats are compared over the time that all of them hold", "[bench][explain]") {
  const auto [first_s, second_s] = GENERATE(std::pair(6.0, 3.0), std::pair(3.0, 6.0));
  const TimeRecords read = repeats(first_s, second_s, 1);
  for (const TimeRecord& record : read.all) {
    CHECK(begins_s(record) == Approx(3 / 40.0).margin(0.002));
    CHECK(ends_s(record) == Approx(3 - 3 / 40.0).margin(0.002));
  }
}

TEST_CASE("repeats sampled at two rates are compared over the same time", "[bench][explain]") {
  const TimeRecords read = repeats(6, 6, 2);
  CHECK(read.all[0].excitation.rate_Hz() == 500);
  CHECK(read.all[1].excitation.rate_Hz() == 250);
  for (const TimeRecord& record : read.all) {
    CHECK(begins_s(record) == Approx(3 / 40.0).margin(0.004));
    CHECK(ends_s(record) == Approx(6 - 3 / 40.0).margin(0.006));
  }
}

TEST_CASE("a repeat too short to be compared says so, and no other does", "[bench][explain]") {
  Campaign campaign = MovedSlide().campaign();
  campaign.records.resize(3);  // of three programmes
  for (Channel& channel : campaign.records[1].recording.channels) {
    channel.samples = channel.samples.head(100).eval();  // 0.2 s: its edges take 0.15 s
  }
  const auto read = time_records(MovedSlide::plant(), campaign, sim::standard_terms());
  REQUIRE(read.index() == 1);
  const Refusal& refusal = std::get<Refusal>(read);
  for (const hal::ConfigFault& fault : refusal.faults) {
    CHECK_THAT(fault.message, Catch::StartsWith("record 2: "));
  }
  CHECK(refusal.faults.back().message == "record 2: too short to be compared");
}
