#include <algorithm>
#include <cmath>

#include "hal/can/can_frames.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  hal::CanFrame frame{
      .id = data[0] % 2 == 0 ? hal::can_frames::torque_id : hal::can_frames::brake_status_id,
      .length = data[1]};
  std::copy_n(data + 2, std::min<std::size_t>(size - 2, frame.data.size()), frame.data.begin());
  if (const auto torque = hal::can_frames::torque_from_frame(frame)) {
    test::must(std::isfinite(torque->torque_Nm));
    test::must(torque->angle_turns >= 0 && torque->angle_turns < 1);
  }
  if (const auto brake = hal::can_frames::brake_status_from_frame(frame)) {
    test::must(brake->torque_Nm >= 0 && brake->torque_Nm <= hal::can_frames::max_brake_torque_Nm);
  }
  return 0;
}
