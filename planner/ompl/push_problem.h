/// A regrasp as OMPL sees it: one space information, one problem definition, shared by
/// every planner that runs in the frame.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/control/SpaceInformation.h>

#include "planner/ompl/push_space.h"

namespace prehensile {

/// The goal region: exactly the grasps that `reaches` accepts. Samples are members of the
/// set with exact values where the goal fixes them, the nearest to the start first, then
/// round again.
class PushGoal : public ompl::base::GoalSampleableRegion {
 public:
  PushGoal(const ompl::base::SpaceInformationPtr& si,
           std::shared_ptr<const PushSteps> steps, const Grasp& start);

  bool isSatisfied(const ompl::base::State* state) const override;
  bool isSatisfied(const ompl::base::State* state, double* distance) const override;

  /// Distance in the metric of the space to the member of the goal set next to it [m].
  double distanceGoal(const ompl::base::State* state) const override;

  void sampleGoal(ompl::base::State* state) const override;
  unsigned int maxSampleCount() const override;

  /// False once every member was handed out, or a planner would wait for more for ever.
  bool couldSample() const override;

  const prehensile::Goal& wanted() const { return steps_->goal(); }

  /// Propagations spent when a planner first reached the goal; -1: not yet.
  std::int64_t first_reached_at() const { return first_reached_at_; }

 private:
  const PushSpace& space() const;

  std::shared_ptr<const PushSteps> steps_;
  std::vector<PushState> members_;
  mutable std::size_t handed_out_ = 0;
  mutable std::int64_t first_reached_at_ = -1;
};

/// Space, space information with propagator, samplers, validity and motion validator, and
/// problem definition with start, goal and objective.
///
/// The objective is PushObjective; finished plans are charged J itself.
///
/// `search` and `work` must outlive it; so must it any planner that uses it.
class PushProblem {
 public:
  PushProblem(const SearchModel& search, const Grasp& start, const Goal& goal, Work& work,
              ControlMeaning meaning = ControlMeaning::kSteered);

  const Grasp& start() const { return start_; }
  const PushSpace& space() const { return *space_; }
  const std::shared_ptr<PushSteps>& steps() const { return steps_; }
  const std::shared_ptr<PushGoal>& goal() const { return goal_; }
  const ompl::control::SpaceInformationPtr& space_information() const { return si_; }
  const ompl::base::ProblemDefinitionPtr& definition() const { return definition_; }
  Work& work() const { return work_; }

 private:
  Grasp start_;
  Work& work_;
  std::shared_ptr<PushSteps> steps_;
  std::shared_ptr<PushSpace> space_;
  ompl::control::SpaceInformationPtr si_;
  std::shared_ptr<PushGoal> goal_;
  ompl::base::ProblemDefinitionPtr definition_;
};

}  // namespace prehensile
