#pragma once

namespace rvbench::test {

/// While it lives no thread but its own gets memory: `new` throws std::bad_alloc there. Link
/// scarce_memory.cpp, which replaces the program's `new`.
class ScarceMemory {
 public:
  ScarceMemory();
  ~ScarceMemory();
  ScarceMemory(const ScarceMemory&) = delete;
  ScarceMemory& operator=(const ScarceMemory&) = delete;
};

}  // namespace rvbench::test
