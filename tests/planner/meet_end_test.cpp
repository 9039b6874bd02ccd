#include "planner/meet_end.h"

#include <gtest/gtest.h>

#include "planner/planner.h"
#include "planner/replay.h"
#include "problems/random_fixtures.h"
#include "problems/random_pushes.h"

namespace prehensile {
namespace {

double distance(const Model& model, const Grasp& a, const Grasp& b) {
  return Vec3(a.X_HO.x - b.X_HO.x, a.X_HO.y - b.X_HO.y,
              model.c * (a.X_HO.theta - b.X_HO.theta))
      .norm();
}

/// Pushes that were aimed a little wrong come back to where the right ones ended.
TEST(MeetEnd, FindsAPushThatIsThere) {
  int tried = 0;
  int met = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    RandomPush c = random_push(5, i);
    c.scene.pushers[0].feature = PointFeature{};
    const Model model = prepare(c.scene);
    const TransitionOptions options;
    const Transition right = apply(model, c.scene.start, c.push, options);
    if (!right.completed() || right.slipped > 1e-9) continue;
    LinearPush wrong = c.push;
    wrong.e = rotated(0.02, wrong.e);
    wrong.travel *= 1.03;
    wrong.place += 0.5e-3;
    Plan plan;
    plan.pushes.push_back({.push = wrong, .start = c.scene.start, .end = right.end});
    const Transition before = apply(model, c.scene.start, wrong, options);
    if (!before.completed()) continue;
    ++tried;
    EXPECT_GT(distance(model, before.end, right.end), 1e-5);
    meet_ends(model, options, plan);
    EXPECT_GT(plan.instants, 0);
    const Transition after = apply(model, c.scene.start, plan.pushes[0].push, options);
    if (after.completed() && distance(model, after.end, right.end) <= 1e-6) ++met;
  }
  EXPECT_GE(tried, 50);
  EXPECT_GE(met, 0.9 * tried) << met << " of " << tried;
}

TEST(MeetEnd, LeavesOtherPushesAlone) {
  RandomPush c = random_push(5, 3);
  c.scene.pushers[0].feature = LineFeature{};
  const Model model = prepare(c.scene);
  Plan plan;
  plan.pushes.push_back({.push = c.push, .start = c.scene.start, .end = c.scene.start});
  meet_ends(model, {}, plan);
  EXPECT_EQ(plan.instants, 0);
  const auto& push = std::get<LinearPush>(plan.pushes[0].push);
  EXPECT_EQ(push.place, c.push.place);
  EXPECT_EQ(push.e, c.push.e);
}

/// Plans by points alone hold in a replay, costs and ends included.
TEST(MeetEnd, PlansByPointsAreReplayed) {
  FixtureRange range;
  range.pushers = FixturePushers::kPoints;
  int planned = 0;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const std::optional<RandomRegrasp> problem = random_fixture(range, 8, i);
    if (!problem) continue;
    const Model model = prepare(problem->scene);
    PlanOptions options;
    options.budget = 20'000;
    const Plan plan = plan_regrasp(model, options);
    if (!plan.usable()) continue;
    ++planned;
    const Replay replayed = replay(model, plan);
    EXPECT_TRUE(replayed.agrees) << i << ": " << replayed.why;
  }
  EXPECT_GE(planned, 5);
}

}  // namespace
}  // namespace prehensile
