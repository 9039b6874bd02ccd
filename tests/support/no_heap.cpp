#include "tests/support/no_heap.h"

#include <cstddef>

#include "tests/support/sanitizers.h"

namespace {
thread_local long allocation_count = 0;
}

#if !PREHENSILE_SANITIZED
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

bool heap_is_counted() { return PREHENSILE_SANITIZED == 0; }

}  // namespace prehensile::testing
