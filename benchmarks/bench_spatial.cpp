/// Error against run time of the spatial instant solvers on the same instances, one CSV
/// line per run: the exact solver, pivoting and the paper's interior point on polyhedral
/// cones with g generators, and, where it is installed, Siconos.
///
/// Instances: problems/random_spatial.h, a point pusher, foundations of 1e-2 V0 / F0 (so
/// that there is one answer), with accelerations of 0 (quasi-static; not for Siconos,
/// whose unknowns need inertia), 0.1 and 10 m/s^2.
///
/// `residual` is the natural map on circular cones for all of them, by one function;
/// errors are against the answer that Newton's method in long double finds from that of
/// the exact solver (benchmarks/converged.h). A run is a success if its residual is at
/// most 1e-6; polyhedral answers, which cannot be that, if their own residual is.
/// `distance` is how far an answer is from the one that the same method finds from
/// itself: small where `twist_error` is large means another motion.
///
/// Usage: bench_spatial [--quick] [--instances N] [--peers-every N] [--seed S] [-o FILE]
///        --peers-every N: the slow solvers get every N-th instance only
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "benchmarks/spatial_runs.h"

namespace prehensile::benchmarks {
namespace {

/// Answers agree if push forces and twists do within this share of the capacity of the
/// pads and of the push rate.
constexpr double kAgreement = 1e-6;

struct Options {
  int instances = 60;
  std::uint64_t seed = 1;
  std::vector<int> points = {1, 2, 4, 8, 16};
  std::vector<double> accelerations = {0.0, 0.1, 10.0};
  std::vector<int> generators = {8, 16, 32};
  int peer_share = 1;  // every how-many-th instance is given to the slow solvers
  int batches = 5;
  bool peers = true;
  const char* file = nullptr;
};

void run_instance(const Options& options, int points, double acceleration, int index,
                  std::vector<SpatialRun>& runs) {
  SpatialQuestion q = posed(random_spatial(
      options.seed, static_cast<std::uint64_t>(index),
      {.points_per_pad = points, .pusher_points = 1, .acceleration = acceleration}));
  sharpen_truth(q);
  const auto add = [&](SpatialRun run) {
    measure_distance(q, run);
    run.points = points;
    run.acceleration = acceleration;
    run.instance = index;
    runs.push_back(run);
  };
  add(exact_run(q, options.batches));
  for (const int g : options.generators) {
    // Cost grows with the third power of points times generators.
    if (points * g <= 64) add(pivoting_run(q, g));
  }
  if (!options.peers || index % options.peer_share != 0) return;
  if (spatial_reference_is_built() && points <= 4) {
    add(ipopt_run(q, 8));
  }
  if (!siconos_is_built() || acceleration <= 0.0) return;
  for (const SiconosSolver solver : kSiconosSolvers) add(siconos_run(q, solver));
}

void write_csv(const Options& options, const std::vector<SpatialRun>& runs,
               std::FILE* out) {
  std::fputs(
      "solver,generators,points_per_pad,acceleration,seed,instance,reference_status,"
      "success,force_error,twist_error,residual,distance,least_gain,time_us,iterations,"
      "compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const SpatialRun& run : runs) {
    std::fprintf(
        out, "%s,%d,%d,%g,%llu,%d,%s,%d,%.6g,%.6g,%.3g,%.3g,%.3g,%.4g,%d,%s,%s\n",
        run.solver, run.generators, run.points, run.acceleration,
        static_cast<unsigned long long>(options.seed), run.instance, run.reference_status,
        run.success ? 1 : 0, run.force_error, run.twist_error, run.residual, run.distance,
        run.least_gain, run.time_us, run.iterations, compiler.c_str(), cpu.c_str());
  }
}

/// One line per solver, generators, points and acceleration, over the instances that were
/// asked (the exact solver gives one answer).
void write_summary(const std::vector<SpatialRun>& runs, std::FILE* out) {
  std::fprintf(out, "%6s %6s %-15s%3s%6s%5s%10s%10s%10s%10s%10s%11s%11s\n", "accel",
               "points", "solver", "g", "asked", "ok", "force med", "p95", "twist med",
               "p95", "residual", "us med", "p95");
  const auto key = [](const SpatialRun& run) {
    return std::tuple(run.acceleration, run.points, std::string(run.solver),
                      run.generators);
  };
  std::vector<const SpatialRun*> left;
  for (const SpatialRun& run : runs) {
    if (run.asked) left.push_back(&run);
  }
  std::stable_sort(
      left.begin(), left.end(),
      [&](const SpatialRun* a, const SpatialRun* b) { return key(*a) < key(*b); });
  for (std::size_t first = 0; first < left.size();) {
    std::vector<double> force, twist, residual, time;
    int ok = 0;
    std::size_t last = first;
    for (; last < left.size() && key(*left[last]) == key(*left[first]); ++last) {
      const SpatialRun& run = *left[last];
      ok += run.success ? 1 : 0;
      time.push_back(run.time_us);
      residual.push_back(run.residual);
      if (!run.success) continue;
      force.push_back(run.force_error);
      twist.push_back(run.twist_error);
    }
    const SpatialRun& run = *left[first];
    std::fprintf(out,
                 "%6g %6d %-15s%3d%6zu%5d%10.1e%10.1e%10.1e%10.1e%10.1e%11.1f%11.1f\n",
                 run.acceleration, run.points, run.solver, run.generators, last - first,
                 ok, quantile(force, 0.5), quantile(force, 0.95), quantile(twist, 0.5),
                 quantile(twist, 0.95), quantile(residual, 0.5), quantile(time, 0.5),
                 quantile(time, 0.95));
    first = last;
  }
}

/// Of the instants with two or more points per pad that the exact solver and a peer both
/// solve: on how many they agree, and who is right on the others.
void write_agreement(const std::vector<SpatialRun>& runs, std::FILE* out) {
  struct Agreement {
    int both = 0, agree = 0, other_motion = 0, exact_right = 0, peer_right = 0;
    double worst_exact = 0.0, worst_peer = 0.0;
  };
  std::map<std::pair<double, std::string>, Agreement> table;
  const SpatialRun* exact = nullptr;
  for (const SpatialRun& run : runs) {
    if (run.solver == std::string_view("exact")) exact = &run;
    if (!std::string_view(run.solver).starts_with("siconos") || run.points < 2) continue;
    if (!run.asked || !run.success || !exact->success) continue;
    Agreement& row = table[{run.acceleration, run.solver}];
    ++row.both;
    row.worst_exact = std::max(row.worst_exact, exact->distance);
    row.worst_peer = std::max(row.worst_peer, run.distance);
    const double exact_error = std::max(exact->force_error, exact->twist_error);
    const double peer_error = std::max(run.force_error, run.twist_error);
    if (exact_error + peer_error <= kAgreement) {
      ++row.agree;
    } else if (run.distance <= 1e-3 && peer_error > 1e-3) {
      ++row.other_motion;
    } else {
      row.exact_right += exact->distance <= kAgreement ? 1 : 0;
      row.peer_right += run.distance <= kAgreement ? 1 : 0;
    }
  }
  if (table.empty()) return;
  std::fprintf(out, "\n%6s %-15s%6s%7s%7s%8s%8s%12s%12s\n", "accel", "peer", "both",
               "agree", "other", "exact ok", "peer ok", "exact off", "peer off");
  for (const auto& [key, row] : table) {
    std::fprintf(out, "%6g %-15s%6d%7d%7d%8d%8d%12.1e%12.1e\n", key.first,
                 key.second.c_str(), row.both, row.agree, row.other_motion,
                 row.exact_right, row.peer_right, row.worst_exact, row.worst_peer);
  }
}

bool read_options(int count, char** arguments, Options& options) {
  return take_options(count, arguments,
                      {{"-o", &options.file},
                       {"--seed", &options.seed},
                       {"--instances", &options.instances},
                       {"--peers-every", &options.peer_share, 1}},
                      [&options] {
                        options.instances = 3;
                        options.points = {2, 4};
                        options.generators = {8};
                        options.peers = false;
                        options.batches = 1;
                      });
}

int run(int count, char** arguments) {
  Options options;
  if (!read_options(count, arguments, options)) {
    std::fputs(
        "usage: bench_spatial [--quick] [--instances N] [--peers-every N] [--seed S]"
        " [-o FILE]\n",
        stderr);
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  if (!siconos_is_built()) std::fputs("built without Siconos: no peers\n", stderr);
  std::vector<SpatialRun> runs;
  for (const double acceleration : options.accelerations) {
    for (const int points : options.points) {
      for (int index = 0; index < options.instances; ++index) {
        run_instance(options, points, acceleration, index, runs);
      }
    }
  }
  write_csv(options, runs, csv.get());
  const bool written = csv.close();
  write_summary(runs, stderr);
  write_agreement(runs, stderr);
  return written ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
