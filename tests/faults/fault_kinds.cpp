#include <utility>

#include "tests/faults/fault_kind.hpp"

namespace rvbench::test {

FaultKind on_bench(std::string name, std::function<void(FaultBench&)> what, Answer answer,
                   std::string words, double stopped_within_s) {
  return {std::move(name), [what = std::move(what)](Victim& victim) { what(victim.bench); }, answer,
          std::move(words), stopped_within_s};
}

FaultKind disturbed(std::string name, bool Disturbance::*what, Answer answer, std::string words,
                    double stopped_within_s) {
  return on_bench(
      std::move(name), [what](FaultBench& bench) { bench.disturbance.*what = true; }, answer,
      std::move(words), stopped_within_s);
}

const std::vector<FaultKind>& fault_kinds() {
  static const std::vector<FaultKind> kinds = [] {
    std::vector<FaultKind> all;
    for (const auto& group :
         {faults_of_the_drive(), faults_of_the_bus(), faults_of_the_daq(), faults_of_the_hall()}) {
      all.insert(all.end(), group.begin(), group.end());
    }
    return all;
  }();
  return kinds;
}

}  // namespace rvbench::test
