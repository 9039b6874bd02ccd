/// Pushes in space: closed forms, events, and hard cases.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "primitives/transition.h"
#include "problems/random_pushes.h"
#include "tests/primitives/push_checks.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

using testing::distance;
using testing::has_event;

constexpr double kGravity = 9.81;
constexpr double kHalf = 0.015;  // [m] of the thickness

/// A square of 100 mm, 30 mm thick, pushed at its face -x by a wall at a height.
Scene square_scene(double height) {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.1, 2.0 * kHalf}};
  scene.object.mass = 0.5;
  scene.gripper.pad = DiscPad{0.012};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 40.0;
  scene.g_W.setZero();
  scene.pushers.resize(1);
  scene.pushers[0] = {.name = "wall", .feature = LineFeature{}, .friction = 0.5};
  scene.pushers[0].z_WP = height;
  return scene;
}

LinearPush straight(double travel) { return {.travel = travel}; }

// Whole pads that all slip one way resist with 2 mu N, wherever the pusher stands: a
// moment across the pad plane shifts the loads and leaves their sum.
TEST(SpatialPush, AWallAtAHeightSlidesTheObjectWithTheSameForce) {
  for (const double height : {-0.004, 0.002, 0.004}) {
    const Model model = prepare(square_scene(height));
    std::vector<Sample> path;
    const Transition t = apply(model, {}, straight(0.02), {}, &path);
    ASSERT_TRUE(t.completed()) << t.reason;
    EXPECT_TRUE(t.in_space);
    EXPECT_NEAR(t.end.X_HO.x, 0.02, 1e-15);
    EXPECT_EQ(t.end.X_HO.theta, 0.0);
    for (const Sample& sample : path) {
      EXPECT_NEAR(sample.normal_force, 40.0, 4e-3);
      EXPECT_NEAR(sample.jaw_force[0] + sample.jaw_force[1], 80.0, 1e-6);
    }
    // The moment of the push about the mid-plane: friction at the wall, which pushes one
    // jaw and relieves the other, takes its share.
    EXPECT_LE(path.back().moment_across, 40.0 * std::abs(height) + 1e-3);
  }
}

// A frictionless wall leaves all of the moment F z to the pads. A disc presses all over
// while the load is off its middle by less than a quarter of the radius (kern): with two
// pads that is z < N r / F = r / (2 mu) x 1/2.
TEST(SpatialPush, PadsBeginToLiftWhereTheLoadLeavesTheKern) {
  const double kern = 2.0 * 40.0 * 0.25 * 0.012 / 40.0;
  for (const double share : {0.8, 1.5}) {
    Scene scene = square_scene(share * kern);
    scene.pushers[0].friction = 0.0;
    const Transition t =
        apply(prepare(scene, {.points_per_pad = 64}), {}, straight(0.02));
    ASSERT_TRUE(t.completed()) << t.reason;
    EXPECT_EQ(t.least_pressed<1.0, share> 1.0) << t.least_pressed;
  }
}

TEST(SpatialPush, AtTheRimALightGripLosesThePlane) {
  Scene scene = square_scene(kHalf);
  scene.pushers[0].friction = 0.0;
  scene.gripper.pad = DiscPad{0.004};
  const Transition t = apply(prepare(scene), {}, straight(0.04));
  EXPECT_EQ(t.status, TransitionStatus::kLeavesPlane) << t.reason;
  EXPECT_TRUE(has_event(t, EventKind::kOutOfPlane));
  EXPECT_EQ(t.reason, "the object tilts between the jaws");
}

// Pads whose loads are given whatever happens resist no moment by shifting them.
TEST(SpatialPush, PadsOfGivenLoadsDoNotResistTilting) {
  Scene scene = square_scene(0.004);
  scene.pushers[0].friction = 0.0;
  scene.gripper.pressure.law = PressureLaw::kGiven;
  EXPECT_EQ(apply(prepare(scene), {}, straight(0.01)).status,
            TransitionStatus::kLeavesPlane);
  scene.pushers[0].z_WP = 0.0;
  const Transition level =
      apply(prepare(scene), {}, straight(0.01), {.level = PushLevel::kSpace});
  EXPECT_TRUE(level.completed()) << level.reason;
}

