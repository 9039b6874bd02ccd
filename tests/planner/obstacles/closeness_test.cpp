#include "planner/obstacles/closeness.h"

#include <gtest/gtest.h>

#include "planner/obstacles/obstacle_bodies.h"
#include "tests/planner/random_bodies.h"

namespace prehensile {
namespace {

using testing::any_body;
using testing::any_body_shape;
using testing::Random;

Vec3 random_point(Random& random, double half) {
  return {random.in(-half, half), random.in(-half, half), random.in(-half, half)};
}

/// No point of a body is nearer to another than the one that is said to be nearest, and
/// that one is of the body.
TEST(Closeness, TheNearestPointIsOfTheBodyAndNearest) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const BodyShape shape = any_body_shape(random);
    const Vec3 p = random_point(random, 0.15);
    const Vec3 nearest = nearest_point(shape, p);
    const double distance = signed_distance(shape, p);
    EXPECT_LE(signed_distance(shape, nearest), 1e-12) << i;
    EXPECT_NEAR((p - nearest).norm(), std::max(0.0, distance), 1e-12) << i;
    for (int k = 0; k < 50; ++k) {
      const Vec3 other = nearest_point(shape, random_point(random, 0.15));
      EXPECT_GE((p - other).norm(), distance - 1e-12) << i;
    }
  }
}

/// Inside, the ball of that radius lies in the body, and no larger one does.
TEST(Closeness, TheDepthInsideIsThatOfTheLargestBall) {
  Random random(2);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const BodyShape shape = any_body_shape(random);
    const Vec3 p = random_point(random, 0.04);
    const double depth = -signed_distance(shape, p);
    if (depth <= 0.0) continue;
    ++inside;
    double least = 1.0;
    for (int k = 0; k < 200; ++k) {
      const Vec3 d = random_point(random, 1.0).normalized();
      EXPECT_LE(signed_distance(shape, p + 0.999 * depth * d), 0.0) << i;
      double low = 0.0;
      double high = 0.2;
      for (int step = 0; step < 30; ++step) {
        const double middle = 0.5 * (low + high);
        (signed_distance(shape, p + middle * d) < 0.0 ? low : high) = middle;
      }
      least = std::min(least, low);
    }
    EXPECT_GE(least, depth - 1e-6) << i;
    EXPECT_LE(least, 1.3 * depth + 2e-3) << i;
  }
  EXPECT_GT(inside, 300);
}

/// Two independent ways: the bound from above is never below that from below, and where
/// the bodies are apart nearly meets it.
TEST(Closeness, IsNotBelowTheSeparation) {
  Random random(3);
  int apart = 0;
  int met = 0;
  int overlapping = 0;
  int seen_to_overlap = 0;
  for (int i = 0; i < 2000; ++i) {
    const ConvexBody a = any_body(random);
    const ConvexBody b = any_body(random);
    const PlacedBody first{&a, pose_of(a)};
    const PlacedBody second{&b, pose_of(b)};
    const double below = separation(first, second);
    const double above = closeness(first, second);
    EXPECT_GE(above, below - 1e-9) << i;
    if (below > 1e-4) {
      ++apart;
      met += above < below + 1e-3;
    } else if (below < -2e-3) {
      ++overlapping;
      seen_to_overlap += above < 0.0;
    }
  }
  EXPECT_GT(apart, 500);
  EXPECT_GT(met, apart * 99 / 100);
  EXPECT_GT(overlapping, 200);
  EXPECT_GT(seen_to_overlap, overlapping * 9 / 10);
  std::printf("apart: %d of %d within 1 mm; overlapping: %d of %d\n", met, apart,
              seen_to_overlap, overlapping);
}

TEST(Closeness, OfATable) {
  const ConvexBody table{.name = "table", .shape = HalfSpaceShape{Vec3(0.0, 0.6, 0.8)}};
  const ConvexBody cube{.name = "cube", .shape = BoxShape{{0.2, 0.2, 0.2}}};
  for (const double height : {0.5, 0.1, -0.3}) {
    Eigen::Isometry3d X_W = Eigen::Isometry3d::Identity();
    X_W.translation() = height * Vec3(0.0, 0.6, 0.8);
    EXPECT_NEAR(closeness({&cube, X_W}, {&table, pose_of(table)}), height - 0.14, 1e-9);
  }
}

}  // namespace
}  // namespace prehensile
