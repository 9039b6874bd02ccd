/// Laws of finite pushes in space: agreement with the pad plane, symmetries, and what
/// pushes make of each other.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "primitives/linear_push.h"
#include "problems/random_pushes.h"
#include "tests/primitives/push_checks.h"

namespace prehensile {
namespace {

using testing::distance;
using testing::expect_parts_make_whole;
using testing::has_event;
using testing::may_be_cut;
using testing::mirrored;

constexpr TransitionOptions kFine{.tolerance = 1e-7};

// A scene that is symmetric about the mid-plane, followed in space all the same, moves as
// in the pad plane: every status, every event, and the pose.
TEST(SpatialPushLaw, EqualsThePadPlaneWhereTheSceneIsSymmetric) {
  std::vector<double> apart;
  int integrated = 0;
  for (int seed = 0; seed < 80; ++seed) {
    const RandomPush c = random_push(21, seed);
    const Model model = prepare(c.scene);
    ASSERT_FALSE(model.push_needs_space(model.contacts[0]));
    std::vector<Sample> flat_path, path;
    const Transition flat = apply(model, c.scene.start, c.push, kFine, &flat_path);
    TransitionOptions spatial = kFine;
    spatial.level = PushLevel::kSpace;
    const Transition space = apply(model, c.scene.start, c.push, spatial, &path);
    EXPECT_EQ(space.in_space, flat.status != TransitionStatus::kRefused);
    EXPECT_FALSE(flat.in_space);
    ASSERT_EQ(space.status, flat.status) << seed << " " << space.reason;
    if (!flat.completed()) {
      // Whether a grasp all but falls takes the spatial instant for ever to tell.
      if (flat.status == TransitionStatus::kIterationLimit) continue;  // anywhere
      EXPECT_NEAR(space.done, flat.done, 2e-3) << seed << " " << space.reason;
      continue;
    }
    EXPECT_EQ(space.event_count, flat.event_count) << seed;
    apart.push_back(distance(space.end.X_HO, flat.end.X_HO, model.c));
    integrated += flat.slipped > 1e-6 ? 1 : 0;
    const Sample& one = path.back();
    const Sample& other = flat_path.back();
    EXPECT_NEAR(one.push_force, other.push_force, 1e-4 * other.push_force) << seed;
    EXPECT_LT(one.out_of_plane, 1e-2);
    EXPECT_EQ(one.pressed, 1.0);
  }
  std::sort(apart.begin(), apart.end());
  EXPECT_GT(integrated, 12);
  EXPECT_GT(apart.size(), 45U);
  EXPECT_LT(apart[apart.size() / 2], 1e-9);
  EXPECT_LT(apart[apart.size() * 95 / 100], 1e-7);
  EXPECT_LT(apart.back(), 3e-6);
}

TEST(SpatialPushLaw, OnlyScenesThatNeedSpaceAreFollowedThere) {
  const RandomPush c = random_push(21, 3);
  RandomPush free = c;
  free.scene.gripper.pressure.law = PressureLaw::kFree;
  RandomPush high = c;
  high.scene.pushers[0].z_WP = 0.002;
  RandomPush uneven = c;
  uneven.scene.gripper.friction[0] *= 1.1;
  RandomPush tilted = c;
  tilted.scene.g_Wz = 1.0;
  const auto in_space = [](const RandomPush& drawn, FrictionModel friction) {
    return apply(prepare(drawn.scene), drawn.scene.start, drawn.push,
                 {.friction_model = friction})
        .in_space;
  };
  EXPECT_FALSE(in_space(c, FrictionModel::kPads));
  EXPECT_FALSE(in_space(free, FrictionModel::kPads));
  for (const RandomPush& drawn : {high, uneven, tilted}) {
    EXPECT_TRUE(in_space(drawn, FrictionModel::kPads));
    EXPECT_FALSE(in_space(drawn, FrictionModel::kEllipsoid));
  }
}

// The mid-plane is a mirror: jaws, heights and gravity along the closing direction change
// sides, the motion in the pad plane stays.
RandomPush upside_down(RandomPush c) {
  Scene& scene = c.scene;
  scene.g_Wz *= -1.0;
  scene.object.z_OCom *= -1.0;
  scene.pushers[0].z_WP *= -1.0;
  std::swap(scene.gripper.friction[0], scene.gripper.friction[1]);
  const JawMode mode = scene.gripper.jaw_mode;
  if (mode == JawMode::kFixedJaw1) scene.gripper.jaw_mode = JawMode::kFixedJaw2;
  if (mode == JawMode::kFixedJaw2) scene.gripper.jaw_mode = JawMode::kFixedJaw1;
  return c;
}

TEST(SpatialPushLaw, UpsideDownMovesAlike) {
  int compared = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const RandomPush c = random_spatial_push(22, seed);
    const RandomPush m = upside_down(c);
    const Transition one = apply(prepare(c.scene), c.scene.start, c.push, kFine);
    const Transition other = apply(prepare(m.scene), m.scene.start, m.push, kFine);
    ASSERT_EQ(one.status, other.status) << seed << " " << one.reason << other.reason;
    if (!one.completed()) continue;
    EXPECT_LT(distance(one.end.X_HO, other.end.X_HO, 0.01), 5e-7) << seed;
    ++compared;
  }
  EXPECT_GT(compared, 22);
}

TEST(SpatialPushLaw, MirrorImagesMoveAsMirrorImages) {
  int compared = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const RandomPush c = random_spatial_push(23, seed);
    const RandomPush m = mirrored(c);
    const Transition one = apply(prepare(c.scene), c.scene.start, c.push, kFine);
    const Transition other = apply(prepare(m.scene), m.scene.start, m.push, kFine);
    ASSERT_EQ(one.status, other.status) << seed << " " << one.reason << other.reason;
    if (!one.completed()) continue;
    EXPECT_LT(distance(one.end.X_HO, mirrored(other.end.X_HO), 0.01), 5e-7) << seed;
    ++compared;
  }
  EXPECT_GT(compared, 22);
}

