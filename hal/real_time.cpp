#include "hal/real_time.hpp"

#include <pthread.h>
#include <sched.h>

#include <cstring>

namespace rvbench::hal {
namespace {

constexpr int priority = 40;  // threaded interrupt handlers have 50

}  // namespace

std::string make_this_thread_urgent() {
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters);
  if (error == 0) return "";
  return std::string(std::strerror(error)) +
         ": no SCHED_FIFO; as root, with CAP_SYS_NICE or an rtprio limit of 40 there would be";
}

}  // namespace rvbench::hal
