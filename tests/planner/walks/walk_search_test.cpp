#include "planner/walks/walk_search.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "planner/chains/shorten.h"
#include "planner/checks/meet_end.h"
#include "planner/search/push_search.h"
#include "planner/steering/draft.h"
#include "problems/random_fixtures.h"
#include "tests/planner/executed_pushes.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::convex_with_walls;

constexpr std::int64_t kBudget = 5'000'000;

Scene random_scene(FixtureObject object, std::uint64_t index) {
  const FixtureRange range{.object = object, .goals = GoalsFrom::kRandom};
  return random_fixture(range, 1, index)->scene;
}

std::optional<std::vector<Move>> walk_in(const SearchModel& search,
                                         std::int64_t budget = kBudget) {
  const PlanOptions options;
  Work work{.budget = budget};
  const Limits limits(options, work);
  const FlatState start = flat_state(search.model->scene.start);
  const GoalPlaces goals = goal_places(*search.model, *search.model->scene.goal, start);
  WalkLattices lattices;
  return search_walks(search, start, goals, std::numeric_limits<double>::infinity(),
                      lattices, limits, work);
}

/// Walks from the start to the goal by pushes that the exact mechanics does, too; the
/// same every time.
TEST(WalkSearch, ReachesTheGoalByPushesThatStick) {
  testing::Directions directions;
  int walks = 0;
  for (std::uint64_t i = 0; i < 16; ++i) {
    Scene scene = random_scene(static_cast<FixtureObject>(i % 4), i);
    scene.overhang = i % 3 == 0 ? Overhang::kIgnore : Overhang::kClip;
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    const auto moves = walk_in(search);
    if (!moves) continue;
    ++walks;
    if (i < 4) {
      EXPECT_EQ(cost_of(search, *moves), cost_of(search, *walk_in(search)));
    }
    Plan plan = blank_plan(search, scene.start, {});
    for (const Move& move : *moves) append_move(search, move, plan);
    meet_ends(model, {}, plan);
    testing::expect_executable(model, plan, directions);
  }
  EXPECT_GE(walks, 8);
  EXPECT_LT(directions.reversible, directions.pushes);
}

/// Regrasps for which chains of few pushes, and two trees of a million pushes, found no
/// plan: loops near the border of the face, where the pads are clipped.
TEST(WalkSearch, FindsLoopsWhereThePadsAreClipped) {
  for (const std::uint64_t index : {111, 139, 158}) {
    const Model model = prepare(random_scene(FixtureObject::kConvex, index));
    const Plan plan = plan_regrasp(model, {.margin = Margin::none()});
    EXPECT_EQ(plan.status, PlanStatus::kReachedGoal) << index;
    EXPECT_EQ(plan.planner, "push") << index;
  }
}

/// One through places so narrow that only the finest lattice has nodes in them, and two
/// of which many pushes turn out not to stick.
TEST(WalkSearch, FindsNarrowWays) {
  for (const Scene& scene : {random_scene(FixtureObject::kConvex, 151),
                             convex_with_walls(2, 81), convex_with_walls(5, 56)}) {
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    const auto moves = walk_in(search);
    ASSERT_TRUE(moves) << scene.name;
    Plan plan = blank_plan(search, scene.start, {});
    for (const Move& move : *moves) append_move(search, move, plan);
    testing::Directions directions;
    meet_ends(model, {}, plan);
    testing::expect_executable(model, plan, directions);
  }
}

/// One wall, of which the object has to be turned by several whole turns.
Scene scene_of_many_turns(std::uint64_t index) { return convex_with_walls(1, index); }

TEST(WalkSearch, MeetsAngleAtAnyWholeTurn) {
  for (const std::uint64_t index : {7, 22, 39}) {
    const Model model = prepare(scene_of_many_turns(index));
    const Plan plan = plan_regrasp(model, {.margin = Margin::none()});
    ASSERT_EQ(plan.status, PlanStatus::kReachedGoal) << index;
    EXPECT_TRUE(reaches(*model.scene.goal, plan.goal)) << index;
    EXPECT_GT(std::abs(plan.goal.X_HO.theta - plan.start.X_HO.theta),
              3.0 * std::numbers::pi)
        << index;
  }
}

TEST(WalkSearch, MeetsANumberAtItself) {
  int otherwise = 0;
  for (std::uint64_t index = 0; index < 40; ++index) {
    Scene scene = scene_of_many_turns(index);
    const Model of_angle = prepare(scene);
    const auto turned = walk_in(prepare_search(of_angle, Margin::none()));
    scene.goal->theta_is = ThetaMeaning::kNumber;
    const Model model = prepare(scene);
    const auto moves = walk_in(prepare_search(model, Margin::none()));
    if (moves) {
      EXPECT_NEAR(moves->back().to.theta, *scene.goal->theta, 1e-9) << index;
    }
    otherwise += turned && !moves ? 1 : 0;
  }
  EXPECT_GE(otherwise, 1);
}

TEST(WalkSearch, KeepsToItsBudget) {
  const Model model = prepare(random_scene(FixtureObject::kConvex, 111));
  const SearchModel search = prepare_search(model, Margin::none());
  EXPECT_TRUE(walk_in(search));
  EXPECT_FALSE(walk_in(search, 1000));
}

/// A window of angles that no walk may leave on its way.
TEST(WalkSearch, KeepsToLimitsOfTheAngle) {
  int walks = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Model model = prepare(testing::box_with_angle_limits(i));
    const auto moves = walk_in(prepare_search(model, Margin::none()));
    if (!moves) continue;
    ++walks;
    testing::expect_within_limits(model.scene, *moves);
  }
  EXPECT_GE(walks, 10);
}

}  // namespace
}  // namespace prehensile
