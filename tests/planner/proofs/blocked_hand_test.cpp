#include "planner/proofs/blocked_hand.h"

#include <gtest/gtest.h>

#include "planner/obstacles/collision_bodies.h"
#include "planner/obstacles/confines_check.h"
#include "planner/obstacles/placement.h"
#include "planner/search/push_search.h"
#include "problems/confined_regrasps.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

PlanOptions nominal() {
  PlanOptions options;
  options.budget = 300'000;
  options.margin = Margin::none();
  return options;
}

/// Whether a push of this length is free of collisions, by the check of plans.
bool is_free(const Model& model, int contact, double place, const PlanarPose& X_HO,
             bool at_start) {
  PlannedPush planned;
  const LinearPush push{contact, place, model.contacts[contact].n, 1e-6, 0.0};
  planned.push = push;
  planned.start.X_HO = X_HO;
  planned.end.X_HO = pusher_pose(push, X_HO, 1.0);
  if (!at_start) std::swap(planned.start, planned.end);
  return confinement_fault(model, {planned}).empty();
}

/// A square among walls whose posts stand in the hand's way at random.
Scene crowded(int i) {
  Scene scene = with_obstacles(
      random_among_walls(true, RegraspRange::kWide, false, 43, i), 6, 43, i);
  Random random(static_cast<std::uint64_t>(i));
  for (int k = 0; k < 3; ++k) {
    const Pusher& wall = scene.pushers[static_cast<std::size_t>(k)];
    const Vec2 n = rotated(wall.normal_angle, {1.0, 0.0});
    const Vec2 p = wall.p_WP + random.in(0.1, 0.16) * n + random.in(-0.1, 0.1) * perp(n);
    scene.obstacles->fixture.push_back(
        {.name = "bar " + std::to_string(k),
         .shape = BoxShape{{0.02, random.in(0.02, 0.3), 0.2}},
         .position = {p.x(), p.y(), 0.0},
         .turn = wall.normal_angle});
  }
  // Walls of unknown length stand in one place only.
  if (i % 2 == 0) {
    for (Pusher& wall : scene.pushers) wall.feature = LineFeature{};
  }
  return scene;
}

