#include "planner/ompl/push_controls.h"

#include <cmath>
#include <utility>

#include <ompl/control/spaces/DiscreteControlSpace.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include "scene/constants.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

constexpr double kFinishShare = 0.1;  ///< of steered controls: straight to the goal
constexpr double kAimShare = 0.4;     ///< of these: to a random state
constexpr double kRollShare = 0.3;    ///< of controls, for an object that can roll
constexpr int kRedraws = 8;           ///< of headings that cannot stick

using Letter = oc::DiscreteControlSpace;
using Numbers = oc::RealVectorControlSpace;

ob::RealVectorBounds bounds_of(const PushSpace& states, bool rolls) {
  ob::RealVectorBounds bounds(rolls ? 4 : 3);
  const double longest = states.getMaximumExtent();
  bounds.setLow(0, -kPi);  // also holds places [m] of aims, far smaller
  bounds.setHigh(0, kPi);
  bounds.setLow(1, 0.0);
  bounds.setHigh(1, 1.0);
  bounds.setLow(2, 0.0);
  bounds.setHigh(2, longest);
  if (rolls) {
    bounds.setLow(3, -2.0 * kPi);
    bounds.setHigh(3, 2.0 * kPi);
  }
  return bounds;
}

}  // namespace

PushControlSpace::PushControlSpace(const std::shared_ptr<PushSpace>& states,
                                   std::shared_ptr<PushSteps> steps)
    : oc::CompoundControlSpace(states),
      states_(states),
      steps_(std::move(steps)),
      rolls_(steps_->model().cross_section.has_value()) {
  setName("PushControlSpace");
  const ob::RealVectorBounds bounds = bounds_of(*states, rolls_);
  const auto numbers =
      std::make_shared<Numbers>(states, static_cast<unsigned>(bounds.low.size()));
  numbers->setBounds(bounds);
  addSubspace(std::make_shared<Letter>(states, 0, steps_->aim_letter()));
  addSubspace(numbers);
  lock();
}

PushControl PushControlSpace::read(const oc::Control* control) const {
  const auto* compound = control->as<oc::CompoundControl>();
  const double* numbers = compound->as<Numbers::ControlType>(1)->values;
  return {.letter = compound->as<Letter::ControlType>(0)->value,
          .heading = numbers[0],
          .share = numbers[1],
          .travel = numbers[2],
          .roll = rolls_ ? numbers[3] : 0.0};
}

void PushControlSpace::write(const PushControl& from, oc::Control* control) const {
  auto* compound = control->as<oc::CompoundControl>();
  compound->as<Letter::ControlType>(0)->value = from.letter;
  double* numbers = compound->as<Numbers::ControlType>(1)->values;
  numbers[0] = from.heading;
  numbers[1] = from.share;
  numbers[2] = from.travel;
  if (rolls_) numbers[3] = from.roll;
}

oc::ControlSamplerPtr PushControlSpace::allocDefaultControlSampler() const {
  return std::make_shared<PushControlSampler>(this, steps_);
}

PushControlSampler::PushControlSampler(const PushControlSpace* space,
                                       std::shared_ptr<PushSteps> steps)
    : oc::ControlSampler(space), controls_(*space), steps_(std::move(steps)) {}

void PushControlSampler::sample(oc::Control* control) {
  controls_.write(drawn(), control);
}

void PushControlSampler::sample(oc::Control* control, const ob::State* state) {
  const PushState from = controls_.states().read(state);
  PushControl push = drawn();
  if (steps_->meaning() == ControlMeaning::kBlind) return controls_.write(push, control);
  for (int i = 0; i < kRedraws && !steps_->may_stick(from, push); ++i) push = drawn();
  controls_.write(push, control);
}

void PushControlSampler::sampleNext(oc::Control* control, const oc::Control*) {
  sample(control);
}

void PushControlSampler::sampleNext(oc::Control* control, const oc::Control*,
                                    const ob::State* state) {
  sample(control, state);
}

PushControl PushControlSampler::drawn() {
  PushControl push = steps_->meaning() == ControlMeaning::kBlind ? blind() : steered();
  const bool rolls = steps_->model().cross_section && push.letter != steps_->aim_letter();
  if (rolls && uniform() < kRollShare) push.roll = rng_.uniformReal(-kPi, kPi);
  return push;
}

PushControl PushControlSampler::steered() {
  const int contacts = steps_->finish_letter();
  if (contacts == 0 || uniform() < kFinishShare) return {.letter = contacts};
  if (uniform() < kAimShare) return aim();
  return steps_->random_push(steps_->model().L, [this] { return uniform(); });
}

PushControl PushControlSampler::aim() {
  const ob::RealVectorBounds& bounds = controls_.states().getBounds();
  const auto coordinate = [&](unsigned axis) {
    return rng_.uniformReal(bounds.low[axis], bounds.high[axis]);
  };
  PushControl push{.letter = steps_->aim_letter()};
  push.heading = coordinate(0);
  push.share = coordinate(1);
  push.travel = coordinate(2);
  return push;
}

PushControl PushControlSampler::blind() {
  PushControl push;
  if (steps_->finish_letter() == 0) return push;
  push.letter = rng_.uniformInt(0, steps_->finish_letter() - 1);
  push.heading = rng_.uniformReal(-kPi, kPi);
  push.share = uniform();
  push.travel = steps_->model().L * uniform();
  return push;
}

}  // namespace prehensile
