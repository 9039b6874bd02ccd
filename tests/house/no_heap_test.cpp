/// The counter that the tests of hot paths rely on does count.
#include "tests/support/no_heap.h"

#include <memory>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "tests/support/sanitizers.h"

namespace prehensile::testing {
namespace {

// Their sizes are not known to the compiler, which may leave out what it sees through.
volatile int size = 7;

TEST(NoHeap, CountsAllocationsOfLanguageAndLibraries) {
  if (!heap_is_counted()) {
    EXPECT_EQ(NoHeapScope().allocations(), -1);
    return;
  }
  const NoHeapScope nothing;
  EXPECT_EQ(nothing.allocations(), 0);
  {
    const NoHeapScope scope;
    const std::vector<double> some(static_cast<std::size_t>(size));
    EXPECT_EQ(some.size(), 7u);
    EXPECT_GE(scope.allocations(), 1);
  }
  const NoHeapScope scope;
  const Eigen::VectorXd some = Eigen::VectorXd::Zero(size);
  EXPECT_EQ(some.size(), 7);
  EXPECT_GE(scope.allocations(), 1);
}

/// Only where a sanitizer owns the heap may counting be off.
TEST(NoHeap, IsOffUnderSanitizersOnly) {
  EXPECT_EQ(heap_is_counted(), PREHENSILE_SANITIZED == 0);
}

}  // namespace
}  // namespace prehensile::testing
