#include "planner/finish/finish.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "planner/bounds/bounds.h"
#include "planner/chains/chain_search.h"
#include "planner/checks/exact_check.h"
#include "planner/checks/meet_end.h"
#include "planner/costs.h"
#include "planner/finish/ease.h"
#include "planner/finish/loosen_grip.h"
#include "planner/finish/polish.h"
#include "planner/finish/repair.h"
#include "planner/finish/run_search.h"
#include "planner/finish/three_pushes.h"
#include "planner/finish/trajectory.h"
#include "planner/finish/word_plans.h"

namespace prehensile {
namespace {

/// Puts a plan to the exact check, with the grip loosened if that passes.
bool passes_check(const SearchModel& search, const PlanOptions& options, Work& work,
                  Plan& plan, std::string& why) {
  const Model& model = *search.model;
  meet_ends(model, options.transition, plan);
  Plan loosened = plan;
  if (loosen_grip(search, work, loosened)) {
    if (check_exactly(model, options.transition, loosened, &why)) {
      plan = std::move(loosened);
      return true;
    }
    plan.instants = loosened.instants;
  }
  return check_exactly(model, options.transition, plan, &why);
}

/// Eases a plan that passes, if it passes then as well.
void ease_as_it_passes(const SearchModel& search, const PlanOptions& options,
                       const Limits& limits, Work& work, Plan& plan) {
  Plan eased = plan;
  if (!ease(search, options.ease, limits, work, eased)) return;
  const bool passes = check_exactly(*search.model, options.transition, eased, nullptr);
  plan.instants = eased.instants;
  if (passes) plan = std::move(eased);
}

bool is_same_push(const PlannedPush& a, const PlannedPush& b) {
  if (a.push.index() != b.push.index() || a.start != b.start || a.end != b.end) {
    return false;
  }
  if (contact_of(a.push) != contact_of(b.push)) return false;
  if (std::holds_alternative<Roll>(a.push)) return true;
  const LinearPush one = as_linear(a.push);
  const LinearPush other = as_linear(b.push);
  return one.place == other.place && one.e == other.e && one.travel == other.travel &&
         one.turn == other.turn;
}

bool is_same_way(const Plan& a, const Plan& b) {
  return std::ranges::equal(a.pushes, b.pushes, is_same_push);
}

bool is_far_from_bound(const SearchModel& search, const Plan& plan) {
  const Goal goal = planar_goal(*search.model->scene.goal);
  return plan.cost > kGoodEnough * guide_bound(*search.model, plan.start, goal);
}

/// A plan that its exact check has shortened lies on the border of what its margin
/// allows: it has to cost less than this share of the one before.
constexpr double kWorthLessSlack = 0.98;

/// Share of the cost that is way, above which a tenth of the way is worth as much.
constexpr double kLongWay = 0.18;

/// A plan found, a run of one placement in its stead, and three pushes in the stead of
/// both, each polished; and the best of them by what the real pads allow, then by what
/// the exact check does where the closed form knows less, where it may still be far from
/// optimal. The cheapest first.
std::vector<Plan> polished(const SearchModel& search, const Limits& limits, Work& work,
                           const Plan& plan) {
  std::vector<Plan> plans;
  const auto keep_polished = [&](Plan one) {
    polish(search, limits, work, one);
    plans.push_back(one);
    if (improve_by_words(search, limits, work, one)) plans.push_back(one);
  };
  const auto keep_run = [&](const SearchModel& counted) {
    Plan run = plan;
    if (improve_by_run(counted, limits, work, run)) keep_polished(std::move(run));
  };
  keep_run(search);
  if (has_points(search)) {  // pieces of a push by a point become one when polished
    SearchModel staying = search;
    staying.points_stay = true;
    keep_run(staying);
  }
  if (const auto ellipsoid = over_ellipsoid(search)) keep_run(*ellipsoid);
  keep_polished(plan);
  const auto sort = [&] {
    for (Plan& one : plans) account(*search.model, one);
    std::ranges::stable_sort(plans, {}, &Plan::cost);
  };
  sort();
  Plan three = plans.front();
  if (improve_by_three_pushes(search, limits, work, three)) keep_polished(three);
  sort();
  if (is_far_from_bound(search, plans.front())) {
    Plan best = plans.front();
    polish_with_real_pads(search, limits, work, best);
    account(*search.model, best);
    plans.push_back(best);
    const bool is_long = best.cost - best.placements > kLongWay * best.cost;
    const bool may_gain = is_long && (!search.margin.is_none() || limits.improves());
    if (may_gain && shorten_as_trajectory(search, limits, work, best)) {
      account(*search.model, best);
      if (best.cost < kWorthLessSlack * plans.back().cost) plans.push_back(best);
    }
    sort();
  }
  return plans;
}

}  // namespace

Finished finish(const SearchModel& search, const PlanOptions& options,
                const Limits& limits, Work& work, Plan& plan) {
  if (work.meter) work.meter->enter("polish");
  std::string why;
  std::vector<Plan> failed;
  const auto passes = [&](Plan one) {
    const auto is_same = [&](const Plan& other) { return is_same_way(one, other); };
    if (std::ranges::any_of(failed, is_same)) return false;
    failed.push_back(one);
    one.instants = plan.instants;
    const bool passed = passes_check(search, options, work, one, why);
    plan.instants = one.instants;
    if (passed) plan = std::move(one);
    if (passed && options.polish) ease_as_it_passes(search, options, limits, work, plan);
    return passed;
  };
  const Plan found = plan;
  if (options.polish &&
      std::ranges::any_of(polished(search, limits, work, found), passes)) {
    return {};
  }
  if (passes(found)) return {};
  const std::string fault = why;
  if (!options.polish) return {fault};
  if (work.meter) work.meter->enter("repair");
  const std::vector<Plan> rejected = failed;
  for (const auto way : {repair_as_trajectory, repair}) {
    for (Plan one : rejected) {
      if (way(search, limits, work, one) && passes(one)) return {.is_repaired = true};
    }
  }
  return {fault};
}

}  // namespace prehensile
