#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/proof/seal/draw.hpp"

namespace seal {

/// What is to be sealed, before anything is drawn.
struct CasePlan {
  int number = 0;
  std::string kind;                  ///< "null", "single", "several", "outside", "twin"
  std::string machine;               ///< "bench", "axis", "oscillator"
  std::string variant;               ///< of its motion: "", "one way"
  std::vector<std::string> effects;  ///< names of what is hidden; of a null: what it is like
  double concealment_dB = 20;        ///< the first line below the strongest of the meshes
  double snr_dB =
      20;  ///< its line above the noise in its bin, under the middle one of the conditions
};

/// All campaigns of the proof: the same for every seed.
std::vector<CasePlan> all_cases();

/// Writes what the tool may see into a folder: plant.json and recordings.
/// @return the answer: effects with names, places and sizes, how much of them shows, and what else
///         would be right
/// @throws std::runtime_error if it cannot be made as planned
nlohmann::json seal_axis(const CasePlan& plan, Draw& draw, const std::filesystem::path& folder);
nlohmann::json seal_oscillator(const CasePlan& plan, Draw& draw,
                               const std::filesystem::path& folder);
nlohmann::json seal_bench(const CasePlan& plan, Draw& draw, const std::filesystem::path& plants,
                          const std::filesystem::path& folder);

}  // namespace seal
