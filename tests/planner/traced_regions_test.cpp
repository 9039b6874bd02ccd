#include "planner/traced_regions.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "problems/published_regrasps.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kPi = std::numbers::pi;

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

TracedProblem problem_of(FreeAt free_at, const Vec2& goal) {
  TracedProblem problem{std::move(free_at), {goal}, {}, {}};
  for (int k = 0; k < 24; ++k) {
    problem.border.push_back(goal + 1e-3 * towards(2.0 * kPi * k / 24));
  }
  return problem;
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
    for (const Vec2& goal : {Vec2(-0.01, 0.004), Vec2(-0.006, -0.012)}) {
      const TracedProblem problem = problem_of(bent(half), goal);
      for (const Loops& region : traced_regions(model, problem, 30)) {
        ++found;
        EXPECT_TRUE(is_between(region, {0.0, 0.0}));
        for (const Vec2& place : problem.border) EXPECT_FALSE(is_between(region, place));
        const double across = worst_crossing(model, problem.free_at, region);
        EXPECT_GT(across, -kPi) << "beside the object";
        EXPECT_LT(across, 0.03) << half;
      }
    }
  }
  EXPECT_GE(found, 30);
}

TEST(TracedRegions, AreNoneWhereWaysLeadEverywhereOrToTheGoal) {
  const Model model = at_the_middle();
  EXPECT_TRUE(traced_regions(model, problem_of(bent(1.8), {-0.01, 0.0}), 5).empty());
  EXPECT_TRUE(traced_regions(model, problem_of(bent(0.5), {0.012, 0.004}), 5).empty());
}

TEST(TracedRegions, AreNoMoreThanWantedAndEndWhenStopped) {
  const Model model = at_the_middle();
  TracedProblem problem = problem_of(bent(0.8), {-0.01, 0.0});
  EXPECT_EQ(traced_regions(model, problem, 3).size(), 3u);
  problem.stopped = [] { return true; };
  EXPECT_TRUE(traced_regions(model, problem, 3).empty());
}

}  // namespace
}  // namespace prehensile
