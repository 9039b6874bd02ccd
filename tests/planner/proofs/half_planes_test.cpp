#include "planner/proofs/half_planes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "problems/published_regrasps.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Directions within `half` of an angle.
auto around(double angle, double half) {
  return [=](const Vec2& /*place*/) {
    return FreeDirections::where(
        [=](double direction) { return std::cos(direction - angle) >= std::cos(half); });
  };
}

Model at_the_middle() {
  Scene scene = published_square(0);
  scene.start.X_HO = {0.0, 0.0, 0.0};
  return prepare(scene);
}

TEST(HalfPlanes, HoldTheStartAndNotTheGoal) {
  const Model model = at_the_middle();
  const std::vector<Vec2> goals = {{-0.01, 0.004}, {-0.008, -0.003}};
  const auto regions = half_planes(model, goals, around(0.0, 1.2), 5);
  ASSERT_EQ(regions.size(), 5u);
  for (const Loops& region : regions) {
    EXPECT_TRUE(is_between(region, {0.0, 0.0}));
    for (const Vec2& goal : goals) EXPECT_FALSE(is_between(region, goal));
  }
  // All ways lead along +x, by up to 1.2 rad aside: straight across is the safest.
  const Vec2 along = (regions[0][0][1] - regions[0][0][0]).normalized();
  EXPECT_NEAR(std::abs(along.y()), 1.0, 1e-9);
}

TEST(HalfPlanes, AreNoneWhereWaysLeadEverywhereOrToTheGoal) {
  const Model model = at_the_middle();
  EXPECT_TRUE(half_planes(model, {{-0.01, 0.0}}, around(0.0, 0.6 * kPi), 5).empty());
  EXPECT_TRUE(half_planes(model, {{0.01, 0.0}}, around(0.0, 0.3), 5).empty());
  EXPECT_TRUE(half_planes(model, {{0.0, 0.0}}, around(0.0, 0.3), 5).empty());
}

TEST(HalfPlanes, AreNoMoreThanWanted) {
  const Model model = at_the_middle();
  EXPECT_EQ(half_planes(model, {{-0.01, 0.0}}, around(0.0, 1.0), 2).size(), 2u);
}

}  // namespace
}  // namespace prehensile
