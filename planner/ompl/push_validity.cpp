#include "planner/ompl/push_validity.h"

#include <utility>

#include <ompl/base/SpaceInformation.h>

namespace prehensile {
namespace {

namespace ob = ompl::base;

/// Share of a motion to which bisection locates its last valid state.
constexpr double kLastValidResolution = 1.0 / 1024.0;

const PushSpace& space_of(const ob::SpaceInformation* si) {
  return *si->getStateSpace()->as<PushSpace>();
}

PushState between(const PushState& from, const PushState& to, double share) {
  return {{from.flat.p_OF + share * (to.flat.p_OF - from.flat.p_OF),
           from.flat.theta + share * (to.flat.theta - from.flat.theta)},
          from.psi + share * (to.psi - from.psi)};
}

}  // namespace

PushValidity::PushValidity(const ob::SpaceInformationPtr& si,
                           std::shared_ptr<const PushSteps> steps)
    : ob::StateValidityChecker(si), steps_(std::move(steps)) {}

bool PushValidity::isValid(const ob::State* state) const {
  return si_->satisfiesBounds(state) && steps_->is_valid(space_of(si_).read(state));
}

PushMotionValidator::PushMotionValidator(const ob::SpaceInformationPtr& si,
                                         std::shared_ptr<PushSteps> steps)
    : ob::MotionValidator(si), steps_(std::move(steps)) {}

bool PushMotionValidator::checkMotion(const ob::State* from, const ob::State* to) const {
  const PushSpace& space = space_of(si_);
  const bool valid = steps_->join(space.read(from), space.read(to)).has_value();
  ++(valid ? valid_ : invalid_);
  return valid;
}

bool PushMotionValidator::checkMotion(const ob::State* from, const ob::State* to,
                                      std::pair<ob::State*, double>& last_valid) const {
  if (checkMotion(from, to)) return true;
  const PushSpace& space = space_of(si_);
  const PushState start = space.read(from);
  const PushState end = space.read(to);
  double good = 0.0;
  double bad = 1.0;
  while (bad - good > kLastValidResolution) {
    const double middle = 0.5 * (good + bad);
    (steps_->join(start, between(start, end, middle)) ? good : bad) = middle;
  }
  last_valid.second = good;
  if (last_valid.first != nullptr) {
    space.write(between(start, end, good), last_valid.first);
  }
  return false;
}

}  // namespace prehensile
