#pragma once

#include <string>
#include <vector>

#include "bench/console.hpp"
#include "bench/tpa_study.hpp"

namespace rvbench::bench {

/// "J3:X", as the article's figures have it; "J3 active:X" where joint and axis are not enough.
std::string path_label(Eigen::Index path, const std::vector<DegreeOfFreedom>& paths);

/// "J3 +X", "J3 active +X" where that is not enough.
std::string path_name(Eigen::Index path, const std::vector<DegreeOfFreedom>& paths);

/// "X" where all targets are at one point, else "flange X".
std::string target_name(Eigen::Index target, const std::vector<DegreeOfFreedom>& targets);

/// "5 to 500 Hz"
std::string band_text(const analysis::TpaBand& band);

/// "J3 +X leads", "cannot tell whether J3 +X or J4 +X leads", "cannot tell: validation 0.41".
std::string answer_text(const BandAnswer& answer, const std::vector<DegreeOfFreedom>& paths);

/// What leads at each target over the first band: "X: J3 +X leads; Y: ..." Generated from the
/// answers, whatever they are.
std::string motion_sentence(const MotionAnswer& motion);

/// From the joint to the part, or why the way ends at the joint; empty where no path leads or no
/// motion names a reducer.
std::string chain_sentence(const TpaStudy& study);

/// What the repair did to the arm, over the first band; empty where there was none.
std::string repair_sentence(const TpaStudy& study);

/// "-1.2 dB"
std::string level_change_text(double change_dB);

/// How blows were turned, and what setting them right did.
std::string alignment_text(const analysis::HammerAlignment& alignment);

/// What a method alone has to say, a line each; empty: nothing.
std::vector<std::string> findings_text(const MethodFindings& findings);

/// "sign_reversed", "missing_path", ...
const char* to_string(analysis::TpaFaultKind kind) noexcept;

/// "directions swapped": of FRFs that contradict each other.
std::string doubt_text(const analysis::DirectionDoubt& doubt);

/// The study for a reader at a terminal.
void print_study(Console& console, const TpaStudy& study);

}  // namespace rvbench::bench
