/// Which states and motions OMPL may use.
#pragma once

#include <memory>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/StateValidityChecker.h>

#include "planner/ompl/push_space.h"

namespace prehensile {

/// Valid: finite (a refused control is not), within the bounds, pads on the object,
/// gravity held.
class PushValidity : public ompl::base::StateValidityChecker {
 public:
  PushValidity(const ompl::base::SpaceInformationPtr& si,
               std::shared_ptr<const PushSteps> steps);
  bool isValid(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const PushSteps> steps_;
};

/// A motion is valid if one push does it, exactly and not by sampling: directed, for a
/// push cannot be undone by pushing back. Each check counts as one propagation.
class PushMotionValidator : public ompl::base::MotionValidator {
 public:
  PushMotionValidator(const ompl::base::SpaceInformationPtr& si,
                      std::shared_ptr<PushSteps> steps);

  bool checkMotion(const ompl::base::State* from,
                   const ompl::base::State* to) const override;

  /// last_valid: how far along the straight motion the last state lies that one push
  /// reaches, by bisection: the beginning of a sticking push is a sticking push.
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  std::shared_ptr<PushSteps> steps_;
};

}  // namespace prehensile
