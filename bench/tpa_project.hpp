#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analysis/tpa/on_board_validation.hpp"
#include "analysis/tpa/ranking_certainty.hpp"
#include "hal/config_reader.hpp"
#include "hal/types/frequency_response.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::bench {

/// Records of a hammer at one place: each recording in the file is one hit.
struct TpaHits {
  std::string file;
  DegreeOfFreedom place;  ///< that was hit; one of the project's paths
};

/// How raw hits are read: sensors are channels named by point, with direction.
struct TpaHammer {
  std::string channel;         ///< of the force
  double range_N = not_known;  ///< full scale; NaN: not stated
  double acceleration_range_m_s2 = not_known;
  std::vector<TpaHits> hits;
};

/// The recording of a joint's reducer, for the way from the joint to the part.
struct TpaReducer {
  std::string joint;      ///< "J3": first word of its paths' points
  std::string recording;  ///< any format that `judge` reads
  std::string after;      ///< of the reducer after the repair; empty: none
  std::string kinematics;
};

/// One motion of the machine, at constant speed.
struct TpaMotion {
  std::string name;
  std::string recording;
  std::string after;  ///< the same motion after a repair; empty: none
  std::optional<TpaReducer> reducer;
};

/// What `rvbench tpa` works on. Either `frf_files` or `hammer` is given, or neither to a method
/// that needs no FRFs. Files are full paths.
struct TpaProject {
  std::string name;
  std::string method;                  ///< of tpa_methods()
  std::vector<std::string> frf_files;  ///< ready FRFs: UFF 58 and 58b, LMS text
  std::optional<TpaHammer> hammer;
  std::vector<DegreeOfFreedom> paths, indicators, targets, validation;
  std::vector<analysis::TpaBand> bands;
  std::string rule = "tikhonov_by_gcv";
  double least_coherence = 0.8;
  analysis::Resampling resampling;
  std::vector<TpaMotion> motions;

  std::vector<std::string> source;      ///< points inside it, to blocked_forces
  std::vector<DegreeOfFreedom> active;  ///< sides of mounts, one per path, to parametric_mounts
  double step_Hz = not_known;           ///< of the lines, to operational; FRFs have their own
};

/// Reads a project file; what it names is relative to itself.
///
///     {"tpa": "robot 7",
///      "frfs": ["frfs.uff"], or "hammer": {"channel": "hammer", "range_N": 444,
///        "hits": [{"file": "J1_X.h5", "point": "J1 active", "direction": "+X"}, ...]},
///      "paths": {"points": ["J1 active", ...], "directions": ["+X", "+Y", "+Z"]},
///      "sensors": {"indicators": {...}, "targets": {...}, "validation": {...}},
///      "bands": [{"from_Hz": 5, "to_Hz": 500}],
///      "motions": [{"name": "slow", "recording": "slow.h5", "after": "slow_after.h5",
///        "reducer": {"joint": "J3", "recording": "J3.h5", "after": "J3_after.h5",
///          "kinematics": "rv20e"}}]}
///
/// Optional: "after" and "reducer", "rule" (a name of regularisation_rules()), "least_coherence",
/// "resampling" with "replicates" and "seed", "method" (a name of tpa_methods()) with keys of its
/// own: "source" of blocked_forces, "active" of parametric_mounts, "step_Hz" of operational, which
/// has no FRFs, paths or sensors to validate by. Every point has every direction of its list.
/// @return the project, or every fault of the file; a file that is not there is one of them
std::variant<TpaProject, std::vector<hal::ConfigFault>> read_tpa_project(const std::string& file);

/// Places of a list {"points": [...], "directions": [...]}: every point in every direction, each
/// once, directions positive.
std::vector<DegreeOfFreedom> read_places(hal::ConfigReader& of, const char* key);

/// The joint of a path: the first word of its point, "J3" of "J3 active".
std::string joint_of(const DegreeOfFreedom& path);

}  // namespace rvbench::bench
