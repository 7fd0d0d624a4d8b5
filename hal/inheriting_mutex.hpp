#pragma once

#include <pthread.h>

namespace rvbench::hal {

/// A mutex between threads of unequal urgency: whoever holds it runs with the priority of the most
/// urgent one that waits (PTHREAD_PRIO_INHERIT). With an ordinary one the supervisor would wait for
/// a thread that everything else on the computer may keep from running.
///
/// Threads  as std::mutex, for the standard's guards and std::condition_variable_any
class InheritingMutex {
 public:
  InheritingMutex();  ///< @throws std::system_error where the system has no such mutex
  ~InheritingMutex();
  InheritingMutex(const InheritingMutex&) = delete;
  InheritingMutex& operator=(const InheritingMutex&) = delete;

  void lock();
  bool try_lock();
  void unlock();
  pthread_mutex_t* native_handle() { return &mutex_; }

 private:
  pthread_mutex_t mutex_;
};

}  // namespace rvbench::hal
