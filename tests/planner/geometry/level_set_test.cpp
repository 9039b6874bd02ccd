#include "planner/geometry/level_set.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene/outline.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

const std::vector<Vec2> kSquare = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

std::vector<double> values_of(const PlaceGrid& grid, const auto& f) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(grid.count()));
  for (int node = 0; node < grid.count(); ++node) values.push_back(f(grid.place(node)));
  return values;
}

TEST(PlaceGrid, CoversItsPolygonAndSomeNodesBeyond) {
  const PlaceGrid grid = PlaceGrid::over({{0.0, 0.0}, {0.3, 0.1}, {0.1, 0.2}}, 30);
  EXPECT_NEAR(grid.spacing, 0.01, 1e-12);
  const Vec2 low = grid.place(0);
  const Vec2 high = grid.place(grid.count() - 1);
  EXPECT_LE(low.maxCoeff(), -0.0199);
  EXPECT_GE(high.x(), 0.3199);
  EXPECT_GE(high.y(), 0.2199);
  for (int node = 0; node < grid.count(); node += 7) {
    EXPECT_EQ(grid.index(grid.column(node), grid.row(node)), node);
  }
}

TEST(LoopsBelow, OfADistanceIsACircle) {
  const PlaceGrid grid = PlaceGrid::over(kSquare, 60);
  const auto values = values_of(grid, [](const Vec2& p) { return p.norm(); });
  const Loops loops = loops_below(grid, values, 0.7, 1e-3);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_TRUE(is_simple(loops[0]));
  for (const Vec2& vertex : loops[0]) EXPECT_NEAR(vertex.norm(), 0.7, 2e-3);
  EXPECT_LT(loops[0].size(), 120u);
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p = random.in_box(1.0, 1.0);
    if (std::abs(p.norm() - 0.7) < 5e-3) continue;
    EXPECT_EQ(is_between(loops, p), p.norm() < 0.7);
  }
}

/// Around a ring there are two loops, and its hole is not between them.
TEST(LoopsBelow, KnowsHoles) {
  const PlaceGrid grid = PlaceGrid::over(kSquare, 60);
  const auto ring = [](const Vec2& p) { return std::abs(p.norm() - 0.6); };
  const Loops loops = loops_below(grid, values_of(grid, ring), 0.2, 1e-3);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_FALSE(is_between(loops, {0.0, 0.0}));
  EXPECT_TRUE(is_between(loops, {0.0, 0.6}));
  EXPECT_FALSE(is_between(loops, {0.9, 0.0}));
}

/// What is below the level up to the border of the grid is closed there.
TEST(LoopsBelow, AreClosedAtTheBorder) {
  const PlaceGrid grid = PlaceGrid::over(kSquare, 20);
  const auto values = values_of(grid, [](const Vec2& p) { return 1.0 + 0.1 * p.x(); });
  const Loops loops = loops_below(grid, values, 1.05, 1e-6);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_TRUE(is_between(loops, {-1.0, 0.9}));
  EXPECT_TRUE(is_between(loops, {0.45, 0.0}));
  EXPECT_FALSE(is_between(loops, {0.55, 0.0}));
  EXPECT_TRUE(loops_below(grid, values, 0.5, 1e-6).empty());
}

TEST(LoopsBelow, OfRandomFieldsNeitherCrossNorLieWrong) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const PlaceGrid grid = PlaceGrid::over(kSquare, 12);
    auto values = values_of(grid, [&](const Vec2&) { return random.in(0.0, 1.0); });
    const Loops loops = loops_below(grid, values, 0.5, 1e-9);
    for (const auto& loop : loops) EXPECT_TRUE(is_simple(loop));
    for (int node = 0; node < grid.count(); ++node) {
      const int c = grid.column(node);
      const int r = grid.row(node);
      if (c == 0 || r == 0 || c + 1 == grid.nx || r + 1 == grid.ny) continue;
      if (std::abs(values[node] - 0.5) < 1e-6) continue;
      EXPECT_EQ(is_between(loops, grid.place(node)), values[node] < 0.5);
    }
  }
}

TEST(PlaceGrid, InterpolatesBetweenItsNodes) {
  PlaceGrid grid{.low = {-1.0, 2.0}, .spacing = 0.5, .nx = 4, .ny = 3};
  const auto value = [](const Vec2& p) { return 3.0 * p.x() - p.y() + p.x() * p.y(); };
  const std::vector<double> values = values_of(grid, value);
  for (const Vec2& p : {Vec2(-1.0, 2.0), Vec2(-0.7, 2.9), Vec2(0.5, 3.0)}) {
    EXPECT_NEAR(grid.interpolated(values, p), value(p), 1e-12);
  }
  EXPECT_EQ(grid.interpolated(values, {9.0, 9.0}), value({0.5, 3.0}));
}

}  // namespace
}  // namespace prehensile
