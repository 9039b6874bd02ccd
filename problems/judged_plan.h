/// What the planner makes of a problem, judged from the scene and the answer alone.
/// Whoever includes this links the planner.
#pragma once

#include <string>
#include <string_view>

#include "planner/checks/replay.h"
#include "planner/planner.h"
#include "problems/extreme_regrasps.h"

namespace prehensile {

enum class Verdict {
  kSolved,   ///< a plan that replays with the exact mechanics, or nothing to do
  kRefused,  ///< bad input, out of scope, or a proof that holds
  kOpen,     ///< no plan within the budget
  kWrong,    ///< a plan or a proof that does not hold, or that theory contradicts
};

struct JudgedPlan {
  Verdict verdict = Verdict::kWrong;
  std::string reason;  ///< of a refusal, or what is wrong
  Plan plan;           ///< not run where the input is bad
};

inline std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kSolved:
      return "solved";
    case Verdict::kRefused:
      return "refused";
    case Verdict::kOpen:
      return "open";
    case Verdict::kWrong:
      break;
  }
  return "wrong";
}

/// Plans for the problem and judges the answer: by the replay, by `verify`, and by what
/// theory says.
inline JudgedPlan judged_plan(const ExtremeRegrasp& problem, const PlanOptions& options) {
  const Outlook outlook = problem.outlook;
  const auto faults = check(problem.scene);
  if (!faults.empty()) {
    return {Verdict::kRefused, "bad input: " + faults.front().field, {}};
  }
  const Model model = prepare(problem.scene);
  JudgedPlan judged{.plan = plan_regrasp(model, options)};
  const Plan& plan = judged.plan;
  const auto end = [&](Verdict verdict, std::string reason) {
    judged.verdict = verdict;
    judged.reason = std::move(reason);
    return judged;
  };
  if (outlook == Outlook::kIsThere && plan.status != PlanStatus::kNothingToDo) {
    return end(Verdict::kWrong, "the start is a goal");
  }
  if (plan.usable()) {
    const Replay replayed = replay(model, plan);
    if (!replayed.agrees) return end(Verdict::kWrong, replayed.why);
    if (outlook == Outlook::kHasNone) return end(Verdict::kWrong, "there is no plan");
    return end(Verdict::kSolved, "");
  }
  if (plan.status == PlanStatus::kInfeasible) {
    std::string why;
    if (!verify(model, plan.proof, &why)) return end(Verdict::kWrong, why);
    if (must_be_solved(outlook)) return end(Verdict::kWrong, "there is a plan");
    return end(Verdict::kRefused, std::string(name(plan.proof.kind)));
  }
  if (plan.status == PlanStatus::kUnsupported) {
    return end(Verdict::kRefused, plan.message);
  }
  return end(Verdict::kOpen, "");
}

}  // namespace prehensile
