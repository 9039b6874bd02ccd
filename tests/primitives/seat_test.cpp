#include "primitives/seat.h"

#include <gtest/gtest.h>

namespace prehensile {
namespace {

/// A box of 100 x 60 mm with a wall at -x, a short line at -y and a point at +x.
Model box() {
  Scene scene;
  scene.object.shape = BoxShape{{0.1, 0.06, 0.02}};
  scene.object.mass = 0.2;
  scene.gripper.pad = DiscPad{0.009};
  scene.gripper.friction = {0.5, 0.5};
  scene.gripper.grip_force = 20.0;
  scene.pushers.resize(3);
  scene.pushers[0] = {.name = "wall", .feature = LineFeature{}, .friction = 0.4};
  scene.pushers[1] = {.name = "edge", .feature = LineFeature{0.04}, .friction = 0.4};
  scene.pushers[1].normal_angle = 0.5 * M_PI;
  scene.pushers[2] = {.name = "pin", .feature = PointFeature{}, .friction = 0.4};
  scene.pushers[2].normal_angle = M_PI;
  return prepare(scene);
}

class SeatTest : public ::testing::Test {
 protected:
  SeatGeometry geometry(int contact, double place) const {
    return {model_, model_.contacts[contact], place};
  }
  /// Touching points on the object, seen in O.
  Vec2 on_object(const SeatGeometry& geometry, const Seat& seat, const Vec2& q,
                 int k = 0) const {
    return transform(inverse(geometry.object(seat, q)), geometry.touch(seat, q).p_P[k]);
  }
  /// The touching point of the object moves along the pusher with the slide rate, never
  /// along the normal.
  void expect_no_gap(const SeatGeometry& geometry, const Seat& seat, const Vec2& q,
                     const Vec2& rate) const {
    const double d = 1e-6;
    const Vec2 p_O = on_object(geometry, seat, q);
    const Vec2 before = transform(geometry.object(seat, q - d * rate), p_O);
    const Vec2 after = transform(geometry.object(seat, q + d * rate), p_O);
    const Vec2 velocity = (after - before) / (2.0 * d);
    const Vec2 n = geometry.touch(seat, q).n_P;
    EXPECT_NEAR(velocity.dot(n), 0.0, 1e-9);
    EXPECT_NEAR(velocity.dot(perp(n)), rate[0], 1e-9);
  }

  const Model model_ = box();
};

TEST_F(SeatTest, PushesBeginWithTheObjectInThePusherFrame) {
  for (const int contact : {0, 1, 2}) {
    const SeatGeometry g = geometry(contact, 0.01);
    EXPECT_EQ(g.object(g.first(), Vec2::Zero()), PlanarPose());
    const PushContact::Segment segment = model_.contacts[contact].segment(0.01);
    const SeatGeometry::Touch touch = g.touch(g.first(), Vec2::Zero());
    EXPECT_EQ(touch.count, contact == 2 ? 1 : 2);
    EXPECT_NEAR((touch.p_P[0] - segment.a).norm(), 0.0, 1e-16);
    EXPECT_NEAR((touch.p_P[1] - segment.b).norm(), 0.0, 1e-16);
  }
}

TEST_F(SeatTest, CoordinatesKeepContact) {
  const SeatGeometry wall = geometry(0, 0.0);
  expect_no_gap(wall, wall.first(), {0.01, 0.0}, {0.3, 0.0});
  const SeatGeometry pin = geometry(2, 0.005);
  expect_no_gap(pin, pin.first(), {0.01, 0.4}, {0.3, -2.0});
  const SeatGeometry edge = geometry(1, 0.005);
  for (const int end : {0, 1}) {
    expect_no_gap(wall, wall.tipped(wall.first(), 0.01, end), {0.01, 0.4}, {0.3, 2.0});
    expect_no_gap(edge, edge.tipped(edge.first(), 0.01, end), {0.01, 0.4}, {0.3, 2.0});
  }
}

TEST_F(SeatTest, WallsTipAboutTheFaceShortLinesAboutThemselves) {
  const SeatGeometry wall = geometry(0, 0.0);
  EXPECT_EQ(wall.tipped(wall.first(), 0.01, 1).kind, SeatKind::kFaceEnd);
  const SeatGeometry edge = geometry(1, 0.005);
  EXPECT_EQ(edge.tipped(edge.first(), 0.01, 1).kind, SeatKind::kPusherPoint);
  // Slid so far that the face ends above the line.
  EXPECT_EQ(edge.tipped(edge.first(), -0.04, 1).kind, SeatKind::kFaceEnd);
  EXPECT_EQ(edge.tipped(edge.first(), -0.04, 0).kind, SeatKind::kPusherPoint);
}

TEST_F(SeatTest, TippingAndLyingDownAgainLeavesThePoseAlone) {
  for (const int contact : {0, 1}) {
    const SeatGeometry g = geometry(contact, 0.005);
    for (const double slide : {0.01, -0.012}) {
      const PlanarPose flat = g.object(g.first(), {slide, 0.0});
      for (const int end : {0, 1}) {
        const Seat tipped = g.tipped(g.first(), slide, end);
        EXPECT_EQ(tipped.side, end == 1 ? 1 : -1);
        const PlanarPose same = g.object(tipped, Vec2::Zero());
        EXPECT_NEAR(same.x, flat.x, 1e-16);
        EXPECT_NEAR(same.y, flat.y, 1e-16);
        const Seat again = g.flush(tipped, 0.002);
        const PlanarPose moved = g.object(again, Vec2::Zero());
        const Vec2 shift = (slide + 0.002) * model_.contacts[contact].t;
        EXPECT_NEAR(moved.x, shift.x(), 1e-16);
        EXPECT_NEAR(moved.y, shift.y(), 1e-16);
        // The allowed tilt lifts the other end off the pusher.
        const Vec2 tilt(0.0, 0.1 * tipped.side);
        EXPECT_GT(g.clearance(tipped, tilt), -1e-12);
        EXPECT_LT(g.clearance(tipped, -tilt), -1e-4);
      }
    }
  }
}

TEST_F(SeatTest, RoomToTheEndOfTheFace) {
  const SeatGeometry pin = geometry(2, 0.005);  // t of +x points along -y or +y
  EXPECT_NEAR(pin.room(pin.first(), 0.0), 0.025, 1e-15);
  EXPECT_NEAR(pin.room(pin.first(), -0.025), 0.0, 1e-15);
  const SeatGeometry edge = geometry(1, 0.0);
  EXPECT_NEAR(edge.room(edge.first(), 0.0), 0.04, 1e-15);
  EXPECT_NEAR(edge.room(edge.first(), 0.07), 0.0, 1e-15);
  EXPECT_NEAR(edge.room(edge.first(), -0.05), 0.02, 1e-15);
}

TEST_F(SeatTest, ATurnOfAQuarterBringsTheNextFaceToTheWall) {
  const SeatGeometry wall = geometry(0, 0.0);
  const Seat tipped = wall.tipped(wall.first(), 0.0, 1);
  EXPECT_GT(wall.clearance(tipped, {0.0, 0.5 * M_PI - 1e-3}), 0.0);
  EXPECT_LT(wall.clearance(tipped, {0.0, 0.5 * M_PI + 1e-3}), 0.0);
}

}  // namespace
}  // namespace prehensile
