#include "hal/hdf5/recording_skeleton.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <system_error>

#include "hal/hdf5/attributes.hpp"
#include "hal/hdf5/growing_series.hpp"
#include "hal/hdf5/sample_group.hpp"
#include "hal/hdf5/tables.hpp"

namespace rvbench::hal::hdf5 {
namespace {

Handle make_group(const Handle& file, const std::string& path) {
  return own(H5Gcreate2(file.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
             path);
}

template <typename Number>
void make_samples(const Handle& file, const std::string& path, const SampleGroup& samples) {
  const Handle group = make_group(file, path);
  write_sample_group(group, samples);
  GrowingSeries<Number>::create(group, samples.channels.size());
}

void make_point(const Handle& file, int number, const RecordingLayout& layout) {
  const PlannedPoint& plan = layout.points[static_cast<std::size_t>(number)];
  const std::string path = point_path(number);
  const Handle point = make_group(file, path);
  write_number(point, "speed_rpm", plan.speed_rpm);
  write_number(point, "load_pct", plan.load_pct);
  write_integer(point, "repeat", plan.repeat);
  if (!layout.acceleration_channels.empty()) {
    make_samples<float>(file, path + "/acceleration",
                        {layout.acceleration_channels, layout.acceleration_rate_Hz,
                         layout.acceleration_range_m_s2});
  }
  if (layout.torque_rate_Hz > 0) {
    const ChannelInfo torque{std::string(channel_names::input_torque), "N·m", "", not_known};
    const ChannelInfo angle{std::string(channel_names::input_angle), "rad", "", not_known};
    make_samples<float>(file, path + "/torque", {{torque}, layout.torque_rate_Hz, not_known});
    // As a float the angle would be rounded to 0.06 rad after an hour and a half at 1815 rpm.
    make_samples<double>(file, path + "/angle", {{angle}, layout.torque_rate_Hz, not_known});
  }
}

void fill(const Handle& file, const RecordingLayout& layout) {
  write_text(file, "software", layout.software);
  write_integer(file, "format_version", 1);
  make_group(file, "/points");
  for (std::size_t i = 0; i < layout.points.size(); ++i) {
    make_point(file, static_cast<int>(i), layout);
  }
  create_tables(file);
  check(H5Fstart_swmr_write(file.id()), "start SWMR writing");
}

}  // namespace

std::string point_path(int point) { return fmt::format("/points/{:03}", point); }

Handle make_skeleton(const std::filesystem::path& path, const RecordingLayout& layout) {
  const Handle access = file_access();
  Handle file =
      own(H5Fcreate(path.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, access.id()), H5Fclose, "create");
  try {
    fill(file, layout);
  } catch (const FileFailure&) {
    // Half a skeleton cannot be repaired: a run could never be resumed beside it.
    file.close();
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    throw;
  }
  return file;
}

}  // namespace rvbench::hal::hdf5
