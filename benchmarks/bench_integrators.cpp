/// Error against evaluations and time of integrators of a push by a point: fixed Euler,
/// fixed Runge-Kutta 4, adaptive Dormand-Prince, and the transition function, with and
/// without located changes of contact mode; over lengths, on stiff and extreme
/// pushes, and on winding ones with 0 to 10 events. One CSV line per run; --charts writes
/// error against time as SVG.
///
/// The error is that of the end pose (angles weigh the torque radius) against the
/// transition at tolerance 1e-12 with steps of at most a tenth of the push; only pushes
/// that this completes are measured.
/// Usage: bench_integrators [--quick] [--pushes N] [--seed S] [-o FILE] [--charts FILE]
#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/csv_file.h"
#include "benchmarks/fixed_step.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "benchmarks/write_charts.h"
#include "problems/random_pushes.h"

namespace prehensile::benchmarks {
namespace {

struct Options {
  int pushes = 20;
  std::uint64_t seed = 31;
  int batches = 2;
  bool quick = false;
  const char* file = nullptr;
  const char* charts = nullptr;
};

/// A kind of push; `shape` changes a random one.
struct Set {
  std::string name;
  double travel;  // [m]
  void (*shape)(RandomPush&, int index);
  int events = -1;  // that a push shall have; -1: any number
};

void ordinary(RandomPush&, int) {}

void high_friction(RandomPush& c, int index) {
  constexpr double kFrictions[] = {2.0, 10.0, 100.0, 1000.0};
  c.scene.pushers[0].friction = kFrictions[index % 4];
}

void tiny_pads(RandomPush& c, int index) {
  constexpr double kRadii[] = {1e-3, 1e-4, 1e-5};
  c.scene.gripper.pad = DiscPad{kRadii[index % 3]};
  c.scene.g_W.setZero();
}

/// Friction within a millionth of that at which the point begins to slip at once.
void threshold(RandomPush& c, int index) {
  RandomPush sticky = c;
  sticky.scene.pushers[0].friction = 1e3;
  std::vector<Sample> trace;
  (void)apply(prepare(sticky.scene), c.scene.start, c.push, {}, &trace);
  if (trace.empty() || !(trace[0].normal_force > 0.0)) return;
  const double ratio = std::abs(trace[0].tangential_force) / trace[0].normal_force;
  c.scene.pushers[0].friction = ratio * (index % 2 == 0 ? 1.0 + 1e-6 : 1.0 - 1e-6);
}

/// The pusher turns by 1 to 9 rad while its way turns back half as far again: sticking
/// and slipping either way take turns.
void winding(RandomPush& c, int index) {
  c.push.turn = (index % 2 == 0 ? -1.0 : 1.0) * (1.0 + 0.5 * (index % 17));
  c.push.bend = -1.5 * c.push.turn;
}

/// A set for every number of events that is wanted; a few pushes each.
std::vector<Set> sets(bool quick) {
  std::vector<Set> all{
      {"10 mm", 0.01, ordinary},      {"40 mm", 0.04, ordinary},
      {"80 mm", 0.08, ordinary},      {"high friction", 0.04, high_friction},
      {"tiny pads", 0.04, tiny_pads}, {"threshold", 0.04, threshold},
  };
  for (int events = 0; events <= 10; ++events) {
    if (quick && events != 2) continue;
    all.push_back({std::to_string(events) + " events", 0.08, winding, events});
  }
  return all;
}
constexpr int kPushesPerEventful = 8;  // of other sets for one of these
constexpr int kMostDrawn = 20000;      // in search of one

struct Run {
  std::string set;
  int push;
  const char* friction;  // "pads" or "ellipsoid"
  std::string integrator;
  double parameter;  // steps, or tolerance [m]
  bool completed;
  int reference_events;
  int evaluations;
  double error;  // [m]
  double time_us;
};

RandomPush drawn(const Options& options, const Set& set, int index) {
  RandomPush c = random_push(options.seed, index);
  c.scene.object.shape = BoxShape{{0.1, 0.1, 0.02}};  // room for long pushes
  c.scene.pushers[0].feature = PointFeature{};
  c.push.travel = set.travel;
  set.shape(c, index);
  return c;
}

class Measurement {
 public:
  Measurement(const Options& options, std::vector<Run>& runs)
      : options_(options), runs_(runs) {}

