/// The paper's instant in space on polyhedral cones: generators, rows that agree with the
/// laws, residuals that see every fault, mixed problems solved by pivoting.
#include "mechanics/linear_cone.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "mechanics/mixed_lemke.h"
#include "problems/random_spatial.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

TEST(LinearCone, GeneratorsAreUnitAndComeWithTheirOpposites) {
  for (const bool soft : {false, true}) {
    for (const int g : {4, 6, 8, 16, 32}) {
      const Eigen::Matrix3Xd d = friction_generators(g, soft);
      EXPECT_EQ(d.cols(), soft ? (g / 2 - 1) * g + 2 : g);
      for (Eigen::Index k = 0; k < d.cols(); ++k) {
        EXPECT_NEAR(d.col(k).norm(), 1.0, 1e-15);
        EXPECT_LT((d.colwise() + d.col(k)).colwise().norm().minCoeff(), 1e-14);
        if (!soft) {
          EXPECT_EQ(d(2, k), 0.0);
        }
      }
    }
  }
}

// The support of the generators in any direction is 1 but for O(1 / g^2).
TEST(LinearCone, GeneratorsFillTheRoundSetAsTheyGrow) {
  Random random(1);
  for (const bool soft : {false, true}) {
    for (const int g : {4, 8, 16, 32, 64}) {
      const Eigen::Matrix3Xd d = friction_generators(g, soft);
      double least = 1.0;
      for (int trial = 0; trial < 500; ++trial) {
        Vec3 u(random.in(-1.0, 1.0), random.in(-1.0, 1.0), random.in(-1.0, 1.0));
        if (!soft) u.z() = 0.0;
        least = std::min(least, (d.transpose() * u.normalized()).maxCoeff());
      }
      const double angle = (soft ? std::numbers::sqrt2 : 1.0) * std::numbers::pi / g;
      EXPECT_GE(least, std::cos(angle) - 1e-12);
    }
  }
}

SpatialProblem any_problem(int trial) {
  const JawMode modes[] = {JawMode::kCoupled, JawMode::kFixedJaw1, JawMode::kIndependent,
                           JawMode::kLocked, JawMode::kFixedJaw2};
  SpatialProblem q = random_spatial(1, trial,
                                    {.points_per_pad = trial % 3 == 0 ? 1 : 4,
                                     .jaw_mode = modes[trial % 5],
                                     .acceleration = trial % 4 < 2 ? 0.1 : 0.0,
                                     .spin_radius = trial % 6 == 0 ? 4e-3 : 0.0});
  if (trial % 7 == 0) q.patch[2].mu = 0.0;
  if (trial % 8 == 0) {
    for (int k = 0; k < 2; ++k) q.patch[k].pressure = PressureLaw::kGiven;
  }
  return q;
}

// The residual is read from the laws, the rows are assembled: at any point both see the
// same. (xi is an unknown there and a consequence here: it is set to what slip asks for.)
TEST(LinearCone, RowsAndLawsAgreeAtAnyPoint) {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const SpatialProblem q = any_problem(trial);
    const int g = 4 + 2 * random.below(6);
    LinearCone cone;
    ASSERT_TRUE(pose_linear_cone(q, g, cone));
    const ComplementarityProblem problem = complementarity_of(cone);
    EXPECT_EQ(problem.variables, cone.unknowns);
    EXPECT_EQ(problem.constant.size(), static_cast<std::size_t>(cone.unknowns));
    std::vector<double> z(cone.unknowns);
    for (double& value : z) value = random.in(0.0, 1.0);
    for (const LinearConeContact& contact : cone.contact) {
      if (contact.xi < 0) continue;
      const Eigen::Map<const Eigen::VectorXd> v(z.data(), cone.freedoms);
      const Eigen::VectorXd slip =
          contact.D.topRows(cone.freedoms).transpose() * v - contact.D_drive;
      z[contact.xi] = std::max(0.0, -slip.minCoeff());
    }
    const double by_rows = residual_of(problem, z);
    const double by_laws = linear_cone_residual(q, g, forces_of(q, cone, g, z));
    EXPECT_NEAR(by_rows, by_laws, 1e-12 * (1.0 + by_laws));
  }
}

