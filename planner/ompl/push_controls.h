/// The controls of OMPL's control planners: which contact pushes, and how.
#pragma once

#include <memory>

#include <ompl/control/ControlSampler.h>
#include <ompl/control/ControlSpace.h>

#include "planner/ompl/push_space.h"

namespace prehensile {

/// Compound of a discrete letter and the real numbers of PushControl: heading, share,
/// travel and, for an object that can roll, roll. Raw controls are read and written here
/// only.
class PushControlSpace : public ompl::control::CompoundControlSpace {
 public:
  PushControlSpace(const std::shared_ptr<PushSpace>& states,
                   std::shared_ptr<PushSteps> steps);

  PushControl read(const ompl::control::Control* control) const;
  void write(const PushControl& from, ompl::control::Control* control) const;

  ompl::control::ControlSamplerPtr allocDefaultControlSampler() const override;

  const PushSpace& states() const { return *states_; }

 private:
  std::shared_ptr<PushSpace> states_;
  std::shared_ptr<PushSteps> steps_;
  bool rolls_;
};

/// Random pushes. Steered: straight to the goal, or to a random state, or random with a
/// heading mostly from the friction cone of the contact; where the state is known,
/// headings without any sticking rotation are drawn again. Blind: uniform contact,
/// heading and slope.
class PushControlSampler : public ompl::control::ControlSampler {
 public:
  PushControlSampler(const PushControlSpace* space, std::shared_ptr<PushSteps> steps);

  void sample(ompl::control::Control* control) override;
  void sample(ompl::control::Control* control, const ompl::base::State* state) override;
  void sampleNext(ompl::control::Control* control,
                  const ompl::control::Control* previous) override;
  void sampleNext(ompl::control::Control* control, const ompl::control::Control* previous,
                  const ompl::base::State* state) override;

 private:
  PushControl drawn();
  PushControl steered();
  PushControl aim();
  PushControl blind();
  double uniform() { return rng_.uniform01(); }

  const PushControlSpace& controls_;
  std::shared_ptr<PushSteps> steps_;
};

}  // namespace prehensile
