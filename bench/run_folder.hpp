#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rvbench::bench {

/// The table of results, which lies beside the folders of the serials.
inline constexpr const char* result_database_name = "results.db";

/// A name that is safe as one path component. Characters other than letters, digits, '.', '_' and
/// '-' become '_' and a short hash keeps different serials apart, and from the files and folders
/// that lie beside them: results.db, outbox.db, ledger.jsonl, limits, qualification.
/// @throws std::invalid_argument if `serial` is empty
std::string folder_name_of(const std::string& serial);

/// The folders in it, in no order; none in what cannot be looked into.
std::vector<std::filesystem::path> folders_in(const std::filesystem::path& parent);

/// The regular files in it whose names end in ".json", by name.
std::vector<std::filesystem::path> json_files_in(const std::filesystem::path& parent);

/// The folders two levels below the folder of runs: <serial>/<time>, in no order.
std::vector<std::filesystem::path> run_folders(const std::filesystem::path& root);

/// The name that a run's plan.json states; empty if it states none.
std::string plan_name_in(const std::filesystem::path& run);

/// On what a run was made, of its rig.json.
struct RigOfRun {
  std::string kind;                        ///< "bench", "sim", "replay"; empty: it states none
  std::string station;                     ///< that the file's "qualification" names; empty: none
  std::string golden_serial, golden_plan;  ///< of the golden unit that it names; empty: none
};
RigOfRun rig_of(const std::filesystem::path& run);

/// How a run began: start.json of its folder.
struct RunBegin {
  std::string serial;
  std::string started_utc;
  int number = 0;  ///< among the runs of that serial, from 1: clocks may be set back
};

/// Counted on from the runs that are there.
RunBegin next_run(const std::filesystem::path& root, const std::string& serial,
                  const std::string& utc);

std::string run_begin_to_json(const RunBegin& begin);

/// Of a folder without start.json the number is 0, and names stand for serial and time.
RunBegin read_run_begin(const std::filesystem::path& run);

/// Makes <root>/<folder_name_of(serial)>/<utc>/, on the disk when this returns; a folder that
/// exists is never used again.
/// @throws std::system_error
std::filesystem::path create_run_folder(const std::filesystem::path& root,
                                        const std::string& serial, const std::string& utc);

/// Whether a run came to PASS, FAIL or INVALID, with all of its files.
bool is_finished(const std::filesystem::path& run);

/// The run of that serial that began last, by its number, if it did not come to PASS, FAIL or
/// INVALID with all of its files.
std::optional<std::filesystem::path> newest_unfinished_run(const std::filesystem::path& root,
                                                           const std::string& serial);

/// "20261121T114559Z"
std::string utc_now();

}  // namespace rvbench::bench