TEST(LinearCone, EveryPerturbationShows) {
  int answers = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const SpatialProblem q = random_spatial(
        2, trial,
        {.points_per_pad = 4, .pusher_points = 2, .acceleration = trial % 2 * 0.1});
    LinearCone cone;
    ASSERT_TRUE(pose_linear_cone(q, 8, cone));
    const PivotingResult found = solve_by_pivoting(complementarity_of(cone));
    if (found.status != LcpStatus::kSolved) continue;
    ++answers;
    const LinearConeForces answer = forces_of(q, cone, 8, found.z);
    EXPECT_LT(linear_cone_residual(q, 8, answer), 1e-11);
    const auto shows = [&](auto&& perturb) {
      LinearConeForces wrong = answer;
      perturb(wrong);
      return linear_cone_residual(q, 8, wrong);
    };
    const double rate = 1e-3 * cone.rate;
    const double force = 1e-3 * cone.force;
    for (std::size_t i = 0; i < answer.point.size(); ++i) {
      EXPECT_GT(shows([&](LinearConeForces& a) { a.point[i].normal_force += force; }),
                1e-4);
      EXPECT_GT(shows([&](LinearConeForces& a) { a.point[i].beta[3] += force; }), 1e-4);
    }
    EXPECT_GT(shows([&](LinearConeForces& a) { a.jaw_rate[0] += rate; }), 1e-5);
    EXPECT_GT(shows([&](LinearConeForces& a) { a.V_HO[2] += rate; }), 1e-5);
    EXPECT_GT(shows([&](LinearConeForces& a) { a.V_HO[1] = std::nan(""); }), 1e300);
  }
  EXPECT_GT(answers, 35);
}

TEST(LinearCone, UnitsMakeScaledQuestionsEqual) {
  const SpatialProblem q = random_spatial(3, 0, {.acceleration = 0.1});
  SpatialProblem scaled = q;
  const double length = 30.0;
  const double force = 1e5;
  const double rate = 1e-7;
  for (int i = 0; i < q.count; ++i) {
    scaled.x[i] *= length;
    scaled.y[i] *= length;
    scaled.z[i] *= length;
    scaled.preload[i] *= force;
  }
  for (int k = 0; k < q.patch_count; ++k) scaled.patch[k].compliance *= rate / force;
  scaled.grip_force *= force;
  scaled.w_g.head<3>() *= force;
  scaled.w_g.tail<3>() *= force * length;
  scaled.V_HP.head<3>() *= rate;
  scaled.V_HP.tail<3>() *= rate / length;
  scaled.jaw_mass *= force / rate;
  scaled.inertia *= force / rate;
  scaled.inertia.topRightCorner<3, 3>() *= length;
  scaled.inertia.bottomLeftCorner<3, 3>() *= length;
  scaled.inertia.bottomRightCorner<3, 3>() *= length * length;
  LinearCone one, other;
  ASSERT_TRUE(pose_linear_cone(q, 8, one));
  ASSERT_TRUE(pose_linear_cone(scaled, 8, other));
  EXPECT_LT((one.inertia - other.inertia).norm(), 1e-12 * one.inertia.norm());
  EXPECT_LT((one.load - other.load).norm(), 1e-13);
  for (std::size_t i = 0; i < one.contact.size(); ++i) {
    EXPECT_LT((one.contact[i].n - other.contact[i].n).norm(), 1e-13);
    EXPECT_LT((one.contact[i].D - other.contact[i].D).norm(), 1e-13);
    EXPECT_NEAR(one.contact[i].compliance, other.contact[i].compliance, 1e-15);
    EXPECT_NEAR(one.contact[i].preload, other.contact[i].preload, 1e-15);
  }
}

TEST(LinearCone, RefusesWhatMakesNoSense) {
  const SpatialProblem good = random_spatial(4, 0, {.pusher_points = 1});
  LinearCone cone;
  EXPECT_TRUE(pose_linear_cone(good, 8, cone));
  for (const int g : {0, 3, 7, 66, -8}) EXPECT_FALSE(pose_linear_cone(good, g, cone));
  const auto refused = [&](auto&& spoil) {
    SpatialProblem bad = good;
    spoil(bad);
    return !pose_linear_cone(bad, 8, cone);
  };
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.V_HP.setZero(); }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch_count = 2; }));  // no pusher
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch_count = 5; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch[0].mu = -0.1; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch[0].n *= 1.1; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch[0].compliance = 0.0; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.patch[1].count = 100; }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.x[2] = std::nan(""); }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.w_g[4] = std::nan(""); }));
  EXPECT_TRUE(refused([](SpatialProblem& q) { q.grip_force = -1.0; }));
}

