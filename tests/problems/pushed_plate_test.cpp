#include "problems/pushed_plate.h"

#include <gtest/gtest.h>

#include "scene/outline.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

constexpr double kHalf = 0.04;  // [m] of the square

Plate square_plate(int points) {
  return uniform_plate(
      {{-kHalf, -kHalf}, {kHalf, -kHalf}, {kHalf, kHalf}, {-kHalf, kHalf}}, points);
}

std::vector<TipPlaces> straight(const Vec2& from, const Vec2& to) {
  return {{from, from}, {to, to}};
}

TEST(UniformPlate, CarriesItsLoadAtTheCentroidWithTheRightTorque) {
  const Plate square = square_plate(48);
  EXPECT_LE(square.support.size(), 90U);
  EXPECT_LT(square.centre().norm(), 1e-12);
  EXPECT_NEAR(square.torque_radius(), 0.76519571 * kHalf, 5e-4 * kHalf);
  const Plate disc = uniform_plate(
      outline_of(CylinderShape{.radius = 0.03, .length = 0.01, .axis = Axis::kZ}), 60);
  EXPECT_NEAR(disc.torque_radius(), 0.02, 2e-5);
  const std::vector<Vec2> triangle = {{0.0, 0.0}, {0.15, 0.0}, {0.0, 0.15}};
  const Plate right_angle = uniform_plate(triangle, 48);
  EXPECT_LT((right_angle.centre() - Vec2(0.05, 0.05)).norm(), 1e-9);
}

TEST(LoadedPlate, MovesTheLoadToTheEdgeAndKeepsItsCentre) {
  const std::vector<Vec2> triangle = {{0.0, 0.0}, {0.15, 0.0}, {0.0, 0.15}};
  for (const Plate& plate : {square_plate(48), uniform_plate(triangle, 48)}) {
    double last = 0.0;
    for (const double p : {-1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 3.0}) {
      const Plate loaded = loaded_plate(plate, p);
      double sum = 0.0;
      for (const double share : loaded.shares) {
        EXPECT_GT(share, 0.0);
        sum += share;
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);
      EXPECT_GT(loaded.torque_radius(), last) << p;
      last = loaded.torque_radius();
      const double slack = p == 3.0 || p == -1.0 ? 1e-3 : 1e-9;  // least loads
      EXPECT_LT((loaded.centre() - plate.centre()).norm(), slack) << p;
      if (p == 0.0) {
        EXPECT_NEAR(last, plate.torque_radius(), 1e-12);
      }
    }
  }
}

TEST(TipGap, IsTheSignedDistanceWithTheInwardNormal) {
  const Plate plate = square_plate(9);
  const TipGap outside = tip_gap(plate, {-0.05, 0.01}, 0.004);
  EXPECT_NEAR(outside.gap, 0.006, 1e-12);
  EXPECT_LT((outside.n_O - Vec2(1.0, 0.0)).norm(), 1e-12);
  const TipGap inside = tip_gap(plate, {-0.039, 0.01}, 0.0);
  EXPECT_NEAR(inside.gap, -0.001, 1e-12);
  EXPECT_LT((inside.n_O - Vec2(1.0, 0.0)).norm(), 1e-12);
  const TipGap on = tip_gap(plate, {-kHalf, 0.01}, 0.0);
  EXPECT_NEAR(on.gap, 0.0, 1e-15);
  EXPECT_LT((on.n_O - Vec2(1.0, 0.0)).norm(), 1e-12);
  const TipGap corner = tip_gap(plate, {-0.043, 0.044}, 0.001);
  EXPECT_NEAR(corner.gap, 0.004, 1e-12);
  EXPECT_LT((corner.n_O - Vec2(0.6, -0.8)).norm(), 1e-12);
}

TEST(PushPlate, StraightThroughTheCentreMovesWithoutTurning) {
  const Tips tip{.count = 1, .radius = 0.005, .mu = 0.3};
  for (const SupportModel model : {SupportModel::kPoints, SupportModel::kEllipsoid}) {
    const PushedPlate end = push_plate(square_plate(16), model, tip, {},
                                       straight({-0.06, 0.0}, {-0.02, 0.0}));
    EXPECT_NEAR(end.X_WO.x, 0.025, 1e-9);
    EXPECT_NEAR(end.X_WO.y, 0.0, 1e-9);
    EXPECT_NEAR(end.X_WO.theta, 0.0, 1e-9);
    EXPECT_TRUE(end.touched && end.kept_contact);
    EXPECT_FALSE(end.slipped);
    EXPECT_EQ(end.failures, 0);
  }
}

