#include "hal/inheriting_mutex.hpp"

#include <cerrno>
#include <system_error>

namespace rvbench::hal {
namespace {

void check(int error) {
  if (error != 0) throw std::system_error(error, std::generic_category(), "InheritingMutex");
}

}  // namespace

InheritingMutex::InheritingMutex() {
  pthread_mutexattr_t attributes;
  check(::pthread_mutexattr_init(&attributes));
  int error = ::pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
  if (error == 0) error = ::pthread_mutex_init(&mutex_, &attributes);
  ::pthread_mutexattr_destroy(&attributes);
  check(error);
}

InheritingMutex::~InheritingMutex() { ::pthread_mutex_destroy(&mutex_); }

void InheritingMutex::lock() { check(::pthread_mutex_lock(&mutex_)); }

bool InheritingMutex::try_lock() {
  const int error = ::pthread_mutex_trylock(&mutex_);
  if (error == EBUSY) return false;
  check(error);
  return true;
}

void InheritingMutex::unlock() { ::pthread_mutex_unlock(&mutex_); }

}  // namespace rvbench::hal
