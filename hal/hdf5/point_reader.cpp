#include "hal/hdf5/point_reader.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cmath>

#include "hal/formats/start_time.hpp"
#include "hal/hdf5/attributes.hpp"
#include "hal/hdf5/plain_array.hpp"
#include "hal/hdf5/stored_data.hpp"

namespace rvbench::hal::hdf5 {
namespace {

Handle open_group(const Handle& file, const std::string& path) {
  return own(H5Gopen2(file.id(), path.c_str(), H5P_DEFAULT), H5Gclose, path);
}

bool is_group(const Handle& parent, const std::string& name) {
  const Handle object(H5Oopen(parent.id(), name.c_str(), H5P_DEFAULT), H5Oclose);
  return object && H5Iget_type(object.id()) == H5I_GROUP;
}

struct Samples {
  Handle dataset;
  Extent extent;
  SampleGroup info;
  double start_s = not_known;
  double time_uncertainty_s = not_known;
};

Samples open_samples(const Handle& file, const std::string& point, const std::string& name,
                     std::size_t file_bytes) {
  Samples samples;
  const std::string path = point + "/" + name;
  const Handle group = open_group(file, path);
  const std::string place = path + "/data";
  samples.dataset = own(H5Dopen2(file.id(), place.c_str(), H5P_DEFAULT), H5Dclose, place);
  const Handle type = own(H5Dget_type(samples.dataset.id()), H5Tclose, place);
  const H5T_class_t kind = H5Tget_class(type.id());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER) {
    throw FileFailure(IoErrc::bad_data, place + ": not numbers");
  }
  samples.extent = checked_extent(samples.dataset, file_bytes, place);
  try {
    samples.info = read_sample_group(group, samples.extent.columns, name);
    samples.start_s = read_number(group, "t0_s").value_or(not_known);
    samples.time_uncertainty_s = read_number(group, "time_uncertainty_s").value_or(not_known);
  } catch (const FileFailure& failure) {
    throw FileFailure(failure.code(), path + ": " + failure.what());
  }
  return samples;
}

void add_channels(const Samples& samples, const std::string& place, double start_s,
                  Recording& recording) {
  RowMajor rows(samples.extent.rows, samples.extent.columns);
  if (rows.size() > 0) {
    check(H5Dread(samples.dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                  rows.data()),
          place);
  }
  for (std::size_t i = 0; i < samples.extent.columns; ++i) {
    recording.channels.push_back({samples.info.channels[i], samples.info.rate_Hz,
                                  std::isfinite(samples.start_s) ? samples.start_s : start_s,
                                  rows.col(static_cast<Eigen::Index>(i)),
                                  samples.time_uncertainty_s});
  }
}

}  // namespace

std::vector<std::string> groups_in(const Handle& file, const std::string& path) {
  const Handle group = open_group(file, path);
  std::vector<std::string> names = names_in(file, path);
  std::erase_if(names, [&](const std::string& name) { return !is_group(group, name); });
  // Shorter numbers first, so that 1000 follows 999.
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return names;
}

PlannedPoint read_plan(const Handle& file, const std::string& point) {
  const Handle group = open_group(file, point);
  PlannedPoint plan;
  plan.speed_rpm = read_number(group, "speed_rpm").value_or(not_known);
  plan.load_pct = read_number(group, "load_pct").value_or(not_known);
  const double repeat = read_number(group, "repeat").value_or(0);
  plan.repeat = repeat >= 0 && repeat <= 1e6 ? static_cast<int>(repeat) : 0;
  return plan;
}

SampleGroup read_group_info(const Handle& file, const std::string& point, const std::string& name,
                            std::size_t file_bytes) {
  return open_samples(file, point, name, file_bytes).info;
}

Recording read_point(const Handle& file, const std::string& point, std::size_t file_bytes) {
  Recording recording;
  const PlannedPoint plan = read_plan(file, point);
  recording.planned_speed_rpm = plan.speed_rpm;
  recording.load_pct = plan.load_pct;
  recording.repeat = plan.repeat;
  const Handle group = open_group(file, point);
  recording.status = read_text(group, "status").value_or("");
  recording.speed_rpm = read_number(group, "measured_speed_rpm").value_or(not_known);
  recording.torque_Nm = read_number(group, "measured_torque_Nm").value_or(not_known);
  const double start_s = read_number(group, "t0_s").value_or(0);
  recording.notes = read_texts(group, "notes");
  formats::note_start(formats::utc_of_text(read_text(group, "start_time").value_or("")), recording);
  for (const std::string& name : groups_in(file, point)) {
    const Samples samples = open_samples(file, point, name, file_bytes);
    add_channels(samples, point + "/" + name + "/data", start_s, recording);
  }
  return recording;
}

}  // namespace rvbench::hal::hdf5