  /// False if the push is not one of the set, or does not complete.
  bool measure(const Set& set, int index, FrictionModel friction) {
    const RandomPush c = drawn(options_, set, index);
    const Model model = prepare(c.scene);
    const Grasp& start = c.scene.start;
    const TransitionOptions fine{.tolerance = 1e-12,
                                 .max_step = 0.005,
                                 .max_steps = 10000,
                                 .friction_model = friction};
    if (set.events >= 0) {
      const Transition t = apply(model, start, c.push, {.friction_model = friction});
      if (!t.completed() || t.event_count != set.events) return false;
    }
    const Transition reference = apply(model, start, c.push, fine);
    if (!reference.completed()) return false;
    if (set.events >= 0 && reference.event_count != set.events) return false;
    Run run{};
    run.set = set.name;
    run.push = index;
    run.friction = friction == FrictionModel::kPads ? "pads" : "ellipsoid";
    run.reference_events = reference.event_count;
    const auto record = [&](const char* integrator, double parameter, auto&& call) {
      run.integrator = integrator;
      run.parameter = parameter;
      PlanarPose end;
      call(run.completed, end, run.evaluations);
      const PlanarPose& X_HO = reference.end.X_HO;
      run.error = run.completed ? Vec3(end.x - X_HO.x, end.y - X_HO.y,
                                       model.c * (end.theta - X_HO.theta))
                                      .norm()
                                : kNan;
      bool unused_completed = false;
      PlanarPose unused_end;
      int unused = 0;
      run.time_us =
          time_us([&] { call(unused_completed, unused_end, unused); }, options_.batches);
      runs_.push_back(run);
    };
    for (const Scheme scheme : {Scheme::kEuler, Scheme::kEulerLocated,
                                Scheme::kRungeKutta, Scheme::kRungeKuttaLocated}) {
      const bool euler = scheme == Scheme::kEuler || scheme == Scheme::kEulerLocated;
      for (const int steps : euler ? euler_steps() : runge_kutta_steps()) {
        record(name(scheme), steps, [&](bool& completed, PlanarPose& end, int& count) {
          const PlainRun plain = integrate_plainly(
              model, start, c.push, {.friction_model = friction}, scheme, steps);
          completed = plain.completed;
          end = plain.end;
          count = plain.evaluations;
        });
      }
    }
    for (const double tolerance : tolerances()) {
      const TransitionOptions wanted{
          .tolerance = tolerance, .max_steps = 20000, .friction_model = friction};
      record(name(Scheme::kAdaptive), tolerance,
             [&](bool& completed, PlanarPose& end, int& count) {
               const PlainRun plain =
                   integrate_plainly(model, start, c.push, wanted, Scheme::kAdaptive, 0);
               completed = plain.completed;
               end = plain.end;
               count = plain.evaluations;
             });
      record("transition", tolerance, [&](bool& completed, PlanarPose& end, int& count) {
        const Transition t = apply(model, start, c.push, wanted);
        completed = t.completed();
        end = t.end.X_HO;
        count = t.instants;
      });
    }
    return true;
  }

 private:
  std::vector<int> euler_steps() const {
    if (options_.quick) return {10, 100};
    return {10, 30, 100, 300, 1000, 3000};
  }
  std::vector<int> runge_kutta_steps() const {
    if (options_.quick) return {5, 20};
    return {3, 5, 7, 10, 15, 20, 30, 50, 100, 200, 500, 1000};
  }
  std::vector<double> tolerances() const {
    if (options_.quick) return {1e-6};
    return {1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6,  1e-6, 3e-7,
            1e-7, 3e-8, 1e-8, 3e-9, 1e-9, 3e-10, 1e-10};
  }

