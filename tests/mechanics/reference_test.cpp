/// The paper's formulation: closed forms of polyhedral friction, bounds against circular
/// friction, agreement with the exact solver as generators are added, honest refusals.
#include "mechanics/reference.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "mechanics/planar_instant.h"
#include "problems/random_instants.h"
#include "scene/constants.h"
#include "tests/mechanics/instant_cases.h"

namespace prehensile {
namespace {

using testing::disc_grasp;
using testing::line_drive;
using testing::point_drive;

class Reference : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!reference_is_built()) GTEST_SKIP() << "built without Ipopt";
  }
};

PlanarWrench imbalance(const PlanarGrasp& grasp, const PlanarInstant& answer) {
  PlanarWrench w = grasp.w_g + answer.w_push - grasp.inertia * answer.V_HO;
  for (int j = 0; j < answer.finger_count; ++j) {
    w += wrench_of({grasp.x[j], grasp.y[j]}, answer.finger[j].force);
  }
  return w;
}

/// The larger pusher point rate, as the solver's unit of rate.
double push_rate(const PlanarDrive& drive) {
  return std::max(point_velocity(drive.V_HP, drive.p_HC[0]).norm(),
                  point_velocity(drive.V_HP, drive.p_HC[1]).norm());
}

double dissipation(const PlanarGrasp& grasp, const PlanarTwist& u) {
  double power = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    power += grasp.bound[j] * point_velocity(u, {grasp.x[j], grasp.y[j]}).norm();
  }
  return power;
}

TEST_F(Reference, StraightSlideAlongAGeneratorNeedsTwoMuN) {
  const PlanarGrasp grasp = disc_grasp(16, 0.009, 20.0);
  const PlanarDrive drive = line_drive({-0.05, 0.0}, 0.03, {1.0, 0.0}, 0.4, {0.01, 0.0});
  for (const int generators : {4, 8, 16}) {
    const PlanarInstant answer =
        solve_reference(grasp, drive, {.generators = generators});
    ASSERT_EQ(answer.status, InstantStatus::kMoves);
    EXPECT_LT(answer.residual, 1e-9);
    EXPECT_NEAR(answer.push_force, 20.0, 1e-7);
    EXPECT_LT((answer.V_HO - drive.V_HP).norm(), 1e-10);
    EXPECT_EQ(answer.pusher_count, 2);
    EXPECT_EQ(answer.pusher[0].mode, ContactMode::kStick);
    EXPECT_EQ(answer.finger_count, 16);
    EXPECT_EQ(answer.finger[3].mode, ContactMode::kSlip);
    EXPECT_LT((answer.finger[3].force - Vec2(-20.0 / 16, 0.0)).norm(), 1e-7);
  }
}

TEST_F(Reference, AcceleratedSlideAddsMassTimesAcceleration) {
  PlanarGrasp grasp = disc_grasp(8, 0.009, 20.0);
  const double mass = 0.3;
  grasp.inertia = Vec3(mass, mass, 1e-4).asDiagonal();
  for (const double a : {0.1, 10.0}) {
    const PlanarDrive drive = line_drive({-0.05, 0.0}, 0.03, {1.0, 0.0}, 0.4, {a, 0.0});
    const PlanarInstant answer = solve_reference(grasp, drive);
    ASSERT_EQ(answer.status, InstantStatus::kMoves);
    EXPECT_NEAR(answer.push_force, 20.0 + mass * a, 1e-7);
  }
}

// Between two generators friction stays on the nearer one: a sticking push in direction
// phi meets 2 mu N along that generator, not along phi.
TEST_F(Reference, FrictionSnapsToTheNearestGenerator) {
  const PlanarGrasp grasp = disc_grasp(8, 0.009, 20.0);
  const double phi = 0.3;  // nearer to pi / 8 = 0.39 (g = 16) than to 0; to pi / 4 = 0.79
  for (const auto& [generators, theta] : {std::pair{16, kPi / 8.0}, std::pair{8, 0.0}}) {
    const PlanarDrive drive =
        line_drive({-0.05, 0.0}, 0.04, {1.0, 0.0}, 2.0, rotated(phi, {0.01, 0.0}));
    const PlanarInstant answer =
        solve_reference(grasp, drive, {.generators = generators});
    ASSERT_EQ(answer.status, InstantStatus::kMoves);
    EXPECT_LT((answer.w_push.head<2>() - rotated(theta, {20.0, 0.0})).norm(), 1e-7);
    EXPECT_LT((answer.V_HO - drive.V_HP).norm(), 1e-10);
  }
}

