#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/judgement.hpp"
#include "tests/support/program.hpp"

namespace rvbench::test {

/// A run folder below the root as a run leaves it, of that serial; it began at that UTC.
std::filesystem::path judged_run(const std::filesystem::path& root, bench::Judgement judgement,
                                 const std::string& serial,
                                 const std::string& utc = "20260102T030405Z");

/// A broker file in the folder for the broker on that port: station "b3", then `more`, lines such
/// as `, "qos": 2`.
std::string broker_file(const std::filesystem::path& folder, int port,
                        const std::string& more = "");

/// The words of `rvbench publish` with the program's path before them.
std::vector<std::string> publish_words(const std::filesystem::path& root,
                                       const std::string& broker_file,
                                       std::vector<std::string> more = {});

Answer publish(const std::filesystem::path& root, const std::string& broker_file,
               std::vector<std::string> more = {});

}  // namespace rvbench::test
