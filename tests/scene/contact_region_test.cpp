#include "scene/contact_region.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scene/outline.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

Scene box_in(const Pad& pad, Overhang overhang = Overhang::kClip) {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.06, 0.03}};
  scene.object.mass = 0.1;
  scene.gripper.pad = pad;
  scene.overhang = overhang;
  return scene;
}

double torque_about(const ContactPoints& points, const Vec2& p) {
  double sum = 0.0;
  for (int j = 0; j < points.count; ++j) {
    sum += points.weight[j] * std::hypot(points.x[j] - p.x(), points.y[j] - p.y());
  }
  return sum;
}

double sum_of_weights(const ContactPoints& points) {
  double sum = 0.0;
  for (int j = 0; j < points.count; ++j) sum += points.weight[j];
  return sum;
}

TEST(ContactRegion, TorqueRadiusOfKnownPads) {
  for (const int points : {4, 8, 16, 32, 64}) {
    EXPECT_NEAR(ContactRegion(box_in(DiscPad{0.009}), points).torque_radius(), 0.006,
                1e-15);
    EXPECT_NEAR(ContactRegion(box_in(LinePad{0.02, 0.3}), points).torque_radius(), 0.005,
                1e-15);
  }
  const double square = 0.02 * (std::sqrt(2.0) + std::log(1.0 + std::sqrt(2.0))) / 6.0;
  EXPECT_NEAR(
      ContactRegion(box_in(RectanglePad{{0.02, 0.02}}), 16).torque_radius() / square, 1.0,
      5e-3);
  EXPECT_NEAR(
      ContactRegion(box_in(RectanglePad{{0.02, 0.02}}), 64).torque_radius() / square, 1.0,
      2e-4);
  EXPECT_EQ(ContactRegion(box_in(PointPad{}), 16).torque_radius(), 0.0);
}

TEST(ContactRegion, WholePadsDoNotDependOnThePose) {
  const ContactRegion region(box_in(DiscPad{0.009}), 16);
  const PlanarPose X_HO{0.01, -0.005, 0.7};
  EXPECT_TRUE(region.is_whole(X_HO));
  EXPECT_EQ(region.at(X_HO).x[5], region.at({}).x[5]);
  EXPECT_FALSE(region.is_fixed_in_hand());
  EXPECT_TRUE(
      ContactRegion(box_in(DiscPad{0.009}, Overhang::kIgnore), 16).is_fixed_in_hand());
}

TEST(ContactRegion, HalfAPadOnTheEdge) {
  for (const Pad& pad : {Pad(DiscPad{0.009}), Pad(RectanglePad{{0.02, 0.01}})}) {
    const ContactRegion region(box_in(pad), 16);
    const ContactPoints points = region.at(pose_from_finger({0.05, 0.0}, 0.0));
    EXPECT_NEAR(points.coverage, 0.5, 1e-12);
    EXPECT_NEAR(sum_of_weights(points), 1.0, 1e-12);
    for (int j = 0; j < points.count; ++j) EXPECT_LT(points.x[j], 1e-12);
  }
}

TEST(ContactRegion, LoadsVaryContinuouslyAsThePadLeavesTheFace) {
  for (const Pad& pad :
       {Pad(DiscPad{0.009}), Pad(RectanglePad{{0.02, 0.014}}), Pad(LinePad{0.02, 0.0})}) {
    const ContactRegion region(box_in(pad), 16);
    double before = torque_about(region.at({}), {0.003, 0.002});
    for (int i = 0; i < 750; ++i) {
      const double x = 0.035 + 2e-5 * i;
      const ContactPoints points = region.at(pose_from_finger({x, 0.004}, 0.4));
      const double now = torque_about(points, {0.003, 0.002});
      EXPECT_NEAR(now, before, 4e-5) << x;
      before = now;
    }
  }
}

TEST(ContactRegion, ClippedDiscAgreesWithFineSampling) {
  const double radius = 0.009;
  const ContactRegion region(box_in(DiscPad{radius}), 16);
  const PlanarPose X_HO = pose_from_finger({0.046, 0.027}, 0.9);
  Vec2 moment = Vec2::Zero();
  double torque = 0.0;
  int inside = 0;
  int all = 0;
  const int n = 800;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec2 p(radius * (2.0 * (i + 0.5) / n - 1.0),
                   radius * (2.0 * (j + 0.5) / n - 1.0));
      if (p.norm() > radius) continue;
      ++all;
      const Vec2 p_O = transform(inverse(X_HO), p);
      if (std::abs(p_O.x()) > 0.05 || std::abs(p_O.y()) > 0.03) continue;
      ++inside;
      moment += p;
      torque += p.norm();
    }
  }
  const ContactPoints points = region.at(X_HO);
  Vec2 centroid = Vec2::Zero();
  for (int k = 0; k < points.count; ++k) {
    centroid += points.weight[k] * Vec2(points.x[k], points.y[k]);
  }
  EXPECT_NEAR(points.coverage, static_cast<double>(inside) / all, 4e-3);
  EXPECT_NEAR((centroid - moment / inside).norm(), 0.0, 1e-4);
  EXPECT_NEAR(torque_about(points, Vec2::Zero()), torque / inside, 1e-4);
}

