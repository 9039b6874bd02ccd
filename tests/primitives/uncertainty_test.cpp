#include "primitives/uncertainty.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "problems/random_pushes.h"
#include "scene/contact_region.h"

namespace prehensile {
namespace {

UncertaintyBox box_of_all(double width) {
  UncertaintyBox box;
  box.half_width.fill(width);
  return box;
}

TEST(Uncertainty, TheMiddleOfTheBoxIsThePushItself) {
  for (int i = 0; i < 50; ++i) {
    const RandomPush random = random_push(3, static_cast<std::uint64_t>(i));
    const UncertainPush same =
        vary(random.scene, random.scene.start, random.push, box_of_all(0.1), BoxPoint{});
    EXPECT_EQ(same.start.X_HO.x, random.scene.start.X_HO.x);
    EXPECT_NEAR(same.start.X_HO.theta, random.scene.start.X_HO.theta, 1e-15);
    EXPECT_EQ(same.scene.gripper.grip_force, random.scene.gripper.grip_force);
    EXPECT_EQ(same.scene.pushers[0].friction, random.scene.pushers[0].friction);
    EXPECT_EQ(std::get<LinearPush>(same.push).travel, random.push.travel);
  }
}

TEST(Uncertainty, GripForcesOfARangeMoveWithTheGrip) {
  Scene scene = random_push(3, 1).scene;
  scene.gripper.grip_range = Vec2(1.0, 7.0);
  UncertaintyBox box;
  box[Unknown::kGripForce] = 0.1;
  BoxPoint up{};
  up[static_cast<std::size_t>(Unknown::kGripForce)] = 1.0;
  const Scene varied = vary(scene, scene.start, LinearPush{}, box, up).scene;
  EXPECT_NEAR((*varied.gripper.grip_range)[0], 1.1, 1e-12);
  EXPECT_NEAR((*varied.gripper.grip_range)[1], 7.7, 1e-12);
}

TEST(Uncertainty, ContactsOfVariedScenesAreFoundAgain) {
  Scene scene = random_push(3, 1).scene;
  scene.g_W = {0.0, -9.81};
  scene.gripper.grip_force = 10.0;
  scene.gripper.grip_range = Vec2(5.0, 40.0);
  const Model model = prepare(scene);
  UncertaintyBox box;
  box[Unknown::kGripForce] = 0.1;
  BoxPoint up{};
  up[static_cast<std::size_t>(Unknown::kGripForce)] = 1.0;
  Scene varied = vary(scene, scene.start, LinearPush{}, box, up).scene;
  const int count = static_cast<int>(model.contacts.size());
  for (int i = 0; i < count; ++i) EXPECT_EQ(counterpart(model, i, prepare(varied)), i);
  varied.g_W.setZero();  // one grip stands for all
  const Model weightless = prepare(varied);
  for (int i = 0; i < count; ++i) {
    const int own = i % static_cast<int>(weightless.contacts.size());
    EXPECT_EQ(counterpart(model, i, weightless), own);
  }
  varied.pushers.clear();
  EXPECT_EQ(counterpart(model, 0, prepare(varied)), -1);
}

/// A pusher that names no face touches the one opposite to it, and does so tilted, too:
/// one half way between two faces has no other when it is tilted.
TEST(Uncertainty, TiltedPushersKeepTheirFace) {
  Scene scene = random_push(3, 1).scene;
  scene.object.shape = PrismShape{
      {{-0.03, -0.03}, {0.03, -0.03}, {0.03, 0.03}, {-0.03, 0.03}}, 0.02, Axis::kZ};
  scene.pushers = {
      {.name = "post", .feature = PointFeature{}, .normal_angle = 0.75 * kPi}};
  const Model model = prepare(scene);
  ASSERT_EQ(model.contacts.size(), 1U);
  UncertaintyBox box;
  box[Unknown::kTilt] = 0.01;
  for (const double tilt : {-1.0, -1e-9, 0.0, 1e-9, 1.0}) {
    BoxPoint at{};
    at[static_cast<std::size_t>(Unknown::kTilt)] = tilt;
    const Scene varied = vary(scene, scene.start, LinearPush{}, box, at).scene;
    EXPECT_EQ(counterpart(model, 0, prepare(varied)), 0) << tilt;
  }
}

TEST(Uncertainty, EachUnknownMovesItsOwnField) {
  const RandomPush random = random_push(3, 1);
  const Scene& scene = random.scene;
  const auto moved = [&](Unknown unknown, double width, bool absolute = false) {
    UncertaintyBox box;
    box[unknown] = width;
    box.is_absolute[static_cast<std::size_t>(unknown)] = absolute;
    BoxPoint up;
    up.fill(1.0);
    return vary(scene, scene.start, random.push, box, up);
  };
  EXPECT_NEAR(moved(Unknown::kFriction, 0.2).scene.pushers[0].friction,
              1.2 * scene.pushers[0].friction, 1e-12);
  EXPECT_NEAR(moved(Unknown::kFriction, 0.2, true).scene.pushers[0].friction,
              0.2 + scene.pushers[0].friction, 1e-12);
  EXPECT_NEAR(moved(Unknown::kGripForce, 0.1).scene.gripper.grip_force,
              1.1 * scene.gripper.grip_force, 1e-9);
  EXPECT_NEAR(moved(Unknown::kMass, 0.1).scene.object.mass, 1.1 * scene.object.mass,
              1e-12);
  const double c = ContactRegion(scene, 16).torque_radius();
  for (const bool absolute : {false, true}) {
    const double width = absolute ? 0.1 * c : 0.1;
    const Scene wider = moved(Unknown::kTorqueRadius, width, absolute).scene;
    EXPECT_NEAR(ContactRegion(wider, 16).torque_radius(), 1.1 * c, 1e-9);
  }
  const LinearPush push = std::get<LinearPush>(moved(Unknown::kPlace, 2e-3).push);
  EXPECT_NEAR(push.place, random.push.place + 2e-3, 1e-15);
  const LinearPush turned = std::get<LinearPush>(moved(Unknown::kDirection, 0.1).push);
  EXPECT_NEAR(turned.e.dot(random.push.e), std::cos(0.1), 1e-12);
  // The object turns about the finger axis: its place in the object stays.
  const PlanarPose X_HO = moved(Unknown::kGraspAngle, 0.1).start.X_HO;
  EXPECT_NEAR((finger_in_object(X_HO) - finger_in_object(scene.start.X_HO)).norm(), 0.0,
              1e-12);
}

TEST(Uncertainty, PointsAreDeterministicUniformAndInside) {
  std::array<double, kUnknowns> mean{}, square{};
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const BoxPoint point = random_point(5, static_cast<std::uint64_t>(i));
    ASSERT_EQ(point, random_point(5, static_cast<std::uint64_t>(i)));
    for (std::size_t k = 0; k < point.size(); ++k) {
      ASSERT_GE(point[k], -1.0);
      ASSERT_LT(point[k], 1.0);
      mean[k] += point[k] / count;
      square[k] += point[k] * point[k] / count;
    }
  }
  for (std::size_t k = 0; k < mean.size(); ++k) {
    EXPECT_NEAR(mean[k], 0.0, 0.02);
    EXPECT_NEAR(square[k], 1.0 / 3.0, 0.02);
  }
  EXPECT_NE(random_point(5, 0), random_point(6, 0));
}

TEST(Uncertainty, CornersAreAllCorners) {
  UncertaintyBox box;
  box[Unknown::kFriction] = box[Unknown::kMass] = box[Unknown::kPlace] = 0.1;
  std::set<BoxPoint> corners;
  for (std::uint64_t i = 0; i < 8; ++i) corners.insert(corner(box, i));
  EXPECT_EQ(corners.size(), 8U);
  for (const BoxPoint& point : corners) {
    EXPECT_EQ(std::abs(point[0]), 1.0);
    EXPECT_EQ(point[1], 0.0);
  }
}

TEST(Uncertainty, NothingBecomesNegative) {
  const RandomPush random = random_push(3, 2);
  UncertaintyBox box = box_of_all(0.9);
  box.is_absolute.fill(true);
  box[Unknown::kMass] = 100.0;
  BoxPoint down;
  down.fill(-1.0);
  const UncertainPush low =
      vary(random.scene, random.scene.start, random.push, box, down);
  EXPECT_GE(low.scene.object.mass, 0.0);
  EXPECT_GE(low.scene.pushers[0].friction, 0.0);
  EXPECT_GE(std::get<LinearPush>(low.push).travel, 0.0);
}

}  // namespace
}  // namespace prehensile
