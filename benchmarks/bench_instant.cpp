/// Error against run time of the instant solvers, one CSV line per run.
///
/// Study `pads`: how many points a pad needs. Answers over k points per pad, and of the
/// closed form over the ellipsoid, against the exact solver with 64 points.
/// Study `generators`: what polyhedral friction costs. The paper's formulation through
/// Ipopt with g generators against the exact solver over the same 4 points per pad.
/// Study `sequence`: 16 points, solved cold, and warm after a step of 0.1 mm and 0.2 deg
/// of the object in the hand; `evaluations` counts sums over the points, with derivatives
/// or without. Last, the closed form is timed against its own square roots and divisions.
///
/// Every run gives a line: refusals and failures too, with no error but with a status.
/// Usage: bench_instant [--quick] [--instances N] [--ipopt-instances N] [--seed S]
///                      [-o FILE]
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "mechanics/certificate.h"
#include "mechanics/limit_surface.h"
#include "mechanics/planar_instant.h"
#include "mechanics/reference.h"
#include "problems/random_instants.h"

namespace prehensile::benchmarks {
namespace {

struct Options {
  int instances = 1000;
  int ipopt_instances = 100;
  std::uint64_t seed = 1;
  std::vector<int> generators = {4, 8, 16, 32, 64};
  int batches = 5;
  const char* file = nullptr;
};

constexpr int kFinestPad = 64;
constexpr int kPointsForGenerators = 4;
constexpr int kPointsOfSequence = 16;

struct Run {
  const char* study;
  const char* solver;
  int setting;  // points per pad or generators; 0: none
  int instance;
  InstantStatus status;
  InstantStatus reference_status;
  double force_error = kNan;  // of the push force vector, in capacities of the pads
  double twist_error = kNan;  // in push rates, turns weighed by the pads' lever
  double residual = kNan;     // the solver's own
  double certificate = kNan;  // by separate code; of the circular cone
  double time_us = kNan;
  int iterations = 0;
  int evaluations = 0;
};

double push_rate(const PlanarDrive& drive) {
  return std::max(point_velocity(drive.V_HP, drive.p_HC[0]).norm(),
                  point_velocity(drive.V_HP, drive.p_HC[1]).norm());
}

/// Largest torque per largest force of the pads about the finger axis [m].
double torque_radius(const PlanarGrasp& grasp) {
  double torque = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    torque += grasp.bound[j] * std::hypot(grasp.x[j], grasp.y[j]);
  }
  return torque / grasp.capacity();
}

/// An instance with its answer to compare with.
struct Reference {
  RandomInstant instant;
  PlanarInstant answer;
  double lever;
};

Reference reference_for(const Options& options, int index, int points) {
  Reference reference;
  reference.instant = random_instant(options.seed, index, {.points_per_pad = points});
  reference.answer = solve_planar(reference.instant.grasp, reference.instant.drive);
  reference.lever = torque_radius(reference.instant.grasp);
  return reference;
}

void compare(const Reference& reference, const PlanarInstant& answer, Run& run) {
  run.status = answer.status;
  run.reference_status = reference.answer.status;
  run.residual = answer.residual;
  run.iterations = answer.iterations;
  run.evaluations = answer.evaluations;
  if (!usable(answer.status) || !usable(reference.answer.status)) return;
  const auto& [grasp, drive] = reference.instant;
  const PlanarTwist V = answer.V_HO - reference.answer.V_HO;
  run.force_error =
      (answer.w_push - reference.answer.w_push).head<2>().norm() / grasp.capacity();
  run.twist_error = Vec3(V[0], V[1], reference.lever * V[2]).norm() / push_rate(drive);
}

/// Times `solve` and compares its answer, which is left in `answer`.
template <typename Solve>
Run measured(const Reference& reference, int batches, const Solve& solve,
             PlanarInstant& answer) {
  Run run{};
  // Keeps the calls from being optimised away.
  [[maybe_unused]] volatile double used = 0.0;
  run.time_us = time_us([&] { used = solve().residual; }, batches);
  answer = solve();
  compare(reference, answer, run);
  return run;
}

Run exact_run(const Options& options, const Reference& reference,
              const RandomInstant& instant) {
  const PlanarGrasp& grasp = instant.grasp;
  const PlanarDrive& drive = instant.drive;
  PlanarInstant answer;
  Run run = measured(
      reference, options.batches, [&] { return solve_planar(grasp, drive); }, answer);
  run.certificate = certify(grasp, drive, answer).worst;
  run.solver = "exact";
  return run;
}

Run closed_run(const Options& options, const Reference& reference) {
  const PlanarGrasp& grasp = reference.instant.grasp;
  const PlanarDrive& drive = reference.instant.drive;
  const LimitSurface surface{grasp.capacity(), reference.lever};
  PlanarInstant answer;
  Run run = measured(
      reference, options.batches,
      [&] { return solve_limit_surface(surface, grasp.w_g, drive); }, answer);
  run.certificate = limit_surface_residual(surface, grasp.w_g, drive, answer);
  run.solver = "closed";
  return run;
}

Run ipopt_run(const Reference& reference, int generators) {
  const PlanarGrasp& grasp = reference.instant.grasp;
  const PlanarDrive& drive = reference.instant.drive;
  PlanarInstant answer;
  Run run = measured(
      reference, 1,
      [&] { return solve_reference(grasp, drive, {.generators = generators}); }, answer);
  run.certificate = certify(grasp, drive, answer).worst;
  run.solver = "ipopt";
  run.setting = generators;
  return run;
}

void study_pads(const Options& options, std::vector<Run>& runs) {
  const auto add = [&runs](Run run, int index, int setting) {
    run.study = "pads";
    run.instance = index;
    run.setting = setting;
    runs.push_back(run);
  };
  for (int index = 0; index < options.instances; ++index) {
    const Reference reference = reference_for(options, index, kFinestPad);
    add(closed_run(options, reference), index, 0);
    for (const int points : {1, 2, 4, 8, 16, 32, 64}) {
      const RandomInstant instant =
          random_instant(options.seed, index, {.points_per_pad = points});
      add(exact_run(options, reference, instant), index, points);
    }
  }
}

void study_generators(const Options& options, std::vector<Run>& runs) {
  const auto add = [&runs](Run run, int index) {
    run.study = "generators";
    run.instance = index;
    if (run.setting == 0) run.setting = kPointsForGenerators;
    runs.push_back(run);
  };
  for (int index = 0; index < options.ipopt_instances; ++index) {
    const Reference reference = reference_for(options, index, kPointsForGenerators);
    add(exact_run(options, reference, reference.instant), index);
    for (const int generators : options.generators) {
      add(ipopt_run(reference, generators), index);
    }
  }
}

/// The object turned and shifted in the hand, and with it gravity and pusher.
RandomInstant stepped(const RandomInstant& instant) {
  constexpr double kTurn = 0.2 * 0.017453292519943295;
  const Vec2 shift = 1e-4 * instant.drive.t_H();
  const auto moved = [&](const Vec2& p) { return Vec2(rotated(kTurn, p) + shift); };
  RandomInstant next = instant;
  for (Vec2& p : next.drive.p_HC) p = moved(p);
  next.drive.n_H = rotated(kTurn, instant.drive.n_H);
  const PlanarTwist& V = instant.drive.V_HP;
  next.drive.V_HP << rotated(kTurn, Vec2(V.head<2>())) - V[2] * perp(shift), V[2];
  const PlanarWrench& w = instant.grasp.w_g;
  const Vec2 f = rotated(kTurn, Vec2(w.head<2>()));
  next.grasp.w_g << f, w[2] + cross(shift, f);
  return next;
}

void study_sequence(const Options& options, std::vector<Run>& runs) {
  for (int index = 0; index < options.instances; ++index) {
    const Reference before = reference_for(options, index, kPointsOfSequence);
    Reference reference = before;
    reference.instant = stepped(before.instant);
    const PlanarGrasp& grasp = reference.instant.grasp;
    const PlanarDrive& drive = reference.instant.drive;
    reference.answer = solve_planar(grasp, drive);
    for (const bool warm : {false, true}) {
      PlanarInstant answer;
      const auto solve = [&] {
        PlanarWarmStart start{warm && usable(before.answer.status), before.answer};
        return solve_planar(grasp, drive, {}, &start);
      };
      Run run = measured(reference, options.batches, solve, answer);
      run.certificate = certify(grasp, drive, answer).worst;
      run.study = "sequence";
      run.solver = warm ? "warm" : "cold";
      run.setting = kPointsOfSequence;
      run.instance = index;
      runs.push_back(run);
    }
  }
}

/// A point that sticks takes the closed form five square roots (rate of the pusher,
/// motion, friction, misfit, push force) and seven divisions (three units, motion twice,
/// friction, force at the point): here one after the other. `chained`: so are the calls.
double roots_and_divisions_us(bool chained) {
  const volatile double seed = 1.7;
  [[maybe_unused]] volatile double used = 0.0;
  double x = seed;
  return time_us(
      [&] {
        if (!chained) x = seed;
        for (int k = 0; k < 5; ++k) x = std::sqrt(x + 1.0);
        for (int k = 0; k < 7; ++k) x = 1.0 / (x + 0.5);
        used = x;
      },
      50);
}

void write_closed_form(const Options& options, std::FILE* out) {
  std::vector<double> all;
  std::vector<double> sticks;
  std::vector<double> chained_sticks;
  [[maybe_unused]] volatile double used = 0.0;
  for (int index = 0; index < options.instances; ++index) {
    RandomInstant q = random_instant(options.seed, index, {.points_per_pad = 16});
    const LimitSurface surface{q.grasp.capacity(), torque_radius(q.grasp)};
    PlanarWrench& w_g = q.grasp.w_g;
    const auto solve = [&] { return solve_limit_surface(surface, w_g, q.drive); };
    const PlanarInstant answer = solve();
    if (answer.status != InstantStatus::kMoves) continue;
    all.push_back(time_us([&] { used = solve().residual; }, options.batches));
    if (q.drive.count != 1 || answer.pusher[0].mode != ContactMode::kStick) continue;
    sticks.push_back(all.back());
    chained_sticks.push_back(
        time_us([&] { w_g[2] += 1e-300 * solve().push_force; }, options.batches));
  }
  const double bare = roots_and_divisions_us(false);
  const double bare_chained = roots_and_divisions_us(true);
  const double point = quantile(sticks, 0.5);
  const double chained = quantile(chained_sticks, 0.5);
  std::fprintf(
      out,
      "closed form: median %.4f us; a point that sticks %.4f us, 1 : %.1f of its "
      "roots and divisions; calls in a chain %.4f us, 1 : %.1f\n",
      quantile(all, 0.5), point, point / bare, chained, chained / bare_chained);
}

void write_csv(const Options& options, const std::vector<Run>& runs, std::FILE* out) {
  std::fputs(
      "study,solver,setting,seed,instance,status,reference_status,force_error,"
      "twist_error,residual,certificate,time_us,iterations,evaluations,batches,compiler,"
      "cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const Run& run : runs) {
    std::fprintf(
        out, "%s,%s,%d,%llu,%d,%s,%s,%.6g,%.6g,%.3g,%.3g,%.4g,%d,%d,%d,%s,%s\n",
        run.study, run.solver, run.setting, static_cast<unsigned long long>(options.seed),
        run.instance, name(run.status).data(), name(run.reference_status).data(),
        run.force_error, run.twist_error, run.residual, run.certificate, run.time_us,
        run.iterations, run.evaluations, options.batches, compiler.c_str(), cpu.c_str());
  }
}

/// One line per study, solver and setting. `asked`: runs whose reference has an answer;
/// `answered`: those of them that gave one too.
void write_summary(const std::vector<Run>& runs, std::FILE* out) {
  std::fprintf(out, "%-11s%-7s%8s%7s%9s%11s%10s%11s%10s%11s%10s%13s\n", "study", "solver",
               "setting", "asked", "answered", "force med", "p95", "twist med", "p95",
               "us med", "p95", "evaluations");
  std::vector<const Run*> left;
  left.reserve(runs.size());
  for (const Run& run : runs) left.push_back(&run);
  while (!left.empty()) {
    const Run& first = *left.front();
    std::vector<double> force, twist, time, evaluations;
    int asked = 0;
    std::erase_if(left, [&](const Run* run) {
      if (std::strcmp(run->study, first.study) != 0 ||
          std::strcmp(run->solver, first.solver) != 0 || run->setting != first.setting) {
        return false;
      }
      if (!usable(run->reference_status)) return true;
      ++asked;
      time.push_back(run->time_us);
      evaluations.push_back(run->evaluations);
      if (!std::isnan(run->force_error)) {
        force.push_back(run->force_error);
        twist.push_back(run->twist_error);
      }
      return true;
    });
    std::fprintf(
        out, "%-11s %-7s %7d %6d %9zu %10.2e %10.2e %10.2e %10.2e %10.2f %10.2f %12.0f\n",
        first.study, first.solver, first.setting, asked, force.size(),
        quantile(force, 0.5), quantile(force, 0.95), quantile(twist, 0.5),
        quantile(twist, 0.95), quantile(time, 0.5), quantile(time, 0.95),
        quantile(evaluations, 0.5));
  }
}

bool read_options(int count, char** arguments, Options& options) {
  return take_options(count, arguments,
                      {{"-o", &options.file},
                       {"--seed", &options.seed},
                       {"--instances", &options.instances},
                       {"--ipopt-instances", &options.ipopt_instances}},
                      [&options] {
                        options.instances = 10;
                        options.ipopt_instances = 2;
                        options.generators = {4, 8};
                        options.batches = 1;
                      });
}

int run(int count, char** arguments) {
  Options options;
  if (!read_options(count, arguments, options)) {
    std::fputs(
        "usage: bench_instant [--quick] [--instances N] [--ipopt-instances N] "
        "[--seed S] [-o FILE]\n",
        stderr);
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  std::vector<Run> runs;
  study_pads(options, runs);
  study_generators(options, runs);
  study_sequence(options, runs);
  write_csv(options, runs, csv.get());
  const bool written = csv.close();
  write_summary(runs, stderr);
  write_closed_form(options, stderr);
  return written ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
