#include "planner/walks/loop_search.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "planner/chains/shorten.h"
#include "planner/checks/meet_end.h"
#include "planner/search/push_search.h"
#include "planner/steering/draft.h"
#include "planner/walks/walk_search.h"
#include "problems/random_fixtures.h"
#include "tests/planner/executed_pushes.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

using testing::convex_with_walls;

constexpr std::int64_t kBudget = 5'000'000;
constexpr double kTurn = 2.0 * std::numbers::pi;

struct Found {
  std::optional<std::vector<Move>> moves;
  std::int64_t work = 0;
};

Found loop_in(const SearchModel& search, std::int64_t budget = kBudget) {
  const PlanOptions options;
  Work work{.budget = budget};
  const Limits limits(options, work);
  const Model& model = *search.model;
  const FlatState start = flat_state(model.scene.start);
  const Goal& goal = *model.scene.goal;
  WalkLattices lattices;
  Found found;
  found.moves = search_loops(search, start, goal_places(model, goal, start),
                             tolerated_places(model, goal, start), Steepness::kUsual,
                             lattices, limits, work);
  found.work = work.done();
  return found;
}

void expect_executable(const Model& model, const SearchModel& search,
                       const std::vector<Move>& moves, testing::Directions& directions) {
  Plan plan = blank_plan(search, model.scene.start, {});
  for (const Move& move : moves) append_move(search, move, plan);
  meet_ends(model, {}, plan);
  testing::expect_executable(model, plan, directions);
}

/// By pushes that the exact mechanics does, too; the same every time.
TEST(LoopSearch, ReachesTheGoalByPushesThatStick) {
  testing::Directions directions;
  int walks = 0;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const FixtureRange range{.object = static_cast<FixtureObject>(i % 4),
                             .goals = GoalsFrom::kRandom};
    Scene scene = random_fixture(range, 1, i)->scene;
    scene.overhang = i % 3 == 0 ? Overhang::kIgnore : Overhang::kClip;
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    const auto moves = loop_in(search).moves;
    if (!moves) continue;
    ++walks;
    if (i < 4) {
      EXPECT_EQ(cost_of(search, *moves), cost_of(search, *loop_in(search).moves));
    }
    expect_executable(model, search, *moves, directions);
  }
  EXPECT_GE(walks, 6);
  EXPECT_LT(directions.reversible, directions.pushes);
}

/// Regrasps of which labels keep no loop: few headings stick on their ways.
TEST(LoopSearch, FindsWhatTurnsLittleAtATime) {
  for (const Scene& scene : {convex_with_walls(1, 87), convex_with_walls(3, 53)}) {
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    const Found found = loop_in(search);
    ASSERT_TRUE(found.moves) << scene.name;
    testing::Directions directions;
    expect_executable(model, search, *found.moves, directions);
  }
}

/// Through ways that few headings lead through: two friction cones that leave a few
/// degrees more than half a turn.
TEST(LoopSearch, TacksThroughNarrowWays) {
  const FixtureRange low{.object = FixtureObject::kBox,
                         .finger_friction = {0.15, 0.3},
                         .pusher_friction = {0.1, 0.3},
                         .goals = GoalsFrom::kRandom};
  const FixtureRange high{.object = FixtureObject::kBox,
                          .finger_friction = {0.9, 1.5},
                          .pusher_friction = {0.9, 1.5},
                          .goals = GoalsFrom::kRandom};
  const Scene scenes[] = {random_fixture(low, 1, 43)->scene,
                          random_fixture(high, 1, 26)->scene};
  for (const Scene& scene : scenes) {
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    const Found found = loop_in(search, 20'000'000);
    ASSERT_TRUE(found.moves) << scene.name;
    testing::Directions directions;
    expect_executable(model, search, *found.moves, directions);
  }
}

/// A number for a goal, twelve turns away, to either side: the loop is gone
/// around as often as that takes.
TEST(LoopSearch, TurnsAsOftenAsANumberAsks) {
  int wound = 0;
  for (std::uint64_t index = 0; index < 16; ++index) {
    Scene scene = convex_with_walls(2, index);
    if (!loop_in(prepare_search(prepare(scene), Margin::none())).moves) continue;
    scene.goal->theta_is = ThetaMeaning::kNumber;
    *scene.goal->theta += (index % 2 == 0 ? 12.0 : -12.0) * kTurn;
    const Model model = prepare(scene);
    const SearchModel search = prepare_search(model, Margin::none());
    const auto moves = loop_in(search).moves;
    if (!moves) continue;
    ++wound;
    EXPECT_NEAR(moves->back().to.theta, *scene.goal->theta,
                scene.goal->angle_tolerance + 1e-9);
    for (const Move& move : *moves) {
      Work work{.budget = kBudget};
      EXPECT_TRUE(move_passes(search, move, work)) << index;
    }
  }
  EXPECT_GE(wound, 5);
}

/// Limits of the angle hold at both ends of every push.
TEST(LoopSearch, KeepsToLimitsOfTheAngle) {
  int walks = 0;
  for (std::uint64_t i = 0; i < 10; ++i) {
    const Model model = prepare(testing::box_with_angle_limits(i));
    const auto moves = loop_in(prepare_search(model, Margin::none())).moves;
    if (!moves) continue;
    ++walks;
    testing::expect_within_limits(model.scene, *moves);
  }
  EXPECT_GE(walks, 2);
}

TEST(LoopSearch, KeepsToItsBudget) {
  const Model model = prepare(convex_with_walls(1, 87));
  const SearchModel search = prepare_search(model, Margin::none());
  const Found found = loop_in(search, 1000);
  EXPECT_FALSE(found.moves);
  EXPECT_LT(found.work, 10'000);
}

}  // namespace
}  // namespace prehensile
