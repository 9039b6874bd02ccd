#include "planner/geometry/inner_path.h"

#include <gtest/gtest.h>

#include "planner/geometry/segment.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

TEST(InnerPath, StaysInsideAndIsNoLongerThanADetour) {
  const std::vector<Vec2> outline = prepare(published_tee(0)).pad_face;
  Random random(1);
  int bent = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec2 p = random.in_box(0.05, 0.05);
    const Vec2 q = random.in_box(0.05, 0.05);
    if (!contains(outline, p) || !contains(outline, q)) {
      EXPECT_TRUE(inner_path(outline, p, q).empty());
      continue;
    }
    const std::vector<Vec2> path = inner_path(outline, p, q);
    ASSERT_GE(path.size(), 2u);
    EXPECT_EQ(path.front(), p);
    EXPECT_EQ(path.back(), q);
    for (std::size_t k = 1; k < path.size(); ++k) {
      EXPECT_TRUE(segment_inside(outline, path[k - 1], path[k]));
    }
    if (path.size() == 2) continue;
    ++bent;
    const Vec2 middle(-0.03, 0.0);  // where the bar meets the stem: seen from everywhere
    EXPECT_LE(path_length(path), (p - middle).norm() + (q - middle).norm() + 3e-3);
    EXPECT_GT(path_length(path), (p - q).norm());
  }
  EXPECT_GE(bent, 10);
}

TEST(InnerPath, IsCutIntoEqualSteps) {
  const std::vector<Vec2> path = {{0.0, 0.0}, {0.03, 0.0}, {0.03, 0.01}};
  const std::vector<Vec2> points = cut_path(path, 8);
  ASSERT_EQ(points.size(), 9u);
  for (std::size_t k = 1; k < points.size(); ++k) {
    EXPECT_NEAR((points[k] - points[k - 1]).norm(), 0.005, 1e-12);
  }
  EXPECT_EQ(cut_path(path, 1).size(), 3u);  // corners stay
  EXPECT_EQ(cut_path({{0.01, 0.0}, {0.01, 0.0}}, 5).size(), 6u);
}

}  // namespace
}  // namespace prehensile
