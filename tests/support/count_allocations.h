// Counts heap allocations by C++ and C (Eigen calls malloc). Replaces malloc in the test program
// that includes it.
#pragma once

#include <cstddef>

#include "solver/support/sanitized.h"

namespace twinarm::testing {
inline thread_local volatile long allocations = 0, allocated_bytes = 0;  // of this thread
inline void count_allocation(std::size_t size) {
  allocations = allocations + 1;
  allocated_bytes = allocated_bytes + static_cast<long>(size);
}
}  // namespace twinarm::testing

#ifdef TWINARM_SANITIZED
// Sanitizers need their own malloc. g++ ships the function but not its header.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*malloc_hook)(const volatile void*,
                                                                             std::size_t),
                                                         void (*free_hook)(const volatile void*));
namespace twinarm::testing {
inline void note_malloc(const volatile void*, std::size_t size) {
  count_allocation(size);
}
inline void note_free(const volatile void*) {}
inline const int hooks_installed =
    __sanitizer_install_malloc_and_free_hooks(note_malloc, note_free);
}  // namespace twinarm::testing
#else
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

// Weak: defined in every file that includes this header.
[[gnu::weak]] void* malloc(std::size_t size) {
  twinarm::testing::count_allocation(size);
  return __libc_malloc(size);
}
[[gnu::weak]] void* calloc(std::size_t count, std::size_t size) {
  twinarm::testing::count_allocation(count * size);
  return __libc_calloc(count, size);
}
[[gnu::weak]] void* realloc(void* old, std::size_t size) {
  twinarm::testing::count_allocation(size);
  return __libc_realloc(old, size);
}
[[gnu::weak]] void* aligned_alloc(std::size_t alignment, std::size_t size) {
  twinarm::testing::count_allocation(size);
  return __libc_memalign(alignment, size);
}
}
#endif

namespace twinarm::testing {

template <class Work>
long allocations_in(Work&& work) {
  const long before = allocations;
  work();
  return allocations - before;
}
template <class Work>
long bytes_in(Work&& work) {
  const long before = allocated_bytes;
  work();
  return allocated_bytes - before;
}

}  // namespace twinarm::testing
