#include "tests/support/no_heap.h"

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PREHENSILE_COUNT_HEAP 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PREHENSILE_COUNT_HEAP 0
#endif
#endif
#ifndef PREHENSILE_COUNT_HEAP
#define PREHENSILE_COUNT_HEAP 1
#endif

namespace {
thread_local long allocation_count = 0;
}

#if PREHENSILE_COUNT_HEAP
extern "C" {
// The names are those of glibc.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(std::size_t size) {
  ++allocation_count;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocation_count;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++allocation_count;
  return __libc_realloc(old, size);
}
}
#endif

namespace prehensile::testing {

NoHeapScope::NoHeapScope() : at_start_(allocation_count) {}

long NoHeapScope::allocations() const {
  return heap_is_counted() ? allocation_count - at_start_ : -1;
}

bool heap_is_counted() { return PREHENSILE_COUNT_HEAP != 0; }

}  // namespace prehensile::testing
