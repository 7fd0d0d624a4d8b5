#include <benchmark/benchmark.h>

#include <cmath>

#include "sim/plant_json.hpp"
#include "sim/simulate.hpp"

namespace {

using namespace rvbench;

sim::PlantSpec silverbox() { return std::get<sim::PlantSpec>(sim::read_plant("silverbox")); }

std::vector<Channel> excitation_of(Eigen::Index samples) {
  Eigen::VectorXd x(samples);
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / 610.35;
    x[i] = 0.05 * std::sin(40 * t + 2 * t * t) + 0.02 * std::sin(500 * t);
  }
  return {{{"V1", "V", "", not_known}, 610.35, 0, x}};
}

void run(benchmark::State& state, const sim::PlantSpec& plant, const char* label) {
  constexpr Eigen::Index samples = 8192;  // one multisine of Silverbox
  const int substeps = std::get<int>(sim::substeps_for(plant, 610.35));
  const auto excitation =
      std::get<sim::Excitation>(sim::Excitation::make(plant, excitation_of(samples), substeps));
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(sim::simulate(plant, excitation));
  }
  const double seconds = static_cast<double>(samples) / 610.35;
  state.counters["x_real_time"] = benchmark::Counter(
      seconds * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["steps"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * double(samples * substeps),
                         benchmark::Counter::kIsRate);
  state.SetLabel(label);
}

// A fit runs a plant thousands of times: what one run costs decides how many rivals are heard.
void plant_of_one_axis(benchmark::State& state) {
  run(state, silverbox(), "mass, spring, damper; limit 10 M steps per second");
}
BENCHMARK(plant_of_one_axis)->Unit(benchmark::kMillisecond);

void plant_with_cubic_stiffness(benchmark::State& state) {
  run(state,
      sim::with_effect(silverbox(), "cubic_stiffness", {.body_a = "mass"},
                       {{"stiffness", {4, "N/m³"}}}),
      "the same with a cubic spring; limit 4 M steps per second");
}
BENCHMARK(plant_with_cubic_stiffness)->Unit(benchmark::kMillisecond);

void plant_with_dry_friction(benchmark::State& state) {
  run(state,
      sim::with_effect(silverbox(), "coulomb_friction", {.body_a = "mass"},
                       {{"level", {1e-3, "N"}}, {"creep_speed", {0.01, "m/s"}}}),
      "the same with dry friction; limit 2 M steps per second");
}
BENCHMARK(plant_with_dry_friction)->Unit(benchmark::kMillisecond);

void plant_from_its_spec(benchmark::State& state) {
  const sim::PlantSpec plant = silverbox();
  const auto excitation =
      std::get<sim::Excitation>(sim::Excitation::make(plant, excitation_of(2), 4));
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(sim::simulate(plant, excitation));
  }
  state.SetLabel("built anew for one sample; limit 50 us");
}
BENCHMARK(plant_from_its_spec)->Unit(benchmark::kMicrosecond);

}  // namespace
