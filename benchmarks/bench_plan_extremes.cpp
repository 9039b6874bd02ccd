/// Stiff and extreme regrasps: what the planner makes of tolerances from 1e-2 to 1e-6 m,
/// frictions from 0 to 1000, up to 64 pushers, slivers, pads from 1e-6 m to beyond the
/// object, gravity at the limit of the grip, sizes from 1/1000 to 10 times, starts that
/// are goals and goals up to 12 turns off (problems/extreme_regrasps.h). One CSV line per
/// run.
///
/// Verdicts: `solved`, a plan that replays; `refused`, bad input, out of scope, or a
/// proof that holds; `open`, no plan within the budget; `wrong`, a plan or a proof that
/// does not hold, or that theory contradicts. The exit code is 1 if any is wrong.
///
/// Usage: bench_plan_extremes [--quick] [--only PART] [--instances N] [--seed S]
///                            [--budget N] [--planner NAME] [-o FILE]
/// PART: of "group: name", to run those extremes only.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/csv_file.h"
#include "benchmarks/measure.h"
#include "benchmarks/options.h"
#include "problems/judged_plan.h"

namespace prehensile::benchmarks {
namespace {

struct Options {
  int instances = 20;
  int budget = 1'000'000;
  std::uint64_t seed = 1;
  std::string planner = PlanOptions{}.planner;
  std::string only;  // part of the title; empty: all
  const char* file = nullptr;
};

struct Run {
  std::string group, extreme;
  int instance = 0;
  Outlook outlook = Outlook::kUnknown;
  JudgedPlan judged;
  double time_ms = kNan;
};

const char* name(Outlook outlook) {
  switch (outlook) {
    case Outlook::kUnknown:
      return "unknown";
    case Outlook::kHasPlan:
      return "has a plan";
    case Outlook::kHasNone:
      return "has none";
    case Outlook::kIsThere:
      break;
  }
  return "is there";
}

std::string title_of(const RegraspExtreme& extreme) {
  return extreme.group + ": " + extreme.name;
}

bool is_wanted(const RegraspExtreme& extreme, const Options& options) {
  return title_of(extreme).find(options.only) != std::string::npos;
}

std::vector<Run> run_all(const Options& options) {
  PlanOptions wanted;
  wanted.planner = options.planner;
  wanted.budget = options.budget;
  std::vector<Run> runs;
  for (const RegraspExtreme& extreme : regrasp_extremes()) {
    if (!is_wanted(extreme, options)) continue;
    for (int i = 0; i < options.instances; ++i) {
      const ExtremeRegrasp problem =
          extreme_regrasp(extreme, options.seed, static_cast<std::uint64_t>(i));
      const double start = thread_time_us();
      Run run{extreme.group, extreme.name, i, problem.outlook,
              judged_plan(problem, wanted)};
      run.time_ms = 1e-3 * (thread_time_us() - start);
      runs.push_back(std::move(run));
    }
  }
  return runs;
}

void write_csv(const Options& options, const std::vector<Run>& runs, std::FILE* out) {
  std::fputs(
      "planner,group,extreme,seed,instance,outlook,verdict,reason,status,promise,pushes,"
      "cost,bound,stick_tests,instants,budget,time_ms,compiler,cpu\n",
      out);
  const std::string compiler = field(compiler_name());
  const std::string cpu = field(cpu_name());
  for (const Run& run : runs) {
    const Plan& plan = run.judged.plan;
    std::fprintf(
        out, "%s,%s,%s,%llu,%d,%s,%s,%s,%s,%s,%zu,%.6g,%.6g,%lld,%lld,%d,%.4g,%s,%s\n",
        options.planner.c_str(), run.group.c_str(), field(run.extreme).c_str(),
        static_cast<unsigned long long>(options.seed), run.instance, name(run.outlook),
        name(run.judged.verdict).data(), field(run.judged.reason).c_str(),
        name(plan.status).data(), plan.usable() ? name(plan.promise).data() : "",
        plan.pushes.size(), plan.cost, plan.lower_bound,
        static_cast<long long>(plan.stick_tests), static_cast<long long>(plan.instants),
        options.budget, run.time_ms, compiler.c_str(), cpu.c_str());
  }
}

/// What the runs of one extreme came to.
struct Total {
  int runs = 0;
  int with_plan = 0;
  int solved_of_these = 0;
  std::map<Verdict, int> verdicts;
  std::map<std::string, int> reasons;
  std::vector<double> times;

