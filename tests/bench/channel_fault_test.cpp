#include "bench/channel_fault.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace rvbench;
using namespace rvbench::bench;
using Catch::Matchers::Contains;

namespace {

Channel channel(const std::string& name, const Eigen::VectorXd& samples) {
  return {{name, "N", "", not_known}, 1000, 0, samples};
}

Eigen::VectorXd sine(Eigen::Index samples) {
  return (Eigen::VectorXd::LinSpaced(samples, 0, 50).array().sin() * 40).matrix();
}

sim::PlantSpec driven_by_force() {
  sim::PlantSpec plant;
  plant.inputs = {{.name = "force",
                   .channel = "force",
                   .unit = "N",
                   .kind = sim::InputKind::force,
                   .body = "mass",
                   .gain = {1, "1"},
                   .offset = {0, "N"}}};
  return plant;
}

std::vector<std::string> notes_of(const Eigen::VectorXd& force) {
  Campaign campaign;
  campaign.records.resize(1);
  campaign.records[0].name = "run 1";
  campaign.records[0].recording.channels = {channel("force", force)};
  note_clipped_inputs(driven_by_force(), campaign);
  return campaign.notes;
}

}  // namespace

TEST_CASE("a sample that no sensor gives is told with its place", "[bench][explain]") {
  for (const double wrong : {1e299, -1e299, 1e6}) {
    Eigen::VectorXd x = sine(8000);
    x[1233] = wrong;
    CHECK_THAT(sample_fault(channel("x", x)), Contains("sample 1234 is"));
  }
  AND_THEN("a whole channel beyond all bounds is, too") {
    CHECK_FALSE(sample_fault(channel("x", 1e40 * sine(8000))).empty());
  }
}

TEST_CASE("what is large for a while, or by chance, is no wrong sample", "[bench][explain]") {
  CHECK(sample_fault(channel("x", sine(8000))).empty());
  CHECK(sample_fault(channel("x", Eigen::VectorXd::Zero(8000))).empty());
  Eigen::VectorXd hit = Eigen::VectorXd::Constant(8000, 1e-3);  // of a hammer: 20 ms
  hit.segment(4000, 20).setConstant(500);
  CHECK(sample_fault(channel("x", hit)).empty());
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise(100000);
  for (double& value : noise) value = normal(engine);
  CHECK(sample_fault(channel("x", noise)).empty());
}

TEST_CASE("a force that stays at its top is told, and no other", "[bench][explain]") {
  const std::vector<std::string> notes = notes_of(sine(8000).cwiseMin(20).cwiseMax(-20));
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Contains("run 1: \"force\" looks clipped"));
  CHECK(notes_of(sine(8000)).empty());
  CHECK(notes_of(Eigen::VectorXd::Constant(8000, 20)).empty());
}
