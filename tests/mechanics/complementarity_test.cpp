/// Complementarity problems as programmes: derivatives, and a problem with a known
/// answer.
#include "mechanics/complementarity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace prehensile {
namespace {

/// Random rows; the first `free` variables have no row, one row has no partner.
ComplementarityProblem random_problem(testing::Random& random, int variables, int free) {
  ComplementarityProblem problem;
  problem.variables = variables;
  problem.add_row(ComplementarityProblem::kEquality, random.in(-1.0, 1.0));
  for (int i = free; i < variables; ++i) problem.add_row(i, random.in(-1.0, 1.0));
  for (std::size_t row = 0; row < problem.constant.size(); ++row) {
    for (int column = 0; column < variables; ++column) {
      if (random.chance(0.6)) {
        problem.add(static_cast<int>(row), column, random.in(-1.0, 1.0));
      }
    }
  }
  return problem;
}

std::vector<double> random_point(testing::Random& random, int variables) {
  std::vector<double> z(variables);
  for (double& value : z) value = random.in(-1.0, 1.0);
  return z;
}

TEST(Complementarity, ObjectiveIsTheSumOfProducts) {
  testing::Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const ComplementarityProblem problem = random_problem(random, 7, 2);
    const std::vector<double> z = random_point(random, 7);
    double sum = 0.0;
    const std::vector<double> s = problem.slacks(z);
    for (std::size_t row = 1; row < s.size(); ++row) sum += z[row + 1] * s[row];
    EXPECT_NEAR(program_of(problem).objective(z, {}), sum, 1e-14);
  }
}

// The objective is quadratic: central differences of any step are exact but for rounding.
TEST(Complementarity, GradientAndHessianMatchDifferences) {
  testing::Random random(2);
  const int n = 6;
  for (int trial = 0; trial < 30; ++trial) {
    const ComplementarityProblem problem = random_problem(random, n, 1);
    const NonlinearProgram program = program_of(problem);
    const std::vector<double> z = random_point(random, n);
    std::vector<double> gradient(n), above(n), below(n);
    program.objective(z, gradient);

    std::vector<double> values(program.hessian_rows.size());
    program.hessian(z, 2.0, {}, values);
    std::vector<double> hessian(n * n, 0.0);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const int row = program.hessian_rows[k];
      const int column = program.hessian_columns[k];
      EXPECT_GE(row, column);
      hessian[row * n + column] += values[k];
      if (row != column) hessian[column * n + row] += values[k];
    }
    for (int i = 0; i < n; ++i) {
      std::vector<double> up = z;
      std::vector<double> down = z;
      up[i] += 0.5;
      down[i] -= 0.5;
      EXPECT_NEAR(program.objective(up, above) - program.objective(down, below),
                  gradient[i], 1e-12);
      for (int k = 0; k < n; ++k) {
        EXPECT_NEAR(2.0 * (above[k] - below[k]), hessian[i * n + k], 1e-12);
      }
    }
  }
}

TEST(Complementarity, ConstraintsAndJacobianAreTheRows) {
  testing::Random random(3);
  const ComplementarityProblem problem = random_problem(random, 6, 1);
  const NonlinearProgram program = program_of(problem);
  const std::vector<double> z = random_point(random, 6);
  const std::vector<double> s = problem.slacks(z);
  std::vector<double> g(s.size());
  std::vector<double> jacobian(program.jacobian_rows.size());
  program.constraints(z, g);
  program.jacobian(z, jacobian);
  std::vector<double> product(s.size(), 0.0);
  for (std::size_t k = 0; k < jacobian.size(); ++k) {
    product[program.jacobian_rows[k]] += jacobian[k] * z[program.jacobian_columns[k]];
  }
  for (std::size_t row = 0; row < s.size(); ++row) {
    EXPECT_NEAR(g[row] - program.constraint_lower[row], s[row], 1e-14);
    EXPECT_NEAR(product[row], g[row], 1e-14);
    EXPECT_EQ(program.constraint_upper[row] < kUnbounded, row == 0);
  }
  EXPECT_EQ(program.lower[0], -kUnbounded);
  EXPECT_EQ(program.lower[1], 0.0);
}

// Positive definite matrices have one answer; built backwards from it.
TEST(Complementarity, IpoptFindsTheAnswerOfAPositiveDefiniteProblem) {
  if (!ipopt_is_built()) GTEST_SKIP() << "built without Ipopt";
  testing::Random random(4);
  const int n = 8;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> root(n * n), answer(n), slack(n);
    for (double& value : root) value = random.in(-1.0, 1.0);
    for (int i = 0; i < n; ++i) {
      answer[i] = i % 2 == 0 ? random.in(0.2, 1.0) : 0.0;
      slack[i] = i % 2 == 0 ? 0.0 : random.in(0.2, 1.0);
    }
    ComplementarityProblem problem;
    problem.variables = n;
    for (int i = 0; i < n; ++i) {
      double constant = slack[i];
      const int row = problem.add_row(i, 0.0);
      for (int k = 0; k < n; ++k) {
        double value = i == k ? 0.5 : 0.0;
        for (int m = 0; m < n; ++m) value += root[m * n + i] * root[m * n + k];
        problem.add(row, k, value);
        constant -= value * answer[k];
      }
      problem.constant[row] = constant;
    }
    NonlinearProgram program = program_of(problem);
    program.start.assign(n, 0.5);
    const NlpResult result = minimise_ipopt(program);
    for (int i = 0; i < n; ++i) EXPECT_NEAR(result.x[i], answer[i], 1e-4);
  }
}

}  // namespace
}  // namespace prehensile
