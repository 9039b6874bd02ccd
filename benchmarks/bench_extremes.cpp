/// The stiff and extreme suite, one table per solver: what each of them makes of
/// frictions from 0 to 1000, masses from 1e-6 to 1e3 kg, grips from 0 to 1e6 N, sizes
/// from 1e-3 to 10, accelerations from 1e-9 to 1e3 m/s^2, pads down to 1e-8 m, coinciding
/// and parallel contacts, wedges, thresholds at 1 -/+ 1e-6 and denormal numbers
/// (problems/extreme_instants.h, problems/extreme_spatial.h). One CSV line per run.
///
/// Verdicts: `solved`, a motion whose certificate holds; `refused`, no unique motion,
/// with valid evidence (dynamic, ambiguous, jammed, ...) or as bad input; `out`, no
/// answer; `wrong`, an answer that its certificate rejects, or that is not what theory
/// says, or (planar quasi-static motions) that the spatial solver, which shares nothing
/// with the planar one, contradicts. Polyhedral answers are judged by their own laws.
///
/// Usage: bench_extremes [--quick] [--instances N] [--peer-instances N] [--seed S]
///                       [-o FILE]
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "mechanics/certificate.h"
#include "mechanics/limit_surface.h"
#include "mechanics/planar_instant.h"
#include "mechanics/reference.h"
#include "mechanics/spatial_certificate.h"
#include "mechanics/spatial_reference.h"
#include "problems/extreme_instants.h"
#include "problems/extreme_spatial.h"

