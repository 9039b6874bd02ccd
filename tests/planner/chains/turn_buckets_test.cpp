#include "planner/chains/turn_buckets.h"

#include <gtest/gtest.h>

namespace prehensile {
namespace {

constexpr double kC = 0.01;     // [m]
constexpr double kL = 0.1;      // [m]
constexpr float kGain = 0.01F;  // [J]

TurnCost push(double length, double low, double high) {
  return turn_cost(length, {low, high});
}

TEST(TurnBuckets, KeepWhatIsCheaper) {
  TurnBuckets buckets(3, kC, kL);
  const TurnCost dear = push(0.05, -2.0, 2.0);
  const TurnCost same_turn = push(0.04, -2.5, 2.5);
  EXPECT_TRUE(buckets.offer(1, dear, 2, kGain, 0));
  EXPECT_TRUE(buckets.holds(1, dear, 0));
  EXPECT_FALSE(buckets.offer(1, dear, 2, kGain, 1));  // not cheaper than itself
  EXPECT_FALSE(buckets.offer(1, dear, 3, kGain, 1));
  EXPECT_TRUE(buckets.offer(1, same_turn, 1, kGain, 1));
  EXPECT_TRUE(buckets.holds(1, same_turn, 1));
  EXPECT_FALSE(buckets.holds(1, dear, 0));
}

TEST(TurnBuckets, StatesKnowNothingOfEachOther) {
  TurnBuckets buckets(3, kC, kL);
  const TurnCost way = push(0.05, -2.0, 2.0);
  for (int state = 0; state < 3; ++state) {
    EXPECT_TRUE(buckets.offer(state, way, 1, kGain, state));
  }
  for (int state = 0; state < 3; ++state) EXPECT_TRUE(buckets.holds(state, way, state));
}

/// A way that turns the object where others do not is worth a higher price.
TEST(TurnBuckets, TellTurnsApart) {
  TurnBuckets buckets(1, kC, kL);
  const TurnCost straight = push(0.02, 0.0, 0.0);
  const TurnCost left = push(0.02, 3.0, 4.0);
  const TurnCost both = push(0.05, -2.0, 2.0);
  EXPECT_TRUE(buckets.offer(0, straight, 1, kGain, 0));
  EXPECT_TRUE(buckets.offer(0, left, 1, kGain, 1));
  EXPECT_TRUE(buckets.offer(0, both, 1, kGain, 2));
  EXPECT_TRUE(buckets.holds(0, straight, 0));
  EXPECT_TRUE(buckets.holds(0, left, 1));
  EXPECT_TRUE(buckets.holds(0, both, 2));
}

/// A way that is as short, but turns the object over all of it, is cheaper where the turn
/// is large and no cheaper where it is not.
TEST(TurnBuckets, CountWhatATurnCosts) {
  TurnBuckets buckets(1, kC, kL);
  TurnCost in_one_half = push(0.01, 0.0, 0.0);
  in_one_half += push(0.01, 0.0, 8.0);
  const TurnCost all_along = push(0.02, 0.0, 4.0);
  EXPECT_TRUE(buckets.offer(0, in_one_half, 1, kGain, 0));
  EXPECT_TRUE(buckets.offer(0, all_along, 1, kGain, 1));
  EXPECT_TRUE(buckets.holds(0, in_one_half, 0));
  EXPECT_TRUE(buckets.holds(0, all_along, 1));
}

/// Turns beyond what buckets tell apart share the last one.
TEST(TurnBuckets, TakeAnyTurn) {
  TurnBuckets buckets(1, kC, kL);
  for (const double kappa : {-30.0, 30.0}) {
    const TurnCost far = push(1.0, kappa, kappa);
    EXPECT_TRUE(buckets.offer(0, far, 1, kGain, 0));
    EXPECT_FALSE(buckets.offer(0, far, 1, kGain, 1));
  }
}

}  // namespace
}  // namespace prehensile
