#pragma once

#include <filesystem>
#include <string>

#include "bench/campaign.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::bench {

/// What came of holding records against the plant that stands for their machine.
struct TwinCheck {
  std::string difference;    ///< the worst, in words; empty if all is as it may be
  std::string not_compared;  ///< why; empty if it was
};

/// Holds means and lines of steady records against those of the plant as its file has it: nothing
/// is fitted. One differs if it is off by more than three standard errors of its repeats, twice
/// what the plant's tolerances allow and, if it is a line, 1.5 % of the largest mean: the lines of
/// good units differ by less.
///
/// @param campaign  with what drove it, see add_planned_inputs()
TwinCheck check_twin(const sim::PlantSpec& plant, const Campaign& campaign);

/// The same of a run, as an event of its log: "differs from its twin ...", "not compared with its
/// twin: ...", or "as its twin". Whatever goes wrong is a reason for the second.
/// @param plant  shipped, or a plant file
std::string twin_event(const std::filesystem::path& run, const std::string& plant) noexcept;

inline constexpr const char* differs_from_twin = "differs from its twin";  ///< how it begins

}  // namespace rvbench::bench
