#include "planner/point_tree.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "planner/random_stream.h"

namespace prehensile {
namespace {

Vec3 drawn(RandomStream& random) {
  return {random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-0.1, 0.1)};
}

TEST(PointTree, IsEmptyAtFirst) {
  const PointTree tree;
  EXPECT_EQ(tree.nearest(Vec3::Zero()), -1);
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
    ASSERT_EQ(distance(tree.nearest(query)), least);
    if (i % 50 != 0) continue;
    std::vector<int> expected, found;
    for (int k = 0; k <= i; ++k) {
      if (distance(k) <= 0.3) expected.push_back(k);
    }
    tree.within(query, 0.3, found);
    std::ranges::sort(found);
    EXPECT_EQ(found, expected);
  }
  EXPECT_EQ(tree.size(), 2000);
}

}  // namespace
}  // namespace prehensile
