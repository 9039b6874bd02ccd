#include "planner/finish/finish.h"

#include <gtest/gtest.h>

#include "planner/planner.h"
#include "problems/published_regrasps.h"

namespace prehensile {
namespace {

/// The first plan fails its exact check, and what repairs it winds the hand: J 18.3. The
/// next search ends with a single placement.
TEST(Finish, WhatRepairsMakeDearIsSearchedAgain) {
  const Model model =
      prepare(random_among_walls(false, RegraspRange::kWide, true, 1, 201));
  const Plan plan = plan_regrasp(model, {.budget = 5'000'000});
  ASSERT_TRUE(plan.usable()) << plan.message;
  EXPECT_LT(plan.cost, 4.0);
  EXPECT_EQ(plan.promise, Promise::kMargin);
}

}  // namespace
}  // namespace prehensile
