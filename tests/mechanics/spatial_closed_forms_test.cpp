#include <gtest/gtest.h>

#include "mechanics/cross_section.h"
#include "mechanics/limit_surface.h"
#include "mechanics/spatial_instant.h"
#include "problems/random_instants.h"
#include "tests/mechanics/spatial_cases.h"

namespace prehensile {
namespace {

using testing::disc_points;
using testing::grasp_of;
using testing::PadLaw;
using testing::push;
using testing::square_points;
using testing::told;
using testing::weight_at;

constexpr double kTight = 1e-6;
constexpr double kRate = 0.01;

SpatialInstant certified(const SpatialProblem& problem) {
  SpatialInstant answer = solve_spatial(problem);
  const SpatialCertificate certificate = certify(problem, answer);
  EXPECT_TRUE(certificate.holds()) << name(answer.status) << ": " << told(certificate);
  return answer;
}

const SpatialPoint& pusher_point(const SpatialProblem& problem,
                                 const SpatialInstant& answer, int i) {
  return answer.point[problem.patch[2].first + i];
}

// Closed forms of pushes in the pad plane: both fingers together carry 2 mu N = 20 N.

TEST(SpatialClosedForms, StraightSlideOfALinePusher) {
  for (const PressureLaw law : {PressureLaw::kFoundation, PressureLaw::kGiven}) {
    SpatialProblem problem =
        grasp_of(square_points(4, 0.006), 0.01, 20.0, {.mu = 0.5, .pressure = law});
    problem.w_g = weight_at({0.01, 0.007, 0.0}, {0.0, -4.0, 0.0});
    push(problem, {{-0.04, -0.03, 0.0}, {-0.04, 0.03, 0.0}}, Vec3::UnitX(), 0.5,
         {kRate, 0.0, 0.0});
    const SpatialInstant answer = certified(problem);
    EXPECT_EQ(answer.status, InstantStatus::kMoves);
    EXPECT_NEAR((answer.V_HO - problem.V_HP).head<3>().norm(), 0.0, kTight * kRate);
    EXPECT_NEAR(pusher_point(problem, answer, 0).normal_force, 40.0 / 3.0, 20 * kTight);
    EXPECT_NEAR(pusher_point(problem, answer, 1).normal_force, 20.0 / 3.0, 20 * kTight);
    EXPECT_NEAR(answer.w_push[1], 4.0, 20 * kTight);
  }
}

TEST(SpatialClosedForms, StraightSlideWithAccelerationAddsInertia) {
  SpatialProblem problem = grasp_of(square_points(4, 0.006), 0.01, 20.0, {.mu = 0.5});
  const double mass = 0.4;
  const double a = 3.0;
  problem.inertia.topLeftCorner<3, 3>() = mass * Eigen::Matrix3d::Identity();
  problem.inertia.bottomRightCorner<3, 3>() = 2e-4 * Eigen::Matrix3d::Identity();
  push(problem, {{-0.04, -0.03, 0.0}, {-0.04, 0.03, 0.0}}, Vec3::UnitX(), 0.5,
       {a, 0.0, 0.0});
  EXPECT_NEAR(certified(problem).push_force, 20.0 + mass * a, 20 * kTight);
}

TEST(SpatialClosedForms, SlipDownAVerticalLinePusher) {
  const double capacity = 20.0;
  for (const double mu_p : {0.0, 0.1, 0.3, 0.6}) {
    for (const double weight : {mu_p * capacity * 1.001 + 0.1, 13.0, 19.0}) {
      if (weight < mu_p * capacity) continue;
      SpatialProblem problem = grasp_of(square_points(4, 0.006), 0.01, 20.0, {.mu = 0.5});
      problem.w_g = weight_at(Vec3::Zero(), {0.0, -weight, 0.0});
      push(problem, {{-0.01, -0.04, 0.0}, {-0.01, 0.04, 0.0}}, Vec3::UnitX(), mu_p,
           {kRate, 0.0, 0.0});
      const SpatialInstant answer = certified(problem);
      const double phi =
          std::asin(weight / (capacity * std::sqrt(1.0 + mu_p * mu_p))) - std::atan(mu_p);
      ASSERT_EQ(answer.status, InstantStatus::kMoves);
      EXPECT_NEAR(std::atan2(-answer.V_HO[1], answer.V_HO[0]), phi, kTight);
      EXPECT_NEAR(answer.w_push[0], capacity * std::cos(phi), capacity * kTight);
    }
  }
}

TEST(SpatialClosedForms, PivotOfATwoPointPad) {
  const double b = 0.004;
  for (const double d : {0.001, 0.01, 0.05, 0.3}) {
    SpatialProblem problem = grasp_of({{0.0, b}, {0.0, -b}}, 0.01, 20.0, {.mu = 0.5});
    push(problem, {{d, 0.0, 0.0}}, Vec3::UnitY(), 0.4, {0.0, kRate, 0.0});
    const SpatialInstant answer = certified(problem);
    EXPECT_NEAR(answer.push_force, 20.0 * b / std::hypot(b, d), 20.0 * kTight);
    EXPECT_NEAR(answer.V_HO[1] / answer.V_HO[5], b * b / d, kTight * b);
  }
}

TEST(SpatialClosedForms, HoldingCapacityOfATwoPointPad) {
  const double b = 0.004;
  for (const double d : {0.0, 0.001, 0.01, 0.05}) {
    const double limit = 20.0 * b / std::hypot(b, d);
    for (const double share : {0.5, 0.99999, 1.00001, 1.5}) {
      SpatialProblem problem = grasp_of({{0.0, b}, {0.0, -b}}, 0.01, 20.0, {.mu = 0.5});
      problem.w_g = weight_at({d, 0.0, 0.0}, {0.0, -share * limit, 0.0});
      // A pusher that leaves the object: it stays only if the pads hold it.
      push(problem, {{0.02, 0.0, 0.0}}, -Vec3::UnitX(), 0.3, {kRate, 0.0, 0.0});
      EXPECT_EQ(certified(problem).status,
                share < 1.0 ? InstantStatus::kSeparated : InstantStatus::kDynamic)
          << d << " " << share;
    }
  }
}

TEST(SpatialClosedForms, TorsionOfADiscPad) {
  const double radius = 0.009;
  const double limit = 2.0 * 2.0 / 3.0 * 0.5 * 20.0 * radius;
  for (const double share : {0.99, 1.01}) {
    SpatialProblem problem = grasp_of(disc_points(64, radius), 0.01, 20.0, {.mu = 0.5});
    problem.w_g[5] = share * limit;
    push(problem, {{0.02, 0.0, 0.0}}, -Vec3::UnitX(), 0.3, {kRate, 0.0, 0.0});
    EXPECT_EQ(certified(problem).status,
              share < 1.0 ? InstantStatus::kSeparated : InstantStatus::kDynamic);
  }
}

// A soft point is an ellipsoidal limit surface.

TEST(SpatialClosedForms, MotionConeEdgesOfSoftPoints) {
  const double rho = 0.006;
  for (const double mu_p : {0.1, 0.3, 0.7}) {
    for (const double d : {0.003, 0.009, 0.03}) {
      const double edge = std::atan(mu_p * (1.0 + d * d / (rho * rho)));
      for (const double side : {-1.0, 1.0}) {
        for (const double factor : {1.0 - 1e-5, 1.0 + 1e-5}) {
          const double psi = side * factor * edge;
          SpatialProblem problem =
              grasp_of({{0.0, 0.0}}, 0.01, 20.0, {.mu = 0.5, .spin_radius = rho});
          push(problem, {{0.0, -d, 0.0}}, Vec3::UnitY(), mu_p,
               {kRate * std::sin(psi), kRate * std::cos(psi), 0.0});
          const SpatialInstant answer = certified(problem);
          EXPECT_EQ(pusher_point(problem, answer, 0).mode,
                    factor < 1.0 ? ContactMode::kStick : ContactMode::kSlip)
              << mu_p << " " << d << " " << factor;
        }
      }
    }
  }
}

TEST(SpatialClosedForms, SoftPointsMatchTheLimitSurface) {
  int moves = 0;
  for (int i = 0; i < 300; ++i) {
    const RandomInstant q = random_instant(3, i, {.points_per_pad = 1});
    const double N = q.grasp.bound[0];  // 2 mu N with mu = 1/2
    const double rho = 0.006;
    SpatialProblem problem =
        grasp_of({{0.0, 0.0}}, 0.01, N, {.mu = 0.5, .spin_radius = rho});
    problem.w_g << q.grasp.w_g[0], q.grasp.w_g[1], 0.0, 0.0, 0.0, q.grasp.w_g[2];
    const auto flat = [](const Vec2& p) { return Vec3(p.x(), p.y(), 0.0); };
    const Vec3 n = flat(q.drive.n_H);
    if (q.drive.count == 1) {
      push(problem, {flat(q.drive.p_HC[0])}, n, q.drive.mu, Vec3::Zero());
    } else {
      push(problem, {flat(q.drive.p_HC[0]), flat(q.drive.p_HC[1])}, n, q.drive.mu,
           Vec3::Zero());
    }
    problem.V_HP << q.drive.V_HP[0], q.drive.V_HP[1], 0.0, 0.0, 0.0, q.drive.V_HP[2];
    const SpatialInstant spatial = certified(problem);
    const PlanarInstant planar =
        solve_limit_surface({q.grasp.bound[0], rho}, q.grasp.w_g, q.drive);
    if (planar.status != InstantStatus::kMoves) continue;
    ++moves;
    EXPECT_EQ(spatial.status, InstantStatus::kMoves) << i;
    EXPECT_NEAR(spatial.push_force, planar.push_force, kTight * q.grasp.bound[0]) << i;
  }
  EXPECT_GT(moves, 50);
}

// A cylinder (radius r, axis along y) between the jaws on a sheet that moves along z.

struct Roll {
  double r = 0.02;
  double N = 10.0;
  double mu = 0.3;
  double weight = 20.0;
};

SpatialProblem rolling(const Roll& roll, JawMode mode, double mu_sheet,
                       PressureLaw pressure = PressureLaw::kFoundation) {
  SpatialProblem problem = grasp_of({{0.0, -0.01}, {0.0, 0.01}}, roll.r, roll.N,
                                    {.mu = roll.mu, .pressure = pressure});
  problem.jaw_mode = mode;
  problem.w_g = weight_at(Vec3::Zero(), {-roll.weight, 0.0, 0.0});
  push(problem, {{-roll.r, -0.015, 0.0}, {-roll.r, 0.015, 0.0}}, Vec3::UnitX(), mu_sheet,
       {0.0, 0.0, kRate});
  return problem;
}

/// The sheet moves towards jaw 2: jaw 1 is upstream.
double traction(const Roll& roll, JawMode mode) {
  const double both = 2.0 * roll.mu * roll.N;
  switch (mode) {
    case JawMode::kFixedJaw1:
      return both / (1.0 + roll.mu);
    case JawMode::kFixedJaw2:
      return both / (1.0 - roll.mu);
    default:
      return both;
  }
}

TEST(SpatialClosedForms, RollingThreshold) {
  const Roll roll;
  for (const JawMode mode :
       {JawMode::kCoupled, JawMode::kFixedJaw1, JawMode::kFixedJaw2}) {
    const double F_t = traction(roll, mode);
    const double N_e = roll.weight + roll.mu * F_t;
    const double threshold = F_t / N_e;
    const CrossSectionModel section = {.radius = roll.r,
                                       .mass = roll.weight / 9.81,
                                       .grip_force = roll.N,
                                       .friction = {roll.mu, roll.mu},
                                       .jaw_mode = mode};
    EXPECT_NEAR(rolling_threshold(section, kRate, roll.weight), threshold, 1e-12);
    for (const double factor : {0.9, 0.9999, 1.0001, 1.1, 2.0}) {
      const SpatialProblem problem = rolling(roll, mode, factor * threshold);
      const SpatialInstant answer = certified(problem);
      const double roll_rate = std::abs(answer.V_HO[4]) * roll.r / kRate;
      if (factor < 1.0) {
        EXPECT_LT(roll_rate, 0.01) << factor;
        continue;
      }
      EXPECT_GT(roll_rate, 0.9) << factor;
      EXPECT_NEAR(answer.w_push[2], F_t, 20 * kTight);
      EXPECT_NEAR(answer.w_push[0], N_e, 20 * kTight);
    }
  }
}

TEST(SpatialClosedForms, CrossSectionKnowsJawsWithOneRateOnly) {
  const Roll roll;
  const CrossSectionDrive sheet = {.mu = 0.2, .sheet_rate = kRate, .weight = roll.weight};
  for (const JawMode mode :
       {JawMode::kCoupled, JawMode::kIndependent, JawMode::kLocked}) {
    const CrossSectionModel section = {.radius = roll.r,
                                       .mass = roll.weight / 9.81,
                                       .grip_force = roll.N,
                                       .friction = {roll.mu, roll.mu},
                                       .jaw_mode = mode};
    EXPECT_EQ(solve_cross_section(section, sheet).status == InstantStatus::kBadInput,
              mode != JawMode::kCoupled);
  }
}

TEST(SpatialClosedForms, ForceOnASlidingCylinderLiesInTheInterval) {
  for (const double weight : {4.0, 20.0}) {
    const Roll roll = {.weight = weight};
    const double grip = 2.0 * roll.mu * roll.N;
    for (const double mu_e : {0.05, 0.15, 0.25}) {
      const double low = std::max(0.0, (weight - grip) / (1.0 - mu_e * (1.0 + roll.mu)));
      const double high = (weight + grip) / (1.0 + mu_e * (1.0 - roll.mu));
      for (const PressureLaw law : {PressureLaw::kFoundation, PressureLaw::kFree}) {
        const SpatialProblem problem = rolling(roll, JawMode::kCoupled, mu_e, law);
        const SpatialInstant answer = certified(problem);
        EXPECT_GE(answer.w_push[0], low - 20 * kTight) << mu_e;
        EXPECT_LE(answer.w_push[0], high + 20 * kTight) << mu_e;
        if (answer.status == InstantStatus::kNonuniqueForces) {
          EXPECT_NEAR(answer.force_low, low, 20 * kTight) << mu_e;
          EXPECT_NEAR(answer.force_high, high, 20 * kTight) << mu_e;
        }
        // The jaws alone hold the lighter one only.
        EXPECT_EQ(answer.status, weight > grip ? InstantStatus::kAmbiguous
                                 : law == PressureLaw::kFree
                                     ? InstantStatus::kNonuniqueForces
                                     : InstantStatus::kHolds)
            << name(answer.status);
      }
    }
  }
}

// A pusher that presses the object against a fixed jaw.

SpatialProblem wedge(double alpha, double mu_f, double mu_p) {
  const double h = 0.01;
  const double length = 0.03;
  SpatialProblem problem = grasp_of(square_points(2, 0.003), h, 20.0, {.mu = mu_f});
  problem.jaw_mode = JawMode::kFixedJaw1;
  // From the fixed jaw, the pusher is seen at this angle from the jaw's normal.
  const Vec3 jaw(0.0, 0.0, -h);
  const Vec3 towards(-std::sin(alpha), 0.0, std::cos(alpha));
  push(problem, {jaw + length * towards}, Vec3::UnitX(), mu_p, -kRate * towards);
  return problem;
}

TEST(SpatialClosedForms, WedgesWhereTheConesSeeEachOther) {
  for (const double degrees : {30.0, 45.0, 60.0}) {
    const double alpha = degrees * std::numbers::pi / 180.0;
    for (const double margin_f : {0.6, 1.4}) {
      for (const double margin_p : {0.6, 1.4}) {
        const SpatialProblem problem =
            wedge(alpha, margin_f * std::tan(alpha), margin_p / std::tan(alpha));
        const SpatialInstant answer = certified(problem);
        const bool jams = margin_f > 1.0 && margin_p > 1.0;
        EXPECT_EQ(answer.status == InstantStatus::kJammed, jams)
            << degrees << " " << margin_f << " " << margin_p << " "
            << name(answer.status);
      }
    }
  }
}

TEST(SpatialClosedForms, PushOntoTheFixedJawJams) {
  SpatialProblem problem = grasp_of(square_points(2, 0.004), 0.01, 20.0, {.mu = 0.5});
  problem.jaw_mode = JawMode::kFixedJaw1;
  push(problem, {{0.0, 0.0, 0.01}}, -Vec3::UnitZ(), 0.3, {0.0, 0.0, -kRate});
  EXPECT_EQ(certified(problem).status, InstantStatus::kJammed);
}

}  // namespace
}  // namespace prehensile
