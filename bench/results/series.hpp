#pragma once

#include <string>
#include <vector>

#include "bench/results/sqlite.hpp"
#include "hal/types/set_point.hpp"

namespace rvbench::bench {

/// Which values of one indicator; what is empty narrows nothing.
struct SeriesOf {
  std::string measure = {};  ///< a name of measures()
  std::string of = {};       ///< band, order or mesh
  SetPoint at = {};
  std::string channel = {};
  std::string serial = {};
  bool least = false;       ///< the smallest value of a run is its worst
  bool may_be_hid = false;  ///< a depth that is not shown counts as what noise may hide, not as 0
};

/// The worst of one run, among those asked for.
struct RunValue {
  std::string folder, serial, started_utc, verdict;
  double value = 0;
  std::string unit;
  std::string of;
  int point = 0;  ///< of the plan, from 0; -1 of a depth
  std::string channel;
};

/// One value per run that has any, oldest first.
/// Units   as measured: RunValue::unit. Errors  refused: the file cannot be read
/// The depth of what was found is of no point or channel: narrowed by `of`, a part, and by serial.
/// A part that noise may hide beyond its limit is not told; one that is not shown has depth 0.
Result<std::vector<RunValue>> read_series(const SqliteFile& file, const SeriesOf& asked);

}  // namespace rvbench::bench
