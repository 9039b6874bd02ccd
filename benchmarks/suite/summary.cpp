#include "benchmarks/suite/summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "benchmarks/suite/statistics.h"

namespace prehensile::suite {
namespace {

constexpr double kNearBound = 0.10;
constexpr double kSameCost = 1e-6;

ProblemKey problem_of(const ResultRow& row) { return {row.key.family, row.key.problem}; }

std::set<ProblemKey> infeasible_problems(const Results& results) {
  std::set<ProblemKey> problems;
  for (const ResultRow& row : results.rows) {
    if (row.record.status == RunStatus::kInfeasible) problems.insert(problem_of(row));
  }
  return problems;
}

GroupSummary group_of(const std::vector<const ResultRow*>& rows,
                      const std::set<ProblemKey>& infeasible) {
  GroupSummary group;
  std::vector<double> times, costs, gaps, pushes;
  for (const ResultRow* row : rows) {
    const RunRecord& record = row->record;
    ++group.runs;
    ++group.by_status[static_cast<std::size_t>(record.status)];
    if (!infeasible.contains(problem_of(*row))) ++group.feasible_runs;
    times.push_back(record.time);
    group.memory_most = std::fmax(group.memory_most, record.memory);
    if (!record.solved()) continue;
    costs.push_back(record.cost);
    gaps.push_back(record.gap);
    pushes.push_back(static_cast<double>(record.pushes));
    const bool near_bound = record.gap <= kNearBound;
    group.near_bound += near_bound;
    group.near_bound_at_goal +=
        near_bound || record.cost <= (1.0 + kNearBound) * record.bound_at_goal;
    if (record.part_of_margin) ++group.part_of_margin;
    if (record.nominal_only) ++group.nominal_only;
  }
  group.success_interval =
      wilson(std::min(group.solved(), group.feasible_runs), group.feasible_runs);
  group.time_median = quantile(times, 0.5);
  group.time_p99 = quantile(times, 0.99);
  group.time_most = quantile(times, 1.0);
  group.cost_median = quantile(costs, 0.5);
  group.gap_median = quantile(gaps, 0.5);
  group.pushes_median = quantile(pushes, 0.5);
  return group;
}

/// Counts the pairs of one comparison.
class Pairs {
 public:
  void add(const RunRecord& a, const RunRecord& b) {
    ++out_.pairs;
    if (a.solved() && !b.solved()) ++out_.only_a;
    if (b.solved() && !a.solved()) ++out_.only_b;
    if (!a.solved() || !b.solved()) return;
    ++out_.both;
    if (a.cost < b.cost * (1.0 - kSameCost)) ++out_.cheaper_a;
    if (b.cost < a.cost * (1.0 - kSameCost)) ++out_.cheaper_b;
    if (a.cost > 0.0) cost_ratios_.push_back(b.cost / a.cost);
    if (!std::isfinite(a.time) || !std::isfinite(b.time)) return;
    if (a.time < b.time) ++out_.faster_a;
    if (b.time < a.time) ++out_.faster_b;
    if (a.time > 0.0) time_ratios_.push_back(b.time / a.time);
  }

  Comparison result(int family, int a, int b) const {
    Comparison out = out_;
    out.family = family;
    out.a = a;
    out.b = b;
    out.success_p = sign_test(out.only_a, out.only_b);
    out.cost_p = sign_test(out.cheaper_a, out.cheaper_b);
    out.time_p = sign_test(out.faster_a, out.faster_b);
    out.cost_ratio = quantile(cost_ratios_, 0.5);
    out.time_ratio = quantile(time_ratios_, 0.5);
    return out;
  }

