/// Success, time and cost of the planners that steer, one CSV line per run, failures
/// included.
///
/// Sets: `published`, 50 regrasps each of a square and a T; `ranges`, random ones from
/// the same ranges, and `wide`, any start and goal at any angle, with and without
/// gravity; `constructed`, 100 each of boxes, Ts and cans, feasible by construction;
/// `random`, random scenes of boxes, Ts and polygons with 1 to 6 line pushers or 2 to 4
/// points, whose goals random pushes made, and `random_goals`, with goals anywhere; how
/// many could not be drawn is said. Our
/// own planner runs with its default budget, once per problem: it draws no random
/// numbers. The others run with a time limit, once per seed. `search_s` is the search
/// alone, timed in the same way for all planners (measure.h), `total_s` all of
/// plan_regrasp: proofs, search, polish, exact check, bound. A run counts as solved if
/// its plan replays.
/// `--help` shows the options.
#include <cstdio>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "planner/baselines/baselines.h"
#include "planner/bounds/bounds.h"
#include "planner/checks/replay.h"
#include "planner/checks/share_interval.h"
#include "planner/search/frame.h"
#include "planner/search/push_search.h"
#include "primitives/uncertainty.h"
#include "problems/pad_shapes.h"
#include "problems/published_regrasps.h"
#include "problems/random_fixtures.h"
#include "problems/random_regrasps.h"