TEST_F(Reference, FillsAConsistentAnswer) {
  int answered = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto [grasp, drive] = random_instant(21, i, {.points_per_pad = 4});
    const PlanarInstant answer = solve_reference(grasp, drive);
    if (!usable(answer.status)) continue;
    ++answered;
    const double force = grasp.capacity();
    const double rate = push_rate(drive);
    EXPECT_LE(answer.residual, 1e-4);
    EXPECT_LT(imbalance(grasp, answer).head<2>().norm(),
              3.0 * answer.residual * force + 1e-12 * force);
    EXPECT_NEAR(answer.push_force, answer.w_push.head<2>().norm(), 1e-15 * force);
    PlanarWrench w = PlanarWrench::Zero();
    for (int p = 0; p < answer.pusher_count; ++p) {
      const PusherPoint& point = answer.pusher[p];
      const Vec2 c = point_velocity(answer.V_HO - drive.V_HP, drive.p_HC[p]);
      EXPECT_NEAR(point.normal_rate, drive.n_H.dot(c), 1e-12 * rate);
      EXPECT_NEAR(point.slip_rate, drive.t_H().dot(c), 1e-12 * rate);
      EXPECT_GE(point.normal_force, 0.0);
      EXPECT_LE(std::abs(point.tangential_force),
                drive.mu * point.normal_force + 1e-3 * force);
      if (point.mode == ContactMode::kOpen) {
        EXPECT_GT(point.normal_rate, 0.0);
      }
      w += wrench_of(drive.p_HC[p], point.normal_force * drive.n_H +
                                        point.tangential_force * drive.t_H());
    }
    EXPECT_LT((w - answer.w_push).head<2>().norm(), 1e-3 * force);
    for (int j = 0; j < answer.finger_count; ++j) {
      EXPECT_LE(answer.finger[j].force.norm(), grasp.bound[j] + 1e-4 * force);
    }
  }
  EXPECT_GE(answered, 25);
}

// The polygon lies inside the disc and holds the disc shrunk by cos(pi / g). For a
// frictionless pusher the force solves a minimisation (its power is the least dissipation
// minus the power of gravity at the prescribed rate), which turns that into bounds.
TEST_F(Reference, FrictionlessPushForceIsBracketed) {
  int compared = 0;
  for (std::uint64_t i = 0; compared < 15 && i < 40; ++i) {
    auto [grasp, drive] =
        random_instant(22, i, {.points_per_pad = 4, .pusher_points = 1});
    drive.mu = 0.0;
    const PlanarInstant exact = solve_planar(grasp, drive);
    if (exact.status != InstantStatus::kMoves) continue;
    const double rate = drive.n_H.dot(point_velocity(drive.V_HP, drive.p_HC[0]));
    for (const int generators : {8, 32}) {
      const PlanarInstant answer =
          solve_reference(grasp, drive, {.generators = generators});
      if (!usable(answer.status)) continue;
      ++compared;
      const double slack =
          (1.0 - std::cos(kPi / generators)) * dissipation(grasp, answer.V_HO) / rate;
      const double rounding = 1e-6 * grasp.capacity();
      EXPECT_LE(answer.push_force, exact.push_force + rounding);
      EXPECT_GE(answer.push_force, exact.push_force - slack - rounding);
    }
  }
  EXPECT_GE(compared, 15);
}

struct Errors {
  std::vector<double> force, twist;  // in units of capacity and push rate
  int refused = 0;
};

Errors errors_at(int generators, std::uint64_t count) {
  Errors errors;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto [grasp, drive] = random_instant(23, i, {.points_per_pad = 4});
    const PlanarInstant exact = solve_planar(grasp, drive);
    if (exact.status != InstantStatus::kMoves) continue;
    const PlanarInstant answer =
        solve_reference(grasp, drive, {.generators = generators});
    if (!usable(answer.status)) {
      EXPECT_EQ(answer.status, InstantStatus::kOutOfIterations);
      ++errors.refused;
      continue;
    }
    const PlanarTwist gap = answer.V_HO - exact.V_HO;
    const double length = 0.01;  // of the pads, which span 6 to 24 mm
    errors.force.push_back((answer.w_push - exact.w_push).head<2>().norm() /
                           grasp.capacity());
    errors.twist.push_back(PlanarTwist(gap[0], gap[1], length * gap[2]).norm() /
                           push_rate(drive));
  }
  std::sort(errors.force.begin(), errors.force.end());
  std::sort(errors.twist.begin(), errors.twist.end());
  return errors;
}

double median(const std::vector<double>& sorted) { return sorted.at(sorted.size() / 2); }

TEST_F(Reference, ConvergesToTheExactSolverWithGenerators) {
  const std::uint64_t count = 40;
  const Errors coarse = errors_at(8, count);
  const Errors middle = errors_at(16, count);
  const Errors fine = errors_at(32, count);
  for (const Errors* errors : {&coarse, &middle, &fine}) {
    EXPECT_GE(errors->force.size(), 25u);
    EXPECT_LE(errors->refused, 3);
  }
  EXPECT_LT(median(coarse.force), 0.06);
  EXPECT_LT(median(middle.force), 0.5 * median(coarse.force));
  EXPECT_LT(median(fine.force), 0.5 * median(middle.force));
  EXPECT_LT(median(coarse.twist), 0.12);
  EXPECT_LT(median(middle.twist), 0.75 * median(coarse.twist));
  EXPECT_LT(median(fine.twist), 0.75 * median(middle.twist));
}

