#include "mechanics/linear_program.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/support/no_heap.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::NoHeapScope;
using testing::Random;
using Point = LinearProgram::Point;
using Relation = LinearProgram::Relation;

double dot(const Point& a, const Point& b, int count) {
  double sum = 0.0;
  for (int j = 0; j < count; ++j) sum += a[j] * b[j];
  return sum;
}

double row_value(const LinearProgram& program, int i, const Point& x) {
  return dot(program.coefficient[i], x, program.variables);
}

double violation(const LinearProgram& program, const Point& x) {
  double worst = 0.0;
  for (int i = 0; i < program.rows; ++i) {
    const double excess = row_value(program, i, x) - program.right[i];
    worst = std::max(worst,
                     program.relation[i] == Relation::kEqual ? std::abs(excess) : excess);
  }
  for (int j = 0; j < program.variables; ++j)
    if (program.nonnegative[j]) worst = std::max(worst, -x[j]);
  return worst;
}

/// y.A - c over the variables that may grow without limit in a direction, and the signs
/// of y: how far multipliers are from being a proof.
double dual_violation(const LinearProgram& program, const Point& cost,
                      const LinearProgram::Multipliers& y) {
  double worst = 0.0;
  for (int j = 0; j < program.variables; ++j) {
    double excess = -cost[j];
    for (int i = 0; i < program.rows; ++i) excess += y[i] * program.coefficient[i][j];
    worst = std::max(worst, program.nonnegative[j] ? excess : std::abs(excess));
  }
  for (int i = 0; i < program.rows; ++i)
    if (program.relation[i] == Relation::kAtMost) worst = std::max(worst, y[i]);
  return worst;
}

double bound_of(const LinearProgram& program, const LinearProgram::Multipliers& y) {
  double sum = 0.0;
  for (int i = 0; i < program.rows; ++i) sum += y[i] * program.right[i];
  return sum;
}

/// Small whole numbers make ties and degenerate vertices common.
LinearProgram random_program(Random& random, int variables, int rows, bool whole) {
  const auto number = [&] {
    return whole ? static_cast<double>(random.below(5) - 2) : random.in(-1.0, 1.0);
  };
  LinearProgram program(variables);
  for (int j = 0; j < variables; ++j) program.nonnegative[j] = random.chance(0.6);
  for (int i = 0; i < rows; ++i) {
    const Relation relation = random.chance(0.25) ? Relation::kEqual : Relation::kAtMost;
    Point& row = program.add_row(relation, number());
    for (int j = 0; j < variables; ++j) row[j] = number();
  }
  return program;
}

void add_box(LinearProgram& program, double size) {
  for (int j = 0; j < program.variables; ++j) {
    program.add_row(Relation::kAtMost, size)[j] = 1.0;
    program.add_row(Relation::kAtMost, size)[j] = -1.0;
  }
}

/// Least cost over all vertices: every choice of as many active rows as variables.
std::optional<double> least_vertex(const LinearProgram& program, const Point& cost) {
  const int n = program.variables;
  std::vector<Eigen::VectorXd> row;
  std::vector<double> right;
  for (int i = 0; i < program.rows; ++i) {
    row.emplace_back(Eigen::Map<const Eigen::VectorXd>(program.coefficient[i].data(), n));
    right.push_back(program.right[i]);
  }
  for (int j = 0; j < n; ++j) {
    if (!program.nonnegative[j]) continue;
    row.emplace_back(Eigen::VectorXd::Unit(n, j));
    right.push_back(0.0);
  }
  std::optional<double> best;
  std::vector<bool> active(row.size(), false);
  std::fill(active.end() - n, active.end(), true);
  do {
    Eigen::MatrixXd A(n, n);
    Eigen::VectorXd b(n);
    for (int i = 0, k = 0; i < static_cast<int>(row.size()); ++i) {
      if (!active[i]) continue;
      A.row(k) = row[i];
      b[k++] = right[i];
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(A);
    if (!lu.isInvertible()) continue;
    const Eigen::VectorXd vertex = lu.solve(b);
    Point x{};
    for (int j = 0; j < n; ++j) x[j] = vertex[j];
    if (violation(program, x) > 1e-8) continue;
    const double value = dot(cost, x, n);
    if (!best || value < *best) best = value;
  } while (std::next_permutation(active.begin(), active.end()));
  return best;
}

TEST(LinearProgram, AgreesWithAllVertices) {
  Random random(1);
  int feasible = 0;
  int infeasible = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const int variables = 1 + random.below(3);
    LinearProgram program =
        random_program(random, variables, random.below(5), random.chance(0.5));
    add_box(program, 3.0);
    Point cost{};
    for (int j = 0; j < variables; ++j) cost[j] = random.in(-1.0, 1.0);
    const std::optional<double> best = least_vertex(program, cost);
    const LinearSolution solution = minimise(program, cost);
    if (best) {
      ++feasible;
      ASSERT_EQ(solution.status, LinearStatus::kOptimal) << trial;
      EXPECT_NEAR(solution.value, *best, 1e-9) << trial;
    } else {
      ++infeasible;
      ASSERT_EQ(solution.status, LinearStatus::kInfeasible) << trial;
    }
  }
  EXPECT_GT(feasible, 500);
  EXPECT_GT(infeasible, 500);
}

template <typename Numbers>
double size_of(const Numbers& numbers) {
  double largest = 1.0;
  for (const double x : numbers) largest = std::max(largest, std::abs(x));
  return largest;
}

