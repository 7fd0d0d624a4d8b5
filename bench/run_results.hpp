#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/kinematics.hpp"
#include "bench/judgement.hpp"
#include "bench/report/report.hpp"

namespace rvbench::bench {

/// A file that tells a judgement, and what writes it; it may throw.
struct ResultFile {
  std::string name;
  std::function<void()> write;
};

/// Writes all of them, whatever becomes of the others. One that cannot be written is removed: an
/// older text would tell another judgement.
/// @return what is missing, and why: "report.html: No space left on device"
std::vector<std::string> unwritten_files(const std::filesystem::path& folder,
                                         const std::vector<ResultFile>& files);

/// Has the result files written. If one cannot be, the judgement becomes an ERROR, `unwritten` says
/// which, and all are written once more, so that what can be written tells the same.
/// @param write  what unwritten_files() returned
void tell_in_files(Judgement& judgement,
                   const std::function<std::vector<std::string>(const Judgement&)>& write);

/// verdict.json, junit.xml, report.html, if it is asked for, and SHA256SUMS of a run folder. Older
/// reports go in any case. @return as unwritten_files()
std::vector<std::string> write_results(const std::filesystem::path& folder,
                                       const Judgement& judgement,
                                       const analysis::Kinematics& kinematics, bool with_report);

/// The name under which reports state the hash of SHA256SUMS as it stood when they were made, but
/// for its lines of reports: those cannot hold their own hash.
inline constexpr const char* sums_in_report = "SHA256SUMS without reports";

/// What the reports of a run are made of, out of what its folder holds.
ReportInput report_input(const std::filesystem::path& folder, const Judgement& judgement,
                         const analysis::Kinematics& kinematics);

}  // namespace rvbench::bench
