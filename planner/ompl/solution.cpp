#include "planner/ompl/solution.h"

#include <limits>

#include <ompl/control/PathControl.h>
#include <ompl/geometric/PathGeometric.h>

#include "planner/steering/goal.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;

/// Directions in (p_OF, c theta) closer than this are one [rad].
constexpr double kSameDirection = 1e-9;

/// A roll or a straight move, never both.
struct Leg {
  PushState from;
  PushStep step;
};

std::vector<PushState> way_points_of(const PushProblem& problem, ob::Path& path) {
  const auto* control = dynamic_cast<ompl::control::PathControl*>(&path);
  const auto* geometric = dynamic_cast<ompl::geometric::PathGeometric*>(&path);
  const std::size_t count = control     ? control->getStateCount()
                            : geometric ? geometric->getStateCount()
                                        : 0;
  std::vector<PushState> points;
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = static_cast<unsigned>(i);
    points.push_back(problem.space().read(control ? control->getState(index)
                                                  : geometric->getState(index)));
  }
  // The space stores c theta: put back the start as it was given, to the last digit.
  if (!points.empty()) points.front() = state_of(problem.start());
  return points;
}

void add_legs(const PushState& from, const PushStep& step, std::vector<Leg>& legs) {
  PushState middle = from;
  if (step.roll && step.roll_first) {
    middle.psi = step.to.psi;
    legs.push_back({from, {.to = middle, .roll = step.roll}});
  }
  if (step.move_contact >= 0) {
    const PushState end{step.to.flat, middle.psi};
    legs.push_back({middle, {.to = end, .move_contact = step.move_contact}});
    middle = end;
  }
  if (step.roll && !step.roll_first) {
    legs.push_back({middle, {.to = step.to, .roll = step.roll}});
  }
}

Vec3 direction_of(const Leg& leg, double theta_scale) {
  const Vec2 dp = leg.step.to.flat.p_OF - leg.from.flat.p_OF;
  const double turn = theta_scale * (leg.step.to.flat.theta - leg.from.flat.theta);
  return Vec3(dp.x(), dp.y(), turn).normalized();
}

bool is_continued_by(const Leg& leg, const Leg& next, double theta_scale) {
  return leg.step.move_contact >= 0 && leg.step.move_contact == next.step.move_contact &&
         (direction_of(leg, theta_scale) - direction_of(next, theta_scale)).norm() <
             kSameDirection;
}

std::vector<Leg> merged(const std::vector<Leg>& legs, PushSteps& steps) {
  std::vector<Leg> result;
  for (const Leg& leg : legs) {
    if (!result.empty() && is_continued_by(result.back(), leg, steps.theta_scale())) {
      Leg& before = result.back();
      const int contact = leg.step.move_contact;
      const std::optional<PushStep> whole = steps.join(before.from, leg.step.to, contact);
      if (whole && whole->move_contact == contact) {
        before.step = *whole;
        continue;
      }
    }
    result.push_back(leg);
  }
  return result;
}

PlannedPush planned_push(const PushSteps& steps, const Leg& leg) {
  PlannedPush planned;
  planned.start = grasp_of(leg.from);
  planned.end = grasp_of(leg.step.to);
  if (leg.step.roll) {
    planned.push = *leg.step.roll;
  } else {
    const Move move{leg.step.move_contact, leg.from.flat, leg.step.to.flat};
    planned.push = push_of(steps.search(), move);
  }
  return planned;
}

}  // namespace

std::optional<std::vector<PlannedPush>> pushes_along(const PushProblem& problem,
                                                     ob::Path& path) {
  const std::vector<PushState> points = way_points_of(problem, path);
  const Goal& goal = problem.steps()->goal();
  if (points.empty() || !reaches(goal, grasp_of(points.back()))) return {};

  Work uncounted{.budget = std::numeric_limits<std::int64_t>::max()};
  PushSteps steps(problem.steps()->search(), goal, uncounted);
  std::vector<Leg> legs;
  int last = -1;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const std::optional<PushStep> step = steps.join(points[i - 1], points[i], last);
    if (!step) return {};
    add_legs(points[i - 1], *step, legs);
    if (step->move_contact >= 0) last = step->move_contact;
  }
  std::vector<PlannedPush> pushes;
  for (const Leg& leg : merged(legs, steps)) pushes.push_back(planned_push(steps, leg));
  return pushes;
}

}  // namespace prehensile
