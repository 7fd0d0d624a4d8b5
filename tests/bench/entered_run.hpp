#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <utility>

#include "bench/result_database.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"

namespace rvbench::test {

/// Leaves a folder with its verdict below `root`, as the end of a run does, and enters it.
/// @return the folder
inline std::filesystem::path enter_run(const std::filesystem::path& root,
                                       const bench::Judgement& judgement,
                                       const std::string& rig_kind = "sim") {
  const auto folder =
      bench::create_run_folder(root, judgement.facts.serial, judgement.facts.started_utc);
  bench::write_file(folder / "verdict.json", bench::judgement_to_json(judgement));
  bench::write_file(folder / "rig.json", "{\"rig\": \"" + rig_kind + "\"}");
  bench::write_sums(folder);
  auto database = bench::ResultDatabase::open(root);
  REQUIRE(database);
  REQUIRE(std::move(database).value().enter(bench::row_of(root, folder, judgement), judgement));
  return folder;
}

}  // namespace rvbench::test
