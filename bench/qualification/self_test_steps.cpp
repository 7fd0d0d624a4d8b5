#include "bench/qualification/self_test_steps.hpp"

namespace rvbench::bench {

std::vector<std::unique_ptr<SelfTestStep>> self_test_steps() {
  std::vector<std::unique_ptr<SelfTestStep>> steps;
  steps.push_back(make_sensor_noise());
  steps.push_back(make_sensor_bias());
  steps.push_back(make_tap());
  steps.push_back(make_drive_read_back());
  steps.push_back(make_brake_read_back());
  return steps;
}

}  // namespace rvbench::bench
