/// Counts heap allocations in a scope. Interposes malloc, because Eigen does not go
/// through operator new. Inactive under sanitizers, which own malloc.
#pragma once

namespace prehensile::testing {

class NoHeapScope {
 public:
  NoHeapScope();
  NoHeapScope(const NoHeapScope&) = delete;
  NoHeapScope& operator=(const NoHeapScope&) = delete;

  /// Allocations by this thread since construction; -1 where counting is not possible.
  long allocations() const;

 private:
  long at_start_;
};

/// False under sanitizers.
bool heap_is_counted();

}  // namespace prehensile::testing
