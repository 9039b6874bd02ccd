/// A plain nonlinear programme and the two libraries that can minimise it. What the
/// variables mean is the caller's business: complementarity is written in mechanics,
/// way-points in planner.
///
///   minimise f(x)  subject to  x_low <= x <= x_high,  g_low <= g(x) <= g_high
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace prehensile {

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Its functions must not throw: they are called from within C and Fortran frames.
struct NonlinearProgram {
  std::vector<double> start;  ///< x at the start; its size is the number of variables
  std::vector<double> lower, upper;  ///< bounds of x; empty or one per variable

  /// f(x); fills `gradient` if it is not empty.
  std::function<double(std::span<const double> x, std::span<double> gradient)> objective;

  /// Constraints; empty bounds mean none. Equal bounds make an equality.
  std::vector<double> constraint_lower, constraint_upper;
  std::function<void(std::span<const double> x, std::span<double> g)> constraints;

  /// Sparse Jacobian of g: value k belongs to (rows[k], columns[k]).
  std::vector<int> jacobian_rows, jacobian_columns;
  std::function<void(std::span<const double> x, std::span<double> values)> jacobian;

  /// Lower triangle of the Hessian of f_scale f + sum multipliers g; optional: without it
  /// a quasi-Newton approximation is used.
  std::vector<int> hessian_rows, hessian_columns;
  std::function<void(std::span<const double> x, double f_scale,
                     std::span<const double> multipliers, std::span<double> values)>
      hessian;

  /// Asked after each iteration (Ipopt) or evaluation of f (NLopt): true ends the search,
  /// at a limit. Optional.
  std::function<bool()> stop;
};

enum class NlpStatus {
  kConverged,  ///< the library says so, or stops at the precision of the machine; x must
               ///< still be judged by its residual
  kLimit,      ///< evaluation or iteration limit, or stopped; x is the last iterate
  kFailed,     ///< x is the last iterate, or the start if the library was not asked;
               ///< message says why
  kNotBuilt,   ///< the library was switched off at build time
};

struct NlpResult {
  NlpStatus status = NlpStatus::kFailed;
  std::vector<double> x;
  double objective = std::numeric_limits<double>::quiet_NaN();
  int evaluations = 0;
  std::string message;
};

struct NlpOptions {
  double tolerance = 1e-9;    ///< relative, of the library's own convergence test
  int max_evaluations = 500;  ///< of f (NLopt) or iterations (Ipopt)
};

enum class LocalMethod {
  kSlsqp,    ///< gradients, constraints (NLopt LD_SLSQP)
  kCobyla,   ///< no gradients, constraints (NLopt LN_COBYLA)
  kSubplex,  ///< no gradients, bounds only, tolerates infinite values (NLopt LN_SBPLX)
};

/// NLopt; deterministic methods only. `initial_step` [units of x] sets the first trial
/// steps of the methods without gradients; 0: the library's choice.
NlpResult minimise_nlopt(const NonlinearProgram& program, LocalMethod method,
                         const NlpOptions& options = {}, double initial_step = 0.0);

/// Ipopt with MUMPS. Not re-entrant in the library: calls are serialised by a global
/// lock; run several in several processes.
NlpResult minimise_ipopt(const NonlinearProgram& program, const NlpOptions& options = {});

bool nlopt_is_built();
bool ipopt_is_built();

}  // namespace prehensile
