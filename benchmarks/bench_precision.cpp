/// Error against run time of all instant solvers and discretisations in one run: a CSV
/// line per run, work-precision plots, a performance profile, and the ratios of times.
///
/// Planar: the exact solver with k points per pad, the closed form, and the paper's way
/// by Ipopt with k points and g generators, against the exact solver with 64 points.
/// Spatial, at accelerations of 0.1 m/s^2 (next to quasi-static) and 10 m/s^2: the exact
/// solver with k points and foundations of compliance R down to the rigid limit, pivoting
/// and Ipopt with g generators, and, where it is built, Siconos, against the exact solver
/// with 64 points in the rigid limit; point pushers. Solved: a residual of at most 1e-6
/// of the run's own problem (Ipopt in the plane: 1e-4, its gate).
///
/// Usage: bench_precision [--quick] [--instances N] [--peer-instances N] [--seed S]
///                        [--plots FOLDER] [-o FILE]
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "benchmarks/precision_plots.h"
#include "benchmarks/spatial_runs.h"
#include "benchmarks/svg_file.h"
#include "mechanics/limit_surface.h"
#include "mechanics/planar_instant.h"
#include "mechanics/reference.h"
#include "problems/random_instants.h"

namespace prehensile::benchmarks {
namespace {

constexpr int kFinest = 64;
constexpr double kCompliance = 1e-2;  // at which peers are compared

struct Options {
  int instances = 200;
  int peer_instances = 20;
  std::uint64_t seed = 1;
  std::vector<int> points = {1, 2, 4, 8, 16, 32};
  std::vector<int> peer_points = {2, 4, 8, 16};
  int batches = 3;
  bool peers = true;
  const char* file = nullptr;
  std::string plots;
};

double push_rate(const PlanarDrive& drive) {
  return std::max(point_velocity(drive.V_HP, drive.p_HC[0]).norm(),
                  point_velocity(drive.V_HP, drive.p_HC[1]).norm());
}

double lever_of(const PlanarGrasp& grasp) {
  double torque = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    torque += grasp.bound[j] * std::hypot(grasp.x[j], grasp.y[j]);
  }
  return torque / grasp.capacity();
}

/// One planar instant by all methods.
void run_planar(const Options& options, int index, std::vector<PrecisionRun>& runs) {
  const auto at = [&](int points) {
    return random_instant(options.seed, index, {.points_per_pad = points});
  };
  const RandomInstant finest = at(kFinest);
  const PlanarInstant truth = solve_planar(finest.grasp, finest.drive);
  const double lever = lever_of(finest.grasp);
  const auto add = [&](const char* solver, int points, int generators, int batches,
                       const auto& solve) {
    PrecisionRun run{.set = "planar", .solver = solver, .points = points};
    run.generators = generators;
    run.instance = index;
    run.asked = usable(truth.status);
    [[maybe_unused]] volatile double used = 0.0;
    run.time_us = time_us([&] { used = solve().residual; }, batches);
    const PlanarInstant answer = solve();
    run.residual = answer.residual;
    run.solved = usable(answer.status);
    if (run.asked && run.solved) {
      const PlanarTwist V = answer.V_HO - truth.V_HO;
      run.twist_error = Vec3(V[0], V[1], lever * V[2]).norm() / push_rate(finest.drive);
      run.force_error = (answer.w_push - truth.w_push).head<2>().norm();
      run.force_error /= finest.grasp.capacity();
    }
    runs.push_back(run);
  };
  for (const int points : options.points) {
    const RandomInstant q = at(points);
    add("exact", points, 0, options.batches,
        [&] { return solve_planar(q.grasp, q.drive); });
  }
  const LimitSurface surface{finest.grasp.capacity(), lever};
  add("closed form", 0, 0, options.batches,
      [&] { return solve_limit_surface(surface, finest.grasp.w_g, finest.drive); });
  if (!options.peers || !reference_is_built() || index >= options.peer_instances) return;
  for (const int points : {2, 4, 8}) {
    const RandomInstant q = at(points);
    for (const int generators : {4, 8, 16, 32}) {
      add("ipopt", points, generators, 1,
          [&] { return solve_reference(q.grasp, q.drive, {.generators = generators}); });
    }
  }
}

std::string set_of(double acceleration) {
  return acceleration < 1.0 ? "spatial 0.1" : "spatial 10";
}

/// One spatial instant by all methods.
void run_spatial(const Options& options, double acceleration, int index,
                 std::vector<PrecisionRun>& runs) {
  const auto at = [&](int points, double compliance) {
    return random_spatial(options.seed, static_cast<std::uint64_t>(index),
                          {.points_per_pad = points,
                           .pusher_points = 1,
                           .acceleration = acceleration,
                           .compliance = compliance});
  };
  const SpatialInstant truth =
      solve_spatial(at(kFinest, kCompliance), {.rigid_limit = true});
  const auto question = [&](int points, double compliance) {
    SpatialQuestion q = posed(at(points, compliance));
    q.truth = {truth.status, truth.V_HO, truth.w_push};
    return q;
  };
  const auto add = [&](const SpatialRun& run, int points, double compliance) {
    runs.push_back({.set = set_of(acceleration),
                    .solver = run.solver,
                    .points = points,
                    .generators = run.generators,
                    .compliance = compliance,
                    .instance = index,
                    .asked = run.asked,
                    .solved = run.success,
                    .residual = run.residual,
                    .force_error = run.force_error,
                    .twist_error = run.twist_error,
                    .time_us = run.time_us});
  };
  for (const int points : options.points) {
    for (const double compliance : {1.0, 0.1, 1e-2, 1e-3, 1e-4}) {
      add(exact_run(question(points, compliance), options.batches), points, compliance);
    }
    const SpatialSolveOptions rigid{.rigid_limit = true};
    add(exact_run(question(points, kCompliance), options.batches, rigid), points, 0.0);
  }
  if (!options.peers) return;
  for (const int points : options.peer_points) {
    const SpatialQuestion q = question(points, kCompliance);
    for (const int generators : {8, 16, 32}) {
      if (points * generators <= 64) {
        add(pivoting_run(q, generators), points, kCompliance);
      }
    }
    if (spatial_reference_is_built() && points <= 4) {
      add(ipopt_run(q, 8), points, kCompliance);
    }
    if (!siconos_is_built()) continue;
    for (const SiconosSolver solver : kSiconosSolvers) {
      add(siconos_run(q, solver), points, kCompliance);
    }
  }
}

void write_csv(const Options& options, const std::vector<PrecisionRun>& runs,
               std::FILE* out) {
  std::fputs(
      "set,solver,points_per_pad,generators,compliance,seed,instance,asked,solved,"
      "residual,force_error,twist_error,time_us,compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const PrecisionRun& run : runs) {
    std::fprintf(out, "%s,%s,%d,%d,%g,%llu,%d,%d,%d,%.3g,%.6g,%.6g,%.4g,%s,%s\n",
                 run.set.c_str(), run.solver.c_str(), run.points, run.generators,
                 run.compliance, static_cast<unsigned long long>(options.seed),
                 run.instance, run.asked ? 1 : 0, run.solved ? 1 : 0, run.residual,
                 run.force_error, run.twist_error, run.time_us, compiler.c_str(),
                 cpu.c_str());
  }
}

void write_points(const std::vector<PrecisionPoint>& points, std::FILE* out) {
  std::fprintf(out, "%-12s%-16s%4s%4s%8s%7s%8s%10s%11s%9s%11s%9s%11s\n", "set", "solver",
               "k", "g", "R", "asked", "failed", "residual", "force med", "p95",
               "twist med", "p95", "us median");
  for (const PrecisionPoint& p : points) {
    std::fprintf(out, "%-12s%-16s%4d%4d%8g%7d%7.1f%%%10.1e%11.1e%9.1e%11.1e%9.1e%11.2f\n",
                 p.example.set.c_str(), p.example.solver.c_str(), p.example.points,
                 p.example.generators, p.example.compliance, p.asked, 100.0 * p.failed(),
                 p.residual, p.force_median, p.force_p95, p.twist_median, p.twist_p95,
                 p.time_median);
  }
}

/// exact : best Siconos and exact : Ipopt, medians over the instants that both solve.
void write_ratios(const Options& options, const std::vector<PrecisionRun>& runs,
                  std::FILE* out) {
  std::fprintf(out, "\ntimes over those of the exact solver, medians (%s; %s; %s)\n",
               cpu_name().c_str(), compiler_name().c_str(), build_name());
  std::fprintf(out, "%-12s%4s%16s%10s%16s\n", "set", "k", "best Siconos", "solved",
               "Ipopt g = 8");
  for (const char* set : {"spatial 0.1", "spatial 10"}) {
    for (const int points : options.peer_points) {
      std::map<int, double> exact, siconos, ipopt;
      for (const PrecisionRun& run : runs) {
        const bool counts = run.set == set && run.points == points && run.solved &&
                            run.compliance == kCompliance && run.asked;
        if (!counts) continue;
        const auto keep = [&](std::map<int, double>& times) {
          const auto [at, is_new] = times.try_emplace(run.instance, run.time_us);
          if (!is_new) at->second = std::min(at->second, run.time_us);
        };
        if (run.solver == "exact") keep(exact);
        if (run.solver.starts_with("siconos")) keep(siconos);
        if (run.solver == "ipopt") keep(ipopt);
      }
      const auto ratio = [&](const std::map<int, double>& times) {
        std::vector<double> ratios;
        for (const auto& [instance, time] : times) {
          if (exact.contains(instance)) ratios.push_back(time / exact[instance]);
        }
        return quantile(ratios, 0.5);
      };
      std::fprintf(out, "%-12s%4d%16.0f%7zu/%-3zu%15.0f\n", set, points, ratio(siconos),
                   siconos.size(), exact.size(), ratio(ipopt));
    }
  }
}

bool write_plots(const Options& options, const std::vector<PrecisionRun>& runs,
                 const std::vector<PrecisionPoint>& points) {
  const std::filesystem::path folder = options.plots;
  bool written = true;
  const auto write = [&](const char* file, const std::string& svg) {
    written = write_svg(folder / file, svg) && written;
  };
  write("precision_planar.svg", work_precision_svg(points, "planar"));
  write("precision_spatial.svg", work_precision_svg(points, "spatial 0.1"));
  write("profile_0.1.svg", profile_svg(runs, {.set = "spatial 0.1"}));
  write("profile_10.svg", profile_svg(runs, {.set = "spatial 10"}));
  return written;
}

bool read_options(int count, char** arguments, Options& options) {
  return take_options(count, arguments,
                      {{"-o", &options.file},
                       {"--seed", &options.seed},
                       {"--instances", &options.instances},
                       {"--peer-instances", &options.peer_instances},
                       {"--plots", &options.plots}},
                      [&options] {
                        options.instances = 3;
                        options.peer_instances = 2;
                        options.points = {2, 4};
                        options.batches = 1;
                        options.peers = false;
                      }) &&
         (options.plots.empty() || std::filesystem::is_directory(options.plots));
}

int run(int count, char** arguments) {
  Options options;
  if (!read_options(count, arguments, options)) {
    std::fputs(
        "usage: bench_precision [--quick] [--instances N] [--peer-instances N] "
        "[--seed S] [--plots FOLDER] [-o FILE]\n",
        stderr);
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  if (!siconos_is_built()) std::fputs("built without Siconos\n", stderr);
  std::vector<PrecisionRun> runs;
  for (int index = 0; index < options.instances; ++index) {
    run_planar(options, index, runs);
  }
  for (const double acceleration : {0.1, 10.0}) {
    for (int index = 0; index < options.peer_instances; ++index) {
      run_spatial(options, acceleration, index, runs);
    }
  }
  write_csv(options, runs, csv.get());
  bool written = csv.close();
  const std::vector<PrecisionPoint> points = points_of(runs);
  write_points(points, stderr);
  if (options.peers) write_ratios(options, runs, stderr);
  if (!options.plots.empty()) written = write_plots(options, runs, points) && written;
  return written ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
