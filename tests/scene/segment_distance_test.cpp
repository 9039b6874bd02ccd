#include "scene/segment_distance.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// No point of the segment is nearer, and one of many is about as near.
TEST(SegmentDistance, IsThatOfTheNearestPoint) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Vec2 p = random.in_box(1.0, 1.0);
    const Vec2 a = random.in_box(1.0, 1.0);
    const Vec2 b = i % 10 == 0 ? a : random.in_box(1.0, 1.0);
    const double distance = std::sqrt(squared_distance_to_segment(p, a, b));
    double nearest = (p - a).norm();
    for (int k = 1; k <= 1000; ++k) {
      nearest = std::min(nearest, (p - a - k / 1000.0 * (b - a)).norm());
    }
    const double share = nearest_share(p, a, b);
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
    EXPECT_NEAR((p - a - share * (b - a)).norm(), distance, 1e-12) << i;
    EXPECT_LE(distance, nearest + 1e-12) << i;
    EXPECT_GE(distance, nearest - 1e-3) << i;
  }
}

}  // namespace
}  // namespace prehensile