/// Every status brings its own proof, checked here from the data alone.
void expect_proved(const LinearProgram& program, const Point& cost,
                   const LinearSolution& solution) {
  const double x_size = size_of(solution.x);
  const double y_size = size_of(solution.multiplier);
  switch (solution.status) {
    case LinearStatus::kOptimal:
      EXPECT_LE(violation(program, solution.x), 1e-9 * x_size);
      EXPECT_LE(dual_violation(program, cost, solution.multiplier), 1e-8 * y_size);
      EXPECT_NEAR(bound_of(program, solution.multiplier), solution.value,
                  1e-8 * x_size * y_size);
      EXPECT_NEAR(dot(cost, solution.x, program.variables), solution.value,
                  1e-12 * x_size);
      return;
    case LinearStatus::kUnbounded: {
      EXPECT_LE(violation(program, solution.x), 1e-9 * x_size);
      EXPECT_LT(dot(cost, solution.ray, program.variables), 0.0);
      LinearProgram cone = program;
      std::fill(cone.right.begin(), cone.right.begin() + cone.rows, 0.0);
      EXPECT_LE(violation(cone, solution.ray), 1e-9 * size_of(solution.ray));
      return;
    }
    case LinearStatus::kInfeasible:
      EXPECT_LE(dual_violation(program, Point{}, solution.multiplier), 1e-8 * y_size);
      EXPECT_GT(bound_of(program, solution.multiplier), 0.0);
      return;
    case LinearStatus::kNotRun:
    case LinearStatus::kPivotLimit:
      ADD_FAILURE();
  }
}

void expect_all_proved(std::uint64_t seed, int trials) {
  Random random(seed);
  std::array<int, 5> seen{};
  for (int trial = 0; trial < trials; ++trial) {
    const int variables = 1 + random.below(LinearProgram::kMaxVariables);
    const int rows = random.below(LinearProgram::kMaxRows + 1);
    const LinearProgram program =
        random_program(random, variables, rows, random.chance(0.5));
    Point cost{};
    for (int j = 0; j < variables; ++j)
      cost[j] = random.chance(0.3) ? 0.0 : random.in(-1.0, 1.0);
    const LinearSolution solution = minimise(program, cost);
    ++seen[static_cast<int>(solution.status)];
    expect_proved(program, cost, solution);
    if (::testing::Test::HasFailure()) FAIL() << "trial " << trial;
  }
  EXPECT_GT(seen[static_cast<int>(LinearStatus::kOptimal)], trials / 20);
  EXPECT_GT(seen[static_cast<int>(LinearStatus::kUnbounded)], trials / 20);
  EXPECT_GT(seen[static_cast<int>(LinearStatus::kInfeasible)], trials / 20);
}

TEST(LinearProgram, EveryVerdictIsProved) { expect_all_proved(2, 20000); }

TEST(LinearProgram, EveryVerdictIsProvedFull) { expect_all_proved(3, 1000000); }

TEST(LinearProgram, BealesExampleDoesNotCycle) {
  LinearProgram program(4);
  program.add_row(Relation::kAtMost, 0.0) = {0.25, -60.0, -0.04, 9.0};
  program.add_row(Relation::kAtMost, 0.0) = {0.5, -90.0, -0.02, 3.0};
  program.add_row(Relation::kAtMost, 1.0) = {0.0, 0.0, 1.0, 0.0};
  const LinearSolution solution = minimise(program, {-0.75, 150.0, -0.02, 6.0});
  ASSERT_EQ(solution.status, LinearStatus::kOptimal);
  EXPECT_NEAR(solution.value, -0.05, 1e-12);
}

TEST(LinearProgram, RepeatedAndContradictingRows) {
  LinearProgram program(2, /*nonnegative=*/false);
  for (int copy = 0; copy < 5; ++copy)
    program.add_row(Relation::kEqual, 1.0) = {1.0, 1.0};
  program.add_row(Relation::kEqual, 3.0) = {1.0, -1.0};
  const LinearSolution solution = find_point(program);
  ASSERT_EQ(solution.status, LinearStatus::kOptimal);
  EXPECT_NEAR(solution.x[0], 2.0, 1e-12);
  EXPECT_NEAR(solution.x[1], -1.0, 1e-12);
  program.add_row(Relation::kEqual, 1.0 + 1e-6) = {1.0, 1.0};
  EXPECT_EQ(find_point(program).status, LinearStatus::kInfeasible);
}

TEST(LinearProgram, NoRowsAndEmptyRows) {
  LinearProgram program(1);
  EXPECT_EQ(find_point(program).status, LinearStatus::kOptimal);
  EXPECT_EQ(minimise(program, {-1.0}).status, LinearStatus::kUnbounded);
  program.add_row(Relation::kAtMost, 0.0);
  EXPECT_EQ(find_point(program).status, LinearStatus::kOptimal);
  program.add_row(Relation::kEqual, 1.0);
  EXPECT_EQ(find_point(program).status, LinearStatus::kInfeasible);
}

TEST(LinearProgram, NoHeap) {
  Random random(4);
  const LinearProgram program = random_program(random, 16, 32, false);
  const NoHeapScope scope;
  const LinearSolution solution = find_point(program);
  EXPECT_LE(scope.allocations(), 0);
  EXPECT_NE(solution.status, LinearStatus::kNotRun);
}

}  // namespace
}  // namespace prehensile
