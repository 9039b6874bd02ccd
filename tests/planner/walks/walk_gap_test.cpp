#include "planner/walks/walk_gap.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planner/walks/walk_rest.h"
#include "scene/constants.h"
#include "tests/planner/random_search.h"

namespace prehensile {
namespace {

using testing::RandomLattice;

/// Nothing where a walk leads to a goal, and no more than from the start to the nearest
/// goal elsewhere.
TEST(WalkGap, IsNothingWhereAWalkLeadsToAGoal) {
  int walks = 0;
  int gaps = 0;
  for (std::uint64_t i = 0; i < 24; ++i) {
    RandomLattice c(i);
    const LeastRest rest = rest_of_walks(c.lattice, c.contacts, c.limits, c.work);
    const auto gap = walk_gap(c.lattice, c.limits, c.work);
    ASSERT_TRUE(gap);
    EXPECT_NEAR(gap->spacings * c.lattice.spacing(), (gap->from - gap->to).norm(), 1e-12);
    if (rest.after(c.lattice.start(), -1) < kInfinity) {
      ++walks;
      EXPECT_EQ(gap->spacings, 0.0) << i;
      continue;
    }
    ++gaps;
    EXPECT_GT(gap->spacings, 0.0) << i;
    double nearest = kInfinity;
    for (int k = 0; k < c.goals.count; ++k) {
      nearest = std::min(nearest, (c.goals.places[k].p_OF - c.start.p_OF).norm());
    }
    EXPECT_LE(gap->spacings, nearest / c.lattice.spacing() + 1e-9) << i;
  }
  EXPECT_GE(walks, 5);
  EXPECT_GE(gaps, 5);
}

TEST(WalkGap, IsNotKnownWhereABudgetEnds) {
  RandomLattice c(0, 1);
  EXPECT_FALSE(walk_gap(c.lattice, c.limits, c.work));
}

}  // namespace
}  // namespace prehensile
