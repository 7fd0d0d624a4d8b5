#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "sequences/plan.hpp"

namespace rvbench::bench {

/// Who did what with limits, and when.
struct LimitsStep {
  std::string step;  ///< "proposed", "approved" or "activated"
  std::string utc;
  std::string by;
  std::string limits_sha256;  ///< of the limits as they were then: limits_hash()
};

/// Limits of a plan that stand by themselves, as one version: a JSON file
///
///     {"limits_version": "2026-11", "plan": "quick", "steps": [...], "limits": [...]}
///
/// "limits" as in a plan. Made by rvbench limits propose; one that a user writes has no steps.
struct LimitsFile {
  std::string version;
  std::string plan;  ///< the name of the plan whose runs they are for
  std::vector<LimitsStep> steps;
  std::vector<sequences::Limit> limits;
};

/// The file, or every fault of it at once.
std::variant<LimitsFile, std::vector<hal::ConfigFault>> read_limits_file(
    const std::filesystem::path& file);

std::string limits_file_to_json(const LimitsFile& file);

/// SHA-256 of the limits alone: what was approved.
std::string limits_hash(const std::vector<sequences::Limit>& limits);

}  // namespace rvbench::bench
