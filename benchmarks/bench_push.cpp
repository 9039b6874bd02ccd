/// Error against run time of the transition function over its tolerance, one CSV line per
/// run: random pushes by points, short lines and walls, whole and clipped pads.
///
/// The error is that of the end pose against tolerance 1e-11. Pushes that stop early are
/// compared too; `status` and `reference_status` say where they part.
/// Usage: bench_push [--quick] [--pushes N] [--seed S] [-o FILE]
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
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
constexpr TransitionOptions kReference{.tolerance = 1e-11, .max_steps = 20000};

struct Run {
  int push;
  const char* pusher;
  const char* overhang;
  double tolerance;
  Transition transition;
  TransitionStatus reference_status;
  double error = kNan;  // [m] of the end pose, angles weighed by the torque radius
  double time_us = kNan;
};

const char* kind_of(const PushContact& contact) {
  if (contact.is_point) return "point";
  return std::isinf(contact.half_length) ? "wall" : "line";
}

void run_push(const Options& options, int index, std::vector<Run>& runs) {
  const RandomPush drawn = random_push(options.seed, index);
  const Model model = prepare(drawn.scene);
  const Grasp& start = drawn.scene.start;
  const Transition reference = apply(model, start, drawn.push, kReference);
  const PlanarPose& X_HO = reference.end.X_HO;
  for (const double tolerance : kTolerances) {
    const TransitionOptions wanted{.tolerance = tolerance};
    Run run{};
    run.push = index;
    run.pusher = kind_of(model.contacts[0]);
    run.overhang = drawn.scene.overhang == Overhang::kClip ? "clip" : "ignore";
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
      "seed,push,pusher,overhang,tolerance,status,reference_status,done,error,"
      "error_estimate,slipped,events,instants,certificate,time_us,batches,compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const Run& run : runs) {
    const Transition& t = run.transition;
    std::fprintf(
        out, "%llu,%d,%s,%s,%.0e,%s,%s,%.6f,%.3g,%.3g,%.6g,%d,%d,%.3g,%.4g,%d,%s,%s\n",
        static_cast<unsigned long long>(options.seed), run.push, run.pusher, run.overhang,
        run.tolerance, name(t.status).data(), name(run.reference_status).data(), t.done,
        run.error, t.error_estimate, t.slipped, t.event_count, t.instants,
        t.worst_certificate, run.time_us, options.batches, compiler.c_str(), cpu.c_str());
  }
}

/// One line per tolerance, over the pushes that were integrated and end alike.
void write_summary(const std::vector<Run>& runs, std::FILE* out) {
  std::fprintf(out, "%9s%8s%8s%10s%10s%11s%10s%10s%9s%9s\n", "tolerance", "pushes",
               "alike", "instants", "p99", "error med", "p99", "covered", "us med",
               "p99");
  for (const double tolerance : kTolerances) {
    std::vector<double> instants, errors, times;
    int pushes = 0;
    int alike = 0;
    int covered = 0;
    for (const Run& run : runs) {
      const Transition& t = run.transition;
      if (run.tolerance != tolerance) continue;
      ++pushes;
      if (t.status != run.reference_status) continue;
      ++alike;
      if (t.done == 0.0 || (t.event_count == 0 && t.slipped == 0.0)) continue;
      instants.push_back(t.instants);
      errors.push_back(run.error);
      times.push_back(run.time_us);
      covered += run.error <= t.error_estimate + 1e-11 ? 1 : 0;
    }
    std::fprintf(out, "%9.0e%8d%8d%10.0f%10.0f%11.1e%10.1e%9.2f%%%9.1f%9.1f\n", tolerance,
                 pushes, alike, quantile(instants, 0.5), quantile(instants, 0.99),
                 quantile(errors, 0.5), quantile(errors, 0.99),
                 100.0 * covered / static_cast<double>(errors.size()),
                 quantile(times, 0.5), quantile(times, 0.99));
  }
}

bool read_number(const char* text, long long& value) {
  char* end = nullptr;
  value = std::strtoll(text, &end, 10);
  return end != text && *end == '\0' && value >= 0;
}

bool read_options(int count, char** arguments, Options& options) {
  for (int i = 1; i < count; ++i) {
    const std::string option = arguments[i];
    if (option == "--quick") {
      options.pushes = 20;
      options.batches = 1;
      continue;
    }
    if (i + 1 == count) return false;
    const char* value = arguments[++i];
    long long number = 0;
    const bool is_number = read_number(value, number);
    if (option == "-o") {
      options.file = value;
    } else if (is_number && option == "--pushes") {
      options.pushes = static_cast<int>(number);
    } else if (is_number && option == "--seed") {
      options.seed = static_cast<std::uint64_t>(number);
    } else {
      return false;
    }
  }
  return true;
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
  for (int index = 0; index < options.pushes; ++index) run_push(options, index, runs);
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
