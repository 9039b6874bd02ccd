/// Pushes as OMPL's propagations, and exact steering for the planners that ask for it.
#pragma once

#include <memory>

#include <ompl/control/DirectedControlSampler.h>
#include <ompl/control/StatePropagator.h>

#include "planner/ompl/push_controls.h"

namespace prehensile {

/// One call is one whole push. A control that no sticking push answers gives a state that
/// the validity check rejects, so that no node is created: `propagate` has no other way
/// to refuse. Durations other than 1 do not occur.
class PushPropagator : public ompl::control::StatePropagator {
 public:
  PushPropagator(const ompl::control::SpaceInformationPtr& si,
                 std::shared_ptr<PushSteps> steps);

  void propagate(const ompl::base::State* state, const ompl::control::Control* control,
                 double duration, ompl::base::State* result) const override;
  bool canPropagateBackward() const override { return false; }
  bool canSteer() const override { return true; }
  bool steer(const ompl::base::State* from, const ompl::base::State* to,
             ompl::control::Control* control, double& duration) const override;

 private:
  std::shared_ptr<PushSteps> steps_;
};

/// Steers to a wanted state: exactly if one push does it, else as close as one push
/// comes, else anywhere by a random push. Returns duration 0 where nothing sticks. Used
/// by RRT, EST, PDST and SyclopRRT; SST, KPIECE1 and SyclopEST draw controls without a
/// wanted state, so their sampler draws the wanted state too (PushControlSampler).
class PushDirectedSampler : public ompl::control::DirectedControlSampler {
 public:
  PushDirectedSampler(const ompl::control::SpaceInformation* si,
                      std::shared_ptr<PushSteps> steps);

  unsigned int sampleTo(ompl::control::Control* control, const ompl::base::State* source,
                        ompl::base::State* dest) override;
  unsigned int sampleTo(ompl::control::Control* control,
                        const ompl::control::Control* previous,
                        const ompl::base::State* source,
                        ompl::base::State* dest) override;

 private:
  const PushSpace& space_;
  const PushControlSpace& controls_;
  std::shared_ptr<PushSteps> steps_;
  PushControlSampler random_;
};

}  // namespace prehensile