// Gravity along the closing direction: the coupled jaws carry N -/+ W / 2, and of what a
// rough wall adds along it, with its moment about the finger axis, the same. Where that
// is all of a jaw's force the object is not held, whatever the pusher does.
TEST(SpatialPush, GravityAlongTheClosingDirectionLoadsTheLowerJaw) {
  Scene scene = square_scene(0.0);
  scene.g_Wz = -kGravity;
  for (const double friction : {0.0, 0.5}) {
    scene.pushers[0].friction = friction;
    std::vector<Sample> path;
    const Transition t = apply(prepare(scene), {}, straight(0.02), {}, &path);
    ASSERT_TRUE(t.completed()) << t.reason;
    ASSERT_GT(path.size(), 5U);
    for (const Sample& sample : path) {
      const double lever = 0.05 - sample.grasp.X_HO.x;  // of the wall, [m]
      const double added = sample.moment_across / lever;
      const double shift = 0.25 * kGravity + 0.5 * added;
      EXPECT_NEAR(sample.jaw_force[0], 40.0 + shift, 1e-6);
      EXPECT_NEAR(sample.jaw_force[1], 40.0 - shift, 1e-6);
      EXPECT_NEAR(sample.normal_force, 40.0, 4e-3);
      EXPECT_LE(added, friction * 40.0 + 1e-6);
    }
  }
  scene.gripper.grip_force = 0.2 * kGravity;
  const Transition loose = apply(prepare(scene), {}, straight(0.02));
  EXPECT_EQ(loose.status, TransitionStatus::kFalls) << loose.reason;
  EXPECT_EQ(loose.done, 0.0);
}

TEST(SpatialPush, NoGripHoldsNothing) {
  Scene scene = square_scene(0.004);
  scene.gripper.grip_force = 0.0;
  scene.g_W = {0.0, -kGravity};
  const Transition t = apply(prepare(scene), {}, straight(0.02));
  EXPECT_NE(t.status, TransitionStatus::kCompleted);
  EXPECT_EQ(t.done, 0.0);
  EXPECT_EQ(t.end, Grasp());
}

// Friction of 0 and 1000, at the pads and at the pusher: whatever is reported as done is
// certified, and nothing ends without a reason.
TEST(SpatialPush, ExtremeFrictionIsCertifiedOrRefused) {
  int done = 0;
  for (int seed = 0; seed < 12; ++seed) {
    for (const double mu : {0.0, 1000.0}) {
      RandomPush c = random_spatial_push(27, seed);
      if (seed % 3 != 0) c.scene.pushers[0].friction = mu;
      if (seed % 3 == 0) c.scene.gripper.friction[seed % 2] = mu;
      const Transition t = apply(prepare(c.scene), c.scene.start, c.push);
      EXPECT_NE(t.status, TransitionStatus::kUncertified) << seed << " " << mu;
      EXPECT_TRUE(t.completed() || !t.reason.empty()) << seed << " " << mu;
      if (t.done > 0.0) {
        EXPECT_LE(t.worst_certificate, 1e-6) << seed << " " << mu;
      }
      done += t.completed() ? 1 : 0;
    }
  }
  EXPECT_GT(done, 7);
}

// Pads that leave the face partly are clipped, and their loads drawn anew, on the way.
TEST(SpatialPush, OverhangingPadsAreClippedOnTheWay) {
  Scene scene = square_scene(0.003);
  scene.overhang = Overhang::kClip;
  scene.start.X_HO.y = 0.03;
  scene.pushers[0].friction = 0.9;
  const Transition t =
      apply(prepare(scene), scene.start, straight(0.055), {.max_step = 0.02});
  EXPECT_EQ(t.status, TransitionStatus::kPadLost) << t.reason;
  EXPECT_NEAR(t.end.X_HO.x, 0.05, 1e-9);
  EXPECT_NEAR(t.end.X_HO.y, 0.03, 1e-12);
  EXPECT_LE(t.worst_certificate, 1e-6);
}

TEST(SpatialPush, PlanesAndUprightEdgesAreFollowed) {
  const PushLevel space = PushLevel::kSpace;
  for (const PusherFeature& feature :
       {PusherFeature(PlaneFeature{}), PusherFeature(PlaneFeature{0.03, 0.01}),
        PusherFeature(UprightFeature{})}) {
    Scene scene = square_scene(0.0);
    scene.pushers[0].feature = feature;
    scene.g_W = {0.0, -1.0};
    const Transition flat = apply(prepare(scene), {}, straight(0.02));
    const Transition t = apply(prepare(scene), {}, straight(0.02), {.level = space});
    EXPECT_FALSE(flat.in_space);
    ASSERT_TRUE(t.completed()) << t.reason;
    EXPECT_LT(distance(t.end.X_HO, flat.end.X_HO, 0.01), 2e-6);
    scene.pushers[0].z_WP = 0.004;
    const Transition high = apply(prepare(scene), {}, straight(0.02), {.level = space});
    EXPECT_TRUE(high.completed()) << high.reason;
  }
}

TEST(SpatialPush, UsesNoHeapWithoutATrace) {
  const int none = testing::heap_is_counted() ? 0 : -1;
  for (int seed = 0; seed < 40; ++seed) {
    const RandomPush c = random_spatial_push(28, seed);
    const Model model = prepare(c.scene);
    const testing::NoHeapScope scope;
    (void)apply(model, c.scene.start, c.push);
    ASSERT_EQ(scope.allocations(), none) << seed;
  }
}

}  // namespace
}  // namespace prehensile
