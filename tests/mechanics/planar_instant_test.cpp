#include "mechanics/planar_instant.h"

#include <iostream>

#include <gtest/gtest.h>

#include "problems/random_instants.h"
#include "tests/mechanics/instant_cases.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

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
