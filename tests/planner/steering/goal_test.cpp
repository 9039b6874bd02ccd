#include "planner/steering/goal.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "planner/geometry/segment.h"
#include "scene/constants.h"
#include "tests/planner/planner_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::goal_at;
using testing::Random;

TEST(Goal, CountsAnglesByWholeTurns) {
  Goal goal = goal_at({-0.02, 0.01}, 3.1);
  Grasp grasp{pose_from_finger({-0.02, 0.01}, 3.1 - 2.0 * kPi), 0.0};
  EXPECT_TRUE(reaches(goal, grasp));
  grasp.X_HO.theta += 6.0 * kPi + 0.5 * goal.angle_tolerance;
  EXPECT_TRUE(reaches(goal, grasp));
  grasp.X_HO.theta += goal.angle_tolerance;
  EXPECT_FALSE(reaches(goal, grasp));
}

TEST(Goal, FreeCoordinatesDoNotCount) {
  Goal goal;
  goal.y = 0.01;
  EXPECT_TRUE(reaches(goal, {{5.0, 0.0105, 2.0}, 1.0}));
  EXPECT_FALSE(reaches(goal, {{5.0, 0.0125, 2.0}, 1.0}));
  EXPECT_NEAR(goal_excess(goal, {{0.0, 0.0125, 0.0}, 0.0}), 1.5, 1e-12);
}

TEST(Goal, WeighsAngleAgainstDistance) {
  Goal goal = goal_at({0.0, 0.0}, 0.0);
  goal.test = GoalTest::kWeightedSum;
  EXPECT_TRUE(reaches(goal, {{3e-4, 4e-4, 0.049}, 0.0}));
  EXPECT_FALSE(reaches(goal, {{3e-4, 4e-4, 0.051}, 0.0}));
  EXPECT_NEAR(goal_excess(goal, {{3e-4, 4e-4, -0.25}, 0.0}), 2e-3, 1e-12);
}

/// Each coordinate is free with this chance.
Goal random_goal(Random& random, double free) {
  Goal goal = goal_at(random.in_box(0.05, 0.05), random.in(-kPi, kPi));
  if (random.chance(free)) goal.x.reset();
  if (random.chance(free)) goal.y.reset();
  if (random.chance(free)) goal.theta.reset();
  return goal;
}

TEST(Goal, PlacesMeetTheGoalOnTheObjectNearestFirst) {
  const Model model = prepare(published_tee(3));
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Goal goal = random_goal(random, 0.3);
    if (!goal.x && !goal.y && !goal.theta) continue;
    const FlatState start{random.in_box(0.05, 0.014), random.in(-5.0, 5.0)};
    const GoalPlaces places = goal_places(model, goal, start);
    double last = 0.0;
    for (int k = 0; k < places.count; ++k) {
      const GoalPlace& place = places.places[k];
      EXPECT_TRUE(contains(model.outline, place.p_OF));
      for (int j = 0; j < place.count; ++j) {
        EXPECT_TRUE(reaches(goal, grasp_of({place.p_OF, place.theta[j]}, 0.0)));
      }
      const double distance = std::hypot((place.p_OF - start.p_OF).norm(),
                                         model.c * (place.theta[0] - start.theta));
      EXPECT_GE(distance, last);
      last = distance;
    }
  }
}

/// What the goal fixes, and where the pads are at the start, is no choice of the planner.
TEST(Goal, PlacesThatThePlannerChoosesKeepTheMargin) {
  const Model model = prepare(published_tee(3));
  Margin margin;
  margin.grasp = 1e-3;
  margin.tilt = 0.02;
  Random random(2);
  int chosen = 0;
  int too_near = 0;
  for (int i = 0; i < 500; ++i) {
    const Goal goal = random_goal(random, 0.4);
    if (!goal.x && !goal.y && !goal.theta) continue;
    const bool fixed = goal.x && goal.y && goal.theta;
    const FlatState start{random.in_box(0.05, 0.014), random.in(-5.0, 5.0)};
    const auto room = [&](const Vec2& p_OF) {
      return distance_to_border(model.pad_face, p_OF, p_OF);
    };
    const auto needed = [&](const Vec2& p_OF) {
      return margin.grasp + 2.0 * margin.tilt * (p_OF - start.p_OF).norm();
    };
    const GoalPlaces with = goal_places(model, goal, start, margin);
    const GoalPlaces without = goal_places(model, goal, start);
    EXPECT_TRUE(!fixed || with.count == without.count);
    for (int k = 0; k < with.count; ++k) {
      const Vec2& p_OF = with.places[k].p_OF;
      if (fixed || (p_OF - start.p_OF).norm() < 1e-9) continue;
      EXPECT_GE(room(p_OF), needed(p_OF));
      ++chosen;
    }
    for (int k = 0; k < without.count; ++k) {
      const Vec2& p_OF = without.places[k].p_OF;
      too_near += !fixed && room(p_OF) < needed(p_OF);
    }
  }
  EXPECT_GT(chosen, 1000);
  EXPECT_GT(too_near, 100);
}

