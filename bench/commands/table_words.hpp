#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/command.hpp"
#include "hal/formats/table/table_hints.hpp"

namespace rvbench::bench {

/// Options that describe a table in text: --head-line, --separator, --decimal, --dates.
class TableWords {
 public:
  /// Adds its options to those of a command.
  void add_to(std::vector<Option>& options);

  hal::formats::TableHints hints() const;

 private:
  std::optional<std::uint64_t> head_line_;
  std::string separator_, decimal_, dates_;
};

}  // namespace rvbench::bench
