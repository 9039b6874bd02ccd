#include "planner/baselines/point_tree.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "planner/baselines/random_stream.h"

namespace prehensile {
namespace {

int nearest(const PointTree& tree, const Vec3& to) {
  Work work;
  return tree.nearest(to, work);
}

Vec3 drawn(RandomStream& random) {
  return {random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-0.1, 0.1)};
}

TEST(PointTree, IsEmptyAtFirst) {
  const PointTree tree;
  EXPECT_EQ(nearest(tree, Vec3::Zero()), -1);
  std::vector<int> found = {1};
  tree.within(Vec3::Zero(), 10.0, found);
  EXPECT_TRUE(found.empty());
}

TEST(PointTree, AgreesWithLookingAtAllPoints) {
  RandomStream random(3);
  PointTree tree;
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) {
    const bool again = i > 0 && random.chance(0.05);  // equal points occur
    points.push_back(again ? points[random.below(i)] : drawn(random));
    tree.add(points.back());
    const Vec3 query = drawn(random);
    const auto distance = [&](int index) { return (points[index] - query).norm(); };
    double least = distance(0);
    for (int k = 1; k <= i; ++k) least = std::min(least, distance(k));
    ASSERT_EQ(distance(nearest(tree, query)), least);
    if (i % 50 != 0) continue;
    std::vector<int> expected, found;
    for (int k = 0; k <= i; ++k) {
      if (distance(k) <= 0.3) expected.push_back(k);
    }
    tree.within(query, 0.3, found);
    EXPECT_EQ(found, expected);
  }
  EXPECT_EQ(tree.size(), 2000);
}

TEST(PointTree, FindsTheFirstOfEqualPoints) {
  PointTree tree;
  for (int i = 0; i < 100; ++i) tree.add(Vec3(i % 2, 0.0, 0.0));
  EXPECT_EQ(nearest(tree, Vec3(-1.0, 0.0, 0.0)), 0);
  EXPECT_EQ(nearest(tree, Vec3(2.0, 0.0, 0.0)), 1);
}

/// Without balance, or by the sides of its cuts alone, a tree looks at all points of a
/// row when it is asked from afar.
TEST(PointTree, LooksAtFewPointsOfRowsFromAfar) {
  RandomStream random(5);
  PointTree tree;
  Work work;
  constexpr int kPoints = 100'000;
  for (int i = 0; i < kPoints; ++i) {
    const double along = 1e-7 * i;
    tree.add(Vec3(along, 0.5 * along, 1e-5 * random.in(0.0, 1.0)));
    ASSERT_EQ(tree.nearest(Vec3(3.0, 1.5, 0.0), work), i);
  }
  EXPECT_GT(work.other, kPoints / 2);
  EXPECT_LT(work.other, 3 * kPoints);
  EXPECT_EQ(nearest(tree, Vec3(-1.0, 0.0, 0.0)), 0);
}

}  // namespace
}  // namespace prehensile
