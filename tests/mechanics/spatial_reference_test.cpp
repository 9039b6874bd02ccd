/// The paper's instant in space by pivoting and by the interior point: closed forms and
/// how fast polyhedral friction comes to them, two solvers against each other, refusals.
#include "mechanics/spatial_reference.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/mechanics/linear_cone_cases.h"

namespace prehensile {
namespace {

using testing::add_jaws;
using testing::add_patch;
using testing::Random;
using testing::random_spatial;
using testing::set_gravity;

constexpr double kPi = std::numbers::pi;
constexpr double kRate = 0.01;
constexpr double kSoftness = 1e-3;
const std::vector<Vec2> kSquare{
    {-0.006, -0.006}, {-0.006, 0.006}, {0.006, -0.006}, {0.006, 0.006}};

SpatialReference pivoted(const SpatialProblem& q, int generators) {
  SpatialReference answer = solve_spatial_pivoting(q, {.generators = generators});
  EXPECT_EQ(answer.status, SpatialReferenceStatus::kSolved);
  EXPECT_LT(answer.residual, 1e-11);
  return answer;
}

/// A line pusher on the left face carries the object along `direction`.
SpatialProblem straight_slide(const Vec2& direction, double weight, double mu_pusher) {
  SpatialProblem q;
  add_jaws(q, 20.0, 0.5, 0.01, kSquare, kSoftness, kRate);  // 2 mu N = 20 N
  add_patch(q, ContactBody::kPusher, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, mu_pusher,
            {{-0.05, -0.03, 0.0}, {-0.05, 0.03, 0.0}});
  q.V_HP.head<2>() = kRate * direction;
  set_gravity(q, {0.0, -weight, 0.0}, Vec3::Zero());
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
  SpatialProblem q;
  add_jaws(q, 20.0, 0.5, 0.01, {{-b, 0.0}, {b, 0.0}}, kSoftness, kRate);
  add_patch(q, ContactBody::kPusher, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.0,
            {{-0.02, -d, 0.0}});
  q.V_HP[0] = kRate;
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
  SpatialProblem q;
  q.jaw_mode = mode;
  add_jaws(q, grip, mu, r, {{-0.01, 0.0}, {0.01, 0.0}}, 1e-6, kRate);
  add_patch(q, ContactBody::kPusher, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, mu_sheet,
            {{-0.01, -r, 0.0}, {0.01, -r, 0.0}});
  q.V_HP[2] = kRate;
  set_gravity(q, {0.0, -weight, 0.0}, Vec3::Zero());
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
    SpatialProblem q;
    add_jaws(q, 20.0, 0.5, 0.01, {{0.0, 0.0}}, kSoftness, kRate);
    for (int k = 0; k < 2; ++k) q.patch[k].spin_radius = e;
    add_patch(q, ContactBody::kPusher, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.0,
              {{-0.02, -d, 0.0}});
    q.V_HP[0] = kRate;
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

// Whatever the inertia, down to none: the answers of the ordinary range, at rounding.
TEST(SpatialPivoting, OrdinaryInstantsAreSolvedToRounding) {
  for (const bool inertia : {true, false}) {
    Random random(2);
    int solved = 0;
    int asked = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const SpatialProblem q =
          random_spatial(random, {.points_per_pad = trial % 2 == 0 ? 1 : 4,
                                  .pushers = 1 + trial % 3 / 2,
                                  .softness = random.log_in(1e-4, 1e-1),
                                  .push_rate = inertia ? random.log_in(1e-6, 10.0) : 0.1,
                                  .inertia = inertia});
      const SpatialReference answer = solve_spatial_pivoting(q);
      ++asked;
      if (answer.status != SpatialReferenceStatus::kSolved) continue;
      ++solved;
      EXPECT_LT(answer.residual, 1e-9);
    }
    // Without inertia some grasps do not hold gravity and have no answer.
    EXPECT_GE(solved, inertia ? asked - 1 : asked * 85 / 100);
  }
}

double twist_distance(const SpatialTwist& a, const SpatialTwist& b, double length) {
  SpatialTwist difference = a - b;
  difference.tail<3>() *= length;
  return difference.norm();
}

// More generators, less to go: medians against g = 64 fall by about 4 in force for each
// doubling.
TEST(SpatialPivoting, RandomInstantsComeTogetherAsGGrows) {
  Random random(3);
  std::vector<std::vector<double>> errors(4);
  for (int trial = 0; trial < 60; ++trial) {
    const SpatialProblem q =
        random_spatial(random, {.points_per_pad = 1, .pushers = 2, .inertia = true});
    const SpatialReference fine = solve_spatial_pivoting(q, {.generators = 64});
    if (fine.status != SpatialReferenceStatus::kSolved) continue;
    for (int level = 0; level < 4; ++level) {
      const SpatialReference coarse =
          solve_spatial_pivoting(q, {.generators = 4 << level});
      if (coarse.status != SpatialReferenceStatus::kSolved) continue;
      errors[level].push_back((coarse.w_push - fine.w_push).head<3>().norm() /
                              fine.w_push.head<3>().norm());
    }
  }
  std::vector<double> median;
  for (auto& level : errors) {
    ASSERT_GT(level.size(), 50u);
    std::nth_element(level.begin(), level.begin() + level.size() / 2, level.end());
    median.push_back(level[level.size() / 2]);
  }
  EXPECT_LT(median[1], 0.7 * median[0]);
  EXPECT_LT(median[2], 0.7 * median[1]);
  EXPECT_LT(median[3], 0.7 * median[2]);
  EXPECT_LT(median[3], 0.03);
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

// Two ways that share no solver: where both answer, it is the same answer.
TEST_F(SpatialInteriorPoint, AgreesWithPivoting) {
  Random random(4);
  int both = 0;
  int same = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const SpatialProblem q = random_spatial(
        random, {.points_per_pad = trial % 2 == 0 ? 1 : 4, .inertia = true});
    const SpatialReference one = solve_spatial_pivoting(q, {.generators = 6});
    const SpatialReference other =
        solve_spatial_reference(q, {.generators = 6, .starts = 4});
    if (one.status != SpatialReferenceStatus::kSolved ||
        other.status != SpatialReferenceStatus::kSolved) {
      continue;
    }
    ++both;
    if (twist_distance(one.V_HO, other.V_HO, 0.02) < 1e-4 * 0.1 &&
        (one.w_push - other.w_push).norm() < 1e-4 * q.grip_force) {
      ++same;
    }
  }
  EXPECT_GE(both, 24);
  EXPECT_GE(same, both - 2);  // one point per pad: two motions may be possible
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
  set_gravity(q, {0.0, -30.0, 0.0}, Vec3::Zero());
  const SpatialReference answer = solve_spatial_pivoting(q);
  EXPECT_NE(answer.status, SpatialReferenceStatus::kSolved);
  if (!spatial_reference_is_built()) return;
  EXPECT_EQ(solve_spatial_reference(q, {.starts = 2}).status,
            SpatialReferenceStatus::kNotFound);
}

}  // namespace
}  // namespace prehensile