/// Mixed problems built backwards from an answer: A positive semidefinite in the pairs,
/// free variables with or without a diagonal of their own.
struct MixedCase {
  ComplementarityProblem problem;
  std::vector<double> answer;
};

MixedCase random_mixed(Random& random, int free, int pairs, double own) {
  const int n = free + pairs;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd root(pairs, pairs);
  for (double& value : root.reshaped()) value = random.in(-1.0, 1.0);
  A.bottomRightCorner(pairs, pairs) = root * root.transpose();
  for (int i = 0; i < free; ++i) {
    A(i, i) = own;
    for (int k = free; k < n; ++k) {
      A(k, i) = random.in(-1.0, 1.0);
      A(i, k) = -A(k, i);
    }
  }
  MixedCase mixed;
  mixed.problem.variables = n;
  Eigen::VectorXd z(n), s = Eigen::VectorXd::Zero(n);
  for (int i = 0; i < n; ++i) {
    const bool loose = i < free || random.chance(0.5);
    z[i] = loose ? random.in(i < free ? -1.0 : 0.1, 1.0) : 0.0;
    if (!loose) s[i] = random.in(0.1, 1.0);
  }
  const Eigen::VectorXd constant = s - A * z;
  for (int i = 0; i < n; ++i) {
    mixed.problem.add_row(i < free ? ComplementarityProblem::kEquality : i, constant[i]);
    for (int k = 0; k < n; ++k) mixed.problem.add(i, k, A(i, k));
  }
  mixed.answer.assign(z.begin(), z.end());
  return mixed;
}

TEST(MixedLemke, FindsTheAnswerWithAndWithoutInertia) {
  Random random(6);
  for (int trial = 0; trial < 600; ++trial) {
    const int free = 1 + random.below(5);
    const int pairs = free + random.below(8);
    const double own = trial % 3 == 0 ? 0.0 : random.log_in(1e-12, 1.0);
    const MixedCase mixed = random_mixed(random, free, pairs, own);
    EXPECT_LT(residual_of(mixed.problem, mixed.answer), 1e-13);
    const PivotingResult found = solve_by_pivoting(mixed.problem, {.starts = 4});
    ASSERT_EQ(found.status, LcpStatus::kSolved) << trial << " own " << own;
    EXPECT_LT(found.residual, 1e-9);
    EXPECT_EQ(found.residual, residual_of(mixed.problem, found.z));
  }
}

TEST(MixedLemke, SharpeningUndoesABlur) {
  Random random(7);
  for (int trial = 0; trial < 100; ++trial) {
    const MixedCase mixed = random_mixed(random, 2, 8, 0.5);
    std::vector<double> blurred = mixed.answer;
    for (double& value : blurred) value += random.in(0.0, 1e-4);
    EXPECT_GT(residual_of(mixed.problem, blurred), 1e-6);
    EXPECT_LT(residual_of(mixed.problem, sharpened(mixed.problem, blurred)), 1e-10);
  }
}

TEST(MixedLemke, SaysWhatItCannotDo) {
  // More free variables than equalities.
  ComplementarityProblem loose;
  loose.variables = 2;
  loose.add_row(1, 1.0);
  EXPECT_EQ(solve_by_pivoting(loose).status, LcpStatus::kRay);
  // z >= 2 by the equality with the free variable, s = 1 - z >= 0.
  ComplementarityProblem never;
  never.variables = 2;
  never.add(never.add_row(ComplementarityProblem::kEquality, -1.0), 0, 1.0);
  const int row = never.add_row(1, -2.0);
  never.add(row, 1, -1.0);
  never.add(row, 0, 1.0);
  EXPECT_EQ(solve_by_pivoting(never).status, LcpStatus::kInfeasible);
  // A free variable that nothing mentions stays at zero.
  ComplementarityProblem idle;
  idle.variables = 2;
  idle.add_row(ComplementarityProblem::kEquality, 0.0);
  idle.add(idle.add_row(1, -1.0), 1, 1.0);
  const PivotingResult found = solve_by_pivoting(idle);
  ASSERT_EQ(found.status, LcpStatus::kSolved);
  EXPECT_EQ(found.z[0], 0.0);
  EXPECT_NEAR(found.z[1], 1.0, 1e-15);
}

}  // namespace
}  // namespace prehensile
