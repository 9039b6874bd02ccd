#include "apps/solver_comparison.h"

#include <chrono>

#include "apps/json_number.h"
#include "apps/table.h"
#include "mechanics/certificate.h"
#include "mechanics/planar_instant.h"
#include "mechanics/reference.h"
#include "mechanics/spatial_certificate.h"
#include "mechanics/spatial_reference.h"

namespace prehensile::apps {
namespace {

/// Runs a solver and notes how long it took: the second of two calls, caches filled,
/// where that is quick.
template <class Solve>
auto timed(const Solve& solve, double& microseconds) {
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto since = [&now](auto begin) {
    return std::chrono::duration<double, std::micro>(now() - begin).count();
  };
  auto begin = now();
  auto answer = solve();
  microseconds = since(begin);
  if (microseconds < 1e4) {
    begin = now();
    answer = solve();
    microseconds = since(begin);
  }
  return answer;
}

SolverAnswer row_of(std::string solver, const PlanarInstant& answer, double certificate,
                    double microseconds) {
  return {std::move(solver), std::string(name(answer.status)),
          answer.push_force, answer.V_HO,
          answer.residual,   certificate,
          microseconds};
}

PlanarTwist in_pad_plane(const SpatialTwist& V) { return {V[0], V[1], V[5]}; }

const char* name_of(SpatialReferenceStatus status) {
  switch (status) {
    case SpatialReferenceStatus::kNotRun:
      return "not built";
    case SpatialReferenceStatus::kSolved:
      return "moves";
    case SpatialReferenceStatus::kInfeasible:
      return "infeasible";
    case SpatialReferenceStatus::kNotFound:
      return "not found";
    case SpatialReferenceStatus::kBadInput:
      return "bad input";
  }
  return "";
}

SolverAnswer row_of(std::string solver, const SpatialReference& answer,
                    double microseconds) {
  SolverAnswer row{.solver = std::move(solver),
                   .status = name_of(answer.status),
                   .microseconds = microseconds};
  if (answer.status != SpatialReferenceStatus::kSolved) return row;
  row.push_force = answer.w_push.head<3>().norm();
  row.V_HO = in_pad_plane(answer.V_HO);
  row.residual = answer.residual;
  return row;
}

void add_planar(const ComparedInstant& question, std::vector<SolverAnswer>& rows) {
  const PlanarGrasp& grasp = question.grasp;
  const PlanarDrive& drive = question.drive;
  double us = 0.0;
  const PlanarInstant closed =
      timed([&] { return solve_limit_surface(question.surface, grasp.w_g, drive); }, us);
  rows.push_back(row_of("closed", closed, kNan, us));
  const PlanarInstant exact = timed([&] { return solve_planar(grasp, drive); }, us);
  rows.push_back(row_of("exact", exact, certify(grasp, drive, exact).worst, us));
  if (!reference_is_built()) return;
  const PlanarInstant ipopt = timed(
      [&] { return solve_reference(grasp, drive, {.generators = question.generators}); },
      us);
  rows.push_back(row_of("ipopt", ipopt, certify(grasp, drive, ipopt).worst, us));
}

void add_spatial(const ComparedInstant& question, std::vector<SolverAnswer>& rows) {
  constexpr int kMostPivotingColumns = 700;  // points x generators; beyond it, minutes
  const SpatialProblem& problem = question.spatial;
  double us = 0.0;
  const SpatialInstant exact = timed([&] { return solve_spatial(problem); }, us);
  rows.push_back({"spatial", std::string(name(exact.status)), exact.push_force,
                  in_pad_plane(exact.V_HO), exact.residual, certify(problem, exact).worst,
                  us});
  if (problem.count * question.generators > kMostPivotingColumns) {
    rows.push_back({.solver = "pivoting", .status = "not run: too many points"});
    return;
  }
  const SpatialReference pivoting = timed(
      [&] {
        return solve_spatial_pivoting(problem, {.generators = question.generators});
      },
      us);
  rows.push_back(row_of("pivoting", pivoting, us));
}

}  // namespace

std::vector<SolverAnswer> compare_solvers(const ComparedInstant& question) {
  std::vector<SolverAnswer> rows;
  if (question.in_plane) add_planar(question, rows);
  if (question.spatial.count > 0) add_spatial(question, rows);
  return rows;
}

std::string describe(const std::vector<SolverAnswer>& answers) {
  Table table({"solver", "status", "push force N", "v_x mm/s", "v_y mm/s", "turn deg/s",
               "residual", "certificate", "time us"});
  for (const SolverAnswer& answer : answers) {
    const auto shown = [](const char* format, double value) {
      return std::isfinite(value) ? text(format, value) : std::string("-");
    };
    table.add({answer.solver, answer.status, shown("%.5f", answer.push_force),
               shown("%.5f", to_mm(answer.V_HO[0])), shown("%.5f", to_mm(answer.V_HO[1])),
               shown("%.5f", to_deg(answer.V_HO[2])), shown("%.1e", answer.residual),
               shown("%.1e", answer.certificate), shown("%.1f", answer.microseconds)});
  }
  return table.str() +
         "closed: ellipsoid; exact, spatial: circular cones over the pads' points; "
         "ipopt, pivoting: polyhedral\ncones, which the certificate, of circular ones, "
         "need not accept. spatial, pivoting: pads on an elastic foundation\n";
}

nlohmann::ordered_json to_json(const std::vector<SolverAnswer>& answers) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const SolverAnswer& answer : answers) {
    rows.push_back({{"solver", answer.solver},
                    {"status", answer.status},
                    {"push_force", number(answer.push_force)},
                    {"object_twist", numbers(answer.V_HO)},
                    {"residual", number(answer.residual)},
                    {"certificate", number(answer.certificate)},
                    {"microseconds", number(answer.microseconds)}});
  }
  return {{"solvers", rows}};
}

}  // namespace prehensile::apps