TEST_F(Reference, ConvergesToTheExactSolverWithGeneratorsFull) {
  const Errors coarse = errors_at(8, 200);
  const Errors fine = errors_at(64, 200);
  EXPECT_LE(coarse.refused, 10);
  EXPECT_LE(fine.refused, 10);
  // Eight times the generators: between 1/g and 1/g^2.
  EXPECT_LT(median(fine.force), median(coarse.force) / 16.0);
  EXPECT_LT(median(fine.twist), median(coarse.twist) / 6.0);
}

TEST_F(Reference, RecedingPusherLeavesTheObjectAtRest) {
  PlanarGrasp grasp = disc_grasp(6, 0.01, 20.0);
  grasp.w_g = {0.0, -2.0, 0.0};
  const PlanarDrive drive = point_drive({-0.05, 0.0}, {1.0, 0.0}, 0.3, {-0.01, 0.0});
  const PlanarInstant answer = solve_reference(grasp, drive);
  EXPECT_EQ(answer.status, InstantStatus::kSeparated);
  EXPECT_LT(answer.V_HO.norm(), 1e-9);
  EXPECT_NEAR(answer.push_force, 0.0, 1e-7);
  EXPECT_EQ(answer.pusher[0].mode, ContactMode::kOpen);
  EXPECT_EQ(answer.finger[0].mode, ContactMode::kStick);
}

TEST_F(Reference, RefusesWhatHasNoEquilibrium) {
  PlanarGrasp grasp = disc_grasp(6, 0.01, 20.0);
  grasp.w_g = {0.0, -30.0, 0.0};  // more than the pads hold; the pusher cannot help
  const PlanarDrive drive = point_drive({-0.05, 0.0}, {1.0, 0.0}, 0.3, {0.01, 0.0});
  const PlanarInstant answer = solve_reference(grasp, drive);
  EXPECT_EQ(answer.status, InstantStatus::kOutOfIterations);
  EXPECT_GT(answer.residual, 1e-4);
  EXPECT_TRUE(std::isnan(answer.push_force));
}

TEST_F(Reference, RefusesIteratesShortOfTheGate) {
  const PlanarGrasp grasp = disc_grasp(6, 0.01, 20.0);
  const PlanarDrive drive = point_drive({-0.05, 0.01}, {1.0, 0.0}, 0.3, {0.01, 0.004});
  const PlanarInstant stopped =
      solve_reference(grasp, drive, {.starts = 1, .max_iterations = 2});
  EXPECT_EQ(stopped.status, InstantStatus::kOutOfIterations);
  EXPECT_GT(stopped.residual, 1e-4);
  EXPECT_LE(stopped.iterations, 2);
  EXPECT_EQ(solve_reference(grasp, drive, {.gate = 0.0}).status,
            InstantStatus::kOutOfIterations);
  EXPECT_EQ(solve_reference(grasp, drive).status, InstantStatus::kMoves);
}

TEST_F(Reference, RefusesBadInput) {
  const PlanarGrasp good = disc_grasp(6, 0.01, 20.0);
  const PlanarDrive push = point_drive({-0.05, 0.0}, {1.0, 0.0}, 0.3, {0.01, 0.0});
  const auto status = [](const PlanarGrasp& grasp, const PlanarDrive& drive,
                         const ReferenceOptions& options = {}) {
    return solve_reference(grasp, drive, options).status;
  };
  PlanarGrasp grasp = good;
  grasp.count = 0;
  EXPECT_EQ(status(grasp, push), InstantStatus::kBadInput);
  grasp = good;
  grasp.w_g[2] = kNan;
  EXPECT_EQ(status(grasp, push), InstantStatus::kBadInput);
  grasp = good;
  grasp.bound[2] = kNan;
  EXPECT_EQ(status(grasp, push), InstantStatus::kBadInput);
  PlanarDrive drive = push;
  drive.V_HP.setZero();
  EXPECT_EQ(status(good, drive), InstantStatus::kBadInput);
  drive = push;
  drive.mu = -0.1;
  EXPECT_EQ(status(good, drive), InstantStatus::kBadInput);
  for (const int generators : {0, 2, 7, 66}) {
    EXPECT_EQ(status(good, push, {.generators = generators}), InstantStatus::kBadInput);
  }
}

TEST_F(Reference, EqualQuestionsGiveEqualNumbers) {
  const auto [grasp, drive] = random_instant(24, 0, {.points_per_pad = 4});
  const PlanarInstant one = solve_reference(grasp, drive);
  const PlanarInstant two = solve_reference(grasp, drive);
  EXPECT_EQ(one.V_HO, two.V_HO);
  EXPECT_EQ(one.push_force, two.push_force);
  EXPECT_EQ(one.iterations, two.iterations);
}

}  // namespace
}  // namespace prehensile
