#pragma once

#include "sequences/sequencer.hpp"

namespace rvbench::sequences {

/// Watches a run, and says nothing of it.
class SilentObserver final : public RunObserver {
 public:
  void progress(double, double, const std::string&) override {}
  void event(double, const std::string&) override {}
};

}  // namespace rvbench::sequences
