/// Error against run time of planning: the same regrasps with more and more work, by our
/// planner and others on our steering, each told to improve its plan for as long as it
/// may. One CSV line per run, failures included; a table and, with --plots, charts.
///
/// The error of a plan is its excess cost over the cheapest plan that any run of this
/// program found for the problem; a problem without a plan has none. Timed is the search
/// alone (CPU time of the thread), from the prepared scene to its pushes. A run counts as
/// solved if these pass the exact check and replay. Every run ends by its budget of work,
/// stick tests of ours and propagations of the others, which the axis of time makes
/// comparable.
///
/// Sets: the published pairs in four attitudes of gravity, `wide` Ts with gravity and
/// without.
///
/// Usage: bench_plan_precision [--quick] [--set published|wide] [--planner PREFIX]
///                             [--plans robust|nominal] [--problems N] [--most N]
///                             [--plots FOLDER] [-o FILE]
/// --most: greatest budget.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/baseline_runs.h"
#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "benchmarks/svg_file.h"
#include "planner/catalogue.h"
#include "plot/chart.h"
#include "scene/constants.h"

namespace prehensile::benchmarks {
namespace {

/// Shares of the cheapest plan's cost by which a plan counts as as good.
constexpr double kAsGood = 0.01;
constexpr std::uint64_t kSeed = 1;  // of random problems and planners

/// That improve their plans, and the fastest of those that do not. Blind ones are a
/// matter of bench_baselines.
constexpr std::array kPlanners = {
    "push",         "random-shooting",    "two-trees",          "motion-cone-tree",
    "control::SST", "geometric::RRTstar", "geometric::BITstar", "geometric::AITstar"};

struct Options {
  std::string set = "wide";
  std::string planner;  // empty: all of kPlanners; else a prefix
  std::string plans = "nominal";
  int problems = 10;  // of each kind
  int most = 30'000;
  std::string plots;
  const char* file = nullptr;
};

struct Level {
  std::int64_t budget = 0;
  Run run;
  double excess = kInfinity;  // over the cheapest plan known; infinity: unsolved
};

/// 10, 30, 100, ... up to the greatest.
std::vector<std::int64_t> budgets(int most) {
  std::vector<std::int64_t> all;
  for (std::int64_t decade = 10; decade <= most; decade *= 10) {
    all.push_back(decade);
    if (3 * decade <= most) all.push_back(3 * decade);
  }
  return all;
}

std::vector<std::string> wanted_planners(const Options& options) {
  std::vector<std::string> wanted;
  const std::vector<std::string> built = planner_names();
  for (const std::string planner : kPlanners) {
    const bool is_built = std::ranges::find(built, planner) != built.end();
    if (is_built && planner.starts_with(options.planner)) wanted.push_back(planner);
  }
  return wanted;
}

/// Runs of one problem, and what they miss by.
void run_problem(const Options& options, const Problem& problem,
                 const std::vector<std::string>& planners, std::vector<Level>& levels) {
  const std::size_t first = levels.size();
  double least = kInfinity;
  for (const std::string& planner : planners) {
    for (const std::int64_t budget : budgets(options.most)) {
      PlanOptions wanted;
      wanted.planner = planner;
      wanted.seed = kSeed;
      wanted.budget = budget;
      wanted.improve = true;
      Level level{budget, run_planner(problem, wanted, options.plans == "robust")};
      if (level.run.solved) least = std::min(least, level.run.plan.cost);
      levels.push_back(std::move(level));
    }
  }
  for (std::size_t i = first; i < levels.size(); ++i) {
    if (levels[i].run.solved) levels[i].excess = levels[i].run.plan.cost / least - 1.0;
  }
}

void write_csv(const Options& options, const std::vector<Level>& levels, std::FILE* out) {
  std::fputs(
      "set,plans,kind,problem,planner,budget,solved,search_us,stick_tests,propagations,"
      "pushes,cost,excess,bound,gap,compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const auto& [budget, run, excess] : levels) {
    const Plan& plan = run.plan;
    std::fprintf(
        out, "%s,%s,%s,%s,%s,%lld,%d,%.4g,%lld,%lld,%zu,%.6g,%.4g,%.6g,%.4g,%s,%s\n",
        options.set.c_str(), options.plans.c_str(), run.kind.c_str(),
        field(run.problem).c_str(), run.planner.c_str(), static_cast<long long>(budget),
        run.solved ? 1 : 0, run.us, static_cast<long long>(plan.stick_tests),
        static_cast<long long>(plan.propagations), plan.pushes.size(),
        run.solved ? plan.cost : kNan, excess, run.solved ? plan.lower_bound : kNan,
        run.solved ? plan.gap() : kNan, compiler.c_str(), cpu.c_str());
  }
}

/// What one planner makes of all problems with one budget.
struct Summary {
  int runs = 0, solved = 0, as_good = 0;
  std::vector<double> ms, excess, gap;

