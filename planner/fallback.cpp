#include "planner/fallback.h"

#include <algorithm>

#include "planner/baselines.h"
#include "planner/frame.h"
#include "planner/goal.h"
#include "planner/shorten.h"

namespace prehensile {
namespace {

constexpr const char* kWithOmpl = "geometric::RRTConnect";
constexpr const char* kWithout = "motion-cone-tree";

std::optional<std::vector<Move>> moves_of(const SearchModel& search, const Plan& plan) {
  std::vector<Move> moves;
  for (const PlannedPush& planned : plan.pushes) {
    if (std::holds_alternative<Roll>(planned.push)) return std::nullopt;
    const int contact = search_contact_of(search, as_linear(planned.push));
    if (contact < 0) return std::nullopt;
    moves.push_back({contact, flat_state(planned.start), flat_state(planned.end)});
  }
  return moves;
}

}  // namespace

const char* fallback_planner(const Model& model) {
  return frame_is_built() && !model.cross_section ? kWithOmpl : kWithout;
}

std::optional<std::vector<Move>> fall_back(const SearchModel& search, const Grasp& start,
                                           const Goal& goal, const PlanOptions& options,
                                           std::int64_t budget, Work& work) {
  PlanOptions of_fallback = options;
  of_fallback.planner = fallback_planner(*search.model);
  of_fallback.settings.clear();
  const std::int64_t whole = work.budget;
  work.budget = std::min(whole, work.stick_tests + work.propagations + budget);
  const Plan plan = find_planner(of_fallback.planner)->needs_ompl()
                        ? solve_in_frame(search, start, goal, of_fallback, work)
                        : search_by_baseline(search, start, goal, of_fallback, work);
  work.budget = whole;
  if (plan.status != PlanStatus::kReachedGoal) return std::nullopt;
  const auto moves = moves_of(search, plan);
  if (!moves) return std::nullopt;
  return shortened(search, *moves, Limits(options, work), work);
}

}  // namespace prehensile
