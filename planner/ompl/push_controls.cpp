#include "planner/ompl/push_controls.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <ompl/control/spaces/DiscreteControlSpace.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

namespace prehensile {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

constexpr double kPi = std::numbers::pi;

constexpr double kFinishShare = 0.1;  ///< of blind controls: straight to the goal
constexpr double kConeShare = 0.8;    ///< of headings: within the friction cone
constexpr double kRollShare = 0.3;    ///< of controls, for an object that can roll
constexpr int kRedraws = 8;           ///< of headings that cannot stick

using Letter = oc::DiscreteControlSpace;
using Numbers = oc::RealVectorControlSpace;

ob::RealVectorBounds bounds_of(const PushSpace& states, bool rolls) {
  ob::RealVectorBounds bounds(rolls ? 4 : 3);
  const double longest = states.getMaximumExtent();
  bounds.setLow(0, -kPi);
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
  addSubspace(std::make_shared<Letter>(states, 0, steps_->finish_letter()));
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
  PushControl push;
  const int contacts = steps_->finish_letter();
  if (contacts == 0 || rng_.uniform01() < kFinishShare) {
    push.letter = contacts;
    return push;
  }
  push.letter = rng_.uniformInt(0, contacts - 1);
  const StickContact& stick = steps_->search().contacts[push.letter].stick;
  const double width = rng_.uniform01() < kConeShare ? std::atan(stick.mu) : kPi;
  push.heading =
      std::atan2(stick.n.y(), stick.n.x()) + rng_.uniformReal(-1.0, 1.0) * width;
  push.share = rng_.uniform01();
  // Short moves as often as long ones: narrow places need them.
  const double length = rng_.uniform01();
  push.travel = steps_->model().L * length * length;
  if (steps_->model().cross_section && rng_.uniform01() < kRollShare) {
    push.roll = rng_.uniformReal(-kPi, kPi);
  }
  return push;
}

}  // namespace prehensile
