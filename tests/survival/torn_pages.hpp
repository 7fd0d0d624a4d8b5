#pragma once

#include <random>
#include <string>
#include <vector>

#include "tests/survival/disk_record.hpp"

namespace rvbench::test {

/// The bytes of a file on a disk that wrote its pages in no order. See PowerCut for what it may.
class TornPages {
 public:
  void apply(const DiskEntry& change);  ///< a write or a truncation that is on the disk

  /// @param changes  since then, in order, of which any may be there
  std::string torn(const std::vector<const DiskEntry*>& changes, std::mt19937_64& random) const;

 private:
  std::string bytes_;
};

}  // namespace rvbench::test