  void add(const Run& run) {
    const bool solved = run.judged.verdict == Verdict::kSolved;
    ++runs;
    ++verdicts[run.judged.verdict];
    if (!run.judged.reason.empty()) ++reasons[run.judged.reason];
    if (must_be_solved(run.outlook)) {
      ++with_plan;
      if (solved) ++solved_of_these;
    }
    times.push_back(run.time_ms);
  }

  void print(const std::string& title, std::FILE* out) {
    std::string why;
    for (const auto& [reason, count] : reasons) {
      why += (why.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
    }
    std::fprintf(out, "%-44s%6d%5d of %-5d%7d%8d%6d%6d%10.3g%10.4g  %s\n", title.c_str(),
                 runs, solved_of_these, with_plan, verdicts[Verdict::kSolved],
                 verdicts[Verdict::kRefused], verdicts[Verdict::kOpen],
                 verdicts[Verdict::kWrong], quantile(times, 0.5), quantile(times, 1.0),
                 why.c_str());
  }
};

void write_table(const std::vector<Run>& runs, std::FILE* out) {
  std::fprintf(out, "%-44s%6s%14s%7s%8s%6s%6s%10s%10s  %s\n", "extreme", "runs",
               "have a plan", "solved", "refused", "open", "wrong", "median ms",
               "worst ms", "why");
  Total all;
  for (std::size_t i = 0; i < runs.size();) {
    const std::string& extreme = runs[i].extreme;
    Total total;
    const std::string title = runs[i].group + ": " + extreme;
    for (; i < runs.size() && runs[i].extreme == extreme; ++i) {
      total.add(runs[i]);
      all.add(runs[i]);
    }
    total.print(title, out);
  }
  all.reasons.clear();
  all.print("all", out);
}

int run(int count, char** arguments) {
  Options options;
  const bool readable = take_options(count, arguments,
                                     {{"-o", &options.file},
                                      {"--seed", &options.seed},
                                      {"--instances", &options.instances, 1},
                                      {"--budget", &options.budget, 1},
                                      {"--planner", &options.planner},
                                      {"--only", &options.only}},
                                     [&options] {
                                       options.instances = 1;
                                       options.budget = 10'000;
                                     });
  const std::vector<std::string> planners = planner_names();
  if (!readable || std::ranges::find(planners, options.planner) == planners.end()) {
    std::fputs(
        "usage: bench_plan_extremes [--quick] [--only PART] [--instances N] [--seed S]\n"
        "                           [--budget N] [--planner NAME] [-o FILE]\n",
        stderr);
    return 2;
  }
  const bool any = std::ranges::any_of(
      regrasp_extremes(),
      [&](const RegraspExtreme& extreme) { return is_wanted(extreme, options); });
  if (!any) {
    std::fprintf(stderr, "error: --only %s: no extreme has this in its title\n",
                 options.only.c_str());
    return 2;
  }
  CsvFile csv(options.file);
  if (!csv.get()) return 2;
  const std::vector<Run> runs = run_all(options);
  write_csv(options, runs, csv.get());
  const bool written = csv.close();
  write_table(runs, stderr);
  const bool wrong = std::ranges::any_of(
      runs, [](const Run& run) { return run.judged.verdict == Verdict::kWrong; });
  return written && !wrong ? 0 : 1;
}

}  // namespace
}  // namespace prehensile::benchmarks

int main(int count, char** arguments) {
  return prehensile::benchmarks::run(count, arguments);
}
