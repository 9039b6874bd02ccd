#include "planner/proofs/traced_regions.h"

#include <cmath>

#include <gtest/gtest.h>

#include "problems/published_regrasps.h"
#include "scene/constants.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

Model at_the_middle() {
  Scene scene = published_square(0);
  scene.start.X_HO = {0.0, 0.0, 0.0};
  return prepare(scene);
}

/// Directions within `half` of one that turns from place to place.
auto bent(double half) {
  return [=](const Vec2& place) {
    const double middle = 0.3 + 20.0 * place.x() - 35.0 * place.y();
    return FreeDirections::where(
        [=](double direction) { return std::cos(direction - middle) >= std::cos(half); });
  };
}

GoalSample goal_around(const Vec2& place) {
  GoalSample goal{{place}, {}};
  for (int k = 0; k < 24; ++k) {
    goal.border.push_back(place + 1e-3 * towards(2.0 * kPi * k / 24));
  }
  return goal;
}

/// The greatest angle by which a free direction leads out across a border, which has to
/// be on the object somewhere.
double worst_crossing(const Model& model, const FreeAt& free_at, const Loops& region) {
  double worst = -kPi;
  const std::vector<Vec2>& loop = region[0];
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2& a = loop[i];
    const Vec2& b = loop[(i + 1) % loop.size()];
    const Vec2 middle = 0.5 * (a + b);
    if (depth_inside(model.pad_face, middle) < 1e-3) continue;
    Vec2 out = perp((b - a).normalized());
    if (is_between(region, middle + 1e-6 * out)) out = -out;
    const double off = free_at(middle).distance(angle_of(out));
    worst = std::max(worst, 0.5 * kPi - off);
  }
  return worst;
}

TEST(TracedRegions, NoFreeDirectionLeadsOut) {
  const Model model = at_the_middle();
  int found = 0;
  for (const double half : {0.4, 1.0, 1.4}) {
    for (const Vec2& middle : {Vec2(-0.01, 0.004), Vec2(-0.006, -0.012)}) {
      const GoalSample goal = goal_around(middle);
      for (const Loops& region : traced_regions(model, goal, bent(half), 30)) {
        ++found;
        EXPECT_TRUE(is_between(region, {0.0, 0.0}));
        for (const Vec2& place : goal.border) EXPECT_FALSE(is_between(region, place));
        const double across = worst_crossing(model, bent(half), region);
        EXPECT_GT(across, -kPi) << "beside the object";
        EXPECT_LT(across, 0.03) << half;
      }
    }
  }
  EXPECT_GE(found, 30);
}

TEST(TracedRegions, AreNoneWhereWaysLeadEverywhereOrToTheGoal) {
  const Model model = at_the_middle();
  EXPECT_TRUE(traced_regions(model, goal_around({-0.01, 0.0}), bent(1.8), 5).empty());
  EXPECT_TRUE(traced_regions(model, goal_around({0.012, 0.004}), bent(0.5), 5).empty());
}

TEST(TracedRegions, AreNoMoreThanWantedAndEndWhenStopped) {
  const Model model = at_the_middle();
  const GoalSample goal = goal_around({-0.01, 0.0});
  EXPECT_EQ(traced_regions(model, goal, bent(0.8), 3).size(), 3u);
  const auto stopped = [] { return true; };
  EXPECT_TRUE(traced_regions(model, goal, bent(0.8), 3, stopped).empty());
}

}  // namespace
}  // namespace prehensile
