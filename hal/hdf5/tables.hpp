#pragma once

#include <cstddef>
#include <vector>

#include "hal/hdf5/hdf5_handle.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::hal::hdf5 {

/// One row of /points/index. Missing members of other programs' files keep these defaults.
struct IndexRow {
  int point = -1;
  double t0_s = not_known;
  char status[32] = "ok";
  double speed_rpm = not_known;
  double torque_Nm = not_known;
  double acceleration_t0_s = not_known;                ///< of the first acceleration scan
  double torque_t0_s = not_known;                      ///< of the first torque and angle sample
  double acceleration_time_uncertainty_s = not_known;  ///< of acceleration_t0_s
  double torque_time_uncertainty_s = not_known;        ///< of torque_t0_s
};

/// One row of /events.
struct EventRow {
  double time_s = not_known;
  char text[256] = "";
};

inline constexpr const char* index_path = "/points/index";
inline constexpr const char* events_path = "/events";

/// Makes the two empty tables; /points must exist. Before SWMR writing starts.
void create_tables(const Handle& file);

/// Appends one row and hands it to the operating system.
void append_row(const Handle& file, const IndexRow& row);
void append_row(const Handle& file, const EventRow& row);

/// All rows; none if the file has no such table. `file_bytes` bounds what it may claim.
std::vector<IndexRow> read_index(const Handle& file, std::size_t file_bytes);
std::vector<EventRow> read_events(const Handle& file, std::size_t file_bytes);

}  // namespace rvbench::hal::hdf5
