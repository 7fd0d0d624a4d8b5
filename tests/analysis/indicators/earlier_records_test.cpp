#include "analysis/indicators/earlier_records.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <optional>

using namespace rvbench;
using analysis::add_na4;
using analysis::Examination;

namespace {

constexpr const char* sun = "sun-planet mesh, sun against carrier";

// One channel, one gear whose residual is Gaussian: a fourth moment of three times variance².
Examination record(double variance, const char* gear = sun, const char* channel = "accel_1x") {
  Examination e;
  e.channels.resize(1);
  e.channels[0].name = channel;
  e.channels[0].unit = "m/s²";
  e.channels[0].residuals = {{gear, {variance, 3 * variance * variance}}};
  return e;
}

std::optional<double> na4_of(Examination now, const std::vector<Examination>& before) {
  std::vector<const Examination*> earlier;
  for (const Examination& e : before) earlier.push_back(&e);
  add_na4(now, earlier);
  const auto& all = now.channels[0].indicators;
  if (all.empty()) return std::nullopt;
  CHECK(all.size() == 1);
  CHECK(all[0].measure == "na4");
  CHECK(all[0].of == sun);
  CHECK(all[0].unit == "1");
  return all[0].value;
}

}  // namespace

TEST_CASE("NA4 of a gear that stays as it was is 3", "[analysis][indicators]") {
  CHECK(*na4_of(record(2), {record(2)}) == Approx(3));
  CHECK(*na4_of(record(2), {record(2), record(2)}) == Approx(3));
}

TEST_CASE("NA4 holds a record against the mean variance of all so far", "[analysis][indicators]") {
  // 3·4² over ((1 + 4)/2)², and over ((1 + 1 + 4)/3)².
  CHECK(*na4_of(record(4), {record(1)}) == Approx(7.68));
  CHECK(*na4_of(record(4), {record(1), record(1)}) == Approx(12));
  // It falls again below 3 for a gear that has become quieter.
  CHECK(*na4_of(record(1), {record(4)}) == Approx(0.48));
}

TEST_CASE("without an earlier record of that gear in that channel there is no NA4",
          "[analysis][indicators]") {
  CHECK_FALSE(na4_of(record(4), {}));
  CHECK_FALSE(na4_of(record(4), {Examination{}}));
  CHECK_FALSE(na4_of(record(4), {record(1, "pin-lobe pass, pins against crank")}));
  CHECK_FALSE(na4_of(record(4), {record(1, sun, "accel_1y")}));
  Examination in_volts = record(1);
  in_volts.channels[0].unit = "V";
  CHECK_FALSE(na4_of(record(4), {in_volts}));
  CHECK_FALSE(na4_of(record(0), {record(0)}));  // nothing has ever swung
}
