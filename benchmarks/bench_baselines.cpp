/// Our planner beside OMPL's and other baselines on the same problems: success, thread
/// CPU time, cost, and the ratios of both within the run. One CSV line per run, failures
/// included.
///
/// Sets: `published`, the 50 pairs of start and goal with the square and the T in four
/// attitudes of gravity (`gravity` 0: none, 1: along -y of O for all walls, 2: along each
/// face, 3: onto each wall); `wide`, any start and goal at any angle of the T, with
/// gravity and without.
///
/// What is timed is the search alone, from the prepared scene to its pushes, without
/// polish and final check, of all planners alike. A run counts as solved if its pushes as
/// they are pass the exact check over the margin, end at the goal, and replay. Every
/// planner ends by work (--budget, propagations), never by the clock; those that improve
/// their plans do so with ten times the work of their first.
///
/// With --tune each baseline is run with --draws random sets of its options and with its
/// defaults on other problems than the sets above, and the best set is printed: most
/// solved, then least mean of log J, then least work.
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/baseline_runs.h"
#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "planner/catalogue.h"
#include "problems/random_stream.h"

namespace prehensile::benchmarks {
namespace {

constexpr std::uint64_t kTuningSeed = 77;  // of problems that no table uses
constexpr std::uint64_t kTableSeed = 1;
constexpr int kTuningProblems = 20;
constexpr int kPairs = 50;  // published

struct Options {
  std::string set = "published";
  std::string planner;  // empty: all; else a prefix of names
  std::string plans = "robust";
  int problems = 0;  // of each kind; 0: 50
  int seeds = 1;
  int budget = 200'000;
  int tune = 0;
  int draws = 20;
  const char* file = nullptr;
};

PlanOptions plan_options(const Options& options, const std::string& planner,
                         std::uint64_t seed, const PlannerSettings& settings) {
  PlanOptions wanted;
  wanted.planner = planner;
  wanted.seed = seed;
  wanted.settings = settings;
  wanted.budget = options.budget;
  return wanted;
}

std::vector<std::string> wanted_planners(const Options& options, bool with_own) {
  std::vector<std::string> planners;
  for (const std::string& name : planner_names()) {
    const bool is_own = find_planner(name)->family == PlannerFamily::kOwn;
    if (is_own ? with_own : name.starts_with(options.planner)) planners.push_back(name);
  }
  return planners;
}

void write_csv(const Options& options, const std::vector<Run>& runs, std::FILE* out) {
  std::fputs(
      "set,kind,problem,planner,seed,status,solved,search_us,stick_tests,propagations,"
      "pushes,placements,travel,cost,bound,budget,plans,compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const Run& run : runs) {
    const Plan& plan = run.plan;
    std::fprintf(out,
                 "%s,%s,%s,%s,%llu,%s,%d,%.4g,%lld,%lld,%zu,%.0f,%.6g,%.6g,%.6g,%d,%s,%s,"
                 "%s\n",
                 options.set.c_str(), field(run.kind).c_str(), field(run.problem).c_str(),
                 run.planner.c_str(), static_cast<unsigned long long>(run.seed),
                 name(plan.status).data(), run.solved ? 1 : 0, run.us,
                 static_cast<long long>(plan.stick_tests),
                 static_cast<long long>(plan.propagations), plan.pushes.size(),
                 plan.placements, plan.travel, plan.cost, plan.lower_bound,
                 options.budget, options.plans.c_str(), compiler.c_str(), cpu.c_str());
  }
}

/// One line per planner over all problems. Ratios are to our own run on the same problem:
/// of times over all problems, where a run that failed has spent its time too; of costs
/// where both solved it.
void write_table(const std::vector<std::string>& planners, const std::vector<Run>& runs,
                 std::FILE* out) {
  std::map<std::pair<std::string, std::string>, const Run*> own;
  for (const Run& run : runs) {
    if (find_planner(run.planner)->family == PlannerFamily::kOwn) {
      own[{run.kind, run.problem}] = &run;
    }
  }
  std::fprintf(out, "%-28s%6s%8s%12s%12s%10s%10s%8s%8s%10s\n", "planner", "runs",
               "solved", "median ms", "p90 ms", "time :", "90 %", "S med", "J med",
               "J : ours");
  for (const std::string& planner : planners) {
    std::vector<double> ms, time_ratio, placements, cost, cost_ratio;
    int solved = 0;
    for (const Run& run : runs) {
      if (run.planner != planner) continue;
      const Run& ours = *own.at({run.kind, run.problem});
      ms.push_back(1e-3 * run.us);
      time_ratio.push_back(run.us / ours.us);
      if (!run.solved) continue;
      ++solved;
      placements.push_back(run.plan.placements);
      cost.push_back(run.plan.cost);
      if (ours.solved) cost_ratio.push_back(run.plan.cost / ours.plan.cost);
    }
    std::fprintf(out, "%-28s%6zu%8d%12.4g%12.4g%10.3g%10.3g%8.0f%8.3f%10.2f\n",
                 planner.c_str(), ms.size(), solved, quantile(ms, 0.5), quantile(ms, 0.9),
                 quantile(time_ratio, 0.5), quantile(time_ratio, 0.9),
                 quantile(placements, 0.5), quantile(cost, 0.5),
                 quantile(cost_ratio, 0.5));
  }
}

void write_solved_by_kind(const std::vector<std::string>& planners,
                          const std::vector<Run>& runs, std::FILE* out) {
  std::vector<std::string> kinds;
  std::map<std::pair<std::string, std::string>, std::pair<int, int>> counts;
  for (const Run& run : runs) {
    if (std::find(kinds.begin(), kinds.end(), run.kind) == kinds.end()) {
      kinds.push_back(run.kind);
    }
    auto& [solved, all] = counts[{run.planner, run.kind}];
    ++all;
    if (run.solved) ++solved;
  }
  std::fprintf(out, "\n%-28s", "solved");
  for (const std::string& kind : kinds) std::fprintf(out, "%13s", kind.c_str());
  std::fputc('\n', out);
  for (const std::string& planner : planners) {
    std::fprintf(out, "%-28s", planner.c_str());
    for (const std::string& kind : kinds) {
      const auto& [solved, all] = counts[{planner, kind}];
      std::fprintf(out, "%7d of %2d", solved, all);
    }
    std::fputc('\n', out);
  }
}

/// Any value of the range; positive ones by their logarithm if it spans more than 20.
double drawn_value(const PlannerOption& option, RandomStream& random) {
  if (option.whole && option.least == 0.0) return random.below(2);
  const double low = std::max(option.least, option.value / 10.0);
  const double high = std::min(option.most, option.value * 10.0);
  if (option.least == 0.0 && option.most == 1.0) return random.in(0.0, 1.0);
  const double value = random.log_in(low, high);
  return option.whole ? std::clamp(std::round(value), option.least, option.most) : value;
}

struct Score {
  int solved = 0;
  double log_cost = 0.0;  // mean over solved
  double propagations = 0.0;
  bool beats(const Score& other) const {
    if (solved != other.solved) return solved > other.solved;
    constexpr double kSame = 0.02;
    if (std::abs(log_cost - other.log_cost) > kSame) return log_cost < other.log_cost;
    return propagations < other.propagations;
  }
};

Score score_of(const std::vector<Run>& runs) {
  Score score;
  for (const Run& run : runs) {
    score.propagations += static_cast<double>(run.plan.propagations);
    if (!run.solved) continue;
    ++score.solved;
    score.log_cost += std::log(run.plan.cost);
  }
  score.log_cost = score.solved > 0 ? score.log_cost / score.solved : kNan;
  return score;
}

void print_score(const char* what, const Score& score, std::FILE* out) {
  std::fprintf(out, "  %-8s %2d of %d, J %.2f, %9.0f propagations", what, score.solved,
               kTuningProblems, std::exp(score.log_cost), score.propagations);
}

void tune(const std::string& planner, const Options& options, std::vector<Run>& all,
          std::FILE* out) {
  const PlannerKind& kind = *find_planner(planner);
  const std::vector<Problem> problems = tuning_problems(kTuningProblems, kTuningSeed);
  RandomStream random(kTuningSeed);
  PlannerSettings best;
  Score best_score;
  std::fprintf(out, "%s\n", planner.c_str());
  for (int draw = 0; draw <= options.draws; ++draw) {
    PlannerSettings settings;  // the first: defaults
    for (const PlannerOption& option : kind.options) {
      if (draw > 0) settings[option.name] = drawn_value(option, random);
    }
    std::vector<Run> runs;
    runs.reserve(problems.size());
    for (const Problem& problem : problems) {
      runs.push_back(run_planner(problem, plan_options(options, planner, 1, settings),
                                 options.plans == "robust"));
    }
    const Score score = score_of(runs);
    if (draw == 0) print_score("defaults", score, out);
    if (draw == 0 || score.beats(best_score)) {
      best = settings;
      best_score = score;
    }
    all.insert(all.end(), runs.begin(), runs.end());
  }
  std::fputc('\n', out);
  print_score("best", best_score, out);
  for (const auto& [name, value] : best)
    std::fprintf(out, "  %s=%.4g", name.c_str(), value);
  std::fputs(best.empty() ? "  (the defaults)\n" : "\n", out);
  std::fflush(out);
}

bool read_options(int count, char** arguments, Options& options) {
  return take_options(count, arguments,
                      {{"-o", &options.file},
                       {"--set", &options.set},
                       {"--planner", &options.planner},
                       {"--plans", &options.plans},
                       {"--problems", &options.problems},
                       {"--seeds", &options.seeds, 1},
                       {"--budget", &options.budget, 1},
                       {"--tune", &options.tune},
                       {"--draws", &options.draws}},
                      [&options] {
                        options.problems = 1;
                        options.budget = 300;
                      }) &&
         (options.set == "published" || options.set == "wide") &&
         (options.plans == "robust" || options.plans == "nominal");
}

int run(int count, char** arguments) {
  Options options;
  if (!read_options(count, arguments, options) ||
      wanted_planners(options, false).empty()) {
    std::fputs(
        "usage: bench_baselines [--quick] [--set published|wide] [--planner PREFIX]\n"
        "                       [--plans robust|nominal] [--problems N] [--seeds N]\n"
        "                       [--budget PROPAGATIONS] [--tune 1] [--draws N] [-o "
        "FILE]\n",
        stderr);
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  std::vector<Run> runs;
  const bool tunes = options.tune != 0;
  const std::vector<std::string> planners = wanted_planners(options, !tunes);
  const int number = options.problems > 0 ? options.problems : kPairs;
  const std::vector<Problem> problems =
      options.set == "wide" ? wide_problems(number, kTableSeed)
                            : published_problems(std::min(number, kPairs));
  for (const std::string& planner : planners) {
    if (tunes) {
      tune(planner, options, runs, stderr);
      continue;
    }
    const bool is_own = find_planner(planner)->family == PlannerFamily::kOwn;
    for (const Problem& problem : problems) {
      for (int seed = 1; seed <= (is_own ? 1 : options.seeds); ++seed) {
        runs.push_back(run_planner(
            problem, plan_options(options, planner, static_cast<std::uint64_t>(seed), {}),
            options.plans == "robust"));
      }
    }
  }
  write_csv(options, runs, csv.get());
  const bool written = csv.close();
  if (!tunes) {
    write_table(planners, runs, stderr);
    write_solved_by_kind(planners, runs, stderr);
  }
  return written ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
