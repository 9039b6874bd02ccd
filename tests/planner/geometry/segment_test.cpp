#include "planner/geometry/segment.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "scene/outline.h"
#include "tests/support/no_heap.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// T: bar at the left, stem to the right.
std::vector<Vec2> tee() {
  return {{-0.05, -0.05}, {-0.02, -0.05}, {-0.02, -0.015}, {0.05, -0.015},
          {0.05, 0.015},  {-0.02, 0.015}, {-0.02, 0.05},   {-0.05, 0.05}};
}

/// Star-shaped polygon with deep notches.
std::vector<Vec2> star(Random& random) {
  const int count = 5 + random.below(20);
  std::vector<Vec2> outline;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + random.in(0.1, 0.9)) / count;
    outline.push_back(rotated(angle, {random.in(0.01, 0.06), 0.0}));
  }
  return outline;
}

/// Least depth of the segment's points; their spacing is `step`.
double sampled_depth(const std::vector<Vec2>& outline, const Vec2& p, const Vec2& q,
                     double& step) {
  const int count = 400;
  step = (q - p).norm() / count;
  double least = 1.0;
  for (int i = 0; i <= count; ++i) {
    least = std::min(least, depth_inside(outline, p + (q - p) * (1.0 * i / count)));
  }
  return least;
}

TEST(Segment, AgreesWithSamplesOnRandomOutlines) {
  Random random(1);
  int inside = 0;
  int decided = 0;
  for (int i = 0; i < 400; ++i) {
    const std::vector<Vec2> outline = star(random);
    for (int k = 0; k < 50; ++k) {
      const Vec2 p = random.in_disc(0.05);
      const Vec2 q = p + random.in_disc(0.05);
      double step = 0.0;
      const double depth = sampled_depth(outline, p, q, step);
      const bool answer = segment_inside(outline, p, q);
      EXPECT_EQ(answer, segment_inside(outline, q, p));
      if (depth < -1e-9) {
        EXPECT_FALSE(answer);
        ++decided;
      }
      if (depth > step) {
        EXPECT_TRUE(answer);
        EXPECT_NEAR(distance_to_border(outline, p, q), depth, step);
        ++decided;
        ++inside;
      }
    }
  }
  EXPECT_GT(decided, 15'000);
  EXPECT_GT(inside, 500);
}

TEST(Segment, FindsSliversOutside) {
  // A notch one micrometre wide, as deep as the object.
  const std::vector<Vec2> outline = {{-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.05},
                                     {5e-7, 0.05},   {0.0, -0.04},  {-5e-7, 0.05},
                                     {-0.05, 0.05}};
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p(random.in(-0.05, -1e-3), random.in(-0.03, 0.05));
    const Vec2 q(random.in(1e-3, 0.05), random.in(-0.03, 0.05));
    EXPECT_FALSE(segment_inside(outline, p, q));
    const Vec2 below(q.x(), -0.041);
    EXPECT_TRUE(segment_inside(outline, {p.x(), -0.041}, below));
  }
}

TEST(Segment, BorderAndReflexVerticesBelongToTheObject) {
  const std::vector<Vec2> outline = tee();
  EXPECT_TRUE(segment_inside(outline, {-0.05, -0.05}, {-0.05, 0.05}));  // along an edge
  EXPECT_TRUE(segment_inside(outline, {-0.03, 0.015}, {0.05, 0.015}));  // along the stem
  EXPECT_TRUE(
      segment_inside(outline, {-0.035, 0.0225}, {-0.005, 0.0075}));  // by the corner
  EXPECT_TRUE(segment_inside(outline, {-0.02, 0.0}, {-0.02, 0.0}));  // a point
  EXPECT_FALSE(
      segment_inside(outline, {-0.02, 0.05}, {0.05, 0.015}));  // across the notch
  EXPECT_FALSE(segment_inside(outline, {-0.02, 0.04}, {0.02, 0.015}));
  EXPECT_FALSE(segment_inside(outline, {-0.035, 0.0235}, {-0.005, 0.0085}));
  EXPECT_FALSE(segment_inside(outline, {0.0, 0.02}, {0.0, 0.02}));
  EXPECT_FALSE(segment_inside(outline, {0.0, 0.0}, {0.06, 0.0}));
  EXPECT_FALSE(segment_inside(outline, {-0.03, -0.04}, {-0.03, 0.06}));
}

TEST(Segment, NeedsNoHeap) {
  const std::vector<Vec2> outline = tee();
  const testing::NoHeapScope scope;
  const bool inside = segment_inside(outline, {-0.04, 0.04}, {-0.04, -0.04});
  const double distance = distance_to_border(outline, {-0.04, 0.0}, {0.0, 0.0});
  const long allocations = scope.allocations();
  EXPECT_LE(allocations, 0);
  EXPECT_TRUE(inside);
  EXPECT_NEAR(distance, 0.01, 1e-12);
}

/// Of the part of the polygon between two lines: no point of it is outside, and some are
/// on its ends.
TEST(Segment, ExtentsHoldThePolygon) {
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const std::vector<Vec2> outline = star(random);
    const Vec2 along = random.direction();
    const double low = random.in(-0.06, 0.06);
    const double high = low + random.log_in(1e-4, 0.05);
    const Extent extent = extent_across(outline, along, perp(along), low, high);
    double least = 1.0, most = -1.0;
    for (int k = 0; k < 2000; ++k) {
      const Vec2 p = random.in(low, high) * along + random.in(-0.06, 0.06) * perp(along);
      if (!contains(outline, p)) continue;
      least = std::min(least, perp(along).dot(p));
      most = std::max(most, perp(along).dot(p));
    }
    if (least > most) continue;
    EXPECT_LE(extent.low, least);
    EXPECT_GE(extent.high, most);
    EXPECT_NEAR(extent.low, least, 0.01);
    EXPECT_NEAR(extent.high, most, 0.01);
  }
  const Extent bar = extent_across(tee(), {1.0, 0.0}, {0.0, 1.0}, -0.04, -0.03);
  EXPECT_DOUBLE_EQ(bar.low, -0.05);
  EXPECT_DOUBLE_EQ(bar.high, 0.05);
  const Extent stem = extent_across(tee(), {1.0, 0.0}, {0.0, 1.0}, 0.0, 0.01);
  EXPECT_DOUBLE_EQ(stem.low, -0.015);
  EXPECT_DOUBLE_EQ(stem.high, 0.015);
  const Extent none = extent_across(tee(), {1.0, 0.0}, {0.0, 1.0}, 0.06, 0.07);
  EXPECT_GT(none.low, none.high);
}

}  // namespace
}  // namespace prehensile
