#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hal/hdf5/hdf5_handle.hpp"
#include "hal/hdf5/sample_group.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::hal::hdf5 {

/// Names of the groups in the group at `path`, sorted. @throws FileFailure if it is no group
std::vector<std::string> groups_in(const Handle& file, const std::string& path);

/// The point's attributes speed_rpm, load_pct, repeat; each may be absent.
PlannedPoint read_plan(const Handle& file, const std::string& point);

/// The channels of one of the point's groups. `file_bytes` bounds what the file may claim.
SampleGroup read_group_info(const Handle& file, const std::string& point, const std::string& name,
                            std::size_t file_bytes);

/// All groups of a point with their samples. What /points/index holds in rvbench's own files is
/// taken from the attributes t0_s, status, measured_speed_rpm and measured_torque_Nm, where
/// another program left them; a point without status has an empty one. A group may have a
/// t0_s and a time_uncertainty_s of its own; a point start_time (UTC, ISO 8601) and notes.
Recording read_point(const Handle& file, const std::string& point, std::size_t file_bytes);

}  // namespace rvbench::hal::hdf5
