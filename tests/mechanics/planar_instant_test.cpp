#include "mechanics/planar_instant.h"

#include <gtest/gtest.h>

#include "problems/random_instants.h"
#include "tests/mechanics/instant_cases.h"
#include "tests/support/no_heap.h"

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

TEST(PlanarInstant, RandomInstantsEndWithEvidence) {
  int count[9] = {};
  int refused = 0;
  const int total = 100000;
  const int sizes[] = {1, 2, 4, 8, 16, 16, 32, 64};
  for (int i = 0; i < total; ++i) {
    const RandomInstant instant = random_instant(7, i, {.points_per_pad = sizes[i % 8]});
    const PlanarInstant answer = solve_planar(instant.grasp, instant.drive);
    ++count[static_cast<int>(answer.status)];
    const Certificate certificate = certify(instant.grasp, instant.drive, answer);
    if (certificate.holds()) continue;
    if (++refused < 5) {
      ADD_FAILURE() << i << " " << name(answer.status) << ": " << told(certificate);
    }
  }
  for (int s = 0; s < 9; ++s) {
    if (count[s] == 0) continue;
    std::cout << name(static_cast<InstantStatus>(s)) << " " << 100.0 * count[s] / total
              << " %\n";
  }
  EXPECT_EQ(refused, 0);
  EXPECT_EQ(count[static_cast<int>(InstantStatus::kOutOfIterations)], 0);
  EXPECT_GT(count[static_cast<int>(InstantStatus::kMoves)], total / 2);
}

TEST(PlanarInstant, RandomAccelerationsEndWithEvidence) {
  int unsolved = 0;
  const int total = 4000;
  for (int i = 0; i < total; ++i) {
    const double a = i % 2 == 0 ? 10.0 : 0.1;
    const RandomInstant instant =
        random_instant(8, i, {.points_per_pad = 16, .inertia = a});
    const PlanarInstant answer = solve_planar(instant.grasp, instant.drive);
    if (answer.status == InstantStatus::kOutOfIterations) {
      ++unsolved;
      continue;
    }
    const Certificate certificate = certify(instant.grasp, instant.drive, answer);
    EXPECT_TRUE(certificate.holds())
        << i << " " << name(answer.status) << ": " << told(certificate);
  }
  std::cout << "accelerations out of iterations: " << unsolved << " of " << total << "\n";
  EXPECT_LE(unsolved, total / 2000);
}

TEST(PlanarInstant, QuasiStaticIsTheLimitOfSmallAccelerations) {
  for (int i = 0; i < 300; ++i) {
    RandomInstant slow = random_instant(9, i, {.points_per_pad = 16});
    RandomInstant fast = random_instant(9, i, {.points_per_pad = 16, .inertia = 1e-6});
    const PlanarInstant limit = solve_planar(slow.grasp, slow.drive);
    const PlanarInstant near = solve_planar(fast.grasp, fast.drive);
    if (limit.status != InstantStatus::kMoves || near.status != InstantStatus::kMoves) {
      continue;
    }
    EXPECT_NEAR(near.push_force, limit.push_force, 1e-5 * slow.grasp.capacity()) << i;
  }
}

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

TEST(PlanarInstant, GravityHeldMeansOneMotion) {
  int held = 0;
  for (int i = 0; i < 20000; ++i) {
    const RandomInstant q = random_instant(13, i, {.points_per_pad = i % 2 ? 4 : 16});
    const PlanarInstant a = solve_planar(q.grasp, q.drive);
    if (a.status != InstantStatus::kMoves) continue;
    ++held;
    const PlanarInstant b = solve_planar(q.grasp, q.drive, {.probe_multiplicity = true});
    EXPECT_EQ(b.status, InstantStatus::kMoves) << i;
    EXPECT_NEAR((a.V_HO - b.V_HO).norm(), 0.0, 1e-8 * a.V_HO.norm()) << i;
  }
  EXPECT_GT(held, 15000);
}

// What the pusher may do besides pushing.

TEST(PlanarInstant, RecedingPusherLeavesAHeldObject) {
  PlanarGrasp grasp = square_grasp(4, 0.006, 20.0);
  grasp.w_g = wrench_of({0.002, 0.0}, {0.0, -4.0});
  const PlanarDrive drive =
      line_drive({-0.04, 0.0}, 0.03, {1.0, 0.0}, 0.5, {-0.01, 0.002});
  const PlanarInstant answer = certified(grasp, drive);
  EXPECT_EQ(answer.status, InstantStatus::kSeparated);
  EXPECT_TRUE(answer.V_HO.isZero(0.0));
  EXPECT_GT(answer.pusher[0].normal_rate, 0.0);
}

TEST(PlanarInstant, PusherThatMovesAlongTheFaceLeavesTheObjectAtRest) {
  const PlanarGrasp grasp = square_grasp(4, 0.006, 20.0);
  const PlanarDrive drive = line_drive({-0.04, 0.0}, 0.03, {1.0, 0.0}, 0.5, {0.0, 0.01});
  const PlanarInstant answer = certified(grasp, drive);
  EXPECT_EQ(answer.status, InstantStatus::kHolds);
}