  const Options& options_;
  std::vector<Run>& runs_;
};

void write_csv(const Options& options, const std::vector<Run>& runs, std::FILE* out) {
  std::fputs(
      "seed,set,push,friction,integrator,parameter,completed,reference_events,"
      "evaluations,error,time_us,compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const Run& run : runs) {
    std::fprintf(out, "%llu,%s,%d,%s,%s,%g,%d,%d,%d,%.4g,%.4g,%s,%s\n",
                 static_cast<unsigned long long>(options.seed), run.set.c_str(), run.push,
                 run.friction, run.integrator.c_str(), run.parameter,
                 run.completed ? 1 : 0, run.reference_events, run.evaluations, run.error,
                 run.time_us, compiler.c_str(), cpu.c_str());
  }
}

/// The least evaluations and time over an integrator's parameters with which each push
/// comes within `error`; infinity where none does.
struct Least {
  std::vector<double> evaluations, times;
};

/// For every set, friction model and integrator: what 1 um and 1 nm cost.
void write_summary(const std::vector<Run>& runs, std::FILE* out) {
  std::fprintf(out, "%-23s%-10s%-16s%7s%12s%10s%9s%12s%10s%9s\n", "set", "friction",
               "integrator", "pushes", "1um: evals", "p90", "us", "1nm: evals", "p90",
               "us");
  using Key = std::array<std::string, 3>;
  std::map<Key, std::map<int, std::array<std::array<double, 2>, 2>>> table;
  std::vector<Key> order;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  for (const Run& run : runs) {
    const bool counted = run.set.ends_with("events");
    const std::string events = run.reference_events > 0 ? ", events" : ", none";
    const Key key{counted ? run.set : run.set + events, run.friction, run.integrator};
    if (!table.contains(key)) order.push_back(key);
    auto& best = table[key]
                     .try_emplace(run.push,
                                  std::array<std::array<double, 2>, 2>{
                                      {{kNever, kNever}, {kNever, kNever}}})
                     .first->second;
    for (const int i : {0, 1}) {
      if (!run.completed || !(run.error <= (i == 0 ? 1e-6 : 1e-9))) continue;
      if (run.evaluations < best[i][0]) best[i] = {1.0 * run.evaluations, run.time_us};
    }
  }
  for (const Key& key : order) {
    Least um, nm;
    for (const auto& [push, best] : table[key]) {
      um.evaluations.push_back(best[0][0]);
      um.times.push_back(best[0][1]);
      nm.evaluations.push_back(best[1][0]);
      nm.times.push_back(best[1][1]);
    }
    std::fprintf(out, "%-23s%-10s%-16s%7zu%12.0f%10.0f%9.1f%12.0f%10.0f%9.1f\n",
                 key[0].c_str(), key[1].c_str(), key[2].c_str(), um.times.size(),
                 quantile(um.evaluations, 0.5), quantile(um.evaluations, 0.9),
                 quantile(um.times, 0.5), quantile(nm.evaluations, 0.5),
                 quantile(nm.evaluations, 0.9), quantile(nm.times, 0.5));
  }
}

bool write_charts(const std::vector<Run>& runs, const char* file) {
  std::vector<ErrorChart> charts;
  for (const char* friction : {"ellipsoid", "pads"}) {
    for (const Set& set : sets(false)) {
      if (set.events >= 0 && set.events % 5 != 0) continue;
      ErrorChart chart{set.name + ", " + friction, {}};
      std::map<std::string, std::map<double, std::array<std::vector<double>, 2>>> lines;
      for (const Run& run : runs) {
        if (run.set != set.name || run.friction != std::string(friction)) continue;
        auto& at = lines[run.integrator][run.parameter];
        at[0].push_back(run.time_us);
        at[1].push_back(run.completed ? run.error : 1.0);
      }
      for (const auto& [integrator, parameters] : lines) {
        ErrorChart::Line line{integrator, {}};
        for (const auto& [parameter, values] : parameters) {
          line.points.push_back({quantile(values[0], 0.5), quantile(values[1], 0.5)});
        }
        chart.lines.push_back(line);
      }
      charts.push_back(chart);
    }
  }
  return write_error_charts(charts, "time of a push [us]", file);
}

bool read_options(int count, char** arguments, Options& options) {
  return take_options(count, arguments,
                      {{"-o", &options.file},
                       {"--charts", &options.charts},
                       {"--pushes", &options.pushes},
                       {"--seed", &options.seed}},
                      [&options] {
                        options.quick = true;
                        options.pushes = 3;
                        options.batches = 1;
                      });
}

int run(int count, char** arguments) {
  Options options;
  if (!read_options(count, arguments, options)) {
    std::fputs(
        "usage: bench_integrators [--quick] [--pushes N] [--seed S] [-o FILE] "
        "[--charts FILE]\n",
        stderr);
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  std::vector<Run> runs;
  Measurement measurement(options, runs);
  for (const Set& set : sets(options.quick)) {
    for (const FrictionModel friction :
         {FrictionModel::kEllipsoid, FrictionModel::kPads}) {
      const bool counts = set.events >= 0;
      int left = counts ? std::max(1, options.pushes / kPushesPerEventful) : kMostDrawn;
      const int until = counts ? kMostDrawn : options.pushes;
      for (int index = 0; index < until && left > 0; ++index) {
        if (measurement.measure(set, index, friction)) --left;
      }
    }
  }
  write_csv(options, runs, csv.get());
  const bool written = csv.close();
  write_summary(runs, stderr);
  const bool drawn = !options.charts || write_charts(runs, options.charts);
  return written && drawn ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  try {
    return prehensile::benchmarks::run(count, arguments);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "error: %s\n", fault.what());
    return 3;
  }
}
