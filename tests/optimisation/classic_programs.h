/// Small programmes with known answers, for both libraries.
#pragma once

#include <algorithm>
#include <cmath>

#include "optimisation/nonlinear_program.h"
#include "tests/support/random.h"

namespace prehensile::testing {

/// Rosenbrock's valley: minimum 0 at (1, 1).
inline NonlinearProgram rosenbrock() {
  NonlinearProgram program;
  program.start = {-1.2, 1.0};
  program.objective = [](std::span<const double> x, std::span<double> gradient) {
    const double a = x[1] - x[0] * x[0];
    const double b = 1.0 - x[0];
    if (!gradient.empty()) {
      gradient[0] = -400.0 * a * x[0] - 2.0 * b;
      gradient[1] = 200.0 * a;
    }
    return 100.0 * a * a + b * b;
  };
  return program;
}

/// Problem 71 of Hock and Schittkowski (1981):
///   minimise x0 x3 (x0 + x1 + x2) + x2,  x0 x1 x2 x3 >= 25,  |x|^2 = 40,  1 <= x <= 5.
/// Minimum 17.0140173 at (1, 4.7429994, 3.8211503, 1.3794082).
inline NonlinearProgram hock_schittkowski_71() {
  NonlinearProgram program;
  program.start = {1.0, 5.0, 5.0, 1.0};
  program.lower.assign(4, 1.0);
  program.upper.assign(4, 5.0);
  program.constraint_lower = {25.0, 40.0};
  program.constraint_upper = {kUnbounded, 40.0};
  program.objective = [](std::span<const double> x, std::span<double> gradient) {
    const double sum = x[0] + x[1] + x[2];
    if (!gradient.empty()) {
      gradient[0] = x[3] * (sum + x[0]);
      gradient[1] = x[0] * x[3];
      gradient[2] = x[0] * x[3] + 1.0;
      gradient[3] = x[0] * sum;
    }
    return x[0] * x[3] * sum + x[2];
  };
  program.constraints = [](std::span<const double> x, std::span<double> g) {
    g[0] = x[0] * x[1] * x[2] * x[3];
    g[1] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3];
  };
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 4; ++column) {
      program.jacobian_rows.push_back(row);
      program.jacobian_columns.push_back(column);
    }
  }
  program.jacobian = [](std::span<const double> x, std::span<double> values) {
    for (int i = 0; i < 4; ++i) {
      values[i] = 1.0;
      for (int j = 0; j < 4; ++j) values[i] *= i == j ? 1.0 : x[j];
      values[4 + i] = 2.0 * x[i];
    }
  };
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column <= row; ++column) {
      program.hessian_rows.push_back(row);
      program.hessian_columns.push_back(column);
    }
  }
  program.hessian = [](std::span<const double> x, double f,
                       std::span<const double> multipliers, std::span<double> h) {
    const double p = multipliers[0];
    const double q = multipliers[1];
    h[0] = 2.0 * f * x[3] + 2.0 * q;
    h[1] = f * x[3] + p * x[2] * x[3];
    h[2] = 2.0 * q;
    h[3] = f * x[3] + p * x[1] * x[3];
    h[4] = p * x[0] * x[3];
    h[5] = 2.0 * q;
    h[6] = f * (2.0 * x[0] + x[1] + x[2]) + p * x[1] * x[2];
    h[7] = f * x[0] + p * x[0] * x[2];
    h[8] = f * x[0] + p * x[0] * x[1];
    h[9] = 2.0 * q;
  };
  return program;
}

inline const std::vector<double> kHockSchittkowski71 = {1.0, 4.74299963, 3.82114998,
                                                        1.37940829};

struct KnownProgram {
  NonlinearProgram program;
  std::vector<double> answer;
};

/// A strictly convex quadratic programme built backwards from its Karush-Kuhn-Tucker
/// point: minimise (1/2) sum h_i x_i^2 + c.x over A x = b, x >= 0, where c is chosen so
/// that a drawn x with some zeros is optimal with drawn multipliers.
inline KnownProgram random_quadratic(Random& random, int variables, int rows) {
  std::vector<double> h(variables), c(variables), x(variables), A(rows * variables);
  for (double& a : A) a = random.in(-1.0, 1.0);
  for (int i = 0; i < variables; ++i) {
    h[i] = random.in(0.5, 2.0);
    const bool active = i % 3 == 2;
    x[i] = active ? 0.0 : random.in(0.2, 1.0);
    c[i] = -h[i] * x[i] + (active ? random.in(0.2, 1.0) : 0.0);
  }
  KnownProgram known;
  NonlinearProgram& program = known.program;
  for (int r = 0; r < rows; ++r) {
    const double multiplier = random.in(-1.0, 1.0);
    double b = 0.0;
    for (int i = 0; i < variables; ++i) {
      c[i] += multiplier * A[r * variables + i];
      b += A[r * variables + i] * x[i];
      program.jacobian_rows.push_back(r);
      program.jacobian_columns.push_back(i);
    }
    program.constraint_lower.push_back(b);
  }
  program.constraint_upper = program.constraint_lower;
  program.start.assign(variables, 1.0);
  program.lower.assign(variables, 0.0);
  program.upper.assign(variables, kUnbounded);
  program.objective = [h, c](std::span<const double> z, std::span<double> gradient) {
    double value = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i) {
      value += 0.5 * h[i] * z[i] * z[i] + c[i] * z[i];
      if (!gradient.empty()) gradient[i] = h[i] * z[i] + c[i];
    }
    return value;
  };
  program.constraints = [A](std::span<const double> z, std::span<double> g) {
    for (std::size_t r = 0; r < g.size(); ++r) {
      g[r] = 0.0;
      for (std::size_t i = 0; i < z.size(); ++i) g[r] += A[r * z.size() + i] * z[i];
    }
  };
  program.jacobian = [A](std::span<const double>, std::span<double> values) {
    std::copy(A.begin(), A.end(), values.begin());
  };
  for (int i = 0; i < variables; ++i) {
    program.hessian_rows.push_back(i);
    program.hessian_columns.push_back(i);
  }
  program.hessian = [h](std::span<const double>, double f, std::span<const double>,
                        std::span<double> values) {
    for (std::size_t i = 0; i < h.size(); ++i) values[i] = f * h[i];
  };
  known.answer = x;
  return known;
}

inline double largest_difference(const std::vector<double>& a,
                                 const std::vector<double>& b) {
  if (a.size() != b.size()) return kUnbounded;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

}  // namespace prehensile::testing
