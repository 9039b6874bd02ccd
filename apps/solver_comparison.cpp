#include "apps/solver_comparison.h"

#include <chrono>

#include "apps/json_number.h"
#include "apps/table.h"

namespace prehensile::apps {
namespace {

/// Points x generators of polyhedral cones in space; beyond it, minutes.
constexpr int kMostGenerators = 700;

/// Why a solver is not asked, though it could answer; null if it is.
const char* left_out(Solver solver, const InstantQuestion& question, int generators) {
  if (const char* why = refusal(solver, question)) return why;
  const bool is_polyhedral =
      solver == Solver::kSpatialPivoting || solver == Solver::kSpatialReference;
  if (is_polyhedral && question.spatial.count * generators > kMostGenerators) {
    return "not run: too many points";
  }
  return nullptr;
}

std::string status_text(const InstantAnswer& answer) {
  if (const auto* reference = std::get_if<SpatialReference>(&answer.detail)) {
    if (reference->status == SpatialReferenceStatus::kInfeasible) return "infeasible";
    if (reference->status == SpatialReferenceStatus::kNotFound) return "not found";
  }
  return std::string(name(answer.status));
}

}  // namespace

/// The second of two calls, caches filled, where that is quick.
TimedAnswer timed_answer(const InstantQuestion& question, const SolverOptions& options) {
  TimedAnswer timed;
  for (int run = 0; run < 2; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    timed.answer = solve(question, options);
    timed.microseconds = std::chrono::duration<double, std::micro>(
                             std::chrono::steady_clock::now() - begin)
                             .count();
    if (timed.microseconds > 1e4) break;
  }
  timed.status = status_text(timed.answer);
  return timed;
}

std::vector<TimedAnswer> compare_solvers(const InstantQuestion& question,
                                         const SolverOptions& options) {
  std::vector<TimedAnswer> answers;
  for (const Solver solver : built_solvers()) {
    if (const char* why = left_out(solver, question, options.generators)) {
      TimedAnswer& absent = answers.emplace_back();
      absent.answer.solver = solver;
      absent.status = why;
      continue;
    }
    SolverOptions with = options;
    with.solver = solver;
    answers.push_back(timed_answer(question, with));
  }
  return answers;
}

std::string describe(const std::vector<TimedAnswer>& answers) {
  Table table({"solver", "status", "push force N", "v_x mm/s", "v_y mm/s", "turn deg/s",
               "residual", "certificate", "time us"});
  for (const TimedAnswer& timed : answers) {
    const InstantAnswer& answer = timed.answer;
    const auto shown = [](const char* format, double value) {
      return std::isfinite(value) ? text(format, value) : std::string("-");
    };
    table.add({std::string(name(answer.solver)), timed.status,
               shown("%.5f", answer.push_force), shown("%.5f", to_mm(answer.V_HO[0])),
               shown("%.5f", to_mm(answer.V_HO[1])),
               shown("%.5f", to_deg(answer.V_HO[5])), shown("%.1e", answer.residual),
               shown("%.1e", answer.certificate), shown("%.1f", timed.microseconds)});
  }
  return table.str() +
         "closed: ellipsoid; exact, spatial: circular cones over the pads' points; "
         "ipopt, pivoting, spatial-ipopt: polyhedral\ncones, which the certificate, of "
         "circular ones, need not accept. In space the pads are as the scene says, by "
         "default\non an elastic foundation\n";
}

nlohmann::ordered_json to_json(const std::vector<TimedAnswer>& answers) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const TimedAnswer& timed : answers) {
    const InstantAnswer& answer = timed.answer;
    rows.push_back({{"solver", std::string(name(answer.solver))},
                    {"status", timed.status},
                    {"push_force", number(answer.push_force)},
                    {"object_twist", numbers(answer.V_HO)},
                    {"push_wrench", numbers(answer.w_push)},
                    {"residual", number(answer.residual)},
                    {"certificate", number(answer.certificate)},
                    {"microseconds", number(timed.microseconds)}});
  }
  return {{"solvers", rows}};
}

}  // namespace prehensile::apps
