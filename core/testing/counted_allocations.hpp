// Counts every allocation of the program. For one source file of a program: it replaces operator new.
#pragma once

#include <atomic>
#include <cstdlib>
#include <new>

namespace voussoir {

inline std::atomic<long long> allocations{0};

}  // namespace voussoir

// not inlined, or the compiler takes malloc and delete for a mistake
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++voussoir::allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
