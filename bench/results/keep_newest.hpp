#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rvbench::bench {

/// Takes from a list, oldest first, all but the last so many; without a count it stays as it is.
template <typename Row>
void keep_newest(std::vector<Row>& rows, std::optional<std::uint64_t> count) {
  if (!count || *count >= rows.size()) return;
  rows.erase(rows.begin(), rows.end() - static_cast<std::ptrdiff_t>(*count));
}

}  // namespace rvbench::bench
