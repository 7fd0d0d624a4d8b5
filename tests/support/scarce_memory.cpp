#include "tests/support/scarce_memory.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> is_scarce = false;
thread_local bool has_plenty = false;

void* memory(std::size_t size) noexcept {
  if (is_scarce && !has_plenty) return nullptr;
  return std::malloc(size == 0 ? 1 : size);
}

}  // namespace

void* operator new(std::size_t size) {
  if (void* const found = memory(size)) return found;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return memory(size); }
void operator delete(void* found) noexcept { std::free(found); }
void operator delete(void* found, std::size_t) noexcept { std::free(found); }
void operator delete(void* found, const std::nothrow_t&) noexcept { std::free(found); }

namespace rvbench::test {

ScarceMemory::ScarceMemory() {
  has_plenty = true;
  is_scarce = true;
}

ScarceMemory::~ScarceMemory() {
  is_scarce = false;
  has_plenty = false;
}

}  // namespace rvbench::test
