#include <catch2/catch.hpp>

#include "hal/formats/read_recordings.hpp"
#include "sim/interpolation.hpp"
#include "tests/sim/plant_texts.hpp"
#include "tests/support/real_data.hpp"

using namespace rvbench;

namespace {

Recording recording_of(const std::filesystem::path& file, double rate_Hz) {
  auto read = hal::read_recordings(file, {.rate_Hz = rate_Hz});
  REQUIRE(read);
  return std::move(read).value().front();
}

double relative_rms(const Eigen::VectorXd& measured, const Eigen::VectorXd& predicted) {
  return (measured - predicted).norm() / measured.norm();
}

}  // namespace

TEST_CASE("the positioning system needs Coulomb friction to explain its force", "[sim][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  const Recording emps = recording_of(*folder / "emps/DATA_EMPS.mat", 1000);
  const auto plant = std::get<sim::PlantSpec>(sim::read_plant("emps"));
  // Force and motion low-passed alike.
  Channel voltage = *emps.find("vir");
  const sim::Interpolation low_pass(0, 0, 0.04);
  const Eigen::VectorXd raw = voltage.samples;
  for (Eigen::Index i = 0; i < raw.size(); ++i) voltage.samples[i] = low_pass(raw, i);

  const auto base = test::run_of(plant, emps.channels);
  const auto with_friction =
      test::run_of(sim::with_effect(plant, "coulomb_friction", {.body_a = "slide"},
                                    {{"level", {20.4, "N"}}, {"creep_speed", {1e-3, "m/s"}}}),
                   emps.channels);
  const double before = relative_rms(voltage.samples, base[0].samples);
  const double after = relative_rms(voltage.samples, with_friction[0].samples);
  CAPTURE(before, after);
  // Published values, identified on another run of the machine: not the best fit to this one.
  CHECK(before > 0.15);
  CHECK(after < 0.08);
}

TEST_CASE("the electronic oscillator is linear to a few per cent", "[sim][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  Recording circuit = recording_of(*folder / "silverbox/SNLS80mV.csv", 610.35);
  for (Channel& channel : circuit.channels) {
    channel.samples = Eigen::VectorXd(channel.samples.tail(80000));  // the multisines
  }
  const auto plant = std::get<sim::PlantSpec>(sim::read_plant("silverbox"));
  const auto out = test::run_of(plant, circuit.channels);
  const Eigen::VectorXd measured = circuit.find("V2")->samples.tail(79000);
  const double error = relative_rms(measured, out[0].samples.tail(79000));
  CAPTURE(error);
  CHECK(error < 0.3);  // nominal values: what the linear part cannot do is found by explain
}