namespace prehensile::benchmarks {
namespace {

struct Options {
  std::string set = "published";
  std::string planner;  // empty: all that steer
  int problems = 0;     // of each kind; 0: all
  int seeds = 3;
  int time_ms = 1000;
  std::string plans = "robust";  // or nominal: without a margin; or weightless: that
                                 // and without gravity as well
  std::string theta = "angle";   // or number: the nearest winding is the only goal
  std::string pads = "disc";     // or soft: points; or a name of pad_of_shape; all of
                                 // the torque radius of the discs
  int tolerance_um = 0;          // of goals; 0: that of the set
  const char* file = nullptr;
};

struct Problem {
  std::string kind;
  Scene scene;
};

struct Run {
  std::string kind, problem, planner;
  std::uint64_t seed;
  Plan plan;
  bool replays = false;
  double search_seconds = kNan;
  double bound_seconds = kNan;
};

constexpr int kConstructed = 100;
constexpr int kRandom = 100;
constexpr std::uint64_t kSeed = 1;

std::vector<Problem> published_problems(int count) {
  std::vector<Problem> problems;
  for (int i = 0; i < count; ++i) {
    problems.push_back({"square", published_square(i)});
    problems.push_back({"T", published_tee(i)});
  }
  return problems;
}

std::vector<Problem> random_problems(RegraspRange range, int count) {
  std::vector<Problem> problems;
  for (const bool square : {true, false}) {
    for (const bool gravity : {true, false}) {
      const std::string kind =
          std::string(square ? "square" : "T") + (gravity ? ", gravity" : ", none");
      for (int i = 0; i < count; ++i) {
        problems.push_back({kind, random_among_walls(square, range, gravity, kSeed, i)});
      }
    }
  }
  return problems;
}

std::vector<Problem> constructed_problems(int count) {
  std::vector<Problem> problems;
  for (int i = 0; i < count; ++i) {
    for (const auto& [family, kind] :
         {std::pair(RegraspFamily::kBox, "box"), std::pair(RegraspFamily::kTee, "T"),
          std::pair(RegraspFamily::kCylinder, "can")}) {
      problems.push_back({kind, random_regrasp(family, kSeed, i).scene});
      problems.back().scene.name = std::string(kind) + " " + std::to_string(i + 1);
    }
  }
  return problems;
}

/// Of each kind as many; goals are where the caller says.
std::vector<Problem> random_scenes(GoalsFrom goals, int count) {
  struct Kind {
    const char* name;
    FixtureObject object;
    FixturePushers pushers;
    Range pusher_count;
  };
  const auto lines = FixturePushers::kLines;
  const auto points = FixturePushers::kPoints;
  std::vector<Problem> problems;
  for (const Kind& kind :
       {Kind{"box", FixtureObject::kBox, lines, {2.0, 4.0}},
        Kind{"T", FixtureObject::kTee, lines, {2.0, 4.0}},
        Kind{"convex", FixtureObject::kConvex, lines, {1.0, 6.0}},
        Kind{"concave", FixtureObject::kConcave, lines, {1.0, 6.0}},
        Kind{"box, points", FixtureObject::kBox, points, {2.0, 4.0}},
        Kind{"concave, points", FixtureObject::kConcave, points, {2.0, 4.0}}}) {
    const FixtureRange range{.object = kind.object,
                             .pushers = kind.pushers,
                             .count = kind.pusher_count,
                             .goals = goals};
    int missing = 0;
    for (int i = 0; i < count; ++i) {
      const auto drawn = random_fixture(range, kSeed, static_cast<std::uint64_t>(i));
      if (!drawn) {
        ++missing;
        continue;
      }
      problems.push_back({kind.name, drawn->scene});
      problems.back().scene.name = std::string(kind.name) + " " + std::to_string(i + 1);
    }
    if (missing > 0) {
      std::fprintf(stderr, "%s: %d of %d problems could not be drawn\n", kind.name,
                   missing, count);
    }
  }
  return problems;
}

bool is_set(const std::string& set) {
  return set == "published" || set == "ranges" || set == "wide" || set == "constructed" ||
         set == "random" || set == "random_goals";
}

/// The angle of the goal as a number, no farther from the start than half a turn.
void keep_nearest_winding(Scene& scene) {
  Goal& goal = *scene.goal;
  goal.theta = scene.start.X_HO.theta + wrapped(*goal.theta - scene.start.X_HO.theta);
  goal.theta_is = ThetaMeaning::kNumber;
}

std::vector<Problem> problems_of_set(const Options& options) {
  const auto count = [&](int all) {
    return options.problems > 0 ? options.problems : all;
  };
  if (options.set == "published") {
    return published_problems(std::min(count(kPublishedRegrasps), kPublishedRegrasps));
  }
  if (options.set == "constructed") return constructed_problems(count(kConstructed));
  if (options.set == "random") return random_scenes(GoalsFrom::kPushes, count(kRandom));
  if (options.set == "random_goals") {
    return random_scenes(GoalsFrom::kRandom, count(kRandom));
  }
  const bool wide = options.set == "wide";
  return random_problems(wide ? RegraspRange::kWide : RegraspRange::kPublished,
                         count(kRandom));
}

std::vector<Problem> problems_of(const Options& options) {
  std::vector<Problem> problems = problems_of_set(options);
  if (options.theta == "number") {
    for (Problem& problem : problems) keep_nearest_winding(problem.scene);
  }
  if (options.pads == "soft") {
    for (Problem& problem : problems) problem.scene = with_soft_points(problem.scene);
  }
  if (const std::optional<Pad> shape = pad_of_shape(options.pads)) {
    for (Problem& problem : problems) problem.scene = with_pads(problem.scene, *shape);
  }
  if (options.tolerance_um > 0) {
    for (Problem& problem : problems) {
      problem.scene.goal->position_tolerance = 1e-6 * options.tolerance_um;
    }
  }
  return problems;
}

bool is_own(const std::string& planner) { return planner == PlanOptions{}.planner; }

void search_only(const SearchModel& search, const PlanOptions& options) {
  const Scene& scene = search.model->scene;
  Work work{.budget = options.budget};
  if (is_own(options.planner)) {
    search_pushes(search, scene.start, *scene.goal, options, work);
  } else if (!find_planner(options.planner)->needs_ompl()) {
    search_by_baseline(search, scene.start, *scene.goal, options, work);
  } else {
    solve_in_frame(search, scene.start, *scene.goal, options, work);
  }
}

Run run_planner(const Problem& problem, const std::string& planner, std::uint64_t seed,
                const Options& options) {
  const Scene& scene = problem.scene;
  const Model model = prepare(scene);
  PlanOptions wanted;
  wanted.planner = planner;
  wanted.seed = seed;
  if (!is_own(planner)) wanted.time_limit = 1e-3 * options.time_ms;
  Run run{.kind = problem.kind, .problem = scene.name, .planner = planner, .seed = seed};
  wanted.margin = options.plans == "robust" ? usual_margin(model) : Margin::none();
  wanted.margin->weightless = options.plans == "weightless";
  wanted.nominal_if_needed = options.plans != "weightless";
  const SearchModel search = prepare_search(model, *wanted.margin);
  run.search_seconds = 1e-6 * search_time_us([&] { search_only(search, wanted); });
  run.plan = plan_regrasp(model, wanted);
  run.replays = run.plan.usable() && replay(model, run.plan).agrees;
  if (run.plan.usable()) {
    run.bound_seconds =
        1e-6 * time_us(
                   [&] {
                     lower_bound(model, scene.start, *scene.goal, run.plan.cost,
                                 {.margin = run.plan.margin});
                   },
                   1);
  }
  return run;
}

void write_csv(const Options& options, const std::vector<Run>& runs, std::FILE* out) {
  std::fputs(
      "set,kind,problem,planner,seed,status,certified,replays,search_s,total_s,stick_"
      "tests,"
      "propagations,pushes,placements,travel,cost,bound,gap,bound_is_trivial,bound_nodes,"
      "bound_s,published_cost,time_limit_s,compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const Run& run : runs) {
    const Plan& plan = run.plan;
    std::fprintf(out,
                 "%s,%s,%s,%s,%llu,%s,%d,%d,%.4g,%.4g,%lld,%lld,%zu,%.0f,%.6g,%.6g,%.6g,"
                 "%.4g,%d,%lld,%.4g,%.3g,%.4g,%s,%s\n",
                 options.set.c_str(), field(run.kind).c_str(), field(run.problem).c_str(),
                 run.planner.c_str(), static_cast<unsigned long long>(run.seed),
                 name(plan.status).data(), plan.usable() ? 1 : 0, run.replays ? 1 : 0,
                 run.search_seconds, plan.seconds,
                 static_cast<long long>(plan.stick_tests),
                 static_cast<long long>(plan.propagations), plan.pushes.size(),
                 plan.placements, plan.travel, plan.cost, plan.lower_bound, plan.gap(),
                 plan.bound_is_trivial ? 1 : 0, static_cast<long long>(plan.bound_nodes),
                 run.bound_seconds, plan.published_cost,
                 is_own(run.planner) ? 0.0 : 1e-3 * options.time_ms, compiler.c_str(),
                 cpu.c_str());
  }
}

/// One line per kind of problem and planner; costs and gaps over its solved runs.
void write_summary(const std::set<std::pair<std::string, std::string>>& groups,
                   const std::vector<Run>& runs, std::FILE* out) {
  std::fprintf(out, "%-16s%-28s%6s%8s%16s%12s%10s%10s%11s%8s%8s%8s%10s%10s%14s%11s\n",
               "kind", "planner", "runs", "solved", "95 %", "search med", "p99 ms",
               "worst ms", "total med", "S med", "J med", "gap med", "gap<=10%",
               "trivial", "bound p99 ms", "published");
  for (const auto& [kind, planner] : groups) {
    std::vector<double> search, total, placements, cost, gap, published, bound;
    int count = 0, near_bound = 0, trivial = 0;
    for (const Run& run : runs) {
      if (run.planner != planner || run.kind != kind) continue;
      ++count;
      search.push_back(1e3 * run.search_seconds);
      total.push_back(1e3 * run.plan.seconds);
      if (!run.replays) continue;
      placements.push_back(run.plan.placements);
      cost.push_back(run.plan.cost);
      gap.push_back(run.plan.gap());
      if (gap.back() <= 0.1) ++near_bound;
      if (run.plan.bound_is_trivial) ++trivial;
      bound.push_back(1e3 * run.bound_seconds);
      published.push_back(run.plan.published_cost);
    }
    if (count == 0) continue;
    const int solved = static_cast<int>(cost.size());
    const ShareInterval interval = wilson(solved, count);
    std::fprintf(out,
                 "%-16s%-28s%6d%8d%8.1f-%5.1f %%%9.4f ms%10.3f%10.3f%8.2f ms%8.0f%8.3f"
                 "%7.1f %%%8.1f %%%8.1f %%%14.2f%11.2f\n",
                 kind.c_str(), planner.c_str(), count, solved, 100.0 * interval.low,
                 100.0 * interval.high, quantile(search, 0.5), quantile(search, 0.99),
                 quantile(search, 1.0), quantile(total, 0.5), quantile(placements, 0.5),
                 quantile(cost, 0.5), 100.0 * quantile(gap, 0.5),
                 100.0 * near_bound / count, 100.0 * trivial / count,
                 quantile(bound, 0.99), quantile(published, 0.5));
  }
}

bool read_options(int count, char** arguments, Options& options) {
  return take_options(count, arguments,
                      {{"-o", &options.file},
                       {"--set", &options.set},
                       {"--planner", &options.planner},
                       {"--plans", &options.plans},
                       {"--theta", &options.theta},
                       {"--pads", &options.pads},
                       {"--tolerance-um", &options.tolerance_um},
                       {"--problems", &options.problems},
                       {"--seeds", &options.seeds},
                       {"--time-ms", &options.time_ms}},
                      [&options] {
                        options.problems = 3;
                        options.seeds = 1;
                        options.time_ms = 50;
                      }) &&
         is_set(options.set) &&
         (options.plans == "robust" || options.plans == "nominal" ||
          options.plans == "weightless") &&
         (options.pads == "disc" || options.pads == "soft" ||
          pad_of_shape(options.pads)) &&
         (options.theta == "angle" || options.theta == "number");
}

std::vector<std::string> wanted_planners(const Options& options) {
  std::vector<std::string> planners = planner_names();
  std::erase_if(planners, [&](const std::string& planner) {
    // Blind controls are a matter of bench_baselines.
    return options.planner.empty() ? planner.starts_with("blind::")
                                   : planner != options.planner;
  });
  return planners;
}

int run(int count, char** arguments) {
  Options options;
  const bool readable = read_options(count, arguments, options);
  const std::vector<std::string> planners = wanted_planners(options);
  if (!readable || planners.empty()) {
    std::fputs(
        "usage: bench_planner [--quick] [--set published|ranges|wide|constructed|random|"
        "random_goals]\n"
        "                     [--planner NAME] [--plans robust|nominal|weightless]\n"
        "                     [--theta angle|number]\n"
        "                     [--pads disc|soft|1:1|1:2|1:4|line|half_disc]\n"
        "                     [--tolerance-um N] [--problems N] [--seeds N] [--time-ms "
        "N] [-o FILE]\n",
        stderr);
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  std::vector<Run> runs;
  std::set<std::pair<std::string, std::string>> groups;
  for (const Problem& problem : problems_of(options)) {
    for (const std::string& planner : planners) {
      groups.emplace(problem.kind, planner);
      const int seeds = is_own(planner) ? 1 : options.seeds;
      for (int seed = 1; seed <= seeds; ++seed) {
        runs.push_back(
            run_planner(problem, planner, static_cast<std::uint64_t>(seed), options));
      }
    }
  }
  write_csv(options, runs, csv.get());
  const bool written = csv.close();
  write_summary(groups, runs, stderr);
  return written ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