TEST(Goal, AngleBetweenIsOneOfThePlaceOrWholeTurnsFromIt) {
  Scene scene = published_tee(3);
  const GoalPlace place{.count = 2, .theta = {1.0, 1.0 - 2.0 * kPi}};
  const Model angle = prepare(scene);
  scene.goal->theta_is = ThetaMeaning::kNumber;
  const Model number = prepare(scene);
  for (const Model* model : {&angle, &number}) {
    EXPECT_EQ(angle_between(*model, place, 0.0, 2.0), 1.0);
    EXPECT_EQ(angle_between(*model, place, 1.0, 1.0), 1.0);
    EXPECT_EQ(angle_between(*model, place, -6.0, 0.0), 1.0 - 2.0 * kPi);
    EXPECT_FALSE(angle_between(*model, place, 1.1, 6.0));
    EXPECT_FALSE(angle_between(*model, place, 2.0, 0.0));
    EXPECT_FALSE(angle_between(*model, {}, -100.0, 100.0));
    EXPECT_EQ(angle_between(*model, place, 60.0, 70.0).has_value(), model == &angle);
  }
  EXPECT_NEAR(*angle_between(angle, place, 60.0, 70.0), 1.0 + 20.0 * kPi, 1e-12);
  EXPECT_NEAR(*angle_between(angle, place, -70.0, -60.0), 1.0 - 22.0 * kPi, 1e-12);
}

TEST(Goal, WoundPlacesAreTheWholeTurnsThatOthersLeaveOut) {
  const Model model = prepare(published_tee(3));
  Goal goal = goal_at({0.01, 0.0}, 1.0);
  const FlatState start{{-0.02, 0.01}, 7.0};
  std::vector<double> turns;
  for (const GoalPlaces& places :
       {goal_places(model, goal, start), wound_places(model, goal, start)}) {
    for (int k = 0; k < places.count; ++k) {
      const GoalPlace& place = places.places[k];
      for (int j = 0; j < place.count; ++j) {
        EXPECT_TRUE(reaches(goal, grasp_of({place.p_OF, place.theta[j]}, 0.0)));
        turns.push_back((place.theta[j] - 1.0) / (2.0 * kPi));
      }
    }
  }
  std::ranges::sort(turns);
  ASSERT_EQ(turns.size(), 27u);
  for (std::size_t i = 0; i < turns.size(); ++i) {
    EXPECT_NEAR(turns[i] - turns[0], static_cast<double>(i), 1e-9);
  }
  EXPECT_NEAR(turns[13], 1.0, 1e-9);  // the nearest to the start
  goal.theta_is = ThetaMeaning::kNumber;
  EXPECT_EQ(wound_places(model, goal, start).count, 0);
  goal.theta_is = ThetaMeaning::kAngle;
  goal.y.reset();
  EXPECT_EQ(wound_places(model, goal, start).count, 0);
}

TEST(Goal, WoundToleratedPlacesMeetTheGoalAtEachOfTheseTurns) {
  const Model model = prepare(published_tee(3));
  const Goal goal = goal_at({0.01, 0.0}, 1.0);
  const FlatState start{{-0.02, 0.01}, 7.0};
  const int beside = tolerated_places(model, goal, start).count;
  ASSERT_GT(beside, 1);
  const GoalPlaces exact = wound_places(model, goal, start);
  ASSERT_EQ(exact.count, kWoundShares);
  for (int share = 0; share < kWoundShares; ++share) {
    const GoalPlaces places = wound_tolerated_places(model, goal, start, share);
    EXPECT_EQ(places.count, beside);
    for (int k = 0; k < places.count; ++k) {
      const GoalPlace& place = places.places[k];
      ASSERT_EQ(place.count, exact.places[share].count);
      for (int j = 0; j < place.count; ++j) {
        EXPECT_TRUE(reaches(goal, grasp_of({place.p_OF, place.theta[j]}, 0.0)));
        EXPECT_NEAR(place.theta[j], exact.places[share].theta[j], 0.5);
      }
    }
  }
  Goal number = goal;
  number.theta_is = ThetaMeaning::kNumber;
  EXPECT_EQ(wound_tolerated_places(model, number, start, 0).count, 0);
  EXPECT_GT(tolerated_places(model, number, start).count, 0);
}

/// Each coordinate has a tolerance of its own, or both share one with the angle: the
/// places reach into the corners of a square, or as far to every side.
TEST(Goal, ToleratedPlacesReachIntoTheCorners) {
  const Model model = prepare(published_tee(3));
  Goal goal = goal_at({0.01, 0.0}, 1.0);
  const FlatState start{{-0.02, 0.01}, 1.0};
  for (const GoalTest test : {GoalTest::kPerCoordinate, GoalTest::kWeightedSum}) {
    goal.test = test;
    const GoalPlaces places = tolerated_places(model, goal, start);
    double farthest = 0.0;
    for (int k = 0; k < places.count; ++k) {
      const Grasp grasp =
          grasp_of({places.places[k].p_OF, places.places[k].theta[0]}, 0.0);
      EXPECT_TRUE(reaches(goal, grasp));
      const Vec2 off = translation(grasp.X_HO) - Vec2(*goal.x, *goal.y);
      farthest = std::max(farthest, off.norm() / goal.position_tolerance);
    }
    EXPECT_NEAR(farthest,
                test == GoalTest::kPerCoordinate ? kUsedTolerance * std::sqrt(2.0)
                                                 : kUsedTolerance,
                1e-9);
  }
}

TEST(Goal, RollNeededIsTheShortWayRound) {
  Goal goal;
  goal.psi = 3.0;
  EXPECT_NEAR(roll_needed(goal, -3.0), 6.0 - 2.0 * kPi, 1e-12);
  EXPECT_EQ(roll_needed(goal, 3.0 + 0.5 * goal.angle_tolerance), 0.0);
  goal.psi.reset();
  EXPECT_EQ(roll_needed(goal, 1.0), 0.0);
}

}  // namespace
}  // namespace prehensile
