/// NLopt behind the plain programme. The C interface, because it reports by codes: the
/// C++ one throws where a method merely stops at the precision of the machine.
#include <algorithm>
#include <memory>

#include <nlopt.h>

#include "optimisation/nonlinear_program.h"
#include "optimisation/program_check.h"

namespace prehensile {
namespace {

/// One side of a constraint row, as NLopt wants it: sign * (g_row - bound) <= 0 or == 0.
struct Side {
  int row;
  double sign;
  double bound;
};

/// The programme with its rows sorted into NLopt's two kinds, and scratch for callbacks.
struct Problem {
  const NonlinearProgram* program = nullptr;
  nlopt_opt optimiser = nullptr;
  std::vector<Side> equal, unequal;
  std::vector<double> g, jacobian;
};

void sort_rows(Problem& problem) {
  const NonlinearProgram& program = *problem.program;
  for (std::size_t i = 0; i < program.constraint_lower.size(); ++i) {
    const int row = static_cast<int>(i);
    const double low = program.constraint_lower[i];
    const double high = program.constraint_upper[i];
    if (low == high) {
      problem.equal.push_back({row, 1.0, high});
      continue;
    }
    if (high < kUnbounded) problem.unequal.push_back({row, 1.0, high});
    if (low > -kUnbounded) problem.unequal.push_back({row, -1.0, low});
  }
  problem.g.resize(program.constraint_lower.size());
  problem.jacobian.resize(program.jacobian_rows.size());
}

double objective(unsigned count, const double* x, double* gradient, void* data) {
  const Problem& problem = *static_cast<Problem*>(data);
  const std::span<double> into =
      gradient ? std::span<double>(gradient, count) : std::span<double>();
  const double value = problem.program->objective({x, count}, into);
  if (problem.program->stop && problem.program->stop()) {
    nlopt_force_stop(problem.optimiser);
  }
  return value;
}

void evaluate_sides(Problem& problem, const std::vector<Side>& sides, double* result,
                    unsigned count, const double* x, double* gradient) {
  const NonlinearProgram& program = *problem.program;
  program.constraints({x, count}, problem.g);
  if (gradient) program.jacobian({x, count}, problem.jacobian);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    result[i] = side.sign * (problem.g[side.row] - side.bound);
    if (!gradient) continue;
    double* row = gradient + i * count;
    std::fill(row, row + count, 0.0);
    for (std::size_t k = 0; k < problem.jacobian.size(); ++k) {
      if (program.jacobian_rows[k] != side.row) continue;
      row[program.jacobian_columns[k]] += side.sign * problem.jacobian[k];
    }
  }
}

void equalities(unsigned, double* result, unsigned count, const double* x,
                double* gradient, void* data) {
  Problem& problem = *static_cast<Problem*>(data);
  evaluate_sides(problem, problem.equal, result, count, x, gradient);
}

void inequalities(unsigned, double* result, unsigned count, const double* x,
                  double* gradient, void* data) {
  Problem& problem = *static_cast<Problem*>(data);
  evaluate_sides(problem, problem.unequal, result, count, x, gradient);
}

nlopt_algorithm algorithm_of(LocalMethod method) {
  switch (method) {
    case LocalMethod::kSlsqp:
      return NLOPT_LD_SLSQP;
    case LocalMethod::kCobyla:
      return NLOPT_LN_COBYLA;
    case LocalMethod::kSubplex:
      return NLOPT_LN_SBPLX;
  }
  return NLOPT_NUM_ALGORITHMS;
}

/// What the method needs and the programme lacks; empty if they fit.
std::string misfit_of(const NonlinearProgram& program, LocalMethod method) {
  const bool constrained = !program.constraint_lower.empty();
  if (method == LocalMethod::kSubplex && constrained) {
    return "this method takes bounds only, no constraints";
  }
  if (method == LocalMethod::kSlsqp && constrained && !program.jacobian) {
    return "this method needs the Jacobian of the constraints";
  }
  return {};
}

NlpStatus status_of(nlopt_result code) {
  switch (code) {
    case NLOPT_SUCCESS:
    case NLOPT_STOPVAL_REACHED:
    case NLOPT_FTOL_REACHED:
    case NLOPT_XTOL_REACHED:
    case NLOPT_ROUNDOFF_LIMITED:  // how SLSQP usually stops at an optimum
      return NlpStatus::kConverged;
    case NLOPT_MAXEVAL_REACHED:
    case NLOPT_MAXTIME_REACHED:
    case NLOPT_FORCED_STOP:
      return NlpStatus::kLimit;
    default:
      return NlpStatus::kFailed;
  }
}

void hand_over(Problem& problem, const NlpOptions& options, double initial_step,
               nlopt_opt optimiser) {
  const NonlinearProgram& program = *problem.program;
  nlopt_set_min_objective(optimiser, objective, &problem);
  if (!program.lower.empty()) {
    nlopt_set_lower_bounds(optimiser, program.lower.data());
    nlopt_set_upper_bounds(optimiser, program.upper.data());
  }
  const auto tolerances = [&options](const std::vector<Side>& sides) {
    return std::vector<double>(sides.size(), options.tolerance);
  };
  if (!problem.equal.empty()) {
    nlopt_add_equality_mconstraint(optimiser, static_cast<unsigned>(problem.equal.size()),
                                   equalities, &problem,
                                   tolerances(problem.equal).data());
  }
  if (!problem.unequal.empty()) {
    nlopt_add_inequality_mconstraint(
        optimiser, static_cast<unsigned>(problem.unequal.size()), inequalities, &problem,
        tolerances(problem.unequal).data());
  }
  nlopt_set_xtol_rel(optimiser, options.tolerance);
  nlopt_set_ftol_rel(optimiser, options.tolerance);
  nlopt_set_maxeval(optimiser, options.max_evaluations);
  if (initial_step > 0.0) nlopt_set_initial_step1(optimiser, initial_step);
}

}  // namespace

NlpResult minimise_nlopt(const NonlinearProgram& program, LocalMethod method,
                         const NlpOptions& options, double initial_step) {
  NlpResult result;
  result.x = program.start;
  result.message = fault_of(program);
  if (result.message.empty()) result.message = misfit_of(program, method);
  if (!result.message.empty()) return result;

  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(
      nlopt_create(algorithm_of(method), static_cast<unsigned>(program.start.size())),
      nlopt_destroy);
  Problem problem;
  problem.program = &program;
  problem.optimiser = optimiser.get();
  sort_rows(problem);
  hand_over(problem, options, initial_step, optimiser.get());

  result.x = start_within_bounds(program);
  const nlopt_result code =
      nlopt_optimize(optimiser.get(), result.x.data(), &result.objective);
  result.status = status_of(code);
  result.evaluations = nlopt_get_numevals(optimiser.get());
  result.message = nlopt_result_to_string(code);
  return result;
}

bool nlopt_is_built() { return true; }

}  // namespace prehensile
