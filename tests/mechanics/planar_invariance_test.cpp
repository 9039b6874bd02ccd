#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/random_instants.h"
#include "tests/mechanics/instant_cases.h"

namespace prehensile {
namespace {

// Invariances: the same question in other words.

class Rephrased : public ::testing::Test {
 protected:
  /// Calls check(grasp, drive, answer) for many solvable instants.
  template <class CheckAnswer>
  void for_each_instant(CheckAnswer check) {
    for (int i = 0; i < 2000; ++i) {
      const RandomInstant instant = random_instant(11, i, {.points_per_pad = 8});
      const PlanarInstant answer = solve_planar(instant.grasp, instant.drive);
      if (answer.status == InstantStatus::kMoves) check(instant, answer);
    }
  }
};

TEST_F(Rephrased, RigidMotion) {
  const PlanarPose X{0.31, -0.12, 2.1};
  for_each_instant([&](const RandomInstant& q, const PlanarInstant& a) {
    const PlanarInstant b =
        solve_planar(testing::moved(X, q.grasp), testing::moved(X, q.drive));
    ASSERT_EQ(b.status, a.status);
    EXPECT_NEAR((b.V_HO - testing::moved_twist(X, a.V_HO)).norm(), 0.0,
                1e-8 * a.V_HO.norm());
    EXPECT_NEAR((b.w_push - testing::moved_wrench(X, a.w_push)).norm(), 0.0,
                1e-8 * q.grasp.capacity());
  });
}

TEST_F(Rephrased, Mirror) {
  for_each_instant([&](const RandomInstant& q, const PlanarInstant& a) {
    const PlanarInstant b =
        solve_planar(testing::mirrored(q.grasp), testing::mirrored(q.drive));
    ASSERT_EQ(b.status, a.status);
    const PlanarTwist V(a.V_HO[0], -a.V_HO[1], -a.V_HO[2]);
    EXPECT_NEAR((b.V_HO - V).norm(), 0.0, 1e-8 * V.norm());
    EXPECT_NEAR(b.push_force, a.push_force, 1e-8 * q.grasp.capacity());
  });
}

TEST_F(Rephrased, ForcesRatesAndLengthsScale) {
  const double force = 7.0e3;
  const double rate = 2.0e-4;
  const double length = 31.0;
  for_each_instant([&](RandomInstant q, const PlanarInstant& a) {
    for (int j = 0; j < q.grasp.count; ++j) {
      q.grasp.x[j] *= length;
      q.grasp.y[j] *= length;
      q.grasp.bound[j] *= force;
    }
    q.grasp.w_g =
        force * PlanarWrench(q.grasp.w_g[0], q.grasp.w_g[1], length * q.grasp.w_g[2]);
    for (Vec2& p : q.drive.p_HC) p *= length;
    q.drive.V_HP =
        rate * PlanarTwist(q.drive.V_HP[0], q.drive.V_HP[1], q.drive.V_HP[2] / length);
    const PlanarInstant b = solve_planar(q.grasp, q.drive);
    ASSERT_EQ(b.status, a.status);
    EXPECT_NEAR(b.push_force, force * a.push_force, 1e-8 * q.grasp.capacity());
    EXPECT_NEAR((b.V_HO.head<2>() - rate * a.V_HO.head<2>()).norm(), 0.0,
                1e-8 * rate * a.V_HO.norm());
    EXPECT_NEAR(b.V_HO[2], rate / length * a.V_HO[2],
                1e-8 * rate / length * a.V_HO.norm());
  });
}

TEST_F(Rephrased, PointsSplitInTwoCountTheSame) {
  for_each_instant([&](RandomInstant q, const PlanarInstant& a) {
    const int n = q.grasp.count;
    for (int j = 0; j < n; ++j) {
      q.grasp.x[n + j] = q.grasp.x[j];
      q.grasp.y[n + j] = q.grasp.y[j];
      q.grasp.bound[n + j] = 0.25 * q.grasp.bound[j];
      q.grasp.bound[j] *= 0.75;
    }
    q.grasp.count = 2 * n;
    const PlanarInstant b = solve_planar(q.grasp, q.drive);
    ASSERT_EQ(b.status, a.status);
    EXPECT_NEAR((b.V_HO - a.V_HO).norm(), 0.0, 1e-8 * a.V_HO.norm());
    EXPECT_NEAR(b.push_force, a.push_force, 1e-8 * q.grasp.capacity());
    EXPECT_TRUE(certify(q.grasp, q.drive, b).holds());
  });
}

TEST_F(Rephrased, AnyTwistBoundsThePushForceFromAbove) {
  double k = 0.0;
  for_each_instant([&](const RandomInstant& q, const PlanarInstant& a) {
    if (a.push_force < 1e-6 * q.grasp.capacity()) return;
    const PlanarWrench p = a.w_push / a.push_force;
    EXPECT_NEAR(force_upper_bound(q.grasp, p, a.V_HO), a.push_force,
                1e-8 * q.grasp.capacity());
    for (int trial = 0; trial < 20; ++trial) {
      k += 1.0;
      const PlanarTwist u(std::sin(1.3 * k), std::cos(2.7 * k),
                          100.0 * std::sin(3.1 * k));
      EXPECT_GE(force_upper_bound(q.grasp, p, u),
                a.push_force - 1e-9 * q.grasp.capacity());
    }
  });
}

TEST_F(Rephrased, SequencesGiveTheSameAnswersAsSingleInstants) {
  for_each_instant([&](RandomInstant q, const PlanarInstant&) {
    PlanarWarmStart warm;
    for (int step = 0; step < 6; ++step) {
      const PlanarPose turn{1e-4, -2e-4, 0.05};
      q.grasp.w_g = testing::moved_wrench(turn, q.grasp.w_g);
      q.drive = testing::moved(turn, q.drive);
      const PlanarInstant cold = solve_planar(q.grasp, q.drive);
      const PlanarInstant followed = solve_planar(q.grasp, q.drive, {}, &warm);
      ASSERT_EQ(followed.status, cold.status);
      if (cold.status != InstantStatus::kMoves) break;
      EXPECT_NEAR((followed.V_HO - cold.V_HO).norm(), 0.0, 1e-7 * cold.V_HO.norm());
    }
  });
}

}  // namespace
}  // namespace prehensile
