/// Error against run time of the transition function over its tolerance, one CSV line per
/// run: random pushes by points, short lines and walls, whole and clipped pads, over the
/// pads point by point and over the ellipsoid.
///
/// The error is that of the end pose against tolerance 1e-12 with steps that are ten
/// times shorter: over the pads of at most a twenty-eighth of the push, over the
/// ellipsoid of a fourteenth. Pushes that stop early are compared too; `status` and
/// `reference_status` say where they part. Usage: bench_push [--quick] [--pushes N]
/// [--seed S] [-o FILE]
#include <cstdio>
#include <string>
#include <vector>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "primitives/transition.h"
#include "problems/random_pushes.h"

namespace prehensile::benchmarks {
namespace {

struct Options {
  int pushes = 1000;
  std::uint64_t seed = 1;
  int batches = 5;
  const char* file = nullptr;
};

constexpr double kTolerances[] = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
constexpr FrictionModel kModels[] = {FrictionModel::kPads, FrictionModel::kEllipsoid};

const char* name(FrictionModel model) {
  return model == FrictionModel::kPads ? "pads" : "ellipsoid";
}

struct Run {
  int push;
  const char* pusher;
  const char* overhang;
  FrictionModel friction;
  double tolerance;
  Transition transition;
  TransitionStatus reference_status;
  double error = kNan;  // [m] of the end pose, angles weighed by the torque radius
  double time_us = kNan;

  /// Nothing to integrate: a line that sticks all the way.
  bool sticks() const {
    return transition.event_count == 0 && transition.slipped < 1e-12 &&
           pusher != std::string("point");
  }
};

const char* kind_of(const PushContact& contact) {
  if (contact.is_point) return "point";
  return std::isinf(contact.half_length) ? "wall" : "line";
}

void run_push(const Options& options, int index, FrictionModel friction,
              std::vector<Run>& runs) {
  const RandomPush drawn = random_push(options.seed, index);
  const Model model = prepare(drawn.scene);
  const Grasp& start = drawn.scene.start;
  const TransitionOptions fine{.tolerance = 1e-12,
                               .max_step = 0.005,
                               .max_steps = 20000,
                               .friction_model = friction};
  const Transition reference = apply(model, start, drawn.push, fine);
  const PlanarPose& X_HO = reference.end.X_HO;
  for (const double tolerance : kTolerances) {
    const TransitionOptions wanted{.tolerance = tolerance, .friction_model = friction};
    Run run{};
    run.push = index;
    run.pusher = kind_of(model.contacts[0]);
    run.overhang = drawn.scene.overhang == Overhang::kClip ? "clip" : "ignore";
    run.friction = friction;
    run.tolerance = tolerance;
    run.reference_status = reference.status;
    run.transition = apply(model, start, drawn.push, wanted);
    const PlanarPose& end = run.transition.end.X_HO;
    run.error =
        Vec3(end.x - X_HO.x, end.y - X_HO.y, model.c * (end.theta - X_HO.theta)).norm();
    volatile double used = 0.0;  // keeps the calls from being optimised away
    run.time_us = time_us([&] { used = apply(model, start, drawn.push, wanted).done; },
                          options.batches);
    runs.push_back(run);
  }
}

void write_csv(const Options& options, const std::vector<Run>& runs, std::FILE* out) {
  std::fputs(
      "seed,push,pusher,overhang,friction,tolerance,status,reference_status,done,error,"
      "error_estimate,slipped,events,instants,checks,certificate,time_us,batches,"
      "compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const Run& run : runs) {
    const Transition& t = run.transition;
    std::fprintf(
        out,
        "%llu,%d,%s,%s,%s,%.0e,%s,%s,%.6f,%.3g,%.3g,%.6g,%d,%d,%d,%.3g,%.4g,%d,%s,%s\n",
        static_cast<unsigned long long>(options.seed), run.push, run.pusher, run.overhang,
        name(run.friction), run.tolerance, name(t.status).data(),
        name(run.reference_status).data(), t.done, run.error, t.error_estimate, t.slipped,
        t.event_count, t.instants, t.checks, t.worst_certificate, run.time_us,
        options.batches, compiler.c_str(), cpu.c_str());
  }
}

/// Pushes of one kind at one tolerance.
struct Group {
  std::vector<double> instants, checks, errors, times;
  int under = 0;  // error above three times the estimate
  int over = 0;   // estimate above thirty times the error

  void add(const Run& run) {
    constexpr double kReference = 1e-11;  // [m] error of the reference
    const double estimate = run.transition.error_estimate;
    instants.push_back(run.transition.instants);
    checks.push_back(run.transition.checks);
    errors.push_back(run.error);
    times.push_back(run.time_us);
    under += run.error > 3.0 * estimate + kReference ? 1 : 0;
    over += estimate > 30.0 * run.error + 3.0 * kReference ? 1 : 0;
  }
};

/// A line for the pushes that only stick and one for the others, per friction model and
/// tolerance; those that end like their reference.
void write_summary(const std::vector<Run>& runs, std::FILE* out) {
  std::fprintf(out, "%-10s%10s%7s%12s%9s%6s%8s%10s%10s%9s%9s%9s%9s\n", "friction",
               "tolerance", "alike", "", "instants", "p99", "checks", "error med", "p99",
               "err>3est", "est>30e", "us med", "p99");
  for (const FrictionModel friction : kModels) {
    for (const double tolerance : kTolerances) {
      Group sticking, integrated;
      int alike = 0;
      for (const Run& run : runs) {
        if (run.tolerance != tolerance || run.friction != friction) continue;
        if (run.transition.status != run.reference_status) continue;
        ++alike;
        if (run.transition.done > 0.0) (run.sticks() ? sticking : integrated).add(run);
      }
      for (const bool sticks : {true, false}) {
        const Group& group = sticks ? sticking : integrated;
        const double count = static_cast<double>(group.errors.size());
        std::fprintf(out,
                     "%-10s%10.0e%7d%6.0f%s%9.0f%6.0f%8.0f%10.1e%10.1e%8.2f%%%8.2f%%"
                     "%9.1f%9.1f\n",
                     name(friction), tolerance, alike, count,
                     sticks ? " stick" : " other", quantile(group.instants, 0.5),
                     quantile(group.instants, 0.99), quantile(group.checks, 0.5),
                     quantile(group.errors, 0.5), quantile(group.errors, 0.99),
                     100.0 * group.under / count, 100.0 * group.over / count,
                     quantile(group.times, 0.5), quantile(group.times, 0.99));
      }
    }
  }
}

bool read_options(int count, char** arguments, Options& options) {
  return take_options(
      count, arguments,
      {{"-o", &options.file}, {"--pushes", &options.pushes}, {"--seed", &options.seed}},
      [&options] {
        options.pushes = 20;
        options.batches = 1;
      });
}

int run(int count, char** arguments) {
  Options options;
  if (!read_options(count, arguments, options)) {
    std::fputs("usage: bench_push [--quick] [--pushes N] [--seed S] [-o FILE]\n", stderr);
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  std::vector<Run> runs;
  for (int index = 0; index < options.pushes; ++index) {
    for (const FrictionModel friction : kModels) run_push(options, index, friction, runs);
  }
  write_csv(options, runs, csv.get());
  const bool written = csv.close();
  write_summary(runs, stderr);
  return written ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
