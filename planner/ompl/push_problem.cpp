#include "planner/ompl/push_problem.h"

#include <utility>

#include <ompl/base/ScopedState.h>

#include "planner/costs.h"
#include "planner/ompl/push_controls.h"
#include "planner/ompl/push_objective.h"
#include "planner/ompl/push_propagator.h"
#include "planner/ompl/push_validity.h"
#include "planner/steering/goal.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

/// A plan whose cost is above that of one straight push by no more than this share is
/// optimal: planners need not search on.
constexpr double kOptimal = 1e-9;

std::vector<PushState> members_of(const PushSteps& steps, const Grasp& start) {
  const GoalPlaces places =
      goal_places(steps.model(), steps.goal(), flat_state(start), steps.search().margin);
  const double psi = start.psi + roll_needed(steps.goal(), start.psi);
  std::vector<PushState> members;
  for (int turn = 0; turn < 3; ++turn) {
    for (int i = 0; i < places.count; ++i) {
      const GoalPlace& place = places.places[i];
      if (turn < place.count) members.push_back({{place.p_OF, place.theta[turn]}, psi});
    }
  }
  return members;
}

oc::SpaceInformationPtr make_space_information(const std::shared_ptr<PushSpace>& space,
                                               const std::shared_ptr<PushSteps>& steps) {
  const auto controls = std::make_shared<PushControlSpace>(space, steps);
  auto si = std::make_shared<oc::SpaceInformation>(space, controls);
  si->setStateValidityChecker(std::make_shared<PushValidity>(si, steps));
  si->setMotionValidator(std::make_shared<PushMotionValidator>(si, steps));
  si->setStatePropagator(std::make_shared<PushPropagator>(si, steps));
  if (steps->meaning() == ControlMeaning::kSteered) {
    si->setDirectedControlSamplerAllocator([steps](const oc::SpaceInformation* info) {
      return std::make_shared<PushDirectedSampler>(info, steps);
    });
  }
  // One call of the propagator is one whole push, never a slice of it.
  si->setPropagationStepSize(1.0);
  si->setMinMaxControlDuration(1, 1);
  si->setup();
  return si;
}

}  // namespace

PushGoal::PushGoal(const ob::SpaceInformationPtr& si,
                   std::shared_ptr<const PushSteps> steps, const Grasp& start)
    : ob::GoalSampleableRegion(si), steps_(std::move(steps)) {
  setThreshold(0.0);
  ob::ScopedState<> state(si);
  for (const PushState& member : members_of(*steps_, start)) {
    space().write(member, state.get());
    if (si->isValid(state.get())) members_.push_back(member);
  }
}

bool PushGoal::isSatisfied(const ob::State* state) const {
  const bool reached = reaches(steps_->goal(), grasp_of(space().read(state)));
  if (reached && first_reached_at_ < 0) first_reached_at_ = steps_->work().propagations;
  return reached;
}

bool PushGoal::isSatisfied(const ob::State* state, double* distance) const {
  if (distance != nullptr) *distance = distanceGoal(state);
  return isSatisfied(state);
}

double PushGoal::distanceGoal(const ob::State* state) const {
  const Grasp grasp = grasp_of(space().read(state));
  ob::ScopedState<> member(si_);
  space().write(state_of(member_near(steps_->goal(), grasp)), member.get());
  return si_->distance(state, member.get());
}

void PushGoal::sampleGoal(ob::State* state) const {
  if (members_.empty()) return space().write_refusal(state);
  space().write(members_[handed_out_++ % members_.size()], state);
}

unsigned int PushGoal::maxSampleCount() const {
  return static_cast<unsigned>(members_.size());
}

bool PushGoal::couldSample() const { return handed_out_ < members_.size(); }

const PushSpace& PushGoal::space() const {
  return *si_->getStateSpace()->as<PushSpace>();
}

PushProblem::PushProblem(const SearchModel& search, const Grasp& start, const Goal& goal,
                         Work& work, ControlMeaning meaning)
    : start_(start),
      work_(work),
      steps_(std::make_shared<PushSteps>(search, goal, work, meaning)),
      space_(std::make_shared<PushSpace>(*steps_, start)),
      si_(make_space_information(space_, steps_)),
      goal_(std::make_shared<PushGoal>(si_, steps_, start)),
      definition_(std::make_shared<ob::ProblemDefinition>(si_)) {
  ob::ScopedState<> state(std::static_pointer_cast<ob::StateSpace>(space_));
  space_->write(state_of(start), state.get());
  definition_->addStartState(state.get());
  definition_->setGoal(goal_);
  const auto objective =
      std::make_shared<PushObjective>(si_, placement_length(*search.model));
  const double straight = goal_->distanceGoal(state.get());
  objective->setCostThreshold(
      ob::Cost((1.0 + kOptimal) * (1.0 + straight / placement_length(*search.model))));
  definition_->setOptimizationObjective(objective);
}

}  // namespace prehensile
