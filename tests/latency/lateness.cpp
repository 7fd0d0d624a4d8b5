#include <stdexcept>

#include "tests/latency/figures.hpp"
#include "tests/latency/running_bench.hpp"

namespace rvbench::test {

std::vector<Figure> measure_lateness(double duration_s) {
  hal::Rig rig = make_live_plant_rig({});
  connect(rig);
  const Load load;
  RunningBench bench(rig, 600);
  bench.run_for(duration_s);
  bench.supervisor().end();
  if (bench.supervisor().latched()) throw std::runtime_error(bench.supervisor().latched()->reason);
  rig.drive->stop();
  const sequences::Lateness late = bench.supervisor().lateness();
  std::vector<Figure> figures{
      {"supervisor's round late, p99", 1e6 * late.quantile_s(0.99), "us", 250, 10'000},
      {"supervisor's round late, median", 1e6 * late.quantile_s(0.5), "us"},
      {"supervisor's round late, longest", 1e6 * late.longest_s(), "us"},
      {"supervisor's rounds in a second", double(late.rounds()) / duration_s, "1/s"}};
  const std::string why = bench.supervisor().without_priority();
  if (!why.empty()) figures.push_back({"no real-time priority: " + why, 0, ""});
  return figures;
}

}  // namespace rvbench::test
