#include "planner/baselines/baselines.h"
#include "planner/baselines/random_stream.h"

namespace prehensile {
namespace {

/// A random control that some rotation makes stick, if a few draws find one.
PushControl drawn(const PushSteps& steps, const PushState& from, double longest,
                  int redraws, RandomStream& random) {
  const auto uniform = [&random] { return random.in(0.0, 1.0); };
  PushControl control = steps.random_push(longest, uniform);
  for (int i = 0; i < redraws && !steps.may_stick(from, control); ++i) {
    control = steps.random_push(longest, uniform);
  }
  return control;
}

}  // namespace

std::optional<std::vector<Move>> shoot_at_random(const BaselineQuestion& question,
                                                 const Limits& limits, Work& work) {
  PushSteps steps(question.search, question.goal, work);
  RandomStream random(question.seed);
  const FlatBox box = box_around(steps.model(), question.start, question.goal);
  const double longest = question.setting("longest") * steps.model().L;
  const int depth = static_cast<int>(question.setting("depth"));
  const int redraws = static_cast<int>(question.setting("redraws"));
  std::vector<Move> moves;
  while (!limits.reached()) {
    PushState at = state_of(question.start);
    moves.clear();
    for (int i = 0; i < depth; ++i) {
      const PushState goal = state_of(member_near(question.goal, grasp_of(at)));
      const auto last = steps.join(at, goal);
      if (last && last->move_contact >= 0) {
        moves.push_back({last->move_contact, at.flat, last->to.flat});
        return moves;
      }
      const auto step = steps.follow(at, drawn(steps, at, longest, redraws, random));
      if (!step) break;
      if (step->to.flat.theta < box.low.theta || step->to.flat.theta > box.high.theta) {
        break;
      }
      moves.push_back({step->move_contact, at.flat, step->to.flat});
      at = step->to;
    }
  }
  return std::nullopt;
}

}  // namespace prehensile
