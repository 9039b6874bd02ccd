/// What a simpler model of the pads costs: plans made with one model, done by another.
/// One CSV line per run, failures included.
///
/// Each pair names what the planner assumes and what the pads are: soft points (the
/// ellipsoid) or discs of the same torque radius for discs and for pads of other shapes,
/// whole pads for pads that the face clips, evenly loaded discs for Hertzian ones. The
/// plan is done push by push by the exact mechanics of what the pads are, stood for by as
/// many points as there can be (plans are made with the usual number). *Planned*: a
/// plan was found with what is assumed; *sticks*: it is done to its end without slip;
/// *reaches*: and ends at the goal. Beside it stands the plan made with the true model.
/// Times are CPU times of the thread, of all of planning.
///
/// Usage: bench_plan_models [--quick] [--set published|wide] [--problems N] [-o FILE]
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "planner/checks/share_interval.h"
#include "planner/planner.h"
#include "primitives/uncertainty.h"
#include "problems/pad_shapes.h"
#include "problems/published_regrasps.h"

namespace prehensile::benchmarks {
namespace {

constexpr double kSlip = 1e-5;  // [m] that counts
constexpr std::uint64_t kSeed = 1;

/// Of the pads that do the plans: so many points that the friction of discs hardly
/// depends on their angle.
constexpr PrepareOptions kFinest{.points_per_pad = 64};

struct Options {
  std::string set = "wide";
  int problems = 10;  // of each kind
  const char* file = nullptr;
};

/// What the planner assumes, and what the pads are.
struct Pair {
  std::string assumed, real;
};

struct Run {
  std::string assumed, real, plans, problem;
  bool planned = false, planned_by_real = false;
  bool sticks = false, reaches = false;
  double slipped = kNan;  // [m]
  double cost = kNan, cost_by_real = kNan;
  double ms = kNan, ms_by_real = kNan;
};

Scene hertzian(Scene scene) {
  scene.gripper.pressure.profile = PressureProfile::kHertz;
  return scene;
}

Scene clipped(Scene scene) {
  scene.overhang = Overhang::kClip;
  return scene;
}

/// The problem with each model of the pads; `disc`: with whole, evenly loaded discs.
std::map<std::string, Scene> models_of(const Scene& disc) {
  std::map<std::string, Scene> models = {{"disc", disc},
                                         {"soft point", with_soft_points(disc)},
                                         {"Hertzian disc", hertzian(disc)},
                                         {"clipped disc", clipped(disc)}};
  for (const std::string_view name : kPadShapes) {
    models.emplace(name, with_pads(disc, *pad_of_shape(name)));
  }
  return models;
}

std::vector<Pair> all_pairs() {
  std::vector<Pair> pairs = {{"disc", "disc"},
                             {"soft point", "disc"},
                             {"disc", "Hertzian disc"},
                             {"disc", "clipped disc"}};
  for (const std::string_view name : kPadShapes) {
    for (const char* assumed : {"disc", "soft point"}) {
      pairs.push_back({assumed, std::string(name)});
    }
  }
  return pairs;
}

struct Timed {
  Plan plan;
  double ms = kNan;
};

Timed planned(const Model& model, bool robust) {
  PlanOptions options;
  options.margin = robust ? usual_margin(model) : Margin::none();
  options.nominal_if_needed = false;
  Timed timed;
  const double start = thread_time_us();
  timed.plan = plan_regrasp(model, options);
  timed.ms = 1e-3 * (thread_time_us() - start);
  return timed;
}

/// Does the pushes one after the other with the exact mechanics of the model.
void execute(const Model& model, const Plan& plan, Run& run) {
  Grasp grasp = plan.start;
  run.slipped = 0.0;
  for (const PlannedPush& push : plan.pushes) {
    const Transition done = apply(model, grasp, push.push);
    run.slipped += done.slipped;
    if (!done.completed()) return;
    grasp = done.end;
  }
  run.sticks = run.slipped <= kSlip;
  run.reaches = run.sticks && reaches(*model.scene.goal, grasp);
}

Run run_of(const Pair& pair, const Model& real, const Timed& plan, const Timed& by_real) {
  Run run{.assumed = pair.assumed, .real = pair.real, .problem = real.scene.name};
  run.ms = plan.ms;
  run.ms_by_real = by_real.ms;
  run.planned_by_real = by_real.plan.usable();
  if (run.planned_by_real) run.cost_by_real = by_real.plan.cost;
  run.planned = plan.plan.usable();
  if (!run.planned) return run;
  run.cost = plan.plan.cost;
  execute(real, plan.plan, run);
  return run;
}

/// All pairs; with each model the problem is planned once.
void run_problem(const Scene& scene, bool robust, std::vector<Run>& runs) {
  std::map<std::string, Model> models;
  std::map<std::string, Timed> plans;
  for (const auto& [name, with_model] : models_of(scene)) {
    plans.emplace(name, planned(prepare(with_model), robust));
    models.emplace(name, prepare(with_model, kFinest));
  }
  for (const Pair& pair : all_pairs()) {
    runs.push_back(
        run_of(pair, models.at(pair.real), plans.at(pair.assumed), plans.at(pair.real)));
    runs.back().plans = robust ? "robust" : "nominal";
  }
}

/// Without and with gravity, squares and Ts.
std::vector<Scene> scenes_of(const Options& options) {
  std::vector<Scene> scenes;
  for (int i = 0; i < options.problems; ++i) {
    const auto index = static_cast<std::uint64_t>(i);
    for (const bool square : {true, false}) {
      for (const bool gravity : {true, false}) {
        const RegraspRange range =
            options.set == "wide" ? RegraspRange::kWide : RegraspRange::kPublished;
        scenes.push_back(random_among_walls(square, range, gravity, kSeed, index));
      }
    }
  }
  return scenes;
}

void write_csv(const Options& options, const std::vector<Run>& runs, std::FILE* out) {
  std::fputs(
      "set,plans,assumed,real,problem,planned,sticks,reaches,slipped_mm,cost,time_ms,"
      "planned_by_real,cost_by_real,time_by_real_ms,compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const Run& run : runs) {
    std::fprintf(out, "%s,%s,%s,%s,%s,%d,%d,%d,%.4g,%.6g,%.4g,%d,%.6g,%.4g,%s,%s\n",
                 options.set.c_str(), run.plans.c_str(), run.assumed.c_str(),
                 run.real.c_str(), field(run.problem).c_str(), run.planned ? 1 : 0,
                 run.sticks ? 1 : 0, run.reaches ? 1 : 0, 1e3 * run.slipped, run.cost,
                 run.ms, run.planned_by_real ? 1 : 0, run.cost_by_real, run.ms_by_real,
                 compiler.c_str(), cpu.c_str());
  }
}

/// One line per pair; ratios over the problems that both models plan for.
void write_table(const std::vector<Run>& runs, std::FILE* out) {
  std::fprintf(out, "%-9s%-12s%-15s%6s%9s%8s%9s%16s%9s%8s%12s%12s\n", "plans", "assumed",
               "real", "runs", "planned", "sticks", "reaches", "95 %", "by real", "cost",
               "median ms", "by real");
  std::map<std::string, std::vector<const Run*>> groups;
  std::vector<std::string> order;
  for (const Run& run : runs) {
    const std::string key = run.plans + run.assumed + "/" + run.real;
    if (groups[key].empty()) order.push_back(key);
    groups[key].push_back(&run);
  }
  for (const std::string& key : order) {
    const std::vector<const Run*>& group = groups[key];
    int planned = 0, sticks = 0, reached = 0, by_real = 0;
    std::vector<double> ratio, ms, real_ms;
    for (const Run* run : group) {
      planned += run->planned ? 1 : 0;
      sticks += run->sticks ? 1 : 0;
      reached += run->reaches ? 1 : 0;
      by_real += run->planned_by_real ? 1 : 0;
      ratio.push_back(run->cost / run->cost_by_real);
      ms.push_back(run->ms);
      real_ms.push_back(run->ms_by_real);
    }
    const ShareInterval interval = wilson(reached, std::max(planned, 1));
    std::fprintf(out, "%-9s%-12s%-15s%6zu%9d%8d%9d%8.1f-%5.1f %%%9d%8.3f%12.3g%12.3g\n",
                 group.front()->plans.c_str(), group.front()->assumed.c_str(),
                 group.front()->real.c_str(), group.size(), planned, sticks, reached,
                 100.0 * interval.low, 100.0 * interval.high, by_real,
                 quantile(ratio, 0.5), quantile(ms, 0.5), quantile(real_ms, 0.5));
  }
}

int run(int count, char** arguments) {
  Options options;
  const bool readable = take_options(count, arguments,
                                     {{"-o", &options.file},
                                      {"--set", &options.set},
                                      {"--problems", &options.problems, 1}},
                                     [&options] {
                                       options.set = "published";
                                       options.problems = 1;
                                     });
  if (!readable || (options.set != "published" && options.set != "wide")) {
    std::fputs(
        "usage: bench_plan_models [--quick] [--set published|wide] [--problems N]\n"
        "                         [-o FILE]\n",
        stderr);
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  std::vector<Run> runs;
  for (const Scene& scene : scenes_of(options)) {
    for (const bool robust : {false, true}) run_problem(scene, robust, runs);
  }
  write_csv(options, runs, csv.get());
  const bool written = csv.close();
  write_table(runs, stderr);
  return written ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
