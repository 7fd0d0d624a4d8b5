#include "bench/standstill.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/bench/moved_slide.hpp"

using namespace rvbench;
using bench::TimeRecord;
using bench::TimeRecords;
using Catch::Matchers::Contains;
using test::MovedSlide;

namespace {

// The slide stays where it is from then on; what drives it is measured all the time.
TimeRecords resting_from(double time_s) {
  bench::Campaign campaign = MovedSlide().campaign();
  for (bench::CampaignRecord& record : campaign.records) {
    Eigen::VectorXd& way = record.recording.channels[0].samples;
    const auto from = static_cast<Eigen::Index>(time_s * MovedSlide::rate_Hz);
    if (from < way.size()) way.tail(way.size() - from).setConstant(way[from]);
  }
  const sim::PlantSpec plant = MovedSlide::plant();
  auto read = bench::time_records(plant, campaign, sim::standard_terms());
  REQUIRE(read.index() == 0);
  TimeRecords records = std::get<0>(std::move(read));
  bench::leave_out_standstill(plant, sim::standard_terms(), records);
  return records;
}

double last_compared_s(const TimeRecord& record) {
  return static_cast<double>(record.first + record.kept.back() * record.thin) / MovedSlide::rate_Hz;
}

}  // namespace

TEST_CASE("what only turns round is compared throughout", "[bench][explain]") {
  const TimeRecords records = resting_from(6);
  for (const TimeRecord& record : records.all) {
    CHECK(static_cast<Eigen::Index>(record.kept.size()) ==
          (record.last - record.first) / record.thin);
  }
  CHECK(bench::standstill_notes(records).empty());
}

TEST_CASE("what stands still is not compared, and it is said", "[bench][explain]") {
  const TimeRecords records = resting_from(4);
  for (const TimeRecord& record : records.all) {
    const double half_a_wave_s = 0.5 / 40;
    CHECK(last_compared_s(record) == Approx(4 - half_a_wave_s).margin(0.015));
  }
  const auto notes = bench::standstill_notes(records);
  REQUIRE(notes.size() == records.all.size());
  CHECK_THAT(notes.front(), Contains("record 1") && Contains("stands still"));
}
