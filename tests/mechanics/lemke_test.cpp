/// Complementary pivoting: against enumeration, on every class of matrix it promises to
/// answer, on ties, and on problems that have no answer.
#include "mechanics/lemke.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace prehensile {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::Random;

MatrixXd random_matrix(Random& random, int rows, int columns) {
  MatrixXd A(rows, columns);
  for (double& value : A.reshaped()) value = random.in(-1.0, 1.0);
  return A;
}

VectorXd random_vector(Random& random, int n) { return random_matrix(random, n, 1); }

/// Positive definite plus skew: all principal minors are positive, not symmetric.
MatrixXd random_p_matrix(Random& random, int n) {
  const MatrixXd A = random_matrix(random, n, n);
  const MatrixXd S = random_matrix(random, n, n);
  return A * A.transpose() + 0.1 * MatrixXd::Identity(n, n) + S - S.transpose();
}

/// Every complementary pattern whose linear equations have one solution that fits.
std::vector<VectorXd> enumerated(const MatrixXd& M, const VectorXd& q) {
  const int n = static_cast<int>(q.size());
  std::vector<VectorXd> answers;
  for (int pattern = 0; pattern < (1 << n); ++pattern) {
    MatrixXd B = MatrixXd::Identity(n, n);
    for (int i = 0; i < n; ++i) {
      if ((pattern >> i & 1) != 0) B.col(i) = -M.col(i);
    }
    const Eigen::FullPivLU<MatrixXd> lu(B);
    if (!lu.isInvertible()) continue;
    const VectorXd x = lu.solve(q);
    if (x.minCoeff() < -1e-12) continue;
    VectorXd z = VectorXd::Zero(n);
    for (int i = 0; i < n; ++i) {
      if ((pattern >> i & 1) != 0) z[i] = x[i];
    }
    answers.push_back(z);
  }
  return answers;
}

void expect_answer(const MatrixXd& M, const VectorXd& q, const LcpSolution& s) {
  ASSERT_EQ(s.status, LcpStatus::kSolved);
  EXPECT_GE(s.z.minCoeff(), 0.0);
  const VectorXd w = M * s.z + q;
  EXPECT_EQ((w - s.w).cwiseAbs().maxCoeff(), 0.0);
  double natural = 0.0;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    natural = std::max(natural, std::abs(std::min(s.z[i], w[i])));
  }
  EXPECT_EQ(s.residual, natural);
  EXPECT_LT(s.relative_residual, 1e-12);
}

void expect_proof(const MatrixXd& M, const VectorXd& q, const LcpSolution& s) {
  ASSERT_EQ(s.status, LcpStatus::kInfeasible);
  EXPECT_GE(s.ray.minCoeff(), 0.0);
  EXPECT_LT(s.ray.dot(q), 0.0);
  EXPECT_LE((M.transpose() * s.ray).maxCoeff(), 1e-9 * s.ray.sum());
}

TEST(Lemke, PMatricesHaveTheOneAnswerThatEnumerationFinds) {
  Random random(1);
  for (int trial = 0; trial < 600; ++trial) {
    const int n = 1 + random.below(trial % 20 == 0 ? 10 : 7);
    const MatrixXd M = random_p_matrix(random, n);
    const VectorXd q = random_vector(random, n);
    const LcpSolution s = solve_lcp(M, q);
    expect_answer(M, q, s);
    const std::vector<VectorXd> all = enumerated(M, q);
    ASSERT_FALSE(all.empty());
    for (const VectorXd& z : all) EXPECT_LT((z - s.z).norm(), 1e-9 * (1.0 + z.norm()));
  }
}

TEST(Lemke, TenThousandPMatrices) {
  Random random(2);
  for (int trial = 0; trial < 10000; ++trial) {
    const int n = 1 + random.below(20);
    const MatrixXd M = random_p_matrix(random, n);
    const VectorXd q = random_vector(random, n);
    expect_answer(M, q, solve_lcp(M, q));
    if (HasFatalFailure()) return;
  }
}

/// Convex quadratic programmes, often with flat costs and doubled rows: copositive-plus.
struct QuadraticProgramme {
  MatrixXd M;
  VectorXd q;
};

QuadraticProgramme random_programme(Random& random, int n, int m, int rank) {
  const MatrixXd root = random_matrix(random, n, rank);
  MatrixXd A = random_matrix(random, m, n);
  if (m > 1) A.row(m - 1) = A.row(0);
  QuadraticProgramme p{MatrixXd::Zero(n + m, n + m), random_vector(random, n + m)};
  p.M.topLeftCorner(n, n) = root * root.transpose();
  p.M.topRightCorner(n, m) = -A.transpose();
  p.M.bottomLeftCorner(m, n) = A;
  return p;
}

TEST(Lemke, CopositivePlusMatricesAreAnsweredOrProvedInfeasible) {
  Random random(3);
  int solved = 0;
  int infeasible = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const int n = 1 + random.below(8);
    const int m = random.below(6);
    const auto [M, q] = random_programme(random, n, m, random.below(n + 1));
    const LcpSolution s = solve_lcp(M, q);
    if (s.status == LcpStatus::kSolved) {
      ++solved;
      expect_answer(M, q, s);
    } else {
      ++infeasible;
      expect_proof(M, q, s);
      if (n + m <= 6) {
        EXPECT_TRUE(enumerated(M, q).empty());
      }
    }
  }
  EXPECT_GT(solved, 500);
  EXPECT_GT(infeasible, 500);
}

