#include "scene/near_outline.h"

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
        near(outline, centre, radius) {}
  std::vector<Vec2> outline;
  Vec2 centre;
  double radius;
  NearOutline near;
};

/// Depths that are less than what may be missed are those of the whole outline.
TEST(NearOutline, KnowsTheDepthWhereItIsSmall) {
  Random random(1);
  int small = 0;
  for (int i = 0; i < 300; ++i) {
    const Case made(60, random);
    const auto& [outline, centre, radius, near] = made;
    for (int k = 0; k < 50; ++k) {
      const double within = random.in(0.0, radius);
      const Vec2 p = centre + random.in_disc(within);
      const double reach = within - (p - centre).norm();
      const double depth = depth_inside(outline, p);
      const double found = near.depth_at(p, within);
      EXPECT_EQ(found > 0.0, depth > 0.0) << i;
      if (std::abs(depth) < reach) {
        EXPECT_EQ(found, depth) << i;
        ++small;
      } else {
        EXPECT_GE(std::abs(found), std::abs(depth)) << i;
      }
    }
  }
  EXPECT_GT(small, 1000);
}

TEST(NearOutline, KnowsTheOnlyEdgeThatIsClose) {
  Random random(2);
  int only = 0;
  for (int i = 0; i < 300; ++i) {
    const Case made(20, random);
    const auto& [outline, centre, radius, near] = made;
    for (int k = 0; k < 50; ++k) {
      const Vec2 p = centre + random.in_disc(0.5 * radius);
      const double distance = random.in(0.0, 0.5 * radius);
      std::vector<std::size_t> close;
      for (std::size_t j = 0; j < outline.size(); ++j) {
        const Vec2& b = outline[(j + 1) % outline.size()];
        if (squared_distance_to_segment(p, outline[j], b) < distance * distance) {
          close.push_back(j);
        }
      }
      const NearOutline::Edge* const edge = near.only_edge_at(p, distance, radius);
      ASSERT_EQ(edge != nullptr, close.size() == 1) << i;
      if (!edge) continue;
      ++only;
      EXPECT_EQ(edge->a, outline[close[0]]);
    }
  }
  EXPECT_GT(only, 500);
}

}  // namespace
}  // namespace prehensile