namespace prehensile::benchmarks {
namespace {

constexpr double kAccepted = 1e-6;     // of a certificate
constexpr double kContradicts = 1e-3;  // difference of two solvers' motions
constexpr int kGenerators = 8;
constexpr double kEllipsoidRadius = 0.006;  // [m] torque radius of the closed form

struct Options {
  int instances = 100;
  int peer_instances = 6;
  std::uint64_t seed = 1;
  const char* file = nullptr;
};

struct Run {
  const char* solver;
  std::string group;
  std::string extreme;
  int points = 0;
  int instance = 0;
  std::string verdict;  // solved, refused, out, wrong
  std::string status;
  double residual = kNan;  // of the certificate; polyhedral: of its own laws
  int steps = 0;
  double time_us = kNan;
};

/// From status, certificate and theory to the verdict.
void judge(InstantStatus status, double certificate, bool as_expected, Run& run) {
  run.status = name(status);
  run.residual = certificate;
  if (status == InstantStatus::kOutOfIterations) {
    run.residual = kNan;
    run.verdict = "out";
  } else if (status == InstantStatus::kBadInput) {
    run.verdict = "refused";
  } else if (!(certificate <= kAccepted) || !as_expected) {
    run.verdict = "wrong";
  } else {
    run.verdict = usable(status) ? "solved" : "refused";
  }
}

/// The same pads in space, their loads given, on both sides of the mid-plane.
SpatialProblem in_space(const RandomInstant& instant) {
  const auto& [grasp, drive] = instant;
  SpatialProblem q;
  q.grip_force = grasp.capacity();
  for (const double side : {-1.0, 1.0}) {
    ContactPatch& patch = q.patch[q.patch_count++];
    patch.body = side < 0.0 ? ContactBody::kJaw1 : ContactBody::kJaw2;
    patch.n = {0.0, 0.0, -side};
    patch.t = Vec3::UnitX();
    patch.mu = 0.5;
    patch.pressure = PressureLaw::kGiven;
    patch.first = q.count;
    patch.count = grasp.count;
    for (int j = 0; j < grasp.count; ++j) {
      q.x[q.count] = grasp.x[j];
      q.y[q.count] = grasp.y[j];
      q.z[q.count] = 0.01 * side;
      q.preload[q.count++] = grasp.bound[j];
    }
  }
  ContactPatch& pusher = q.patch[q.patch_count++];
  pusher.n << drive.n_H, 0.0;
  pusher.t << drive.t_H(), 0.0;
  pusher.mu = drive.mu;
  pusher.first = q.count;
  pusher.count = drive.count;
  for (int i = 0; i < drive.count; ++i) {
    q.x[q.count] = drive.p_HC[i].x();
    q.y[q.count] = drive.p_HC[i].y();
    q.z[q.count] = 0.0;
    q.preload[q.count++] = 0.0;
  }
  q.w_g << grasp.w_g[0], grasp.w_g[1], 0.0, 0.0, 0.0, grasp.w_g[2];
  q.V_HP << drive.V_HP[0], drive.V_HP[1], 0.0, 0.0, 0.0, drive.V_HP[2];
  return q;
}

/// A motion that the spatial solver also calls the only one, and that differs.
bool contradicted(const RandomInstant& instant, const PlanarInstant& answer) {
  const auto& [grasp, drive] = instant;
  if (answer.status != InstantStatus::kMoves || !grasp.inertia.isZero(0.0) ||
      2 * grasp.count + drive.count > SpatialProblem::kMaxPoints) {
    return false;
  }
  const SpatialProblem q = in_space(instant);
  const SpatialInstant other = solve_spatial(q);
  if (other.status != InstantStatus::kMoves || !certify(q, other).holds()) return false;
  // Below what the spatial solver resolves it cannot tell a push from none.
  if (other.push_force < 1e-6 * grasp.capacity()) return false;
  const Vec3 planar(other.V_HO[0], other.V_HO[1], other.V_HO[5]);
  const PlanarTwist apart = answer.V_HO - planar;
  double rate = 0.0;
  double difference = 0.0;
  for (int i = 0; i < drive.count; ++i) {
    rate = std::max(rate, point_velocity(drive.V_HP, drive.p_HC[i]).norm());
    rate = std::max(rate, point_velocity(answer.V_HO, drive.p_HC[i]).norm());
    difference = std::max(difference, point_velocity(apart, drive.p_HC[i]).norm());
  }
  return difference > kContradicts * rate;
}

template <class Solve>
auto timed(const Solve& solve, Run& run) {
  const double start = thread_time_us();
  auto answer = solve();
  run.time_us = thread_time_us() - start;
  return answer;
}

Run planar_exact(const PlanarExtreme& extreme, const RandomInstant& q) {
  Run run{.solver = "planar exact"};
  const PlanarInstant answer = timed([&] { return solve_planar(q.grasp, q.drive); }, run);
  run.steps = answer.iterations;
  const bool as_expected =
      (!extreme.expected || extreme.expected(answer)) && !contradicted(q, answer);
  judge(answer.status, certify(q.grasp, q.drive, answer).worst, as_expected, run);
  return run;
}

/// The quasi-static instant over the ellipsoid of the same capacity.
Run planar_closed(const RandomInstant& q) {
  Run run{.solver = "closed form"};
  const LimitSurface surface{q.grasp.capacity(), kEllipsoidRadius};
  const PlanarInstant answer =
      timed([&] { return solve_limit_surface(surface, q.grasp.w_g, q.drive); }, run);
  const double residual = limit_surface_residual(surface, q.grasp.w_g, q.drive, answer);
  judge(answer.status, residual, true, run);
  return run;
}

Run planar_ipopt(const RandomInstant& q) {
  Run run{.solver = "planar Ipopt"};
  const PlanarInstant answer = timed(
      [&] { return solve_reference(q.grasp, q.drive, {.generators = kGenerators}); },
      run);
  run.steps = answer.iterations;
  judge(answer.status, answer.residual <= 1e-4 ? 0.0 : answer.residual, true, run);
  run.residual = answer.residual;
  return run;
}

Run spatial_exact(const SpatialExtreme& extreme, const SpatialProblem& q) {
  Run run{.solver = "spatial exact"};
  const SpatialInstant answer = timed([&] { return solve_spatial(q); }, run);
  run.steps = answer.iterations;
  judge(answer.status, certify(q, answer).worst,
        !extreme.expected || extreme.expected(answer), run);
  return run;
}

template <class Solve>
Run polyhedral(const char* solver, const SpatialProblem& q, const Solve& solve) {
  Run run{.solver = solver};
  const SpatialReference answer =
      timed([&] { return solve(q, {.generators = kGenerators, .starts = 3}); }, run);
  run.steps = answer.steps;
  run.residual = answer.residual;
  switch (answer.status) {
    case SpatialReferenceStatus::kSolved:
      run.status = "solved";
      run.verdict = answer.residual <= kAccepted ? "solved" : "wrong";
      break;
    case SpatialReferenceStatus::kInfeasible:
      run.status = "infeasible";
      run.verdict = "refused";
      break;
    case SpatialReferenceStatus::kBadInput:
      run.status = "bad input";
      run.verdict = "refused";
      break;
    case SpatialReferenceStatus::kNotFound:
    case SpatialReferenceStatus::kNotRun:
      run.status = "not found";
      run.verdict = "out";
      break;
  }
  return run;
}

void run_planar(const Options& options, std::vector<Run>& runs) {
  for (const PlanarExtreme& extreme : planar_extremes()) {
    const auto add = [&](Run run, int points, int i) {
      run.group = extreme.group;
      run.extreme = extreme.name;
      run.points = points;
      run.instance = i;
      runs.push_back(std::move(run));
    };
    for (int i = 0; i < options.instances; ++i) {
      const int points = std::array{1, 2, 4, 16, 64}[i % 5];
      const RandomInstant q = extreme_instant(extreme, options.seed, i, points);
      add(planar_exact(extreme, q), points, i);
      // The ellipsoid stands at the finger axis and knows no inertia.
      const bool has_ellipsoid = q.grasp.inertia.isZero(0.0) && extreme.group != "far";
      if (has_ellipsoid) add(planar_closed(q), points, i);
    }
    if (!reference_is_built()) continue;
    for (int i = 0; i < options.peer_instances; ++i) {
      const int points = std::array{2, 4}[i % 2];
      add(planar_ipopt(extreme_instant(extreme, options.seed, i, points)), points, i);
    }
  }
}

void run_spatial(const Options& options, std::vector<Run>& runs) {
  for (const SpatialExtreme& extreme : spatial_extremes()) {
    const auto add = [&](Run run, int points, int i) {
      run.group = extreme.group;
      run.extreme = extreme.name;
      run.points = points;
      run.instance = i;
      runs.push_back(std::move(run));
    };
    const auto instant = [&](int i, int points) {
      return extreme_spatial(extreme, options.seed, i, points, i % 2 == 0 ? 0.0 : 0.1);
    };
    for (int i = 0; i < options.instances; ++i) {
      const int points = std::array{2, 4, 8, 16, 64}[i % 5];
      add(spatial_exact(extreme, instant(i, points)), points, i);
    }
    for (int i = 0; i < options.peer_instances; ++i) {
      const SpatialProblem q = instant(i, 2);
      add(polyhedral("pivoting", q, solve_spatial_pivoting), 2, i);
      if (!spatial_reference_is_built()) continue;
      add(polyhedral("spatial Ipopt", q, solve_spatial_reference), 2, i);
    }
  }
}

void write_csv(const Options& options, const std::vector<Run>& runs, std::FILE* out) {
  std::fputs(
      "solver,group,extreme,points_per_pad,seed,instance,verdict,status,residual,steps,"
      "time_us,compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const Run& run : runs) {
    std::fprintf(out, "%s,%s,%s,%d,%llu,%d,%s,%s,%.3g,%d,%.4g,%s,%s\n", run.solver,
                 run.group.c_str(), field(run.extreme).c_str(), run.points,
                 static_cast<unsigned long long>(options.seed), run.instance,
                 run.verdict.c_str(), run.status.c_str(), run.residual, run.steps,
                 run.time_us, compiler.c_str(), cpu.c_str());
  }
}

/// What runs of one solver on one group came to.
struct Total {
  int runs = 0;
  std::map<std::string, int> verdicts;
  std::map<std::string, int> reasons;  // of refusals
  std::vector<double> residual, steps, time;

