/// Results condensed: one line per family and planner, and planners against each other.
#pragma once

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "benchmarks/suite/results.h"
#include "planner/checks/share_interval.h"

namespace prehensile::suite {

/// Runs of one planner on one family, or on all.
///
/// Success is the share of solved runs among those on problems that nobody has proved
/// infeasible; where problems are made by pushes, that is all.
struct GroupSummary {
  int family = -1;  ///< -1: all
  int planner = 0;
  int runs = 0;
  std::array<int, kRunStatusNames.size()> by_status{};
  int feasible_runs = 0;   ///< on problems that nobody has proved infeasible
  int part_of_margin = 0;  ///< solved, with a part of the margin asked for
  int nominal_only = 0;    ///< solved, with none of it
  ShareInterval success_interval;
  double time_median = kNothing, time_p99 = kNothing, time_most = kNothing;  ///< [s]
  double cost_median = kNothing;
  double gap_median = kNothing;
  int near_bound = 0;          ///< solved with a gap of at most 10 %
  int near_bound_at_goal = 0;  ///< likewise, or to the bound of plans to the goal itself
  double pushes_median = kNothing;
  double memory_most = kNothing;  ///< [MB]

  int count(RunStatus status) const {
    return by_status[static_cast<std::size_t>(status)];
  }
  int solved() const { return count(RunStatus::kSolved); }
  int decided() const { return solved() + count(RunStatus::kInfeasible); }
  double success() const {
    return feasible_runs > 0 ? solved() / (feasible_runs + 0.0) : kNothing;
  }
  double decided_share() const { return runs > 0 ? decided() / (runs + 0.0) : kNothing; }
};

/// A problem of the suite.
struct ProblemKey {
  int family = 0;
  int problem = 0;
  friend bool operator<(const ProblemKey& a, const ProblemKey& b) {
    return std::tie(a.family, a.problem) < std::tie(b.family, b.problem);
  }
};

struct Summary {
  std::vector<GroupSummary> groups;  ///< family by family, planners in order
  std::vector<GroupSummary> totals;  ///< of all families, per planner
  /// Problems that one run solves, or that are made by pushes, and another run proves
  /// infeasible: one of the verifiers is wrong. Nobody has seen one.
  std::vector<ProblemKey> contradictions;
};

Summary summarise(const Results& results);

/// Two planners on the same problems and seeds, or one planner in two files.
struct Comparison {
  int family = -1;   ///< -1: all
  int a = 0, b = 0;  ///< planners
  int pairs = 0;
  int only_a = 0, only_b = 0;        ///< solved by one of them
  double success_p = 1.0;            ///< McNemar's exact test
  int both = 0;                      ///< solved by both
  int cheaper_a = 0, cheaper_b = 0;  ///< cost lower by more than 1e-6 of it
  double cost_p = 1.0;
  double cost_ratio = kNothing;  ///< median of b over a
  int faster_a = 0, faster_b = 0;
  double time_p = 1.0;
  double time_ratio = kNothing;  ///< median of b over a
};

/// Every planner against every other: each family, then all.
std::vector<Comparison> compare_planners(const Results& results);

/// The same planners in two files, matched by names of families and planners; family and
/// planner indices are those of `a`.
std::vector<Comparison> compare_results(const Results& a, const Results& b);

}  // namespace prehensile::suite
