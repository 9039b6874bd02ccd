/// The paper's instant in space by pivoting and by the interior point: closed forms and
/// how fast polyhedral friction comes to them, two solvers against each other, refusals.
#include "mechanics/spatial_reference.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "mechanics/spatial_instant.h"
#include "problems/random_spatial.h"
#include "scene/constants.h"
#include "tests/mechanics/spatial_cases.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::grasp_of;
using testing::PadLaw;
using testing::push;
using testing::Random;
using testing::weight_at;

constexpr double kRate = 0.01;

PadLaw pad(double mu, double grip, double softness = 1e-3) {
  return {.mu = mu, .compliance = softness * kRate / grip};
}

SpatialReference pivoted(const SpatialProblem& q, int generators) {
  SpatialReference answer = solve_spatial_pivoting(q, {.generators = generators});
  EXPECT_EQ(answer.status, SpatialReferenceStatus::kSolved);
  EXPECT_LT(answer.residual, 1e-11);
  return answer;
}

/// A line pusher on the left face carries the object along `direction`.
SpatialProblem straight_slide(const Vec2& direction, double weight, double mu_pusher) {
  SpatialProblem q =  // 2 mu N = 20 N
      grasp_of(testing::square_points(2, 0.012), 0.01, 20.0, pad(0.5, 20.0));
  push(q, {{-0.05, -0.03, 0.0}, {-0.05, 0.03, 0.0}}, Vec3::UnitX(), mu_pusher,
       kRate * Vec3(direction.x(), direction.y(), 0.0));
  q.w_g = weight_at(Vec3::Zero(), {0.0, -weight, 0.0});
  return q;
}

// MECHANICS: F_n = 2 mu N, F_t = m g, end normals (F_n -/+ d m g / L) / 2 with d = 50 mm,
// L = 30 mm. The push runs along a generator, so every g gives the exact answer.
TEST(SpatialPivoting, StraightSlideSplitsTheForceOverTheLine) {
  const SpatialProblem q = straight_slide({1.0, 0.0}, 4.0, 0.4);
  for (const int g : {4, 8, 16, 32}) {
    const SpatialReference answer = pivoted(q, g);
    EXPECT_LT((answer.V_HO - q.V_HP).norm(), 1e-12);
    EXPECT_NEAR(answer.w_push[0], 20.0, 1e-9);
    EXPECT_NEAR(answer.w_push[1], 4.0, 1e-9);
    const auto& ends = answer.point;
    const double least = std::min(ends[8].normal_force, ends[9].normal_force);
    const double most = std::max(ends[8].normal_force, ends[9].normal_force);
    EXPECT_NEAR(least, (20.0 - 4.0 * 0.05 / 0.03) / 2.0, 1e-8);
    EXPECT_NEAR(most, (20.0 + 4.0 * 0.05 / 0.03) / 2.0, 1e-8);
  }
}

// Friction of a sticking push in direction phi stays on the generator nearest to it: the
// push force is off by 2 sin(delta / 2) with delta <= pi / g, exactly, so the error falls
// as 1 / g at worst and is never more than that.
TEST(SpatialPivoting, ObliqueSlideComesToTheCircleAsOneOverG) {
  const double phi = 0.3;  // small enough for the line to carry every generator's force
  const SpatialProblem q = straight_slide({std::cos(phi), std::sin(phi)}, 0.0, 1.2);
  const Vec2 exact = 20.0 * Vec2(std::cos(phi), std::sin(phi));
  for (const int g : {4, 8, 16, 32, 64}) {
    const SpatialReference answer = pivoted(q, g);
    EXPECT_LT((answer.V_HO - q.V_HP).norm(), 1e-12);
    const double step = 2.0 * kPi / g;
    const double delta = std::abs(phi - step * std::round(phi / step));
    const double error = (answer.w_push.head<2>() - exact).norm() / 20.0;
    EXPECT_NEAR(error, 2.0 * std::sin(delta / 2.0), 1e-9) << g;
    EXPECT_LE(error, kPi / g);
  }
}

