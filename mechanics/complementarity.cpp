#include "mechanics/complementarity.h"

#include <algorithm>

namespace prehensile {
namespace {

double sum_of_products(const ComplementarityProblem& problem, std::span<const double> z,
                       std::span<double> gradient) {
  const std::vector<double> s = problem.slacks(z);
  std::fill(gradient.begin(), gradient.end(), 0.0);
  double sum = 0.0;
  for (std::size_t row = 0; row < s.size(); ++row) {
    const int partner = problem.partner[row];
    if (partner == ComplementarityProblem::kEquality) continue;
    sum += z[partner] * s[row];
    if (!gradient.empty()) gradient[partner] += s[row];
  }
  if (gradient.empty()) return sum;
  for (const auto& [row, column, value] : problem.entries) {
    const int partner = problem.partner[row];
    if (partner != ComplementarityProblem::kEquality) {
      gradient[column] += z[partner] * value;
    }
  }
  return sum;
}

}  // namespace

int ComplementarityProblem::add_row(int partner_of_row, double constant_of_row) {
  partner.push_back(partner_of_row);
  constant.push_back(constant_of_row);
  return static_cast<int>(constant.size()) - 1;
}

void ComplementarityProblem::add(int row, int column, double value) {
  if (value != 0.0) entries.push_back({row, column, value});
}

std::vector<double> ComplementarityProblem::slacks(std::span<const double> z) const {
  std::vector<double> s = constant;
  for (const auto& [row, column, value] : entries) s[row] += value * z[column];
  return s;
}

NonlinearProgram program_of(const ComplementarityProblem& problem) {
  NonlinearProgram program;
  program.start.assign(problem.variables, 0.0);
  program.lower.assign(problem.variables, -kUnbounded);
  program.upper.assign(problem.variables, kUnbounded);
  for (std::size_t row = 0; row < problem.constant.size(); ++row) {
    const bool equality = problem.partner[row] == ComplementarityProblem::kEquality;
    program.constraint_lower.push_back(-problem.constant[row]);
    program.constraint_upper.push_back(equality ? -problem.constant[row] : kUnbounded);
    if (!equality) program.lower[problem.partner[row]] = 0.0;
  }
  std::vector<double> constant_jacobian, constant_hessian;
  for (const auto& [row, column, value] : problem.entries) {
    program.jacobian_rows.push_back(row);
    program.jacobian_columns.push_back(column);
    constant_jacobian.push_back(value);
    const int partner = problem.partner[row];
    if (partner == ComplementarityProblem::kEquality) continue;
    program.hessian_rows.push_back(std::max(partner, column));
    program.hessian_columns.push_back(std::min(partner, column));
    constant_hessian.push_back(partner == column ? 2.0 * value : value);
  }
  program.objective = [&problem](std::span<const double> z, std::span<double> gradient) {
    return sum_of_products(problem, z, gradient);
  };
  program.constraints = [&problem](std::span<const double> z, std::span<double> g) {
    std::fill(g.begin(), g.end(), 0.0);
    for (const auto& [row, column, value] : problem.entries) g[row] += value * z[column];
  };
  program.jacobian = [constant_jacobian](std::span<const double>,
                                         std::span<double> values) {
    std::copy(constant_jacobian.begin(), constant_jacobian.end(), values.begin());
  };
  program.hessian = [constant_hessian](std::span<const double>, double f_scale,
                                       std::span<const double>,
                                       std::span<double> values) {
    std::transform(constant_hessian.begin(), constant_hessian.end(), values.begin(),
                   [f_scale](double h) { return f_scale * h; });
  };
  return program;
}

}  // namespace prehensile
