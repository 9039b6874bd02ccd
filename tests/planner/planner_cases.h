/// Scenes and searches that several planner tests share.
#pragma once

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "planner/chains/chain_search.h"
#include "planner/costs.h"
#include "planner/planner.h"
#include "planner/search/push_search.h"
#include "planner/steering/draft.h"
#include "planner/steering/steering.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"
#include "problems/random_regrasps.h"
#include "scene/constants.h"
#include "tests/planner/no_budget.h"

namespace prehensile::testing {

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

/// A square bar on a sheet, held above its middle by low pads.
inline Scene bar_on_sheet() {
  Scene scene;
  scene.object.shape =
      PrismShape{{{-0.015, -0.015}, {0.015, -0.015}, {0.015, 0.015}, {-0.015, 0.015}},
                 0.1,
                 Axis::kX};
  scene.object.mass = 0.25;
  scene.gripper.pad = RectanglePad{{0.03, 0.002}};
  scene.gripper.friction = {0.05, 0.05};
  scene.gripper.grip_force = 60.0;
  scene.pushers = {{.name = "sheet",
                    .feature = PlaneFeature{},
                    .friction = 1.2,
                    .normal_angle = 0.5 * kPi,
                    .faces = {"-y"}}};
  scene.start.X_HO = {0.0, -0.011, 0.0};
  return scene;
}

/// Among walls at its ends, with a goal on its next side.
inline Scene bar_among_walls() {
  Scene scene = bar_on_sheet();
  for (const double angle : {0.0, kPi}) {
    scene.pushers.push_back({.name = "wall" + std::to_string(scene.pushers.size()),
                             .feature = PlaneFeature{},
                             .friction = 0.9,
                             .normal_angle = angle});
  }
  scene.goal = goal_at({-0.01, 0.008}, 0.0);
  scene.goal->psi = 0.5 * kPi;
  return scene;
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

/// As the ellipsoid steers with this margin.
inline SearchModel search_over_ellipsoid(const Model& model, const Margin& margin) {
  const SearchModel search = prepare_search(model, margin);
  return over_ellipsoid(search).value_or(search);
}

}  // namespace prehensile::testing
