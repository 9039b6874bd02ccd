#include "primitives/push.h"

#include <gtest/gtest.h>

namespace prehensile {
namespace {

const PlanarPose kStart{0.012, -0.03, 0.7};
const LinearPush kPush{0, 0.01, {0.6, 0.8}, 0.04, -0.5};

TEST(Push, PusherStartsWhereTheObjectIs) {
  const PlanarPose X_HP = pusher_pose(kPush, kStart, 0.0);
  EXPECT_NEAR(X_HP.x, kStart.x, 1e-16);
  EXPECT_NEAR(X_HP.y, kStart.y, 1e-16);
  EXPECT_EQ(X_HP.theta, kStart.theta);
}

TEST(Push, FingerAxisRunsStraightInThePusher) {
  const Vec2 first = finger_in_object(kStart);
  for (const double s : {0.25, 0.5, 1.0}) {
    const PlanarPose X_HP = pusher_pose(kPush, kStart, s);
    EXPECT_NEAR((finger_in_object(X_HP) - (first - 0.04 * s * kPush.e)).norm(), 0.0,
                1e-16);
    EXPECT_NEAR(X_HP.theta, kStart.theta - 0.5 * s, 1e-16);
  }
}

TEST(Push, TwistIsTheDerivativeOfThePose) {
  const Vec2 p_PQ(0.03, -0.02);  // any point of the pusher
  const double d = 1e-6;
  for (const double s : {0.1, 0.6}) {
    const Vec2 before = transform(pusher_pose(kPush, kStart, s - d), p_PQ);
    const Vec2 after = transform(pusher_pose(kPush, kStart, s + d), p_PQ);
    const Vec2 here = transform(pusher_pose(kPush, kStart, s), p_PQ);
    const Vec2 velocity = point_velocity(pusher_twist(kPush, kStart, s), here);
    EXPECT_NEAR((velocity - (after - before) / (2.0 * d)).norm(), 0.0, 1e-11);
  }
}

TEST(Push, NamedPrimitivesAreLinearPushes) {
  const LinearPush slide = as_linear(Slide{2, 0.01, {0.0, 1.0}, 0.03, 0.1});
  EXPECT_EQ(slide.contact, 2);
  EXPECT_EQ(slide.place, 0.01);
  EXPECT_EQ(slide.travel, 0.03);
  EXPECT_EQ(slide.turn, 0.0);
  const LinearPush pivot = as_linear(Pivot{1, -0.02, 0.4, 1e-3});
  EXPECT_EQ(pivot.contact, 1);
  EXPECT_EQ(pivot.travel, 0.0);
  EXPECT_EQ(pivot.turn, 0.4);
  EXPECT_EQ(contact_of(Roll{.contact = 3, .travel = 0.01}), 3);
}

TEST(Push, NamesOfMotions) {
  EXPECT_STREQ(kind_name(0.01, 0.0, 0.0), "slide");
  EXPECT_STREQ(kind_name(0.0, -0.2, 0.0), "pivot");
  EXPECT_STREQ(kind_name(0.0, 0.0, 0.3), "roll");
  EXPECT_STREQ(kind_name(0.01, 0.2, 0.0), "push");
  EXPECT_STREQ(kind_name(1e-7, 0.2, 0.0), "pivot");
  EXPECT_STREQ(kind_name(1e-7, 0.2, 0.0, 1e-8), "push");
}

}  // namespace
}  // namespace prehensile
