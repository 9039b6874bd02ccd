#include "mechanics/limit_surface.h"

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/random_instants.h"
#include "tests/mechanics/instant_cases.h"
#include "tests/support/no_heap.h"

namespace prehensile {
namespace {

using testing::line_drive;
using testing::point_drive;

constexpr double kTight = 1e-9;

LimitSurface surface_of(const RandomInstant& q) { return {q.grasp.capacity(), 0.006}; }

TEST(LimitSurface, FrictionAndSlidingTwistAreInverse) {
  const LimitSurface surface{20.0, 0.006};
  for (int k = 0; k < 100; ++k) {
    const PlanarTwist V(std::sin(1.0 * k), std::cos(2.3 * k), 200.0 * std::sin(0.7 * k));
    const PlanarWrench friction = surface.friction(V);
    EXPECT_NEAR(surface.load(friction), 1.0, 1e-12);
    EXPECT_LT(friction.dot(V), 0.0);
    const PlanarTwist back = surface.sliding_twist(friction);
    EXPECT_NEAR((back / back.norm() - V / V.norm()).norm(), 0.0, 1e-12);
  }
}

TEST(LimitSurface, EdgesOfTheMotionConeOfAPointPusher) {
  // tan(psi*) = mu_p (1 + d^2/c^2) for a pusher at d straight below the centre.
  const LimitSurface surface{20.0, 0.006};
  for (const double mu : {0.1, 0.3, 0.8}) {
    for (const double d : {0.003, 0.009, 0.05}) {
      const double edge = std::atan(mu * (1.0 + d * d / (surface.c * surface.c)));
      for (const double share : {0.999999, 1.000001}) {
        const double psi = share * edge;
        const PlanarDrive drive =
            point_drive({0.0, -d}, {0.0, 1.0}, mu, {-std::sin(psi), std::cos(psi)});
        const PlanarInstant answer = solve_limit_surface(surface, {0, 0, 0}, drive);
        EXPECT_EQ(answer.pusher[0].mode,
                  share < 1.0 ? ContactMode::kStick : ContactMode::kSlipMinus);
        EXPECT_LE(limit_surface_residual(surface, {0, 0, 0}, drive, answer), kTight);
      }
    }
  }
}

TEST(LimitSurface, EdgesOfTheMotionConeUnderGravity) {
  // On an edge the force lies on the edge of the friction cone and the total on the
  // surface: |w_g + l e| = 1 gives l, and that wrench the direction of the contact point.
  const LimitSurface surface{20.0, 0.006};
  const double mu = 0.4;
  const Vec2 p(0.004, -0.02);
  const PlanarWrench w_g = wrench_of({0.001, 0.003}, {2.0, -5.0});
  for (const double side : {1.0, -1.0}) {
    const PlanarWrench e = wrench_of(p, {side * mu, 1.0});
    double low = 0.0;
    double high = 100.0;
    for (int step = 0; step < 200; ++step) {
      const double l = 0.5 * (low + high);
      (surface.load(w_g + l * e) < 1.0 ? low : high) = l;
    }
    const PlanarTwist V = surface.sliding_twist(-(w_g + low * e));
    const Vec2 v = point_velocity(V, p);
    const double psi = std::atan2(v.x(), v.y());
    for (const double shift : {-1e-6, 1e-6}) {
      const Vec2 push(std::sin(psi + shift), std::cos(psi + shift));
      const PlanarInstant answer =
          solve_limit_surface(surface, w_g, point_drive(p, {0.0, 1.0}, mu, push));
      // t = (-1, 0): friction along +x is friction along -t.
      const bool beyond = shift * side > 0.0;
      EXPECT_EQ(answer.pusher[0].mode == ContactMode::kStick, !beyond);
    }
  }
}

TEST(LimitSurface, RandomInstantsEndWithEvidence) {
  int solved = 0;
  for (int i = 0; i < 100000; ++i) {
    const RandomInstant q = random_instant(51, i, {.points_per_pad = 1});
    const LimitSurface surface = surface_of(q);
    const PlanarInstant answer = solve_limit_surface(surface, q.grasp.w_g, q.drive);
    ASSERT_NE(answer.status, InstantStatus::kOutOfIterations) << i;
    ASSERT_LE(limit_surface_residual(surface, q.grasp.w_g, q.drive, answer), kTight) << i;
    EXPECT_EQ(answer.status == InstantStatus::kMoves, surface.load(q.grasp.w_g) < 1.0);
    solved += answer.status == InstantStatus::kMoves ? 1 : 0;
  }
  EXPECT_GT(solved, 70000);
}

/// All force directions of the cone by brute force: the one whose sliding twist the
/// contact admits.
double brute_force_push(const LimitSurface& surface, const PlanarWrench& w_g,
                        const PlanarDrive& drive) {
  constexpr int kDirections = 4001;
  const Vec2& p = drive.p_HC[0];
  const Vec2 v_p = point_velocity(drive.V_HP, p);
  const double wanted = drive.t_H().dot(v_p) / drive.n_H.dot(v_p);
  double best = std::numeric_limits<double>::infinity();
  double force = kNan;
  for (int k = 0; k < kDirections; ++k) {
    const double ratio = drive.mu * (2.0 * k / (kDirections - 1) - 1.0);
    const Vec2 f = drive.n_H + ratio * drive.t_H();
    const PlanarWrench e = wrench_of(p, f);
    double low = 0.0;
    double high = 1e3 * surface.F;
    for (int step = 0; step < 60; ++step) {
      const double l = 0.5 * (low + high);
      (surface.load(w_g + l * e) < 1.0 ? low : high) = l;
    }
    const Vec2 v = point_velocity(surface.sliding_twist(-(w_g + low * e)), p);
    if (drive.n_H.dot(v) <= 0.0) continue;
    const double off = drive.t_H().dot(v) / drive.n_H.dot(v) - wanted;
    // At the edges of the cone the object may slip, to the side that friction opposes.
    const bool slips = (k == 0 && off > 0.0) || (k == kDirections - 1 && off < 0.0);
    const double miss = slips ? 0.0 : std::abs(off);
    if (miss < best) {
      best = miss;
      force = low * f.norm();
    }
  }
  return force;
}

TEST(LimitSurface, AgreesWithBruteForceOverForceDirections) {
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const RandomInstant q =
        random_instant(52, i, {.points_per_pad = 1, .pusher_points = 1});
    const LimitSurface surface = surface_of(q);
    const PlanarInstant answer = solve_limit_surface(surface, q.grasp.w_g, q.drive);
    if (answer.status != InstantStatus::kMoves) continue;
    ++compared;
    EXPECT_NEAR(answer.push_force, brute_force_push(surface, q.grasp.w_g, q.drive),
                2e-3 * surface.F)
        << i;
  }
  EXPECT_GT(compared, 30);
}

TEST(LimitSurface, CertificateRejectsPerturbedAnswers) {
  int rejected = 0;
  for (int i = 0; i < 500; ++i) {
    const RandomInstant q = random_instant(53, i, {.points_per_pad = 1});
    const LimitSurface surface = surface_of(q);
    const PlanarInstant right = solve_limit_surface(surface, q.grasp.w_g, q.drive);
    if (right.status != InstantStatus::kMoves) continue;
    const auto rejects = [&](auto change) {
      PlanarInstant wrong = right;
      change(wrong);
      const double residual =
          limit_surface_residual(surface, q.grasp.w_g, q.drive, wrong);
      EXPECT_FALSE(residual <= 1e-6) << i;
      ++rejected;
    };
    const double df = 1e-3 * surface.F;
    for (int k = 0; k < 3; ++k) {
      rejects([&](PlanarInstant& a) { a.V_HO[k] += k < 2 ? 1e-5 : 1e-5 / surface.c; });
      rejects([&](PlanarInstant& a) { a.w_push[k] += k < 2 ? df : df * surface.c; });
    }
    rejects([&](PlanarInstant& a) { a.push_force += df; });
    for (int k = 0; k < q.drive.count; ++k) {
      rejects([&](PlanarInstant& a) { a.pusher[k].normal_force += df; });
      rejects([&](PlanarInstant& a) { a.pusher[k].tangential_force += df; });
      rejects([&](PlanarInstant& a) { a.pusher[k].slip_rate += 1e-5; });
      rejects([&](PlanarInstant& a) { a.pusher[k].normal_rate = kNan; });
    }
  }
  EXPECT_GT(rejected, 3000);
}

TEST(LimitSurface, IsTheLimitOfStraightPushesForPads) {
  // A pure translation does not see the shape of the pads: the two models agree.
  PlanarGrasp grasp = testing::square_grasp(4, 0.006, 20.0);
  grasp.w_g = wrench_of({0.0, 0.004}, {0.0, -4.0});
  const PlanarDrive drive =
      line_drive({-0.03, 0.0}, 0.03, {1.0, 0.0}, 0.1, {0.01, 0.001});
  const PlanarInstant exact = solve_planar(grasp, drive);
  const PlanarInstant closed = solve_limit_surface({20.0, 0.004}, grasp.w_g, drive);
  EXPECT_EQ(closed.pusher[0].mode, exact.pusher[0].mode);
  EXPECT_NEAR((closed.V_HO - exact.V_HO).norm(), 0.0, 1e-12);
  EXPECT_NEAR((closed.w_push - exact.w_push).norm(), 0.0, 1e-9);
}

TEST(LimitSurface, RefusesQuestionsWithoutSense) {
  const PlanarDrive drive = point_drive({-0.03, 0.0}, {1.0, 0.0}, 0.5, {0.01, 0.0});
  EXPECT_EQ(solve_limit_surface({0.0, 0.006}, {0, 0, 0}, drive).status,
            InstantStatus::kBadInput);
  EXPECT_EQ(solve_limit_surface({20.0, 0.0}, {0, 0, 0}, drive).status,
            InstantStatus::kBadInput);
  EXPECT_EQ(solve_limit_surface({20.0, 0.006}, {kNan, 0, 0}, drive).status,
            InstantStatus::kBadInput);
}

TEST(LimitSurface, UsesNoHeap) {
  const RandomInstant q = random_instant(54, 1, {.points_per_pad = 1});
  const testing::NoHeapScope scope;
  const PlanarInstant a = solve_limit_surface(surface_of(q), q.grasp.w_g, q.drive);
  EXPECT_TRUE(
      std::isfinite(limit_surface_residual(surface_of(q), q.grasp.w_g, q.drive, a)));
  if (testing::heap_is_counted()) {
    EXPECT_EQ(scope.allocations(), 0);
  }
}

}  // namespace
}  // namespace prehensile
