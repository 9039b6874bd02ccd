#include "planner/checks/meet_end.h"

#include <gtest/gtest.h>

#include "mechanics/sticking.h"
#include "planner/checks/replay.h"
#include "planner/planner.h"
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

/// Straight moves as the search plans them: what one push does not follow to its end is
/// divided, and every part ends where the next begins.
TEST(MeetEnd, DividesWhatOnePushDoesNotFollow) {
  int whole = 0;
  int divided = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    RandomPush c = random_push(6, i);
    c.scene.pushers[0].feature = PointFeature{};
    const Model model = prepare(c.scene);
    const Grasp& start = c.scene.start;
    const StickContact stick = stick_contact(model, model.contacts[0], c.push.place);
    const KappaSet turns = sticking_kappas(stick, finger_in_object(start.X_HO), c.push.e);
    if (turns.empty()) continue;
    c.push.travel = 0.04;
    c.push.turn = turns.intervals[0].lo * c.push.travel / model.c;
    const Vec2 p_OF = finger_in_object(start.X_HO) - c.push.travel * c.push.e;
    if (!(depth_inside(model.outline, p_OF) > 0.01) ||
        !(stick_test(stick, model.F, finger_in_object(start.X_HO), c.push.e,
                     c.push.travel, c.push.turn)
              .slack > 0.02)) {
      continue;
    }
    const Grasp end{pose_from_finger(p_OF, start.X_HO.theta + c.push.turn), 0.0};
    Plan plan;
    plan.pushes.push_back({.push = c.push, .start = start, .end = end});
    meet_ends(model, {}, plan);
    bool all_met = true;
    for (const PlannedPush& push : plan.pushes) {
      const Transition done = apply(model, push.start, push.push);
      all_met =
          all_met && done.completed() && distance(model, done.end, push.end) <= 1e-6;
    }
    if (plan.pushes.size() == 1) {
      whole += all_met ? 1 : 0;
      continue;
    }
    ++divided;
    EXPECT_TRUE(all_met) << i;
    EXPECT_EQ(distance(model, plan.pushes.front().start, start), 0.0);
    EXPECT_EQ(distance(model, plan.pushes.back().end, end), 0.0);
    for (std::size_t k = 1; k < plan.pushes.size(); ++k) {
      EXPECT_EQ(distance(model, plan.pushes[k - 1].end, plan.pushes[k].start), 0.0);
    }
  }
  EXPECT_GE(whole, 20);
  EXPECT_GE(divided, 2);
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

/// Goals made by points are reached by points, and the plans hold in a replay, costs and
/// ends included.
TEST(MeetEnd, PlansByPointsAreReplayed) {
  FixtureRange range;
  range.pushers = FixturePushers::kPoints;
  int problems = 0;
  int planned = 0;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const std::optional<RandomRegrasp> problem = random_fixture(range, 8, i);
    if (!problem) continue;
    ++problems;
    const Model model = prepare(problem->scene);
    const Plan plan = plan_regrasp(model);
    if (!plan.usable()) continue;
    ++planned;
    const Replay replayed = replay(model, plan);
    EXPECT_TRUE(replayed.agrees) << i << ": " << replayed.why;
  }
  EXPECT_GE(problems, 10);
  EXPECT_EQ(planned, problems);
}

/// Each push begins where the one before really ends, so that nothing adds up.
TEST(MeetEnd, ErrorsDoNotAddUp) {
  FixtureRange range;
  range.object = FixtureObject::kConcave;
  range.pushers = FixturePushers::kPoints;
  range.goals = GoalsFrom::kRandom;
  std::size_t longest = 0;
  for (std::uint64_t i = 0; i < 16; ++i) {
    const Model model = prepare(random_fixture(range, 8, i)->scene);
    const Plan plan = plan_regrasp(model, {.margin = Margin::none()});
    if (!plan.usable()) continue;
    longest = std::max(longest, plan.pushes.size());
    const Replay replayed = replay(model, plan);
    for (std::size_t k = 0; k < plan.pushes.size(); ++k) {
      EXPECT_LE(replayed.pushes[k].position_error, 1e-6) << i;
      EXPECT_LE(model.c * replayed.pushes[k].angle_error, 1e-6) << i;
      if (k > 0) {
        EXPECT_EQ(plan.pushes[k].start, plan.pushes[k - 1].end);
      }
    }
  }
  EXPECT_GE(longest, 4U);
}

}  // namespace
}  // namespace prehensile
