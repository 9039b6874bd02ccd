#include "planner/finish/moved_stretch.h"

#include <gtest/gtest.h>

#include "planner/checks/exact_check.h"
#include "problems/published_regrasps.h"
#include "tests/planner/rejected_plan.h"

namespace prehensile {
namespace {

using testing::RejectedPlan;

constexpr double kSame = 1e-9;

/// Where nothing is moved the pushes are those that were read, with the slacks that the
/// exact check gives them.
TEST(MovedStretch, SaysOfPushesWhatTheExactCheckSays) {
  int pushes_seen = 0;
  for (const int index : {2, 10, 20, 30, 41}) {
    RejectedPlan one(published_tee(index));
    ASSERT_EQ(one.plan.status, PlanStatus::kReachedGoal) << index;
    if (one.plan.pushes.size() < 2 || !one.passes(one.plan)) continue;
    MovedStretch stretch(one.search, one.work, one.plan.margin, 0.0);
    ASSERT_TRUE(stretch.read(one.plan.pushes)) << index;
    std::vector<PlannedPush> pushes;
    std::vector<MovedPush> looks;
    ASSERT_TRUE(stretch.look(stretch.way_points(), pushes, looks)) << index;
    testing::expect_same_way({.pushes = pushes}, one.plan);
    Plan checked = one.plan;
    ASSERT_TRUE(check_exactly(one.model, one.options.transition, checked, nullptr));
    for (std::size_t k = 0; k < looks.size(); ++k) {
      EXPECT_TRUE(looks[k].is_allowed) << index;
      EXPECT_NEAR(looks[k].slack, checked.pushes[k].slack, kSame) << index;
      ++pushes_seen;
    }
  }
  EXPECT_GT(pushes_seen, 3);
}

/// A way-point off the object is not allowed, one beside its border is without room.
TEST(MovedStretch, SaysWhereThePadsLeaveTheObject) {
  RejectedPlan one(published_tee(20));
  MovedStretch stretch(one.search, one.work, one.plan.margin, 0.0);
  ASSERT_TRUE(stretch.read(one.plan.pushes));
  std::vector<PlannedPush> pushes;
  std::vector<MovedPush> looks;
  std::vector<double> way_points = stretch.way_points();
  bool is_crowded = false;
  for (int step = 0; step < 2000; ++step) {
    way_points[1] += 1e-4;
    ASSERT_TRUE(stretch.look(way_points, pushes, looks));
    if (!looks[0].is_allowed) break;
    is_crowded = is_crowded || !looks[0].has_room;
  }
  EXPECT_FALSE(looks[0].is_allowed);
  EXPECT_FALSE(looks[0].has_room);
  EXPECT_TRUE(is_crowded);
}

TEST(MovedStretch, HasNoPushesOfNoLength) {
  RejectedPlan one(published_tee(20));
  MovedStretch stretch(one.search, one.work, one.plan.margin, 0.0);
  ASSERT_TRUE(stretch.read(one.plan.pushes));
  const Vec2 start = flat_state(one.plan.pushes.front().start).p_OF;
  std::vector<double> way_points = stretch.way_points();
  way_points[0] = start.x();
  way_points[1] = start.y();
  std::vector<PlannedPush> pushes;
  std::vector<MovedPush> looks;
  EXPECT_FALSE(stretch.look(way_points, pushes, looks));
}

}  // namespace
}  // namespace prehensile
