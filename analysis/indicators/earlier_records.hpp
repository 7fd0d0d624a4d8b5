#pragma once

#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// Adds to each channel of a record NA4 of its gears, against earlier records of the same machine
/// at the same speed and load. A gear that no earlier record of that channel has has no NA4.
///
/// Shape   any number of earlier records, none among them
/// Units   dimensionless; residuals in the unit of the channel, which must be the same
/// Errors  none thrown
/// Source  na4()
void add_na4(Examination& record, const std::vector<const Examination*>& earlier);

}  // namespace rvbench::analysis
