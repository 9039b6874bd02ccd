#include "planner/chains/scattered_push.h"

#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "planner/checks/replay.h"
#include "planner/search/plane_search.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A push that is there, and a goal that leaves some of its end free: a push is found,
/// and a plan of one placement that costs little more.
TEST(ScatteredPush, FindsAPushToAGoalThatLeavesThatMuchFree) {
  FixtureRange range;
  int found = 0, cheap = 0, problems = 0;
  for (const FixturePushers pushers : {FixturePushers::kPoints, FixturePushers::kLines}) {
    range.pushers = pushers;
    for (std::uint64_t i = 0; i < 300; ++i) {
      const auto problem = random_fixture(range, 5, i);
      if (!problem || problem->pushes.size() != 1) continue;
      Scene scene = problem->scene;
      Goal& goal = *scene.goal;
      if (i % 3 == 0) goal.theta.reset();
      if (i % 3 == 1) goal.x.reset();
      if (i % 3 == 2) goal.y.reset();
      ++problems;
      const Model model = prepare(scene);
      const SearchModel search = prepare_search(model, Margin::none());
      const FlatState from = flat_state(scene.start);
      Work work{.budget = 1'000'000};
      const auto move = scattered_push(search, from, goal, kInfinity, work);
      if (!move) continue;
      ++found;
      EXPECT_TRUE(reaches(goal, grasp_of(move->to, 0.0))) << i;
      const double way = flat_distance(model, move->from, move->to);
      EXPECT_FALSE(scattered_push(search, from, goal, 0.9 * way, work)) << i;
      const Plan plan = plan_regrasp(model, {.margin = Margin::none()});
      ASSERT_TRUE(plan.usable()) << i;
      EXPECT_TRUE(replay(model, plan).agrees) << i;
      cheap += plan.cost <= 1.02 * (1.0 + way / model.L);
    }
  }
  std::printf("a push found to %d of %d goals, plans as cheap to %d\n", found, problems,
              cheap);
  EXPECT_GT(problems, 40);
  EXPECT_GT(found, 0.9 * problems);
  EXPECT_GT(cheap, 0.9 * problems);
}

TEST(ScatteredPush, LeavesGoalsThatFixAllAlone) {
  const Model model = prepare(published_tee(3));
  const SearchModel search = prepare_search(model, Margin::none());
  Work work{.budget = 1'000'000};
  EXPECT_FALSE(scattered_push(search, flat_state(model.scene.start), *model.scene.goal,
                              kInfinity, work));
  EXPECT_EQ(work.stick_tests, 0);
}

/// Thirteen angles of a free one are too few where a point has little friction.
TEST(ScatteredPush, FindsTheAngleThatASlipperyPointTurnsTo) {
  Scene scene;
  scene.object.shape = BoxShape{Vec3(0.10, 0.06, 0.03)};
  scene.object.mass = 0.1;
  scene.gripper.pad = DiscPad{0.006};
  scene.gripper.friction = {0.9, 0.9};
  scene.gripper.grip_force = 45.0;
  scene.pushers = {Pusher{.name = "pin", .feature = PointFeature{}, .friction = 0.2}};
  scene.goal = Goal{.x = 0.005, .y = -0.025};
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model);
  ASSERT_TRUE(plan.usable()) << plan.message;
  EXPECT_EQ(plan.promise, Promise::kMargin);
  EXPECT_LT(plan.cost, 1.3);
  EXPECT_TRUE(replay(model, plan).agrees);
}

}  // namespace
}  // namespace prehensile
