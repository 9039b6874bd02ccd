/// What both backends demand of a programme before they hand it on. Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "optimisation/nonlinear_program.h"

namespace prehensile {

/// The first thing that is wrong with the programme; empty if it is well formed.
inline std::string fault_of(const NonlinearProgram& program) {
  const std::size_t variables = program.start.size();
  const std::size_t rows = program.constraint_lower.size();
  const auto ordered = [](const std::vector<double>& low,
                          const std::vector<double>& high) {
    return std::equal(low.begin(), low.end(), high.begin(), high.end(),
                      [](double a, double b) { return a <= b; });
  };
  const auto outside = [](const std::vector<int>& indices, std::size_t count) {
    return std::any_of(indices.begin(), indices.end(), [count](int i) {
      return i < 0 || static_cast<std::size_t>(i) >= count;
    });
  };
  if (variables == 0) return "no variables";
  if (!program.objective) return "no objective";
  if (!std::all_of(program.start.begin(), program.start.end(),
                   [](double x) { return std::isfinite(x); })) {
    return "start: not finite";
  }
  if (!program.lower.empty() && program.lower.size() != variables) return "lower: size";
  if (!ordered(program.lower, program.upper)) return "lower, upper: sizes or order";
  if (!ordered(program.constraint_lower, program.constraint_upper)) {
    return "constraint bounds: sizes or order";
  }
  if (rows > 0 && !program.constraints) return "constraint bounds without constraints";
  if (program.jacobian_rows.size() != program.jacobian_columns.size() ||
      outside(program.jacobian_rows, rows) ||
      outside(program.jacobian_columns, variables)) {
    return "jacobian: pattern";
  }
  if (program.hessian_rows.size() != program.hessian_columns.size() ||
      outside(program.hessian_rows, variables) ||
      outside(program.hessian_columns, variables)) {
    return "hessian: pattern";
  }
  return {};
}

/// The start, moved into the bounds.
inline std::vector<double> start_within_bounds(const NonlinearProgram& program) {
  std::vector<double> x = program.start;
  for (std::size_t i = 0; i < program.lower.size(); ++i) {
    x[i] = std::clamp(x[i], program.lower[i], program.upper[i]);
  }
  return x;
}

}  // namespace prehensile
