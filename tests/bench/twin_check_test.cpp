#include "bench/twin_check.hpp"

#include <catch2/catch.hpp>

#include "bench/planned_inputs.hpp"
#include "bench/text_file.hpp"
#include "sim/plant_json.hpp"
#include "sim/rv_plant.hpp"
#include "sim/rv_unit.hpp"
#include "tests/support/rv_campaign.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

const sim::PlantSpec& drawing() { return sim::rv20e_bench(); }

// Fast and loaded, twice: 16 s each.
Campaign measured_on(const sim::PlantSpec& machine) {
  test::RvMatrix matrix;
  matrix.speeds_rpm = {1815};
  matrix.loads_pct = {100};
  matrix.repeats = 2;
  Campaign campaign = test::rv_campaign(machine, 21, matrix);
  add_planned_inputs(drawing(), campaign);
  return campaign;
}

}  // namespace

TEST_CASE("a machine within the drawing's tolerances is as its twin", "[bench][twin]") {
  for (const std::uint64_t unit : {1u, 2u}) {
    const TwinCheck check =
        check_twin(drawing(), measured_on(test::within_tolerance(drawing(), unit, 1)));
    CHECK(check.difference.empty());
    CHECK(check.not_compared.empty());
  }
  // What a good unit deviates by brings lines that the drawing has not.
  const auto good = sim::as_built(drawing(), sim::draw_unit("healthy", 3));
  CHECK(check_twin(drawing(), measured_on(good)).difference == "");
}

TEST_CASE("an input shaft that is out of true differs from its twin twice per turn of the sun",
          "[bench][twin]") {
  const auto bent = sim::as_built(drawing(), sim::draw_unit("input_shaft", 3));
  const TwinCheck check = check_twin(drawing(), measured_on(bent));
  CHECK(check.not_compared.empty());
  CHECK_THAT(check.difference,
             StartsWith("input_torque, order 1.983 (240/121) at 1815 rpm, 100 %: ") &&
                 Contains("N·m measured"));
}

TEST_CASE("a brake that pulls more than it is told to shows in the mean", "[bench][twin]") {
  const auto strong = [](double gain) {
    return check_twin(drawing(), measured_on(test::with_value(drawing(), "/inputs/1/gain", -gain)));
  };
  CHECK_THAT(strong(1.2).difference, StartsWith("input_torque, its mean at 1815 rpm, 100 %: "));
  CHECK(strong(1.02).difference.empty());  // within what the transducer's gain is known to
}

TEST_CASE("what does not fit the twin is not compared, and says why", "[bench][twin]") {
  Campaign campaign = measured_on(drawing());
  const auto emps = std::get<sim::PlantSpec>(sim::read_plant("emps"));
  CHECK_THAT(check_twin(emps, campaign).not_compared, Contains("not compared by orders"));
  sim::PlantSpec open = drawing();
  open.bodies[0].inertia.tolerance_pct = sim::Quantity::free_pct;
  CHECK_THAT(check_twin(open, campaign).not_compared, Contains("/bodies/0/inertia"));
  std::erase_if(campaign.records[1].recording.channels,
                [](const Channel& channel) { return channel.info.name == "input_torque"; });
  const TwinCheck check = check_twin(drawing(), campaign);
  CHECK_THAT(check.not_compared,
             Contains("\"input_torque\" is no channel of the recording, which has "));
  CHECK(check.difference.empty());
}

TEST_CASE("a comparison that cannot be made is an event like another", "[bench][twin]") {
  const test::ScratchFolder scratch;
  CHECK_THAT(twin_event(scratch.path(), "rv20e_bench"), StartsWith("not compared with its twin: "));
  CHECK_THAT(twin_event(scratch.path(), "no_such_plant"), Contains("no_such_plant cannot be read"));
  write_file(scratch / "recording.h5", "no HDF5");
  CHECK_THAT(twin_event(scratch.path(), "rv20e_bench"), StartsWith("not compared with its twin: "));
}

}  // namespace rvbench::bench
