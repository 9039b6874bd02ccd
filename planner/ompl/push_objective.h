/// What OMPL's planners minimise, and where they look for something cheaper.
#pragma once

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ProblemDefinition.h>

namespace prehensile {

/// Each motion costs one placement and its travel over L. OMPL 1.5 asks for the cost of
/// two states without the pusher between them, so it cannot see that consecutive pushes
/// share a placement: this is J = S + T / L where every push has its own placement, and
/// above J elsewhere.
class PushObjective : public ompl::base::OptimizationObjective {
 public:
  /// `L` in metres, > 0.
  PushObjective(const ompl::base::SpaceInformationPtr& si, double L);

  ompl::base::Cost stateCost(const ompl::base::State* state) const override;
  ompl::base::Cost motionCost(const ompl::base::State* from,
                              const ompl::base::State* to) const override;

  /// The motion cost itself: no way from one state to another has fewer pushes, or is
  /// shorter.
  ompl::base::Cost motionCostHeuristic(const ompl::base::State* from,
                                       const ompl::base::State* to) const override;

  /// States that may be on a cheaper way, by rejection; any state where some tries find
  /// none. OMPL's own sampler gives up there, and some planners then ask for ever: where
  /// the best plan is a straight line, nothing lies on a cheaper one.
  ompl::base::InformedSamplerPtr allocInformedStateSampler(
      const ompl::base::ProblemDefinitionPtr& definition,
      unsigned int most_tries) const override;

 private:
  double L_;
};

}  // namespace prehensile