TEST(SpatialPushLaw, PushInTwoPartsEndsWhereTheWholePushEnds) {
  int compared = 0;
  for (int seed = 0; seed < 400; ++seed) {
    const RandomPush c = random_spatial_push(24, seed);
    const Model model = prepare(c.scene);
    if (!may_be_cut(model)) continue;
    const Transition whole = apply(model, c.scene.start, c.push, kFine);
    if (!whole.completed() || has_event(whole, EventKind::kCorner)) continue;
    SCOPED_TRACE(seed);
    expect_parts_make_whole(model, c, whole, kFine, 3e-7);
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

// A flush contact that sticks takes the object along exactly, whatever the loads do.
TEST(SpatialPushLaw, StickingPushesAreTheRigidMotionOfThePusher) {
  int rides = 0;
  for (int seed = 0; seed < 200; ++seed) {
    const RandomPush c = random_spatial_push(25, seed);
    const Model model = prepare(c.scene);
    const Transition t = apply(model, c.scene.start, c.push);
    if (!t.completed() || t.event_count > 0 || t.slipped > 0.0) continue;
    if (model.contacts[0].is_point) continue;
    EXPECT_LT(distance(t.end.X_HO, pusher_pose(c.push, c.scene.start.X_HO, 1.0), 0.1),
              1e-15);
    EXPECT_EQ(t.error_estimate, 0.0);
    EXPECT_LT(t.worst_certificate, 1e-6);
    ++rides;
  }
  EXPECT_GT(rides, 20);
}

// The fourth phase of a push: the pusher leaves, and the grasp that it leaves behind
// holds the object at rest, by an instant in which the pusher has parted.
TEST(SpatialPushLaw, RetractingThePusherLeavesAGraspThatHoldsGravity) {
  int flush = 0;
  for (int seed = 0; seed < 150; ++seed) {
    const RandomPush c = random_spatial_push(26, seed);
    const Model model = prepare(c.scene);
    const Transition done = apply(model, c.scene.start, c.push);
    if (!done.completed() || model.contacts[0].is_point) continue;
    if (std::abs(testing::object_at_pusher(c, done).theta) > 0.0) continue;
    SCOPED_TRACE(seed);
    testing::expect_left_behind(model, c, done);
    ++flush;
  }
  EXPECT_GT(flush, 15);
}

}  // namespace
}  // namespace prehensile
