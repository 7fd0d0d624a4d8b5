#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench {

/// Everything a run or a judgement came to: verdict.json in C++.
struct Judgement {
  Ending ending;
  analysis::Diagnosis diagnosis;
  std::vector<analysis::Examination> points;
};

}  // namespace rvbench::bench