TEST(Lemke, FeasibleProgrammesAreNeverCalledInfeasible) {
  Random random(4);
  for (int trial = 0; trial < 2000; ++trial) {
    const int n = 1 + random.below(8);
    const int m = random.below(6);
    auto [M, q] = random_programme(random, n, m, random.below(n + 1));
    // Backwards from an answer, half of whose pairs are zero on both sides.
    VectorXd z = VectorXd::Zero(n + m);
    VectorXd w = VectorXd::Zero(n + m);
    for (Eigen::Index i = 0; i < n + m; ++i) {
      if (random.chance(0.5)) (random.chance(0.5) ? z : w)[i] = random.in(0.1, 1.0);
    }
    q = w - M * z;
    expect_answer(M, q, solve_lcp(M, q));
  }
}

// Small whole numbers: ties at every step, rows and columns that repeat.
TEST(Lemke, TiesDoNotMakeItCycle) {
  Random random(5);
  for (int trial = 0; trial < 3000; ++trial) {
    const int n = 2 + random.below(10);
    const int rank = 1 + random.below(n);
    MatrixXd root(n, rank);
    for (double& value : root.reshaped()) value = random.below(3) - 1;
    const MatrixXd M = root * root.transpose();
    VectorXd q(n);
    for (double& value : q) value = random.below(3) - 1;
    const LcpSolution s = solve_lcp(M, q);
    if (s.status == LcpStatus::kSolved) {
      expect_answer(M, q, s);
    } else {
      expect_proof(M, q, s);
    }
  }
}

TEST(Lemke, AnswersDoNotDependOnUnits) {
  Random random(6);
  for (int trial = 0; trial < 500; ++trial) {
    const int n = 1 + random.below(8);
    const MatrixXd M = random_p_matrix(random, n);
    const VectorXd q = random_vector(random, n);
    VectorXd row(n), column(n);
    for (double& value : row) value = random.log_in(1e-6, 1e6);
    for (double& value : column) value = random.log_in(1e-6, 1e6);
    const MatrixXd M_scaled = row.asDiagonal() * M * column.asDiagonal();
    const VectorXd q_scaled = 1e8 * row.cwiseProduct(q);
    const LcpSolution one = solve_lcp(M, q);
    const LcpSolution other = solve_lcp(M_scaled, q_scaled);
    expect_answer(M_scaled, q_scaled, other);
    const VectorXd z = column.cwiseProduct(other.z) / 1e8;
    EXPECT_LT((z - one.z).norm(), 1e-10 * (1.0 + z.norm()));
  }
}

TEST(Lemke, KnownInfeasibleProblems) {
  const LcpSolution falling =
      solve_lcp(MatrixXd::Constant(1, 1, -1.0), VectorXd::Constant(1, -1.0));
  expect_proof(MatrixXd::Constant(1, 1, -1.0), VectorXd::Constant(1, -1.0), falling);
  const MatrixXd none = MatrixXd::Zero(3, 3);
  expect_proof(none, Eigen::Vector3d(1.0, -1.0, 0.0),
               solve_lcp(none, Eigen::Vector3d(1.0, -1.0, 0.0)));
  // Two walls that press a body apart: x >= 1 and x <= -1.
  MatrixXd walls(3, 3);
  walls << 1.0, -1.0, 1.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0;
  const Eigen::Vector3d q(0.0, -1.0, -1.0);
  expect_proof(walls, q, solve_lcp(walls, q));
}

// Feasible, yet without an answer, so nothing can be proved.
TEST(Lemke, FeasibleWithoutAnswerEndsOnARay) {
  MatrixXd M(2, 2);
  M << 0.0, 1.0, 0.0, 0.0;
  const Eigen::Vector2d q(-1.0, 1.0);  // z2 >= 1, but w2 = 1
  EXPECT_TRUE(enumerated(M, q).empty());
  EXPECT_EQ(solve_lcp(M, q, {.starts = 5}).status, LcpStatus::kRay);
}

// On matrices of no class every "solved" must still be one, and so must every proof.
TEST(Lemke, ArbitraryMatricesNeverGiveAWrongVerdict) {
  Random random(7);
  int solved = 0;
  int helped = 0;  // by further starts
  for (int trial = 0; trial < 2000; ++trial) {
    const int n = 1 + random.below(6);
    const MatrixXd M = random_matrix(random, n, n);
    const VectorXd q = random_vector(random, n);
    const LcpSolution s = solve_lcp(M, q, {.starts = 4});
    if (s.status == LcpStatus::kSolved) {
      ++solved;
      expect_answer(M, q, s);
      if (solve_lcp(M, q).status != LcpStatus::kSolved) ++helped;
    } else if (s.status == LcpStatus::kInfeasible) {
      expect_proof(M, q, s);
      EXPECT_TRUE(enumerated(M, q).empty());
    } else {
      EXPECT_EQ(s.status, LcpStatus::kRay);
    }
  }
  EXPECT_GT(solved, 500);
  EXPECT_GT(helped, 0);
}

