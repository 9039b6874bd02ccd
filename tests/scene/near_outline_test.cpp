#include "scene/near_outline.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "scene/outline.h"
#include "scene/segment_distance.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// About the origin, between 0.02 and 0.06 m from it.
std::vector<Vec2> random_star(int vertices, Random& random) {
  std::vector<Vec2> outline;
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + random.in(0.1, 0.9)) / vertices;
    outline.push_back(rotated(angle, {random.in(0.02, 0.06), 0.0}));
  }
  return outline;
}

struct Case {
  explicit Case(int most_vertices, Random& random)
      : outline(random_star(3 + random.below(most_vertices), random)),
        centre(random.in_box(0.07, 0.07)),
        radius(random.log_in(1e-3, 0.05)),
        near(outline, is_convex(outline), centre, radius) {}
  std::vector<Vec2> outline;
  Vec2 centre;
  double radius;
  NearOutline near;
};

TEST(NearOutline, KnowsTheEdgesThatAreClose) {
  Random random(2);
  int only = 0, more = 0, many = 0, inside = 0, outside = 0;
  for (int i = 0; i < 1500; ++i) {
    const Case made(i % 2 == 0 ? 20 : 60, random);
    const auto& [outline, centre, radius, near] = made;
    for (int k = 0; k < 50; ++k) {
      const double within = random.in(0.0, radius);
      const Vec2 p = centre + random.in_disc(within);
      const double distance = random.in(0.0, within - (p - centre).norm());
      std::vector<std::size_t> close;
      for (std::size_t j = 0; j < outline.size(); ++j) {
        const Vec2& b = outline[(j + 1) % outline.size()];
        if (squared_distance_to_segment(p, outline[j], b) < distance * distance) {
          close.push_back(j);
        }
      }
      const NearOutline::Close found = near.close_to(p, distance, within);
      ASSERT_EQ(found.count == 0, close.empty()) << i;
      if (found.count == 0 && distance > 1e-9) {
        ASSERT_EQ(found.inside, is_inside(outline, p)) << i;
        (found.inside ? inside : outside) += 1;
      }
      ASSERT_LE(found.count, 3);
      if (found.count == 3 && close.size() < 3) {
        ++many;  // edges near the centre, so that all of them count as close or not
        continue;
      }
      ASSERT_EQ(found.count, std::min<std::size_t>(close.size(), 3)) << i;
      if (found.count == 0) continue;
      (found.count == 1 ? only : more) += 1;
      if (found.count == 3) continue;
      const auto is_close = [&](const NearOutline::Edge& edge) {
        return std::ranges::any_of(close,
                                   [&](std::size_t j) { return outline[j] == edge.a; });
      };
      EXPECT_TRUE(is_close(*found.one));
      if (found.count == 2) {
        EXPECT_TRUE(is_close(*found.two) && found.one != found.two);
      }
    }
  }
  EXPECT_GT(only, 1000);
  EXPECT_GT(more, 1000);
  EXPECT_LT(many, only);
  EXPECT_GT(inside, 1000);
  EXPECT_GT(outside, 1000);
}

}  // namespace
}  // namespace prehensile