/// What is called blocked has no free push there by the check of plans, which measures
/// distances in another way; and no planner finds a plan.
TEST(BlockedHand, NothingBeginsOrEndsThere) {
  int at_start = 0;
  int at_goal = 0;
  int open = 0;
  Random random(8);
  for (int i = 0; i < 40; ++i) {
    const Model model = prepare(crowded(i));
    const Goal& goal = *model.scene.goal;
    const bool start_is_blocked = is_blocked_at_start(model);
    const bool goal_is_blocked = is_blocked_at_goal(model);
    at_start += start_is_blocked;
    at_goal += goal_is_blocked;
    for (int c = 0; c < static_cast<int>(model.contacts.size()); ++c) {
      const double room = farthest_place(model.contacts[c]);
      for (int k = 0; k < 30; ++k) {
        const double place = random.in(-room, room);
        if (start_is_blocked) {
          EXPECT_FALSE(is_free(model, c, place, model.scene.start.X_HO, true)) << i;
        }
        const double turn = goal.characteristic_length;
        PlanarPose X_HO{
            *goal.x + random.in(-1.0, 1.0) * goal.position_tolerance,
            *goal.y + random.in(-1.0, 1.0) * goal.position_tolerance,
            *goal.theta + random.in(-1.0, 1.0) * goal.position_tolerance / turn};
        if (goal_is_blocked && reaches(goal, {X_HO, 0.0})) {
          EXPECT_FALSE(is_free(model, c, place, X_HO, false)) << i;
        }
      }
    }
    if (start_is_blocked || goal_is_blocked) {
      const SearchModel search = prepare_search(model, Margin::none());
      Work work{.budget = 200'000};
      const Plan plan = search_pushes(search, model.scene.start, goal, nominal(), work);
      EXPECT_NE(plan.status, PlanStatus::kReachedGoal) << i;
      continue;
    }
    const Plan plan = plan_regrasp(model, nominal());
    open += plan.usable();
  }
  EXPECT_GT(at_start, 3);
  EXPECT_GT(at_goal, 3);
  EXPECT_GT(open, 0);
  std::printf("blocked at the start %d, at the goal %d, solved %d\n", at_start, at_goal,
              open);
}

TEST(BlockedHand, IsAProof) {
  for (int i = 0; i < 15; ++i) {
    const Model model = prepare(crowded(i));
    if (!is_blocked_at_start(model) && !is_blocked_at_goal(model)) continue;
    const Plan plan = plan_regrasp(model, nominal());
    ASSERT_EQ(plan.status, PlanStatus::kInfeasible) << i;
    EXPECT_TRUE(verify(model, plan.proof));
    Scene free = model.scene;
    free.obstacles.reset();
    const Model without = prepare(free);
    std::string why;
    EXPECT_FALSE(verify(without, plan.proof, &why));
    EXPECT_FALSE(why.empty());
  }
}

/// A palm that is too near to the object at the start or at all of the goal is in the way
/// of every push there; the check of plans agrees, and proofs hold.
TEST(BlockedHand, ThePalmBlocksWhateverPushes) {
  Random random(11);
  int at_start = 0;
  int at_goal = 0;
  int nowhere = 0;
  for (int i = 0; i < 60; ++i) {
    Scene scene = random_among_walls(true, RegraspRange::kWide, false, 46, i);
    const Vec2 p = random.in(0.05, 0.12) * random.direction();
    scene.obstacles = Obstacles{.hand = {{.name = "palm",
                                          .shape = BoxShape{{0.02, 0.03, 0.07}},
                                          .position = {p.x(), p.y(), 0.0},
                                          .turn = random.in(-1.0, 1.0)}}};
    const Model model = prepare(scene);
    const Goal& goal = *scene.goal;
    const bool start_is_blocked = is_blocked_at_start(model);
    const bool goal_is_blocked = is_blocked_at_goal(model);
    at_start += start_is_blocked;
    at_goal += goal_is_blocked;
    nowhere += !start_is_blocked && !goal_is_blocked;
    for (int c = 0; c < static_cast<int>(model.contacts.size()); ++c) {
      if (start_is_blocked) {
        EXPECT_FALSE(is_free(model, c, 0.0, scene.start.X_HO, true)) << i;
      }
      for (int k = 0; k < 20 && goal_is_blocked; ++k) {
        const Vec2 off = random.in_disc(goal.position_tolerance);
        const double turn =
            random.in(-1.0, 1.0) * goal.position_tolerance / goal.characteristic_length;
        const PlanarPose X_HO{*goal.x + off.x(), *goal.y + off.y(), *goal.theta + turn};
        if (!reaches(goal, {X_HO, 0.0})) continue;
        EXPECT_FALSE(is_free(model, c, 0.0, X_HO, false)) << i;
      }
    }
    if (!start_is_blocked || i > 20) continue;
    const Plan plan = plan_regrasp(model, nominal());
    if (!collisions_are_built()) continue;
    EXPECT_EQ(plan.status, PlanStatus::kInfeasible) << i;
    EXPECT_TRUE(verify(model, plan.proof)) << i;
  }
  std::printf("blocked at the start %d, at the goal %d, at none %d of 60\n", at_start,
              at_goal, nowhere);
  EXPECT_GT(at_start, 5);
  EXPECT_GT(at_goal, 5);
  EXPECT_GT(nowhere, 5);
}

/// A goal that leaves a coordinate free, or bodies far away, prove nothing.
TEST(BlockedHand, RefusesWhatItCannotKnow) {
  Scene scene = with_obstacles(
      random_among_walls(true, RegraspRange::kPublished, false, 3, 0), 0, 1, 0);
  EXPECT_FALSE(is_blocked_at_start(prepare(scene)));
  for (int i = 0; i < 15; ++i) {
    scene = crowded(i);
    if (!is_blocked_at_goal(prepare(scene))) continue;
    scene.goal->theta.reset();
    EXPECT_FALSE(is_blocked_at_goal(prepare(scene)));
  }
}

/// A wall may be used wherever its ends let it cover the face; where that is stated it
/// helps, and elsewhere the check refuses it.
TEST(BlockedHand, PushersStandWhereTheyMay) {
  Scene scene = with_obstacles(
      random_among_walls(true, RegraspRange::kWide, false, 44, 1), 0, 1, 0);
  const auto fault = [&](double place) {
    const Model model = prepare(scene);
    PlannedPush planned;
    const LinearPush push{0, place, model.contacts[0].n, 1e-6, 0.0};
    planned.push = push;
    planned.start.X_HO = scene.start.X_HO;
    planned.end.X_HO = pusher_pose(push, scene.start.X_HO, 1.0);
    return confinement_fault(model, {planned}).find("beside its place") !=
           std::string::npos;
  };
  const double room = farthest_place(prepare(scene).contacts[0]);
  EXPECT_NEAR(room, 0.1, 1e-9);  // a wall of 0.3 m over a face of 0.1 m
  EXPECT_FALSE(fault(0.99 * room));
  EXPECT_TRUE(fault(1.01 * room));
  scene.pushers[0].feature = LineFeature{};
  EXPECT_FALSE(fault(0.0));
  EXPECT_TRUE(fault(1e-3));
}

}  // namespace
}  // namespace prehensile