TEST(SpatialPivoting, AcceleratedSlideAddsMassTimesAcceleration) {
  const double mass = 0.3;
  for (const double a : {1e-9, 1e-3, 10.0}) {
    SpatialProblem q = straight_slide({1.0, 0.0}, 0.0, 0.4);
    q.V_HP.head<2>() *= a / kRate;
    q.inertia.diagonal() << mass, mass, mass, 1e-4, 1e-4, 1e-4;
    for (int k = 0; k < 2; ++k) q.patch[k].compliance *= a / kRate;
    EXPECT_NEAR(pivoted(q, 8).w_push[0], 20.0 + mass * a, 1e-9);
  }
}

/// Two points per pad at -/+ b, a frictionless point pusher at distance d.
SpatialProblem pivot(double b, double d) {
  SpatialProblem q = grasp_of({{-b, 0.0}, {b, 0.0}}, 0.01, 20.0, pad(0.5, 20.0));
  push(q, {{-0.02, -d, 0.0}}, Vec3::UnitX(), 0.0, {kRate, 0.0, 0.0});
  return q;
}

// F = 2 mu N b / sqrt(b^2 + d^2), turning about b^2 / d on the far side. Dissipation is
// stationary there, so the force comes to it as 1 / g^2; the motion only as 1 / g.
TEST(SpatialPivoting, PivotForceComesToTheClosedFormAsOneOverGSquared) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const double b = random.in(0.003, 0.012);
    const double d = random.in(0.01, 0.05);
    const double force = 20.0 * b / std::hypot(b, d);
    double worst_product = 0.0;
    for (const int g : {4, 8, 16, 32, 64}) {
      const SpatialReference answer = pivoted(pivot(b, d), g);
      const double error = (force - answer.w_push[0]) / force;
      EXPECT_GE(error, -1e-10);  // inscribed cones dissipate less
      worst_product = std::max(worst_product, error * g * g);
      const double centre = -answer.V_HO[0] / answer.V_HO[5];  // of rotation, along -y
      EXPECT_NEAR(-centre, b * b / d, 4.0 * kPi / g * (b + d)) << g;
    }
    EXPECT_LE(worst_product, kPi * kPi / 2.0 + 1e-6);  // 1 - cos(pi / g)
  }
}

/// A cylinder of radius r between flat jaws, on a sheet that moves along the grip axis.
SpatialProblem roll(double mu_sheet, double grip, double mu, double weight,
                    JawMode mode) {
  const double r = 0.01;
  SpatialProblem q = grasp_of({{-0.01, 0.0}, {0.01, 0.0}}, r, grip, pad(mu, grip, 1e-6));
  q.jaw_mode = mode;
  push(q, {{-0.01, -r, 0.0}, {0.01, -r, 0.0}}, Vec3::UnitY(), mu_sheet,
       {0.0, 0.0, kRate});
  q.w_g = weight_at(Vec3::Zero(), {0.0, -weight, 0.0});
  return q;
}

// Rolls iff mu_e >= F_t / N_e, with F_t = 2 mu N / (1 +/- mu) by jaw mode and
// N_e = W + mu F_t: the downstream jaw (2) pressed by force, or fixed.
TEST(SpatialPivoting, RollsAboveTheThresholdOfEachJawMode) {
  const double grip = 4.0;
  const double mu = 0.4;
  const double weight = 10.0;
  for (const auto& [mode, factor] : {std::pair{JawMode::kCoupled, 1.0},
                                     {JawMode::kFixedJaw1, 1.0 / (1.0 + mu)},
                                     {JawMode::kFixedJaw2, 1.0 / (1.0 - mu)}}) {
    const double push = 2.0 * mu * grip * factor;
    const double threshold = push / (weight + mu * push);
    for (const int g : {4, 8, 16}) {
      const SpatialReference rolls =
          pivoted(roll(threshold * 1.001, grip, mu, weight, mode), g);
      EXPECT_NEAR(std::abs(rolls.V_HO[3]) * 0.01, kRate, 1e-4 * kRate);
      EXPECT_NEAR(rolls.w_push[2], push, 1e-5 * push);
      const SpatialReference slides =
          pivoted(roll(threshold * 0.999, grip, mu, weight, mode), g);
      EXPECT_LT(std::abs(slides.V_HO[3]) * 0.01, 1e-4 * kRate);
    }
  }
}

