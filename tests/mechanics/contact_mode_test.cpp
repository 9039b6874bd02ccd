#include "mechanics/contact_mode.h"

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/random_instants.h"
#include "tests/mechanics/instant_cases.h"

namespace prehensile {
namespace {

using testing::point_drive;

/// The mode of an answer: which ends carry load and whether they slip.
bool mode_of(const PlanarInstant& answer, ContactModeOfPush& mode) {
  int loaded = -1;
  int count = 0;
  for (int i = 0; i < answer.pusher_count; ++i) {
    if (answer.pusher[i].mode == ContactMode::kOpen) continue;
    loaded = i;
    ++count;
  }
  if (count == 0) return false;
  using Load = ContactModeOfPush::Load;
  mode.load = count == 2 ? Load::kBoth : loaded == 0 ? Load::kFirst : Load::kSecond;
  const ContactMode found = answer.pusher[loaded].mode;
  mode.slip = found == ContactMode::kStick ? 0 : found == ContactMode::kSlipPlus ? 1 : -1;
  return true;
}

// Asked for the mode that the instant is in, the answer is that of the instant.
TEST(ContactModeOfPush, TheModeOfAnInstantGivesItsMotionAndForces) {
  int compared = 0;
  for (int i = 0; i < 600; ++i) {
    const RandomInstant q = random_instant(61, i, {.pusher_points = 1 + i % 2});
    const PlanarInstant answer = solve_planar(q.grasp, q.drive);
    ContactModeOfPush mode;
    if (answer.status != InstantStatus::kMoves || !mode_of(answer, mode)) continue;
    const MotionInMode motion =
        solve_planar_in_mode(q.grasp, q.drive, mode, &answer.V_HO);
    ASSERT_TRUE(motion.exists) << i << " load " << static_cast<int>(mode.load) << " slip "
                               << mode.slip;
    EXPECT_TRUE(motion.held && motion.advances) << i;
    const double force = q.grasp.capacity();
    EXPECT_LT((motion.V_HO - answer.V_HO).norm(), 1e-7 * answer.V_HO.norm()) << i;
    for (int k = 0; k < answer.pusher_count; ++k) {
      EXPECT_NEAR(motion.normal_force[k], answer.pusher[k].normal_force, 1e-7 * force);
      EXPECT_NEAR(motion.tangential_force[k], answer.pusher[k].tangential_force,
                  1e-7 * force);
    }
    ++compared;
  }
  EXPECT_GT(compared, 400);
}

// Sweeping the pusher's friction through the border between stick and slip: the force of
// the sticking mode does not know the friction, the slip of the slipping one passes
// smoothly through zero where the cone is met.
TEST(ContactModeOfPush, IsSmoothThroughItsEnd) {
  const PlanarGrasp grasp = testing::disc_grasp(16, 0.01, 20.0);
  PlanarDrive drive = point_drive({-0.03, 0.008}, {1.0, 0.0}, 0.5, {1.0, 0.4});
  const MotionInMode stick = solve_planar_in_mode(grasp, drive, {});
  ASSERT_TRUE(stick.exists);
  const double ratio = stick.tangential_force[0] / stick.normal_force[0];
  const int slip = ratio > 0.0 ? -1 : 1;
  const double border = std::abs(ratio);
  double last = 0.0;
  for (int k = -3; k <= 3; ++k) {
    drive.mu = border + 0.01 * k;
    const MotionInMode moved = solve_planar_in_mode(
        grasp, drive, {ContactModeOfPush::Load::kFirst, slip}, &stick.V_HO);
    ASSERT_TRUE(moved.exists);
    const Vec2 c = point_velocity(moved.V_HO - drive.V_HP, drive.p_HC[0]);
    EXPECT_NEAR(c.dot(drive.n_H), 0.0, 1e-12);
    const double rate = slip * c.dot(drive.t_H());
    if (k == 0) {
      EXPECT_NEAR(rate, 0.0, 1e-8);
    } else {
      EXPECT_EQ(rate > 0.0, k < 0) << k;  // beyond the border it points the wrong way
    }
    if (k > -3) {
      EXPECT_LT(rate, last);
    }
    last = rate;
  }
}

TEST(ContactModeOfPush, EllipsoidAgreesWithItsInstant) {
  const LimitSurface surface{20.0, 0.006};
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const RandomInstant q = random_instant(62, i, {.pusher_points = 1 + i % 2});
    const PlanarInstant answer = solve_limit_surface(surface, q.grasp.w_g, q.drive);
    ContactModeOfPush mode;
    if (answer.status != InstantStatus::kMoves || !mode_of(answer, mode)) continue;
    const MotionInMode motion =
        solve_limit_surface_in_mode(surface, q.grasp.w_g, q.drive, mode);
    ASSERT_TRUE(motion.exists) << i;
    EXPECT_LT((motion.V_HO - answer.V_HO).norm(), 1e-9 * answer.V_HO.norm()) << i;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST(ContactModeOfPush, DoesNotExistWithoutFrictionOrMotion) {
  PlanarGrasp none;
  none.count = 0;
  PlanarDrive drive = point_drive({-0.03, 0.0}, {1.0, 0.0}, 0.5, {1.0, 0.0});
  EXPECT_FALSE(solve_planar_in_mode(none, drive, {}).exists);
  const PlanarGrasp grasp = testing::disc_grasp(16, 0.01, 20.0);
  drive.V_HP.setZero();
  EXPECT_FALSE(solve_planar_in_mode(grasp, drive, {}).exists);
  EXPECT_FALSE(
      solve_limit_surface_in_mode({0.0, 0.01}, PlanarWrench::Zero(), drive, {}).exists);
}

}  // namespace
}  // namespace prehensile
