#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "tests/mechanics/instant_cases.h"

namespace prehensile {
namespace {

using testing::disc_grasp;
using testing::grasp_of;
using testing::line_drive;
using testing::point_drive;
using testing::square_grasp;
using testing::told;

constexpr double kTight = 1e-9;

PlanarInstant certified(const PlanarGrasp& grasp, const PlanarDrive& drive) {
  const PlanarInstant answer = solve_planar(grasp, drive);
  const Certificate certificate = certify(grasp, drive, answer);
  EXPECT_TRUE(certificate.holds()) << name(answer.status) << ": " << told(certificate);
  return answer;
}

// Closed forms. N = 10 N per finger, mu = 0.5 in words; capacity 2 mu N in the code.

TEST(PlanarClosedForms, StraightSlideOfALinePusher) {
  const double capacity = 20.0;
  const double weight = 4.0;
  PlanarGrasp grasp = square_grasp(4, 0.006, capacity);
  const Vec2 face(-0.04, 0.0);
  const double d_com = 0.05;
  grasp.w_g = wrench_of(face + Vec2(d_com, 0.007), {0.0, -weight});
  const PlanarDrive drive = line_drive(face, 0.03, {1.0, 0.0}, 0.5, {0.01, 0.0});
  const PlanarInstant answer = certified(grasp, drive);
  EXPECT_EQ(answer.status, InstantStatus::kMoves);
  EXPECT_NEAR((answer.V_HO - drive.V_HP).norm(), 0.0, 1e-15);
  EXPECT_NEAR(answer.pusher[0].normal_force, (20.0 + 4.0 * 5.0 / 3.0) / 2.0, kTight);
  EXPECT_NEAR(answer.pusher[1].normal_force, (20.0 - 4.0 * 5.0 / 3.0) / 2.0, kTight);
  EXPECT_NEAR(answer.pusher[0].tangential_force + answer.pusher[1].tangential_force,
              weight, kTight);
  EXPECT_EQ(answer.pusher[0].mode, ContactMode::kStick);
}

TEST(PlanarClosedForms, StraightSlideWithAccelerationAddsInertia) {
  PlanarGrasp grasp = square_grasp(4, 0.006, 20.0);
  const double mass = 0.4;
  const double a = 3.0;
  const Vec2 com(0.01, 0.0);
  grasp.inertia << mass, 0.0, -mass * com.y(),  //
      0.0, mass, mass * com.x(),                //
      -mass * com.y(), mass * com.x(), 2e-4 + mass * com.squaredNorm();
  const PlanarDrive line = line_drive({-0.04, 0.0}, 0.03, {1.0, 0.0}, 0.5, {a, 0.0});
  EXPECT_NEAR(certified(grasp, line).push_force, 20.0 + mass * a, kTight);
  const PlanarDrive point = point_drive({-0.04, 0.0}, {1.0, 0.0}, 0.5, {a, 0.0});
  EXPECT_NEAR(certified(grasp, point).push_force, 20.0 + mass * a, 1e-7);
}

TEST(PlanarClosedForms, SlipDownAVerticalLinePusher) {
  const double capacity = 20.0;
  for (const double mu_p : {0.0, 0.1, 0.3, 0.6}) {
    for (const double weight : {mu_p * capacity * 1.001 + 0.1, 13.0, 19.0}) {
      if (weight < mu_p * capacity) continue;
      PlanarGrasp grasp = square_grasp(4, 0.006, capacity);
      grasp.w_g = wrench_of({0.0, 0.0}, {0.0, -weight});
      const PlanarDrive drive =
          line_drive({-0.01, 0.0}, 0.04, {1.0, 0.0}, mu_p, {0.01, 0.0});
      const PlanarInstant answer = certified(grasp, drive);
      const double phi =
          std::asin(weight / (capacity * std::sqrt(1.0 + mu_p * mu_p))) - std::atan(mu_p);
      const Vec2 v = answer.V_HO.head<2>();
      ASSERT_EQ(answer.status, InstantStatus::kMoves);
      EXPECT_NEAR(std::atan2(-v.y(), v.x()), phi, kTight);
      EXPECT_NEAR(answer.pusher[0].normal_force + answer.pusher[1].normal_force,
                  capacity * std::cos(phi), capacity * kTight);
      EXPECT_EQ(answer.pusher[0].mode, ContactMode::kSlipMinus);
    }
  }
}

TEST(PlanarClosedForms, PivotOfATwoPointPad) {
  const double capacity = 20.0;
  const double b = 0.004;
  for (const double d : {0.001, 0.01, 0.05, 0.3}) {
    const PlanarGrasp grasp = grasp_of({{0.0, b}, {0.0, -b}}, capacity);
    const PlanarDrive drive = point_drive({d, 0.0}, {0.0, 1.0}, 0.4, {0.0, 0.01});
    const PlanarInstant answer = certified(grasp, drive);
    EXPECT_NEAR(answer.push_force, capacity * b / std::hypot(b, d), capacity * kTight);
    // Centre of rotation: v_y + omega x = 0 at x = -b^2/d.
    EXPECT_NEAR(-answer.V_HO[1] / answer.V_HO[2], -b * b / d, kTight * b * b / d);
  }
}

TEST(PlanarClosedForms, HoldingCapacityOfATwoPointPad) {
  const double capacity = 20.0;
  const double b = 0.004;
  for (const double d : {0.0, 0.001, 0.01, 0.05}) {
    const double limit = capacity * b / std::hypot(b, d);
    for (const double share : {0.5, 0.999999, 1.000001, 1.5}) {
      PlanarGrasp grasp = grasp_of({{0.0, b}, {0.0, -b}}, capacity);
      grasp.w_g = wrench_of({d, 0.0}, {0.0, -share * limit});
      EXPECT_EQ(gravity_slack(grasp) > 0.0, share < 1.0) << d << " " << share;
      // A pusher that leaves the object: it stays only if the pads hold it.
      const PlanarDrive drive = point_drive({0.02, 0.0}, {-1.0, 0.0}, 0.3, {0.01, 0.0});
      const PlanarInstant answer = certified(grasp, drive);
      EXPECT_EQ(answer.status,
                share < 1.0 ? InstantStatus::kSeparated : InstantStatus::kDynamic);
    }
  }
}

TEST(PlanarClosedForms, DiscPadsConvergeToTheExactLimitSurface) {
  // Pivot force over capacity and lever of the centre of rotation over the radius, for a
  // push at d/R from the centre of a uniform disc (elliptic integrals).
  const double exact[4][3] = {{1.0, 0.5258, 0.5471},
                              {2.0, 0.3093, 0.3132},
                              {3.0, 0.2145, 0.2158},
                              {5.0, 0.1316, 0.1319}};
  const double R = 0.009;
  for (const auto& [ratio, force, lever] : exact) {
    const PlanarDrive drive = point_drive({ratio * R, 0.0}, {0.0, 1.0}, 0.9, {0.0, 0.01});
    const PlanarInstant coarse = certified(disc_grasp(16, R, 1.0), drive);
    const PlanarInstant fine = certified(disc_grasp(96, R, 1.0), drive);
    EXPECT_NEAR(fine.push_force, force, 4e-3 * force);
    EXPECT_NEAR(std::hypot(fine.V_HO[0], fine.V_HO[1]) / (R * std::abs(fine.V_HO[2])),
                lever, 0.03 * lever);
    EXPECT_NEAR(coarse.push_force, force, 0.02 * force);
  }
}

}  // namespace
}  // namespace prehensile