// A soft point resists turning by mu N e; a hard one does not.
TEST(SpatialPivoting, SoftPointHasATorqueOfItsOwn) {
  const double e = 0.006;
  const double d = 0.03;
  for (const int g : {8, 16, 32}) {
    PadLaw law = pad(0.5, 20.0);
    law.spin_radius = e;
    SpatialProblem q = grasp_of({{0.0, 0.0}}, 0.01, 20.0, law);
    push(q, {{-0.02, -d, 0.0}}, Vec3::UnitX(), 0.0, {kRate, 0.0, 0.0});
    // f^2 + (f d / e)^2 = (2 mu N)^2: slip and spin share the round set.
    const double force = 20.0 * e / std::hypot(e, d);
    const SpatialReference answer = pivoted(q, g);
    EXPECT_LE(answer.w_push[0], force + 1e-9);
    EXPECT_NEAR(answer.w_push[0], force, force * kPi * kPi / (g * g));
    // Each about its own normal; the jaws' normals are opposite.
    const double spin = answer.point[0].spin_moment - answer.point[1].spin_moment;
    EXPECT_NEAR(std::abs(spin), answer.w_push[0] * d, 1e-9);
  }
}

// Whatever the inertia, down to none: what the exact solver answers is answered here too,
// at rounding. (Inscribed cones hold a little less, so a few grasps drop what they
// carry.)
TEST(SpatialPivoting, OrdinaryInstantsAreSolvedToRounding) {
  Random random(2);
  for (const bool inertia : {true, false}) {
    int asked = 0;
    int solved = 0;
    for (int index = 0; index < 200; ++index) {
      const SpatialProblem q =
          random_spatial(5, index,
                         {.points_per_pad = 1 << index % 3,
                          .acceleration = inertia ? random.log_in(1e-6, 10.0) : 0.0,
                          .compliance = random.log_in(1e-4, 1e-1)});
      if (solve_spatial(q).status != InstantStatus::kMoves) continue;
      ++asked;
      const SpatialReference answer = solve_spatial_pivoting(q);
      if (answer.status != SpatialReferenceStatus::kSolved) continue;
      ++solved;
      EXPECT_LT(answer.residual, 1e-9);
    }
    EXPECT_GT(asked, 90);
    EXPECT_GE(solved, inertia ? asked : asked - 1);
  }
}

// Verdicts of two solvers that share nothing: what moves by the one moves by the other,
// and nothing that falls is ever called solved.
TEST(SpatialPivoting, VerdictsAgreeWithTheExactSolverFull) {
  int moves = 0;
  int missed = 0;
  int falls = 0;
  for (const int points : {1, 2, 4, 8}) {
    for (int index = 0; index < 300; ++index) {
      const SpatialProblem q = random_spatial(3, index, {.points_per_pad = points});
      const InstantStatus exact = solve_spatial(q).status;
      if (exact != InstantStatus::kMoves && exact != InstantStatus::kDynamic) continue;
      const bool solved =
          solve_spatial_pivoting(q).status == SpatialReferenceStatus::kSolved;
      if (exact == InstantStatus::kMoves) {
        ++moves;
        missed += solved ? 0 : 1;
      } else {
        ++falls;
        EXPECT_FALSE(solved) << points << " points, instant " << index;
      }
    }
  }
  EXPECT_GT(moves, 600);
  EXPECT_GT(falls, 50);
  EXPECT_LE(missed, moves / 100);
}

struct Distances {
  std::vector<double> force;  // of the push force, over it
  std::vector<double> twist;  // over the push rate, turns by 1 cm
};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Polyhedral answers against those of the exact solver on circular cones, for instants
/// that have one answer.
Distances distances(int g, int instants) {
  Distances found;
  for (int index = 0; index < instants; ++index) {
    const SpatialProblem q =
        random_spatial(6, index, {.points_per_pad = 4, .acceleration = index % 2 * 0.1});
    const SpatialInstant exact = solve_spatial(q);
    if (exact.status != InstantStatus::kMoves) continue;
    const SpatialReference answer = solve_spatial_pivoting(q, {.generators = g});
    if (answer.status != SpatialReferenceStatus::kSolved) continue;
    const Vec3 force = (answer.w_push - exact.w_push).head<3>();
    SpatialTwist twist = answer.V_HO - exact.V_HO;
    twist.tail<3>() *= 0.01;
    found.force.push_back(force.norm() / exact.push_force);
    found.twist.push_back(twist.norm() / q.V_HP.head<3>().norm());
  }
  return found;
}

