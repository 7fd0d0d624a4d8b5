#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/hash_chain.hpp"
#include "bench/ledger.hpp"

namespace rvbench::test {

/// Begins a ledger with a line of that time, as a clock that was ahead leaves it.
inline void put_in_ledger(const std::filesystem::path& root, const std::string& utc) {
  std::ofstream(root / bench::ledger_name) << bench::chained_line({{"number", 1},
                                                                   {"utc", utc},
                                                                   {"kind", "note"},
                                                                   {"of", "EOL 3"},
                                                                   {"file", "note.txt"},
                                                                   {"sha256", ""}},
                                                                  bench::chain_begin)
                                           << '\n';
}

}  // namespace rvbench::test
