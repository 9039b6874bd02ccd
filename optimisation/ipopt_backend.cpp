/// Ipopt behind the plain programme.
#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <exception>
#include <mutex>

#include "optimisation/nonlinear_program.h"
#include "optimisation/program_check.h"

namespace prehensile {
namespace {

using Ipopt::Index;
using Ipopt::Number;

/// MUMPS keeps state between calls that threads would share: one solve at a time.
std::mutex& library_lock() {
  static std::mutex mutex;
  return mutex;
}

/// Ipopt reads magnitudes from 1e19 on as "no bound".
constexpr double kNoBound = 2e19;

void copy_bounds(const std::vector<double>& bounds, double none, Index count,
                 Number* into) {
  if (bounds.empty()) {
    std::fill(into, into + count, none);
    return;
  }
  std::transform(bounds.begin(), bounds.end(), into,
                 [](double b) { return std::clamp(b, -kNoBound, kNoBound); });
}

void copy_pattern(const std::vector<int>& rows, const std::vector<int>& columns,
                  Index* into_rows, Index* into_columns) {
  std::copy(rows.begin(), rows.end(), into_rows);
  std::copy(columns.begin(), columns.end(), into_columns);
}

std::span<const double> values_at(const Number* x, Index count) {
  return {x, static_cast<std::size_t>(count)};
}

std::span<double> space_at(Number* values, Index count) {
  return {values, static_cast<std::size_t>(count)};
}

/// The callbacks that Ipopt asks for, answered by the programme.
class Callbacks final : public Ipopt::TNLP {
 public:
  Callbacks(const NonlinearProgram& program, NlpResult& result)
      : program_(program), result_(result) {}

  bool get_nlp_info(Index& variables, Index& rows, Index& jacobian_count,
                    Index& hessian_count, IndexStyleEnum& style) override {
    variables = static_cast<Index>(program_.start.size());
    rows = static_cast<Index>(program_.constraint_lower.size());
    jacobian_count = static_cast<Index>(program_.jacobian_rows.size());
    hessian_count = static_cast<Index>(program_.hessian_rows.size());
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index variables, Number* lower, Number* upper, Index rows,
                       Number* g_lower, Number* g_upper) override {
    copy_bounds(program_.lower, -kNoBound, variables, lower);
    copy_bounds(program_.upper, kNoBound, variables, upper);
    copy_bounds(program_.constraint_lower, -kNoBound, rows, g_lower);
    copy_bounds(program_.constraint_upper, kNoBound, rows, g_upper);
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool,
                          Number*) override {
    const std::vector<double> start = start_within_bounds(program_);
    std::copy(start.begin(), start.end(), x);
    return true;
  }

  bool eval_f(Index count, const Number* x, bool, Number& value) override {
    value = program_.objective(values_at(x, count), {});
    return true;
  }

  bool eval_grad_f(Index count, const Number* x, bool, Number* gradient) override {
    program_.objective(values_at(x, count), space_at(gradient, count));
    return true;
  }

  bool eval_g(Index count, const Number* x, bool, Index rows, Number* g) override {
    if (rows > 0) program_.constraints(values_at(x, count), space_at(g, rows));
    return true;
  }

  bool eval_jac_g(Index count, const Number* x, bool, Index, Index entries, Index* rows,
                  Index* columns, Number* values) override {
    if (!values) {
      copy_pattern(program_.jacobian_rows, program_.jacobian_columns, rows, columns);
    } else if (entries > 0) {
      program_.jacobian(values_at(x, count), space_at(values, entries));
    }
    return true;
  }

  bool eval_h(Index count, const Number* x, bool, Number f_scale, Index rows,
              const Number* multipliers, bool, Index entries, Index* row_of,
              Index* column_of, Number* values) override {
    if (!program_.hessian) return false;
    if (!values) {
      copy_pattern(program_.hessian_rows, program_.hessian_columns, row_of, column_of);
    } else {
      program_.hessian(values_at(x, count), f_scale, values_at(multipliers, rows),
                       space_at(values, entries));
    }
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number,
                             Number, Number, Number, Number, Index,
                             const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    return !(program_.stop && program_.stop());
  }

  void finalize_solution(Ipopt::SolverReturn, Index count, const Number* x, const Number*,
                         const Number*, Index, const Number*, const Number*, Number value,
                         const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    result_.x.assign(x, x + count);
    result_.objective = value;
  }

 private:
  const NonlinearProgram& program_;
  NlpResult& result_;
};

void describe_outcome(Ipopt::ApplicationReturnStatus code, NlpResult& result) {
  const auto outcome = [&result](NlpStatus status, const char* message) {
    result.status = status;
    result.message = message;
  };
  switch (code) {
    case Ipopt::Solve_Succeeded:
      return outcome(NlpStatus::kConverged, "solve succeeded");
    case Ipopt::Solved_To_Acceptable_Level:
      return outcome(NlpStatus::kConverged, "solved to acceptable level");
    case Ipopt::Maximum_Iterations_Exceeded:
    case Ipopt::Maximum_CpuTime_Exceeded:
      return outcome(NlpStatus::kLimit, "iteration limit");
    case Ipopt::User_Requested_Stop:
      return outcome(NlpStatus::kLimit, "stopped");
    case Ipopt::Infeasible_Problem_Detected:
      return outcome(NlpStatus::kFailed, "locally infeasible");
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return outcome(NlpStatus::kFailed, "search direction too small");
    case Ipopt::Diverging_Iterates:
      return outcome(NlpStatus::kFailed, "diverging iterates");
    case Ipopt::Restoration_Failed:
      return outcome(NlpStatus::kFailed, "restoration failed");
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return outcome(NlpStatus::kFailed, "more equalities than variables");
    case Ipopt::Invalid_Number_Detected:
      return outcome(NlpStatus::kFailed, "a value or derivative is not finite");
    default:
      result.status = NlpStatus::kFailed;
      result.message = "Ipopt code " + std::to_string(static_cast<int>(code));
  }
}

void set_options(const NonlinearProgram& program, const NlpOptions& options,
                 Ipopt::OptionsList& list) {
  list.SetIntegerValue("print_level", 0);
  list.SetStringValue("sb", "yes");  // no banner
  list.SetNumericValue("tol", options.tolerance);
  list.SetIntegerValue("max_iter", options.max_evaluations);
  if (!program.hessian) {
    list.SetStringValue("hessian_approximation", "limited-memory");
  }
}

}  // namespace

NlpResult minimise_ipopt(const NonlinearProgram& program, const NlpOptions& options) {
  NlpResult result;
  result.x = program.start;
  result.message = fault_of(program);
  if (result.message.empty() && !program.constraint_lower.empty() && !program.jacobian) {
    result.message = "this method needs the Jacobian of the constraints";
  }
  if (!result.message.empty()) return result;

  const std::lock_guard<std::mutex> lock(library_lock());
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application =
      new Ipopt::IpoptApplication(/*create_console_out=*/false);
  set_options(program, options, *application->Options());
  // The empty name keeps the library from reading a file of options in the folder where
  // the program happens to run.
  if (application->Initialize("") != Ipopt::Solve_Succeeded) {
    result.message = "Ipopt did not start";
    return result;
  }
  const Ipopt::SmartPtr<Ipopt::TNLP> callbacks = new Callbacks(program, result);
  describe_outcome(application->OptimizeTNLP(callbacks), result);
  if (IsValid(application->Statistics())) {
    result.evaluations = application->Statistics()->IterationCount();
  }
  return result;
}

bool ipopt_is_built() { return true; }

}  // namespace prehensile
