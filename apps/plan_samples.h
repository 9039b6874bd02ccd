/// Monte Carlo success of a plan: many members of its uncertainty, and what breaks it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "planner/checks/plan_trial.h"

namespace prehensile::apps {

struct SampleOptions {
  UncertaintyBox box;
  Spread spread = Spread::kBox;  ///< normal: the widths are standard deviations
  int samples = 1000;
  std::uint64_t seed = 1;
  int jobs = 1;
  bool needs_goal = false;  ///< success: also the pose at the end is a goal
  TransitionOptions transition;
};

/// How success depends on one unknown: by thirds of its draws, lowest first.
struct Influence {
  Unknown unknown;
  std::array<double, 3> success{};  ///< share of success in each third
  double difference = 0.0;          ///< greatest less least of the three
  double rank_correlation = 0.0;    ///< of the draw with success (Spearman)
  bool is_clear = false;            ///< more than three standard errors of chance
};

struct SampleReport {
  std::vector<PlanTrial> trials;  ///< by draw
  int successes = 0, sticking = 0, reaching = 0, no_scene = 0;
  bool rolls = false;  ///< the plan does: see try_plan for what rolls are tried without
  std::vector<Influence> influences;  ///< most influential first
  /// "push 2 slips", "push 1 falls": how often each came first, most frequent first.
  std::vector<std::pair<std::string, int>> failures;
};

/// Tries the plan `samples` times; the same for any number of jobs. Draws that are no
/// possible scene count as failures.
SampleReport sample_plan(const Model& model, const Plan& plan,
                         const SampleOptions& options);

std::string describe(const SampleReport& report, const SampleOptions& options);
nlohmann::ordered_json to_json(const SampleReport& report, const SampleOptions& options);

}  // namespace prehensile::apps
