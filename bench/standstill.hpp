#pragma once

#include <string>
#include <vector>

#include "bench/time_records.hpp"

namespace rvbench::bench {

/// Which samples of records to compare where the motion of bodies is prescribed and what drives
/// them is measured. At rest dry friction holds what it came to rest with, which no law of the
/// speed can say: rests are not compared. A rest is slower than 1 % of the fastest speed for longer
/// than a wave of the band, and reaches half of one to either side; of any other plant all samples
/// are compared.
///
/// @param records  whose `kept` are filled
void leave_out_standstill(const sim::PlantSpec& plant, const sim::TermLibrary& library,
                          TimeRecords& records);

/// "slow: 10 % of it stands still, ...", for each record that rests.
std::vector<std::string> standstill_notes(const TimeRecords& records);

}  // namespace rvbench::bench
