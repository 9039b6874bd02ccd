#include "benchmarks/spatial_runs.h"

#include "benchmarks/measure.h"

namespace prehensile::benchmarks {
namespace {

SpatialWrench push_of(const SpatialProblem& q, const SpatialAnswer& answer) {
  SpatialWrench w = SpatialWrench::Zero();
  for (int k = 0; k < q.patch_count; ++k) {
    const ContactPatch& patch = q.patch[k];
    if (patch.body != ContactBody::kPusher) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const Vec3& f = answer.force[i];
      w.head<3>() += f[0] * patch.n + f[1] * patch.t + f[2] * patch.o();
    }
  }
  return w;
}

double force_difference(const SpatialQuestion& q, const SpatialWrench& a,
                        const SpatialWrench& b) {
  return (a - b).head<3>().norm() / q.capacity;
}

double twist_difference(const SpatialQuestion& q, const SpatialTwist& a,
                        const SpatialTwist& b) {
  SpatialTwist V = a - b;
  V.tail<3>() *= q.units.length;
  return V.norm() / q.units.rate;
}

SpatialAnswer answer_of(const SpatialInstant& exact) {
  SpatialAnswer answer{
      .given = usable(exact.status), .V_HO = exact.V_HO, .jaw_rate = exact.jaw_rate};
  for (int i = 0; i < exact.count; ++i) {
    const SpatialPoint& point = exact.point[i];
    answer.force.emplace_back(point.normal_force, point.tangential_force.x(),
                              point.tangential_force.y());
  }
  return answer;
}

void compare(const SpatialQuestion& q, const SpatialAnswer& answer, SpatialRun& run) {
  run.asked = q.truth.status == InstantStatus::kMoves;
  run.reference_status = name(q.truth.status).data();
  run.residual = natural_residual(q.problem, answer, q.units);
  run.success = run.residual <= kSuccess;
  if (!run.asked || !answer.given) return;
  run.force_error = force_difference(q, push_of(q.problem, answer), q.truth.w_push);
  run.twist_error = twist_difference(q, answer.V_HO, q.truth.V_HO);
}

template <typename Solve>
SpatialRun polyhedral_run(const SpatialQuestion& q, const char* solver, int generators,
                          const Solve& solve) {
  SpatialRun run{.solver = solver, .generators = generators};
  SpatialReference found;
  const double start = thread_time_us();
  found = solve(q.problem, {.generators = generators});
  run.time_us = thread_time_us() - start;
  run.iterations = found.steps;
  SpatialAnswer answer{.given = found.status == SpatialReferenceStatus::kSolved,
                       .V_HO = found.V_HO,
                       .jaw_rate = found.jaw_rate};
  for (const SpatialReferencePoint& point : found.point) {
    answer.force.emplace_back(point.normal_force, point.tangential_force.x(),
                              point.tangential_force.y());
  }
  compare(q, answer, run);
  run.success = answer.given && found.residual <= kSuccess;
  return run;
}

}  // namespace

SpatialQuestion posed(const SpatialProblem& problem) {
  SpatialQuestion q;
  q.problem = problem;
  q.capacity = 2.0 * problem.patch[0].mu * problem.grip_force;
  q.units.length = 0.01;
  q.units.force = std::max(problem.grip_force, problem.w_g.head<3>().norm());
  q.units.rate = problem.V_HP.head<3>().norm();
  const SpatialInstant exact = solve_spatial(problem);
  q.truth = {exact.status, exact.V_HO, exact.w_push};
  return q;
}

void sharpen_truth(SpatialQuestion& q) {
  if (!usable(q.truth.status)) return;
  const ConvergedAnswer found =
      converged_from(q.problem, q.units, answer_of(solve_spatial(q.problem)));
  if (!found.answer.given) return;
  q.truth.V_HO = found.answer.V_HO;
  q.truth.w_push = push_of(q.problem, found.answer);
}

void measure_distance(const SpatialQuestion& q, SpatialRun& run) {
  if (!run.answer.given) return;
  const ConvergedAnswer found = converged_from(q.problem, q.units, run.answer);
  if (!found.answer.given) return;
  run.distance = difference(q, run.answer, found.answer);
  run.least_gain = found.least_gain;
}

double difference(const SpatialQuestion& q, const SpatialAnswer& a,
                  const SpatialAnswer& b) {
  return std::max(force_difference(q, push_of(q.problem, a), push_of(q.problem, b)),
                  twist_difference(q, a.V_HO, b.V_HO));
}

SpatialRun exact_run(const SpatialQuestion& q, int batches,
                     const SpatialSolveOptions& options) {
  SpatialRun run{.solver = "exact"};
  [[maybe_unused]] volatile double used = 0.0;
  run.time_us =
      time_us([&] { used = solve_spatial(q.problem, options).residual; }, batches);
  const SpatialInstant exact = solve_spatial(q.problem, options);
  run.iterations = exact.iterations;
  run.answer = answer_of(exact);
  compare(q, run.answer, run);
  // Rigid pads are judged by the solver's own residual: the laws here know foundations.
  if (options.rigid_limit) {
    run.residual = exact.residual;
    run.success = run.answer.given && run.residual <= kSuccess;
  }
  return run;
}

SpatialRun pivoting_run(const SpatialQuestion& q, int generators) {
  return polyhedral_run(q, "pivoting", generators, solve_spatial_pivoting);
}

SpatialRun ipopt_run(const SpatialQuestion& q, int generators) {
  return polyhedral_run(q, "ipopt", generators, solve_spatial_reference);
}

SpatialRun siconos_run(const SpatialQuestion& q, SiconosSolver solver) {
  SpatialRun run{.solver = name(solver)};
  const SiconosRun found = solve_siconos(q.problem, solver, kSeconds);
  run.time_us = found.time_us;
  run.iterations = found.iterations;
  run.answer = found.answer;
  compare(q, run.answer, run);
  return run;
}

}  // namespace prehensile::benchmarks
