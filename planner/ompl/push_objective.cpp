#include "planner/ompl/push_objective.h"

#include <algorithm>
#include <memory>

#include <ompl/base/goals/GoalRegion.h>
#include <ompl/base/samplers/InformedStateSampler.h>

namespace prehensile {
namespace {

namespace ob = ompl::base;

constexpr unsigned kMostTries = 20;

class Sampler : public ob::InformedSampler {
 public:
  Sampler(const ob::ProblemDefinitionPtr& definition, unsigned most_tries)
      : ob::InformedSampler(definition, most_tries),
        states_(definition->getSpaceInformation()->allocStateSampler()) {}

  bool sampleUniform(ob::State* state, const ob::Cost& most) override {
    return sampleUniform(state, opt_->identityCost(), most);
  }

  bool sampleUniform(ob::State* state, const ob::Cost& least,
                     const ob::Cost& most) override {
    for (unsigned i = 0; i < std::min(numIters_, kMostTries); ++i) {
      states_->sampleUniform(state);
      const ob::Cost cost = heuristicSolnCost(state);
      if (opt_->isCostBetterThan(cost, most) && !opt_->isCostBetterThan(cost, least)) {
        break;
      }
    }
    return true;
  }

  bool hasInformedMeasure() const override { return false; }

  double getInformedMeasure(const ob::Cost& /*cost*/) const override {
    return space_->getMeasure();
  }

 private:
  ob::StateSamplerPtr states_;
};

}  // namespace

PushObjective::PushObjective(const ob::SpaceInformationPtr& si, double L)
    : ob::OptimizationObjective(si), L_(L) {
  description_ = "pushes + travel / L";
  setCostToGoHeuristic([L](const ob::State* state, const ob::Goal* goal) {
    const double left = goal->as<ob::GoalRegion>()->distanceGoal(state);
    return ob::Cost(left > 0.0 ? 1.0 + left / L : 0.0);
  });
}

ob::Cost PushObjective::stateCost(const ob::State* /*state*/) const {
  return identityCost();
}

ob::Cost PushObjective::motionCost(const ob::State* from, const ob::State* to) const {
  const double travel = si_->distance(from, to);
  return ob::Cost(travel > 0.0 ? 1.0 + travel / L_ : 0.0);
}

ob::Cost PushObjective::motionCostHeuristic(const ob::State* from,
                                            const ob::State* to) const {
  return motionCost(from, to);
}

ob::InformedSamplerPtr PushObjective::allocInformedStateSampler(
    const ob::ProblemDefinitionPtr& definition, unsigned int most_tries) const {
  return std::make_shared<Sampler>(definition, most_tries);
}

}  // namespace prehensile
