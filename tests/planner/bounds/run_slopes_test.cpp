#include "planner/bounds/run_slopes.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "tests/planner/run_programs.h"

namespace prehensile {
namespace {

using testing::for_random_runs;
using testing::Random;

constexpr int kVariables = RunIndex::kV + 1;
using Dense = Eigen::Matrix<double, kVariables, kVariables>;

/// A place that is neither on the straight way nor inside the laws.
RunVector random_place(const RunProgram& program, Random& random) {
  RunVector x;
  for (int i = 0; i < kVariables; ++i) x[i] = random.in(-0.01, 0.01);
  for (int k = 0; k < kRunPieces; ++k) x[3 * k + 2] = random.in(0.0, 0.02);
  x[RunIndex::kRest] = random.in(0.1, 0.9) * program.rest;
  return x;
}

RunNumbers random_numbers(Random& random) {
  RunNumbers numbers;
  for_each_law(
      [&random](auto& number) {
        for (auto& value : number) value = random.in(0.1, 2.0);
      },
      numbers);
  return numbers;
}

/// With laws that say something of the path, too.
RunProgram with_paths(RunProgram program, Random& random) {
  for (Pair& pair : program.per_path) {
    for (double& per_path : pair) per_path = random.in(-0.05, 0.0);
  }
  return program;
}

RunVector unit(int i) { return RunVector::Unit(i); }

double most_of(const RunNumbers& a, const RunNumbers& b) {
  double most = 0.0;
  for_each_law(
      [&most](const auto& x, const auto& y) {
        most = std::max(most, (x - y).abs().maxCoeff());
      },
      a, b);
  return most;
}

TEST(RunSlopes, AreThoseOfTheSlacks) {
  Random random(1);
  int programs = 0;
  for_random_runs(4, 1, [&](const RunProgram& given, double) {
    const RunProgram program = with_paths(given, random);
    ++programs;
    RunSlopes slopes(program);
    const RunVector x = random_place(program, random);
    slopes.linearise(x, random_numbers(random));
    constexpr double kStep = 1e-6;
    for (int i = 0; i < kVariables; ++i) {
      RunNumbers by = slopes.slacks_at(x + kStep * unit(i));
      const RunNumbers before = slopes.slacks_at(x - kStep * unit(i));
      for_each_law([](auto& a, const auto& b) { a = (a - b) / (2.0 * kStep); }, by,
                   before);
      EXPECT_LE(most_of(by, slopes.along(unit(i))), 1e-4) << i;
    }
  });
  EXPECT_GT(programs, 20);
}

/// Sums over the laws are those of each law's slopes.
TEST(RunSlopes, AddUp) {
  Random random(2);
  for_random_runs(4, 2, [&](const RunProgram& given, double) {
    const RunProgram program = with_paths(given, random);
    RunSlopes slopes(program);
    slopes.linearise(random_place(program, random), random_numbers(random));
    const RunNumbers weights = random_numbers(random);
    RunVector sum = RunVector::Zero();
    slopes.add_slopes(weights, sum);
    for (int i = 0; i < kVariables; ++i) {
      double expected = 0.0;
      for_each_law(
          [&](const auto& weight, const auto& by) { expected += (weight * by).sum(); },
          weights, slopes.along(unit(i)));
      EXPECT_NEAR(sum[i], expected, 1e-12 * (1.0 + std::abs(expected))) << i;
    }
  });
}

/// Squares and second derivatives, these by differences, in a full matrix.
Dense squares_by_differences(RunSlopes& slopes, const RunVector& x, const RunNumbers& y,
                             const RunNumbers& weights) {
  constexpr double kStep = 1e-6;
  Dense sum;
  for (int j = 0; j < kVariables; ++j) {
    slopes.linearise(x, y);
    RunNumbers by = slopes.along(unit(j));
    for_each_law([](auto& value, const auto& weight) { value *= weight; }, by, weights);
    RunVector column = RunVector::Zero();
    slopes.add_slopes(by, column);
    RunVector after = RunVector::Zero(), before = RunVector::Zero();
    slopes.linearise(x + kStep * unit(j), y);
    slopes.add_slopes(y, after);
    slopes.linearise(x - kStep * unit(j), y);
    slopes.add_slopes(y, before);
    sum.col(j) = column - (after - before) / (2.0 * kStep);
  }
  return sum;
}

TEST(RunSlopes, HaveTheseSquaresAndSecondDerivatives) {
  Random random(3);
  int programs = 0;
  for_random_runs(3, 3, [&](const RunProgram& given, double) {
    const RunProgram program = with_paths(given, random);
    ++programs;
    RunSlopes slopes(program);
    const RunVector x = random_place(program, random);
    const RunNumbers y = random_numbers(random), weights = random_numbers(random);
    const Dense expected = squares_by_differences(slopes, x, y, weights);
    slopes.linearise(x, y);
    RunHessian hessian;
    hessian.set_zero();
    slopes.add_squares(weights, hessian);
    ASSERT_TRUE(hessian.factor());
    for (int i = 0; i < 5; ++i) {
      RunVector wanted;
      for (double& value : wanted) value = random.in(-1.0, 1.0);
      const RunVector found = hessian.solve(expected * wanted);
      EXPECT_LE((found - wanted).norm(), 2e-3 * wanted.norm());
    }
  });
  EXPECT_GT(programs, 15);
}

}  // namespace
}  // namespace prehensile
