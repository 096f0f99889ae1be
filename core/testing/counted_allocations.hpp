// Counts every allocation of the program. For one source file of a program: it replaces operator new. Not with
// ThreadSanitizer, whose own permits no other: then no allocation is counted.
#pragma once

#include <atomic>
#include <cstdlib>
#include <new>

namespace voussoir {

inline std::atomic<long long> allocations{0};

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define VOUSSOIR_ALLOCATIONS_NOT_COUNTED
#endif
#endif
#ifdef VOUSSOIR_ALLOCATIONS_NOT_COUNTED
inline constexpr bool allocations_are_counted = false;
#else
inline constexpr bool allocations_are_counted = true;
#endif

}  // namespace voussoir

#ifndef VOUSSOIR_ALLOCATIONS_NOT_COUNTED
// not inlined, or the compiler warns of malloc with delete
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++voussoir::allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++voussoir::allocations;
  return std::malloc(size ? size : 1);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
#endif
