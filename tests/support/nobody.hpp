#pragma once

#include "hal/recording_file.hpp"
#include "sequences/sequencer.hpp"

namespace rvbench::test {

/// Watches a run, and says nothing of it.
class Nobody final : public sequences::RunObserver {
 public:
  void progress(double, double, const std::string&) override {}
  void event(double, const std::string&) override {}
};

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
