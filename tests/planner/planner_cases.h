/// Scenes and searches that several planner tests share.
#pragma once

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "planner/chain_search.h"
#include "planner/costs.h"
#include "planner/planner.h"
#include "planner/push_search.h"
#include "planner/steering.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"
#include "problems/random_regrasps.h"

namespace prehensile::testing {

inline constexpr std::int64_t kNoBudget = std::numeric_limits<std::int64_t>::max();

/// A published square, whose goal a test may replace.
inline Scene walled_square() {
  Scene scene = published_square(0);
  scene.start.X_HO = pose_from_finger({0.01, 0.002}, 0.1);
  return scene;
}

/// A goal at this place of the finger axis in the object and this angle of the object.
inline Goal goal_at(const Vec2& p_OF, double theta) {
  const PlanarPose X_HO = pose_from_finger(p_OF, theta);
  Goal goal;
  goal.x = X_HO.x;
  goal.y = X_HO.y;
  goal.theta = X_HO.theta;
  return goal;
}

/// A random polygon with so many walls beside it, and a goal anywhere.
inline Scene convex_with_walls(int walls, std::uint64_t index) {
  const FixtureRange range{.object = FixtureObject::kConvex,
                           .count = {1.0 * walls, 1.0 * walls},
                           .goals = GoalsFrom::kRandom};
  return random_fixture(range, 1, index)->scene;
}

/// A box with a goal anywhere, and limits on its angle 0.3 rad beyond start and goal.
inline Scene box_with_angle_limits(std::uint64_t index) {
  const FixtureRange range{.object = FixtureObject::kBox, .goals = GoalsFrom::kRandom};
  Scene scene = random_fixture(range, 1, index)->scene;
  const double start = scene.start.X_HO.theta;
  const double turn = wrapped(*scene.goal->theta - start);
  scene.limits = GraspLimits{.theta_low = start + std::min(turn, 0.0) - 0.3,
                             .theta_high = start + std::max(turn, 0.0) + 0.3};
  return scene;
}

/// The plan that the first stages find, of two and more pushes unless one is enough,
/// without a look for anything cheaper; without pushes if they find none.
inline Plan plan_of_first_stages(const SearchModel& search, const Limits& limits,
                                 Work& work) {
  const Scene& scene = search.model->scene;
  Plan plan = blank_plan(search, scene.start, {});
  const FlatState start = flat_state(scene.start);
  const GoalPlaces goals = goal_places(*search.model, *scene.goal, start);
  const auto found = search_chains(search, start, goals, 0.0, limits, work);
  if (found) append_chain(search, start, found->chain, plan);
  account(*search.model, plan);
  return plan;
}

/// Expects that every move ends within the limits of the angle.
inline void expect_within_limits(const Scene& scene, const std::vector<Move>& moves) {
  for (const Move& move : moves) {
    EXPECT_GE(move.to.theta, *scene.limits->theta_low - 1e-8);
    EXPECT_LE(move.to.theta, *scene.limits->theta_high + 1e-8);
  }
}

/// Prints median, 99th percentile and worst of times in seconds.
inline void print_times(const std::string& what, std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  const std::size_t n = seconds.size();
  std::printf("%s: %zu runs, median %.1f us, p99 %.1f us, worst %.1f us\n", what.c_str(),
              n, 1e6 * seconds[n / 2], 1e6 * seconds[std::min(n - 1, n * 99 / 100)],
              1e6 * seconds[n - 1]);
}

}  // namespace prehensile::testing