 private:
  Comparison out_;
  std::vector<double> cost_ratios_, time_ratios_;
};

}  // namespace

Summary summarise(const Results& results) {
  const std::set<ProblemKey> infeasible = infeasible_problems(results);
  std::map<std::pair<int, int>, std::vector<const ResultRow*>> rows;
  std::map<int, std::vector<const ResultRow*>> all;
  std::set<ProblemKey> contradictions;
  for (const ResultRow& row : results.rows) {
    rows[{row.key.family, row.key.planner}].push_back(&row);
    all[row.key.planner].push_back(&row);
    const bool is_solvable = row.record.solved() || row.record.constructed;
    if (is_solvable && infeasible.contains(problem_of(row))) {
      contradictions.insert(problem_of(row));
    }
  }
  Summary summary;
  summary.contradictions.assign(contradictions.begin(), contradictions.end());
  for (const auto& [key, members] : rows) {
    GroupSummary& group = summary.groups.emplace_back(group_of(members, infeasible));
    std::tie(group.family, group.planner) = key;
  }
  for (const auto& [planner, members] : all) {
    GroupSummary& group = summary.totals.emplace_back(group_of(members, infeasible));
    group.planner = planner;
  }
  return summary;
}

std::vector<Comparison> compare_planners(const Results& results) {
  std::map<std::tuple<int, int, int>, std::vector<const ResultRow*>> runs;
  for (const ResultRow& row : results.rows) {
    runs[{row.key.family, row.key.problem, row.key.planner}].push_back(&row);
  }
  const auto runs_of = [&runs](int family, int problem, int planner) {
    const auto found = runs.find({family, problem, planner});
    return found == runs.end() ? std::vector<const ResultRow*>() : found->second;
  };
  const int planners = static_cast<int>(results.planners.size());
  const int families = static_cast<int>(results.families.size());
  std::vector<Comparison> comparisons;
  for (int a = 0; a < planners; ++a) {
    for (int b = a + 1; b < planners; ++b) {
      Pairs all;
      for (int family = 0; family < families; ++family) {
        Pairs pairs;
        const int count = results.families[static_cast<std::size_t>(family)].count;
        for (int problem = 0; problem < count; ++problem) {
          const auto of_a = runs_of(family, problem, a);
          const auto of_b = runs_of(family, problem, b);
          if (of_a.empty() || of_b.empty()) continue;
          // One pair per problem: more seeds of one problem are no independent evidence.
          pairs.add(of_a.front()->record, of_b.front()->record);
          all.add(of_a.front()->record, of_b.front()->record);
        }
        comparisons.push_back(pairs.result(family, a, b));
      }
      comparisons.push_back(all.result(-1, a, b));
    }
  }
  return comparisons;
}

std::vector<Comparison> compare_results(const Results& a, const Results& b) {
  const auto index_in = [](const auto& list, const std::string& name) {
    const auto found = std::find_if(list.begin(), list.end(),
                                    [&](const auto& info) { return info.name == name; });
    return found == list.end() ? -1 : static_cast<int>(found - list.begin());
  };
  std::map<RunKey, const RunRecord*> of_b;
  for (const ResultRow& row : b.rows) of_b[row.key] = &row.record;
  std::map<std::pair<int, int>, Pairs> pairs;  // by planner and family, -1: all
  for (const ResultRow& row : a.rows) {
    RunKey key = row.key;
    key.family =
        index_in(b.families, a.families[static_cast<std::size_t>(row.key.family)].name);
    key.planner =
        index_in(b.planners, a.planners[static_cast<std::size_t>(row.key.planner)].name);
    const auto found = of_b.find(key);
    if (found == of_b.end()) continue;
    // Another problem under the same name is no pair.
    if (found->second->scene != row.record.scene) continue;
    pairs[{row.key.planner, row.key.family}].add(row.record, *found->second);
    pairs[{row.key.planner, -1}].add(row.record, *found->second);
  }
  std::vector<Comparison> comparisons;
  comparisons.reserve(pairs.size());
  for (const auto& [key, members] : pairs) {
    comparisons.push_back(members.result(key.second, key.first, key.first));
  }
  return comparisons;
}

}  // namespace prehensile::suite
