#include "planner/ompl/push_propagator.h"

#include <utility>

#include <ompl/control/SpaceInformation.h>

namespace prehensile {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

constexpr int kRandomTries = 4;

const PushSpace& space_of(const oc::SpaceInformation* si) {
  return *si->getStateSpace()->as<PushSpace>();
}

const PushControlSpace& controls_of(const oc::SpaceInformation* si) {
  return *si->getControlSpace()->as<PushControlSpace>();
}

/// Contact of a control that came before; -1 if it names none.
int contact_before(const PushControlSpace& controls, const oc::Control* previous,
                   int contacts) {
  if (previous == nullptr) return -1;
  const int letter = controls.read(previous).letter;
  return letter < contacts ? letter : -1;
}

}  // namespace

PushPropagator::PushPropagator(const oc::SpaceInformationPtr& si,
                               std::shared_ptr<PushSteps> steps)
    : oc::StatePropagator(si), steps_(std::move(steps)) {}

void PushPropagator::propagate(const ob::State* state, const oc::Control* control,
                               double /*duration*/, ob::State* result) const {
  const PushSpace& space = space_of(si_);
  const std::optional<PushStep> step =
      steps_->follow(space.read(state), controls_of(si_).read(control));
  if (step) {
    space.write(step->to, result);
  } else {
    space.write_refusal(result);
  }
}

bool PushPropagator::steer(const ob::State* from, const ob::State* to,
                           oc::Control* control, double& duration) const {
  const PushSpace& space = space_of(si_);
  const PushState start = space.read(from);
  const std::optional<PushStep> step = steps_->join(start, space.read(to));
  if (!step) return false;
  controls_of(si_).write(steps_->control_for(start, *step), control);
  duration = 1.0;
  return true;
}

PushDirectedSampler::PushDirectedSampler(const oc::SpaceInformation* si,
                                         std::shared_ptr<PushSteps> steps)
    : oc::DirectedControlSampler(si),
      space_(space_of(si)),
      controls_(controls_of(si)),
      steps_(std::move(steps)),
      random_(&controls_, steps_) {}

unsigned int PushDirectedSampler::sampleTo(oc::Control* control, const ob::State* source,
                                           ob::State* dest) {
  return sampleTo(control, nullptr, source, dest);
}

unsigned int PushDirectedSampler::sampleTo(oc::Control* control,
                                           const oc::Control* previous,
                                           const ob::State* source, ob::State* dest) {
  const PushState from = space_.read(source);
  const PushState to = space_.read(dest);
  const int preferred = contact_before(controls_, previous, steps_->finish_letter());
  std::optional<PushStep> step;
  if (si_->isValid(dest)) step = steps_->join(from, to, preferred);
  if (!step) step = steps_->closest(from, to);
  if (step) {
    controls_.write(steps_->control_for(from, *step), control);
    space_.write(step->to, dest);
    if (si_->isValid(dest)) return 1;
  }
  for (int i = 0; i < kRandomTries; ++i) {
    random_.sample(control, source);
    if (si_->propagateWhileValid(source, control, 1, dest) == 1) return 1;
  }
  return 0;
}

}  // namespace prehensile
