#include "apps/plan_samples.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "apps/json_number.h"
#include "apps/parallel.h"
#include "apps/table.h"
#include "apps/uncertainty_options.h"
#include "planner/checks/share_interval.h"

namespace prehensile::apps {
namespace {

constexpr double kClearErrors = 3.0;

BoxPoint draw(const SampleOptions& options, int i) {
  const auto index = static_cast<std::uint64_t>(i);
  return options.spread == Spread::kNormal ? random_normal_point(options.seed, index)
                                           : random_point(options.seed, index);
}

bool succeeds(const PlanTrial& trial, const SampleOptions& options) {
  return options.needs_goal ? trial.reaches : trial.sticks;
}

std::string failure_of(const PlanTrial& trial) {
  if (!trial.is_scene) return "no possible scene";
  if (trial.failed_push < 0) return "the end is not a goal";
  std::string out = text("push %d: ", trial.failed_push + 1);
  const bool slips = trial.status == TransitionStatus::kCompleted;
  return out += slips ? std::string_view("slips") : name(trial.status);
}

/// Spearman's correlation of distinct values, in this order, with success.
double rank_correlation(const std::vector<int>& order, const std::vector<char>& success) {
  const double n = static_cast<double>(order.size());
  double hits = 0.0, sum_of_ranks = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    if (!success[static_cast<std::size_t>(order[rank])]) continue;
    hits += 1.0;
    sum_of_ranks += static_cast<double>(rank) + 1.0;
  }
  if (hits == 0.0 || hits == n) return 0.0;
  const double mean = 0.5 * (n + 1.0);
  const double share = hits / n;
  const double covariance = sum_of_ranks / n - share * mean;
  const double rank_variance = (n * n - 1.0) / 12.0;
  return covariance / std::sqrt(rank_variance * share * (1.0 - share));
}

Influence influence_of(Unknown unknown, const std::vector<double>& draws,
                       const std::vector<char>& success) {
  Influence influence{unknown};
  std::vector<int> order(draws.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](int i) { return draws[static_cast<std::size_t>(i)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return at(a) < at(b); });
  influence.rank_correlation = rank_correlation(order, success);
  const std::size_t n = order.size();
  double hits = 0.0;
  for (std::size_t third = 0; third < 3; ++third) {
    const std::size_t first = third * n / 3;
    const std::size_t last = (third + 1) * n / 3;
    double held = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      held += success[static_cast<std::size_t>(order[i])];
    }
    hits += held;
    influence.success[third] =
        last > first ? held / static_cast<double>(last - first) : 0;
  }
  const auto [least, most] =
      std::minmax_element(influence.success.begin(), influence.success.end());
  influence.difference = *most - *least;
  const double share = hits / static_cast<double>(n);
  const double error = std::sqrt(share * (1.0 - share) * 6.0 / static_cast<double>(n));
  influence.is_clear = influence.difference > kClearErrors * error && error > 0.0;
  return influence;
}

std::string percent(double share) { return text("%.2f", 100.0 * share); }

double share(int hits, int samples) {
  return samples > 0 ? static_cast<double>(hits) / samples : 0.0;
}

std::string interval_text(int hits, int samples) {
  const ShareInterval interval = wilson(hits, samples);
  return text("%d of %d, %.2f %% (95 %%: %.2f to %.2f %%)", hits, samples,
              100.0 * share(hits, samples), 100.0 * interval.low, 100.0 * interval.high);
}

nlohmann::ordered_json interval_json(int hits, int samples) {
  const ShareInterval interval = wilson(hits, samples);
  return {{"count", hits},
          {"share", share(hits, samples)},
          {"low", interval.low},
          {"high", interval.high}};
}

}  // namespace

SampleReport sample_plan(const Model& model, const Plan& plan,
                         const SampleOptions& options) {
  SampleReport report{.rolls = plan.rolls()};
  const auto count = static_cast<std::size_t>(options.samples);
  report.trials.resize(count);
  for_each_index(options.samples, options.jobs, [&](int i) {
    report.trials[static_cast<std::size_t>(i)] =
        try_plan(model, plan, options.box, draw(options, i), options.transition);
  });
  std::vector<char> success(count);
  std::map<std::string, int> failures;
  for (std::size_t i = 0; i < count; ++i) {
    const PlanTrial& trial = report.trials[i];
    success[i] = succeeds(trial, options);
    report.successes += success[i];
    report.sticking += trial.sticks;
    report.reaching += trial.reaches;
    report.no_scene += !trial.is_scene;
    if (!success[i]) ++failures[failure_of(trial)];
  }
  report.failures.assign(failures.begin(), failures.end());
  std::stable_sort(report.failures.begin(), report.failures.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<double> draws(count);
  for (const Unknown unknown : options.box.active()) {
    for (std::size_t i = 0; i < count; ++i) {
      draws[i] = draw(options, static_cast<int>(i))[static_cast<std::size_t>(unknown)];
    }
    report.influences.push_back(influence_of(unknown, draws, success));
  }
  std::stable_sort(
      report.influences.begin(), report.influences.end(),
      [](const Influence& a, const Influence& b) { return a.difference > b.difference; });
  return report;
}

std::string describe(const SampleReport& report, const SampleOptions& options) {
  const int n = options.samples;
  std::string out =
      text("%d draws, seed %llu, %s: ", n, static_cast<unsigned long long>(options.seed),
           options.spread == Spread::kNormal ? "normal" : "uniform");
  out += box_text(options.box) + '\n';
  if (report.rolls)
    out += "rolls are tried without errors of tilt, centre of mass and angle\n";
  out += "sticks through:        " + interval_text(report.sticking, n) + '\n';
  out += "and ends at the goal:  " + interval_text(report.reaching, n) + '\n';
  for (const auto& [what, times] : report.failures) {
    out += text("  %s: %d\n", what.c_str(), times);
  }
  if (report.successes == n || report.successes == 0) return out;
  Table table({"unknown", "lowest third %", "middle %", "highest %", "difference %",
               "rank correlation", "clear"});
  for (const Influence& i : report.influences) {
    table.add({std::string(name(i.unknown)), percent(i.success[0]), percent(i.success[1]),
               percent(i.success[2]), percent(i.difference),
               text("%.3f", i.rank_correlation), i.is_clear ? "yes" : "-"});
  }
  return out + "what breaks it most, by success in thirds of the draws:\n" + table.str();
}

nlohmann::ordered_json to_json(const SampleReport& report, const SampleOptions& options) {
  const int n = options.samples;
  nlohmann::ordered_json out = {
      {"draws", n},
      {"seed", options.seed},
      {"spread", options.spread == Spread::kNormal ? "normal" : "box"},
      {"box", to_json(options.box)},
      {"success_means", options.needs_goal ? "goal" : "sticks"},
      {"success", interval_json(report.successes, n)},
      {"sticks", interval_json(report.sticking, n)},
      {"reaches_goal", interval_json(report.reaching, n)},
      {"no_possible_scene", report.no_scene},
      {"failures", nlohmann::ordered_json::array()},
      {"influences", nlohmann::ordered_json::array()}};
  for (const auto& [what, times] : report.failures) {
    out["failures"].push_back({{"what", what}, {"count", times}});
  }
  for (const Influence& i : report.influences) {
    out["influences"].push_back({{"unknown", std::string(name(i.unknown))},
                                 {"success_by_thirds", i.success},
                                 {"difference", i.difference},
                                 {"rank_correlation", number(i.rank_correlation)},
                                 {"is_clear", i.is_clear}});
  }
  return out;
}

}  // namespace prehensile::apps
