#pragma once

#include <string>
#include <vector>

#include "bench/twin.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::bench {

/// What a record of a programme that others repeat is off by, over the same part of it as they are.
struct ProgrammeRecord {
  std::string programme;
  double first_s = 0, length_s = 0;    ///< of what is compared, from the programme's beginning
  std::vector<Eigen::VectorXd> apart;  ///< per output of the plant, measured − simulated
};

/// Means over stretches of their programme, each with what the repeats differ by there. Programmes
/// of too few repeats and stretches to tell chance by have none.
/// @param records  of one programme all as long
Twin::Cells programme_cells(const std::vector<sim::OutputSpec>& outputs,
                            const std::vector<ProgrammeRecord>& records);

}  // namespace rvbench::bench
