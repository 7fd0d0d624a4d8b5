#pragma once

#include <string>
#include <vector>

#include "analysis/explain/pushes.hpp"
#include "analysis/explain/torque_balance.hpp"

namespace rvbench::bench {

/// Where a force may act that a plant lacks.
struct ForceSite {
  std::string name;      ///< "input_shaft"; of a joint "stage_1"
  std::string on, unit;  ///< the body that a force is told of, and N or N·m
  bool is_joint = false;
};

/// Means and lines that a steadily turning plant is compared by, and how they answer forces in it.
struct PushedFeatures {
  std::vector<ForceSite> sites;
  std::vector<analysis::PushedLine> lines;  ///< their responses in order of the sites

  std::string
      transducer;  ///< channel of the torque between two sides of a shaft; "": there is none
  std::vector<std::string> left, right;          ///< bodies on either side of it
  std::vector<analysis::TransducerMeans> means;  ///< one for each condition
};

}  // namespace rvbench::bench