TEST(PlanarInstant, RecedingPusherCanDragByFriction) {
  // Lynch and Mason 1995: a slider pulled by a pusher that moves away from it.
  PlanarGrasp grasp = square_grasp(4, 0.006, 20.0);
  const PlanarDrive drive =
      point_drive({-0.001, -0.02}, {1.0, 0.0}, 50.0, {-0.0005, 0.01});
  const PlanarInstant plain = certified(grasp, drive);
  EXPECT_EQ(plain.status, InstantStatus::kSeparated);
  const PlanarInstant probed = solve_planar(grasp, drive, {.probe_multiplicity = true});
  EXPECT_EQ(probed.status, InstantStatus::kAmbiguous);
  EXPECT_TRUE(certify(grasp, drive, probed).holds())
      << told(certify(grasp, drive, probed));
}

TEST(PlanarInstant, HeavyObjectOnAShelfIsCarriedAndFallsFromAWall) {
  PlanarGrasp grasp = square_grasp(4, 0.006, 20.0);
  grasp.w_g = wrench_of({0.0, 0.0}, {0.0, -40.0});
  const PlanarDrive shelf = line_drive({0.0, -0.03}, 0.03, {0.0, 1.0}, 0.5, {0.0, 0.01});
  EXPECT_EQ(certified(grasp, shelf).status, InstantStatus::kAmbiguous);
  const PlanarDrive wall = line_drive({-0.03, 0.0}, 0.03, {1.0, 0.0}, 0.0, {0.01, 0.0});
  EXPECT_EQ(certified(grasp, wall).status, InstantStatus::kDynamic);
}

TEST(PlanarInstant, PointPadTurnsFreely) {
  // One finger point has no torsion: a line that spans it drives it straight, a point
  // pusher beside it does not determine the turn.
  const PlanarGrasp grasp = grasp_of({{0.0, 0.0}}, 20.0);
  const PlanarDrive line = line_drive({-0.03, 0.002}, 0.02, {1.0, 0.0}, 0.5, {0.01, 0.0});
  const PlanarInstant straight = certified(grasp, line);
  EXPECT_EQ(straight.status, InstantStatus::kMoves);
  EXPECT_NEAR(straight.push_force, 20.0, kTight * 20.0);
  const PlanarDrive point = point_drive({-0.03, 0.002}, {1.0, 0.0}, 0.5, {0.01, 0.0});
  EXPECT_EQ(certified(grasp, point).status, InstantStatus::kAmbiguous);
}

TEST(PlanarInstant, PivotAtAPadPointLeavesTheForceOpen) {
  // The line turns the object about a pad point: that point may carry any force.
  const PlanarGrasp grasp = grasp_of(
      {{0.0, 0.0}, {0.006, 0.0}, {-0.006, 0.0}, {0.0, 0.006}, {0.0, -0.006}}, 20.0);
  PlanarDrive drive = line_drive({-0.03, -0.02}, 0.01, {1.0, 0.0}, 0.8, {0.0, 0.0});
  drive.V_HP = {0.0, 0.0, 0.5};
  const PlanarInstant answer = certified(grasp, drive);
  ASSERT_EQ(answer.status, InstantStatus::kNonuniqueForces);
  EXPECT_LT(answer.force_low, answer.force_high);
}

TEST(PlanarInstant, RefusesQuestionsWithoutSense) {
  const PlanarGrasp grasp = square_grasp(2, 0.006, 20.0);
  const PlanarDrive drive = point_drive({-0.03, 0.0}, {1.0, 0.0}, 0.5, {0.01, 0.0});
  const auto status = [](const PlanarGrasp& g, const PlanarDrive& d) {
    return solve_planar(g, d).status;
  };
  PlanarGrasp empty = grasp;
  empty.count = 0;
  EXPECT_EQ(status(empty, drive), InstantStatus::kBadInput);
  PlanarGrasp slack = grasp;
  slack.bound.fill(0.0);
  EXPECT_EQ(status(slack, drive), InstantStatus::kBadInput);
  PlanarGrasp broken = grasp;
  broken.x[1] = kNan;
  EXPECT_EQ(status(broken, drive), InstantStatus::kBadInput);
  PlanarDrive still = drive;
  still.V_HP.setZero();
  EXPECT_EQ(status(grasp, still), InstantStatus::kBadInput);
  PlanarDrive skew = drive;
  skew.n_H = {1.0, 0.5};
  EXPECT_EQ(status(grasp, skew), InstantStatus::kBadInput);
  PlanarDrive sticky = drive;
  sticky.mu = -0.1;
  EXPECT_EQ(status(grasp, sticky), InstantStatus::kBadInput);
}

TEST(PlanarInstant, UsesNoHeap) {
  PlanarWarmStart warm;
  const testing::NoHeapScope scope;
  for (int i = 0; i < 200; ++i) {
    const RandomInstant q =
        random_instant(17, i, {.points_per_pad = 16, .inertia = i % 3 ? 0.0 : 1.0});
    const PlanarInstant a = solve_planar(q.grasp, q.drive, {}, &warm);
    const Certificate certificate = certify(q.grasp, q.drive, a);
    EXPECT_TRUE(certificate.holds());
    EXPECT_TRUE(std::isfinite(gravity_slack(q.grasp)));
  }
  if (testing::heap_is_counted()) {
    EXPECT_EQ(scope.allocations(), 0);
  }
}

}  // namespace
}  // namespace prehensile
