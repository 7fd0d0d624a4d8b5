#pragma once

#include "hal/recording_file.hpp"

namespace rvbench::test {

/// Where what is recorded goes when nobody will look at it.
class Nowhere final : public hal::RecordingWriter {
 public:
  Status append(int, const hal::AccelerationBlock&) override { return Done{}; }
  Status append(int, const hal::TorqueBlock&) override { return Done{}; }
  Status end_point(const hal::PointResult&) override { return Done{}; }
  Status note(double, const std::string&) override { return Done{}; }
  Status close() override { return Done{}; }
};

}  // namespace rvbench::test