// A bimatrix game (all entries of M >= 0): the first pivot of every covering vector ends
// on a ray, but from another first basis the equilibrium is found.
TEST(Lemke, OtherFirstBasesFindAnEquilibrium) {
  Random random(10);
  int solved = 0;
  const int games = 300;
  for (int trial = 0; trial < games; ++trial) {
    const int m = 1 + random.below(4);
    const int k = 1 + random.below(4);
    MatrixXd M = MatrixXd::Zero(m + k, m + k);
    for (double& cost : M.topRightCorner(m, k).reshaped()) cost = random.in(0.1, 1.0);
    for (double& cost : M.bottomLeftCorner(k, m).reshaped()) cost = random.in(0.1, 1.0);
    const VectorXd q = VectorXd::Constant(m + k, -1.0);
    EXPECT_NE(solve_lcp(M, q).status, LcpStatus::kInfeasible);
    const LcpSolution s = solve_lcp(M, q, {.starts = 40});
    if (s.status != LcpStatus::kSolved) continue;
    ++solved;
    expect_answer(M, q, s);
  }
  EXPECT_GT(solved, games * 9 / 10);
}

TEST(Lemke, LimitsAndBadInput) {
  Random random(8);
  const MatrixXd M = random_p_matrix(random, 8);
  const VectorXd q = VectorXd::Constant(8, -1.0);
  EXPECT_EQ(solve_lcp(M, q, {.max_pivots = 1}).status, LcpStatus::kPivotLimit);
  EXPECT_EQ(solve_lcp(M, q.head(7)).status, LcpStatus::kBadInput);
  EXPECT_EQ(solve_lcp(M.leftCols(7), q).status, LcpStatus::kBadInput);
  EXPECT_EQ(solve_lcp(M, q, {.starts = 0}).status, LcpStatus::kBadInput);
  MatrixXd broken = M;
  broken(2, 3) = std::nan("");
  EXPECT_EQ(solve_lcp(broken, q).status, LcpStatus::kBadInput);
  VectorXd endless = q;
  endless[0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(solve_lcp(M, endless).status, LcpStatus::kBadInput);

  const LcpSolution empty = solve_lcp(MatrixXd(0, 0), VectorXd(0));
  EXPECT_EQ(empty.status, LcpStatus::kSolved);
  EXPECT_EQ(empty.residual, 0.0);
  const LcpSolution at_once = solve_lcp(M, VectorXd::Constant(8, 1.0));
  EXPECT_EQ(at_once.pivots, 0);
  expect_answer(M, VectorXd::Constant(8, 1.0), at_once);
}

TEST(Lemke, JudgementSeesEveryFault) {
  const MatrixXd M = MatrixXd::Identity(2, 2);
  const Eigen::Vector2d q(-1.0, 2.0);
  const auto judged = [&](double a, double b) {
    LcpSolution s;
    s.z = Eigen::Vector2d(a, b);
    judge_lcp(M, q, s);
    return s;
  };
  EXPECT_EQ(judged(1.0, 0.0).residual, 0.0);
  EXPECT_EQ(judged(1.0, 0.0).relative_residual, 0.0);
  EXPECT_NEAR(judged(1.1, 0.0).residual, 0.1, 1e-15);
  EXPECT_NEAR(judged(1.1, 0.0).relative_residual, 0.05 / 1.55, 1e-15);  // q / 2
  EXPECT_NEAR(judged(0.9, 0.0).residual, 0.1, 1e-15);
  EXPECT_NEAR(judged(1.0, 0.3).residual, 0.3, 1e-15);
  EXPECT_NEAR(judged(1.0, -0.3).relative_residual, 0.15, 1e-15);
  EXPECT_FALSE(std::isfinite(judged(std::nan(""), 0.0).residual));
}

// The example of Murty and Fathi: with a covering vector of ones and without scaling the
// path visits all 2^n patterns.
TEST(Lemke, ExampleWithAnExponentialPath) {
  const int n = 10;
  MatrixXd M = MatrixXd::Identity(n, n);
  VectorXd q(n);
  for (int i = 0; i < n; ++i) {
    M.row(i).head(i).setConstant(2.0);
    q[i] = -(std::pow(2.0, n + 1) - std::pow(2.0, i + 1));
  }
  const LcpSolution s = solve_lcp(M, q);
  expect_answer(M, q, s);
  EXPECT_NEAR(s.z[0], -q[0], 1e-9);
}

// 100 to 300 rows: the inverse is refreshed on the way.
TEST(Lemke, LargeProblemsKeepTheirAccuracy) {
  Random random(9);
  for (const int n : {100, 200, 300}) {
    const MatrixXd M = random_p_matrix(random, n);
    const VectorXd q = random_vector(random, n);
    const LcpSolution s = solve_lcp(M, q);
    expect_answer(M, q, s);
    EXPECT_GT(s.pivots, n / 4);
  }
}

}  // namespace
}  // namespace prehensile