  void add(const Run& run) {
    ++runs;
    ++verdicts[run.verdict];
    if (run.verdict == "refused") ++reasons[run.status];
    if (run.verdict == "solved") residual.push_back(run.residual);
    steps.push_back(run.steps);
    time.push_back(run.time_us);
  }

  void print(const std::string& group, std::FILE* out) {
    std::string refused;
    for (const auto& [reason, count] : reasons) {
      refused += (refused.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
    }
    std::fprintf(out, "  %-13s%7d%8d%8d%6d%7d%10.1e%7.0f%10.1f  %s\n", group.c_str(),
                 runs, verdicts["solved"], verdicts["refused"], verdicts["out"],
                 verdicts["wrong"], quantile(residual, 1.0), quantile(steps, 0.5),
                 quantile(time, 0.5), refused.c_str());
  }
};

void write_table(const std::vector<Run>& runs, std::FILE* out) {
  std::vector<std::string> solvers;
  for (const Run& run : runs) {
    if (std::find(solvers.begin(), solvers.end(), run.solver) == solvers.end()) {
      solvers.emplace_back(run.solver);
    }
  }
  for (const std::string& solver : solvers) {
    std::map<std::string, Total> groups;
    Total all;
    for (const Run& run : runs) {
      if (solver != run.solver) continue;
      groups[run.group].add(run);
      all.add(run);
    }
    std::fprintf(out, "\n%-15s%7s%8s%8s%6s%7s%10s%7s%10s  %s\n", solver.c_str(), "runs",
                 "solved", "refused", "out", "wrong", "residual", "steps", "us",
                 "refused as");
    for (auto& [group, total] : groups) total.print(group, out);
    all.print("all", out);
  }
}

bool read_options(int count, char** arguments, Options& options) {
  return take_options(count, arguments,
                      {{"-o", &options.file},
                       {"--seed", &options.seed},
                       {"--instances", &options.instances},
                       {"--peer-instances", &options.peer_instances}},
                      [&options] {
                        options.instances = 5;
                        options.peer_instances = 0;
                      });
}

int run(int count, char** arguments) {
  Options options;
  if (!read_options(count, arguments, options)) {
    std::fputs(
        "usage: bench_extremes [--quick] [--instances N] [--peer-instances N] "
        "[--seed S] [-o FILE]\n",
        stderr);
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  std::vector<Run> runs;
  run_planar(options, runs);
  run_spatial(options, runs);
  write_csv(options, runs, csv.get());
  const bool written = csv.close();
  write_table(runs, stderr);
  const bool wrong = std::any_of(runs.begin(), runs.end(),
                                 [](const Run& run) { return run.verdict == "wrong"; });
  return written && !wrong ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
