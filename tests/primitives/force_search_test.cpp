/// The search for the run of grip forces that do.
#include "primitives/force_search.h"

#include <gtest/gtest.h>

namespace prehensile {
namespace {

TEST(ForceGrid, RunsFromTheLeastToTheGreatestThroughTheSceneOwn) {
  const ForceGrid grid(30.0, 1e-3, 1e4);
  EXPECT_EQ(grid.at(0), 30.0);
  EXPECT_EQ(grid.at(grid.first()), 1e-3);
  EXPECT_EQ(grid.at(grid.last()), 1e4);
  for (int i = grid.first(); i < grid.last(); ++i) EXPECT_LT(grid.at(i), grid.at(i + 1));
}

TEST(ForceGrid, AForceBeyondTheLimitsIsTakenAtThem) {
  const ForceGrid grid(1e6, 1.0, 100.0);
  EXPECT_EQ(grid.at(0), 100.0);
  EXPECT_EQ(grid.last(), 0);
}

TEST(RunOfForces, IsTheOneAroundTheSceneOwnOrNearest) {
  const ForceGrid grid(10.0, 0.1, 1000.0);
  const auto does = [](double force) {
    return (force > 2.0 && force < 50.0) || force > 500.0;
  };
  const auto around = run_of_forces(grid, does);
  ASSERT_TRUE(around);
  EXPECT_TRUE(does(grid.at(around->low)) && !does(grid.at(around->low - 1)));
  EXPECT_LT(grid.at(around->high), 50.0);
  EXPECT_GT(grid.at(around->high + 1), 50.0);
  const ForceGrid tight(200.0, 0.1, 1000.0);
  const auto nearest = run_of_forces(tight, does);
  ASSERT_TRUE(nearest);
  EXPECT_GT(tight.at(nearest->low), 500.0);
  EXPECT_EQ(nearest->high, tight.last());
  EXPECT_FALSE(run_of_forces(grid, [](double) { return false; }));
}

TEST(ForceEnd, LiesBetweenWhatDoesAndWhatDoesNot) {
  const auto does = [](double force) { return force > 7.0; };
  const ForceEnd low = force_end(10.0, 1.0, 1e-9, does);
  EXPECT_GT(low.inside, 7.0);
  EXPECT_LE(low.beyond, 7.0);
  EXPECT_NEAR(low.inside, 7.0, 1e-7);
}

}  // namespace
}  // namespace prehensile
