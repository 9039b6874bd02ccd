/// What the arm carries the object through.
#include "planner/arm/arm_crossings.h"

#include <gtest/gtest.h>

#include "planner/planner.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

/// Every pusher 0.3 m behind the origin of W.
Scene with_pushers_apart(Scene scene) {
  for (Pusher& pusher : scene.pushers) {
    pusher.p_WP = rotated(pusher.normal_angle, Vec2(-0.3, 0.0));
  }
  return scene;
}

/// A tee, a plan of two pushes for it, and what the arm does where the scene is changed:
/// the plan does not depend on where the pushers stand.
class ArmCrossings : public ::testing::Test {
 protected:
  ArmCrossings() : plan_(plan_regrasp(prepare(scene_))) {}

  /// With the hand lifted by so much.
  std::vector<ArmCrossing> found(double lift = 0.0) const {
    const Model model = prepare(scene_);
    ArmMotion motion = arm_motion(model, plan_);
    for (ArmSample& sample : motion.samples) sample.X_WH.position.z() += lift;
    return arm_crossings(model, plan_, motion);
  }

  /// Where O is in W while this push is done.
  Vec2 object_at(std::size_t push) const {
    const auto contact = static_cast<std::size_t>(contact_of(plan_.pushes[push].push));
    const Model model = prepare(scene_);
    const PlanarPose X_WO = pusher_in_world(model, model.contacts[contact], 0.0);
    return translation(X_WO);
  }

  /// With one more pusher, which the plan does not use, at p in the frame that O has
  /// during the first push.
  std::vector<ArmCrossing> found_with(Pusher more, const Vec2& p, double lift = 0.0) {
    more.name = "more";
    more.friction = 0.5;
    more.p_WP = object_at(0) + p;
    scene_.pushers.push_back(more);
    std::vector<ArmCrossing> crossings = found(lift);
    scene_.pushers.pop_back();
    return crossings;
  }

  Scene scene_ = with_pushers_apart(published_tee(20));
  Plan plan_;
};

TEST_F(ArmCrossings, NoneAmongPushersThatStandApart) {
  for (int i = 0; i < 50; ++i) {
    for (const Scene& scene : {with_pushers_apart(published_tee(i)),
                               with_pushers_apart(published_square(i))}) {
      const Model model = prepare(scene);
      const Plan plan = plan_regrasp(model);
      EXPECT_TRUE(arm_crossings(model, plan, arm_motion(model, plan)).empty())
          << scene.name;
    }
  }
}

TEST_F(ArmCrossings, EndlessLinesThroughOnePlaceCutTheObject) {
  ASSERT_EQ(plan_.pushes.size(), 2u);
  for (Pusher& pusher : scene_.pushers) pusher.p_WP.setZero();
  const std::vector<ArmCrossing> crossings = found();
  ASSERT_EQ(crossings.size(), 3u);
  // The wall pushes first, at its middle: floor and ceiling cut the tee from the outset.
  EXPECT_EQ(scene_.pushers[crossings[0].pusher].name, "floor");
  EXPECT_EQ(crossings[0].phase, ArmPhase::kApproach);
  EXPECT_EQ(crossings[0].push, 0);
  EXPECT_EQ(crossings[0].t, 0.0);
  EXPECT_EQ(scene_.pushers[crossings[1].pusher].name, "ceiling");
  EXPECT_EQ(scene_.pushers[crossings[2].pusher].name, "wall");
  EXPECT_GT(crossings[2].t, 0.0);
}

TEST_F(ArmCrossings, APointInTheOutlineCutsIt) {
  // The bar of the tee ends at x = -0.02, its stem at y = +/- 0.015.
  const std::vector<ArmCrossing> inside = found_with({}, {-0.03, 0.04});
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_EQ(inside[0].push, 0);
  EXPECT_EQ(inside[0].phase, ArmPhase::kApproach);
  EXPECT_TRUE(found_with({}, {0.3, 0.3}).empty());
  EXPECT_TRUE(found_with({}, {-0.03, 0.04}, 0.1).empty());  // over it
  EXPECT_FALSE(found_with({.feature = UprightFeature{}}, {-0.03, 0.04}, 0.1).empty());
}

TEST_F(ArmCrossings, OfALineItsLengthCounts) {
  const double quarter = 0.5 * kPi;
  const auto line = [&](std::optional<double> length) {
    return Pusher{.feature = LineFeature{length}, .normal_angle = quarter};
  };
  // Beside the stem, level with the outer part of the bar.
  const Vec2 beside(0.1, 0.04);
  EXPECT_EQ(found_with(line({}), beside).size(), 1u);
  EXPECT_EQ(found_with(line(0.26), beside).size(), 1u);
  EXPECT_TRUE(found_with(line(0.05), beside).empty());
  const auto plane = [&](double width) {
    return Pusher{.feature = PlaneFeature{0.26, width}, .normal_angle = quarter};
  };
  EXPECT_EQ(found_with(plane(0.2), beside, 0.1).size(), 1u);
  EXPECT_TRUE(found_with(plane(0.1), beside, 0.1).empty());
}

TEST_F(ArmCrossings, WhatTheObjectLiesOnDoesNotCutIt) {
  // Along the lower side of the tee, which rests there during the first push.
  const Pusher floor{.feature = LineFeature{}, .normal_angle = 0.5 * kPi};
  const std::vector<ArmCrossing> below = found_with(floor, {0.0, -0.0500});
  ASSERT_EQ(below.size(), 1u);  // on the way to the floor of the scene
  EXPECT_EQ(below[0].phase, ArmPhase::kTransit);
  const std::vector<ArmCrossing> within = found_with(floor, {0.0, -0.0495});
  ASSERT_EQ(within.size(), 1u);
  EXPECT_EQ(within[0].t, 0.0);
}

}  // namespace
}  // namespace prehensile