  void add(const Level& level) {
    ++runs;
    ms.push_back(1e-3 * level.run.us);
    excess.push_back(level.excess);
    if (level.excess <= kAsGood) ++as_good;
    if (!level.run.solved) return;
    ++solved;
    gap.push_back(level.run.plan.gap());
  }
  double missed() const { return 1.0 - static_cast<double>(as_good) / runs; }
};

using Summaries = std::map<std::string, std::map<std::int64_t, Summary>>;  // by planner

Summaries summaries_of(const std::vector<Level>& levels) {
  Summaries all;
  for (const Level& level : levels) all[level.run.planner][level.budget].add(level);
  return all;
}

void write_table(const Summaries& summaries, std::FILE* out) {
  std::fprintf(out, "%-20s%9s%7s%8s%13s%12s%12s%14s%12s\n", "planner", "budget", "runs",
               "solved", "within 1 %", "median ms", "p90 ms", "excess median", "gap med");
  for (const auto& [planner, by_budget] : summaries) {
    for (const auto& [budget, one] : by_budget) {
      std::fprintf(out, "%-20s%9lld%7d%8d%13d%12.3g%12.3g%12.2f %%%10.1f %%\n",
                   planner.c_str(), static_cast<long long>(budget), one.runs, one.solved,
                   one.as_good, quantile(one.ms, 0.5), quantile(one.ms, 0.9),
                   100.0 * quantile(one.excess, 0.5), 100.0 * quantile(one.gap, 0.5));
    }
  }
}

/// A line per planner over its mean time; `error` of a summary.
template <class Error>
plot::Chart chart_of(const Summaries& summaries, const std::string& title,
                     const std::string& label, const Error& error) {
  plot::Chart chart;
  chart.title = title;
  chart.x = {.label = "mean search time [ms]", .scale = plot::Scale::kLog};
  chart.y = {.label = label, .from_zero = true};
  for (const auto& [planner, by_budget] : summaries) {
    plot::Line line{.label = planner, .marks = true};
    if (planner == PlanOptions{}.planner) line.colour = plot::Colour::kBlack;
    for (const auto& [budget, one] : by_budget) {
      double sum = 0.0;
      for (const double ms : one.ms) sum += ms;
      line.points.push_back({sum / one.runs, error(one)});
    }
    chart.series.emplace_back(std::move(line));
  }
  return chart;
}

bool write_plots(const Options& options, const Summaries& summaries) {
  const std::string title = options.set + ", " + options.plans + " plans";
  const plot::Chart missed =
      chart_of(summaries, title + ": not within 1 % of the cheapest plan",
               "share of problems", [](const Summary& one) { return one.missed(); });
  const plot::Chart open = chart_of(
      summaries, title + ": without a plan", "share of problems", [](const Summary& one) {
        return 1.0 - static_cast<double>(one.solved) / one.runs;
      });
  return write_svg(
      std::filesystem::path(options.plots) / ("plan_precision_" + options.set + ".svg"),
      plot::svg_of_sheet({missed, open}, 2));
}

bool read_options(int count, char** arguments, Options& options) {
  return take_options(count, arguments,
                      {{"-o", &options.file},
                       {"--set", &options.set},
                       {"--planner", &options.planner},
                       {"--plans", &options.plans},
                       {"--problems", &options.problems, 1},
                       {"--most", &options.most, 10},
                       {"--plots", &options.plots}},
                      [&options] {
                        options.problems = 1;
                        options.most = 100;
                      }) &&
         (options.set == "published" || options.set == "wide") &&
         (options.plans == "robust" || options.plans == "nominal") &&
         (options.plots.empty() || std::filesystem::is_directory(options.plots));
}

int run(int count, char** arguments) {
  Options options;
  const bool readable = read_options(count, arguments, options);
  const std::vector<std::string> planners = wanted_planners(options);
  if (!readable || planners.empty()) {
    std::fputs(
        "usage: bench_plan_precision [--quick] [--set published|wide] [--planner "
        "PREFIX]\n"
        "                            [--plans robust|nominal] [--problems N] [--most N]\n"
        "                            [--plots FOLDER] [-o FILE]\n",
        stderr);
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  std::vector<Level> levels;
  for (const Problem& problem : options.set == "wide"
                                    ? wide_problems(options.problems, kSeed)
                                    : published_problems(options.problems)) {
    run_problem(options, problem, planners, levels);
  }
  write_csv(options, levels, csv.get());
  bool written = csv.close();
  const Summaries summaries = summaries_of(levels);
  write_table(summaries, stderr);
  if (!options.plots.empty()) written = write_plots(options, summaries) && written;
  if (std::ranges::none_of(levels, [](const Level& level) { return level.run.solved; })) {
    std::fputs("no planner solved any of the problems: no error can be told\n", stderr);
    return 1;
  }
  return written ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