TEST(ContactRegion, ACanIsTouchedAlongALine) {
  Scene scene = box_in(DiscPad{0.009});
  scene.object.shape = CylinderShape{0.033, 0.1, Axis::kX};
  const ContactRegion region(scene, 16);
  EXPECT_NEAR(region.torque_radius(), 0.009 / 2.0, 1e-15);
  const ContactPoints points = region.at(pose_from_finger({0.01, 0.004}, 0.5));
  ASSERT_EQ(points.count, 16);
  for (int j = 0; j < points.count; ++j) {
    const Vec2 p_O = transform(inverse(pose_from_finger({0.01, 0.004}, 0.5)),
                               {points.x[j], points.y[j]});
    EXPECT_NEAR(p_O.y(), 0.0, 1e-15);
  }
  const double half_chord = std::sqrt(0.009 * 0.009 - 0.004 * 0.004);
  EXPECT_NEAR(torque_about(points, {points.x[0], points.y[0]}),
              half_chord * 2.0 * 7.5 / 16.0, 1e-12);
  EXPECT_EQ(region.at(pose_from_finger({0.0, 0.01}, 0.0)).count, 0);
  EXPECT_NEAR(region.at(pose_from_finger({0.05, 0.0}, 0.0)).coverage, 0.5, 1e-12);
  EXPECT_FALSE(region.is_isotropic());
}

// The margin changes by no more than the finger axis moves, and is positive exactly where
// the pad does not overhang.
TEST(ContactRegion, WholeMarginIsADistance) {
  const ContactRegion region(box_in(RectanglePad{{0.02, 0.01}}), 16);
  const PlanarPose centre = pose_from_finger({0.0, 0.0}, 0.3);
  ASSERT_TRUE(region.is_whole(centre));
  double last = region.whole_margin(centre);
  bool overhangs = false;
  for (int i = 1; i <= 100; ++i) {
    const PlanarPose X_HO = pose_from_finger({0.0005 * i, 0.0002 * i}, 0.3);
    const double margin = region.whole_margin(X_HO);
    EXPECT_LE(std::abs(margin - last), std::hypot(0.0005, 0.0002) + 1e-15);
    EXPECT_EQ(region.is_whole(X_HO), margin >= 0.0);
    if (region.at(X_HO).coverage < 1.0 - 1e-9) {
      EXPECT_LT(margin, 0.0);
      overhangs = true;
    }
    last = margin;
  }
  EXPECT_TRUE(overhangs);
}

TEST(ContactRegion, EvaluationUsesNoHeap) {
  const ContactRegion region(box_in(RectanglePad{{0.02, 0.01}}), 16);
  const testing::NoHeapScope scope;
  const ContactPoints points = region.at(pose_from_finger({0.047, 0.028}, 0.2));
  const long allocations = scope.allocations();
  EXPECT_EQ(allocations, testing::heap_is_counted() ? 0 : -1);
  EXPECT_GT(points.count, 0);
}

/// A rectangle and a disc said as polygons are the pads that they are.
TEST(ContactRegion, PolygonPadsAreThePadsTheyDescribe) {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  scene.object.mass = 0.1;
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 10.0;
  const auto radius_of = [&scene](const Pad& pad, int points) {
    scene.gripper.pad = pad;
    EXPECT_TRUE(check(scene).empty());
    return ContactRegion(scene, points).torque_radius();
  };
  PolygonPad disc;
  for (int i = 0; i < 40; ++i) {
    disc.outline.push_back(rotated(2.0 * std::numbers::pi * i / 40, {0.01, 0.0}));
  }
  const PolygonPad rectangle{
      {{-0.01, -0.005}, {0.01, -0.005}, {0.01, 0.005}, {-0.01, 0.005}}};
  const double of_disc = radius_of(DiscPad{0.01}, 64);
  const double of_rectangle = radius_of(RectanglePad{{0.02, 0.01}}, 64);
  for (const int points : {4, 16, 64}) {
    EXPECT_NEAR(radius_of(disc, points), of_disc, 5e-3 * of_disc) << points;
    EXPECT_NEAR(radius_of(rectangle, points), of_rectangle, 5e-3 * of_rectangle)
        << points;
  }
  // Half a disc presses on one side only, and loses no torque as it starts to leave.
  PolygonPad half;
  for (int i = 0; i <= 20; ++i) {
    half.outline.push_back(rotated(std::numbers::pi * i / 20, {0.01, 0.0}));
  }
  scene.gripper.pad = half;
  const ContactRegion region(scene, 16);
  const ContactPoints whole = region.at({});
  double centre = 0.0;
  double weight = 0.0;
  for (int j = 0; j < whole.count; ++j) {
    EXPECT_GT(whole.y[j], 0.0);
    centre += whole.weight[j] * whole.y[j];
    weight += whole.weight[j];
  }
  EXPECT_NEAR(weight, 1.0, 1e-12);
  EXPECT_NEAR(centre, 4.0 * 0.01 / (3.0 * std::numbers::pi), 3e-4);
  const ContactPoints clipped = region.at({0.0, -0.045, 0.0});
  EXPECT_LT(clipped.coverage, 1.0);
  EXPECT_GT(clipped.coverage, 0.3);
}

TEST(ContactRegion, PolygonPadsAreChecked) {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.1, 0.03}};
  scene.object.mass = 0.1;
  scene.gripper.grip_force = 10.0;
  scene.gripper.pad = PolygonPad{{{0, 0}, {0.01, 0}, {0, 0.01}}};
  EXPECT_TRUE(check(scene).empty());
  scene.gripper.pressure.profile = PressureProfile::kHertz;
  EXPECT_EQ(check(scene).size(), 1u);
  scene.gripper.pressure = {};
  scene.gripper.pad = PolygonPad{{{0, 0}, {0, 0.01}, {0.01, 0}}};
  EXPECT_EQ(check(scene).size(), 1u);
  scene.gripper.pad = PolygonPad{};
  EXPECT_EQ(check(scene).size(), 1u);
}

}  // namespace
}  // namespace prehensile