TEST(PushPlate, ATipThatMissesMovesNothing) {
  const Tips tip{.count = 1, .radius = 0.005, .mu = 0.3};
  const PushedPlate end = push_plate(square_plate(16), SupportModel::kPoints, tip, {},
                                     straight({-0.06, 0.06}, {0.06, 0.06}));
  EXPECT_EQ(end.X_WO, PlanarPose{});
  EXPECT_FALSE(end.touched);
}

TEST(PushPlate, TwoTipsCarryThePlateThroughAGentleTurn) {
  const Tips tips{.count = 2, .radius = 0.0, .mu = 0.5};
  std::vector<TipPlaces> path;
  const Vec2 centre(0.0, 0.4);
  constexpr double kTurn = 0.2;
  for (int i = 0; i <= 40; ++i) {
    const auto turned = [&](const Vec2& p) {
      return Vec2(centre + rotated(kTurn * i / 40.0, p - centre));
    };
    path.push_back({turned({-kHalf, -0.025}), turned({-kHalf, 0.025})});
  }
  const PushedPlate end =
      push_plate(square_plate(36), SupportModel::kPoints, tips, {}, path);
  const Vec2 carried = centre + rotated(kTurn, -centre);
  EXPECT_LT((translation(end.X_WO) - carried).norm(), 2e-4);
  EXPECT_NEAR(end.X_WO.theta, kTurn, 2e-3);
}

/// A tip that sticks at distance a behind the centre of an ellipsoid of torque radius c
/// turns the plate by the law tan(phi / 2) = tan(phi_0 / 2) exp(a s / (a^2 + c^2)), phi
/// the angle from the lever to the direction of the push, s its length.
TEST(PushPlate, StickingTipFollowsItsClosedForm) {
  const Plate plate = square_plate(36);
  const double c = plate.torque_radius();
  const Tips tip{.count = 1, .radius = 0.0, .mu = 20.0};
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    const Vec2 contact(-kHalf, random.in(-0.03, 0.03));
    const double a = contact.norm();
    const double lever = std::atan2(-contact.y(), -contact.x());
    const double direction = random.in(-0.6, 0.6);
    const double phi_0 = direction - lever;
    const double s = 0.02;
    const double phi =
        2.0 * std::atan(std::tan(0.5 * phi_0) * std::exp(a * s / (a * a + c * c)));
    for (const double step : {1e-3, 1e-4, 1e-5}) {  // of first order
      const Vec2 to = contact + s * rotated(direction, Vec2(1.0, 0.0));
      const PushedPlate end = push_plate(plate, SupportModel::kEllipsoid, tip, {},
                                         straight(contact, to), step);
      EXPECT_FALSE(end.slipped);
      EXPECT_NEAR(end.X_WO.theta, phi_0 - phi, 4.0 * step) << i << " step " << step;
    }
  }
}

TEST(PushPlate, MirroredPushesGiveMirroredEnds) {
  const Plate plate = square_plate(36);
  const Tips tip{.count = 1, .radius = 0.005, .mu = 0.25};
  Random random(2);
  int slipped = 0;
  for (int i = 0; i < 100; ++i) {
    const double y = random.in(-0.035, 0.035);
    const double dy = random.in(-0.03, 0.03);
    for (const SupportModel model : {SupportModel::kPoints, SupportModel::kEllipsoid}) {
      const PushedPlate up =
          push_plate(plate, model, tip, {}, straight({-0.05, y}, {-0.01, y + dy}));
      const PushedPlate down =
          push_plate(plate, model, tip, {}, straight({-0.05, -y}, {-0.01, -y - dy}));
      EXPECT_NEAR(up.X_WO.x, down.X_WO.x, 1e-7) << i;
      EXPECT_NEAR(up.X_WO.y, -down.X_WO.y, 1e-7) << i;
      EXPECT_NEAR(up.X_WO.theta, -down.X_WO.theta, 1e-6) << i;
      EXPECT_EQ(up.failures, 0);
      slipped += up.slipped;
    }
  }
  EXPECT_GT(slipped, 50);
}

}  // namespace
}  // namespace prehensile