void expect_convergence(int instants, const std::vector<int>& generators) {
  double force = 0.6;
  double twist = 0.4;
  for (const int g : generators) {
    Distances found = distances(g, instants);
    ASSERT_GT(static_cast<int>(found.force.size()), instants * 7 / 10);
    // In force by about 4 per doubling, in twist by about 2.
    force /= 2.5;
    twist /= 1.5;
    EXPECT_LT(median(found.force), force) << g;
    EXPECT_LT(median(found.twist), twist) << g;
  }
}

TEST(SpatialPivoting, ComesToTheExactSolverAsGGrows) {
  expect_convergence(60, {4, 8, 16});
}

TEST(SpatialPivoting, ComesToTheExactSolverAsGGrowsFull) {
  expect_convergence(300, {4, 8, 16, 32});
}

class SpatialInteriorPoint : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!spatial_reference_is_built()) GTEST_SKIP() << "built without Ipopt";
  }
};

TEST_F(SpatialInteriorPoint, StraightSlide) {
  const SpatialProblem q = straight_slide({1.0, 0.0}, 4.0, 0.4);
  const SpatialReference answer = solve_spatial_reference(q);
  ASSERT_EQ(answer.status, SpatialReferenceStatus::kSolved);
  EXPECT_LT(answer.residual, 1e-7);
  EXPECT_NEAR(answer.w_push[0], 20.0, 1e-5);
  EXPECT_NEAR(answer.w_push[1], 4.0, 1e-5);
}

// Two ways that share no solver: where both answer, it is the same answer, but for the
// rare instant with two motions.
TEST_F(SpatialInteriorPoint, AgreesWithPivoting) {
  int both = 0;
  int same = 0;
  for (int index = 0; index < 16; ++index) {
    const SpatialProblem q =
        random_spatial(7, index, {.points_per_pad = 2, .acceleration = 0.1});
    const SpatialReference one = solve_spatial_pivoting(q, {.generators = 6});
    const SpatialReference other =
        solve_spatial_reference(q, {.generators = 6, .starts = 2});
    ASSERT_EQ(one.status, SpatialReferenceStatus::kSolved);
    if (other.status != SpatialReferenceStatus::kSolved) continue;
    ++both;
    const Vec3 twist = (one.V_HO - other.V_HO).head<3>();
    const Vec3 force = (one.w_push - other.w_push).head<3>();
    if (twist.norm() < 1e-4 * 0.1 && force.norm() < 1e-4 * q.grip_force) ++same;
  }
  EXPECT_GE(both, 8);
  EXPECT_GE(same, both - 1);
}

TEST(SpatialReferences, RefuseWhatMakesNoSense) {
  SpatialProblem q = straight_slide({1.0, 0.0}, 4.0, 0.4);
  q.V_HP.setZero();
  EXPECT_EQ(solve_spatial_pivoting(q).status, SpatialReferenceStatus::kBadInput);
  const SpatialProblem good = straight_slide({1.0, 0.0}, 4.0, 0.4);
  EXPECT_EQ(solve_spatial_pivoting(good, {.generators = 7}).status,
            SpatialReferenceStatus::kBadInput);
  EXPECT_EQ(solve_spatial_pivoting(good, {.starts = 0}).status,
            SpatialReferenceStatus::kBadInput);
  const SpatialReferenceStatus status = solve_spatial_reference(q).status;
  EXPECT_EQ(status, spatial_reference_is_built() ? SpatialReferenceStatus::kBadInput
                                                 : SpatialReferenceStatus::kNotRun);
}

// The weight is more than the grasp can hold and nothing else carries it: refused, and
// never called solved.
TEST(SpatialReferences, NoAnswerIsNotCalledOne) {
  SpatialProblem q = straight_slide({1.0, 0.0}, 0.0, 0.0);
  q.w_g = weight_at(Vec3::Zero(), {0.0, -30.0, 0.0});
  const SpatialReference answer = solve_spatial_pivoting(q);
  EXPECT_NE(answer.status, SpatialReferenceStatus::kSolved);
  if (!spatial_reference_is_built()) GTEST_SKIP() << "built without Ipopt";
  EXPECT_EQ(solve_spatial_reference(q, {.starts = 2}).status,
            SpatialReferenceStatus::kNotFound);
}

}  // namespace
}  // namespace prehensile
