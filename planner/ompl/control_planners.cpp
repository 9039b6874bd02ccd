#include <array>
#include <memory>
#include <utility>

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/control/planners/est/EST.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/pdst/PDST.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/control/planners/syclop/GridDecomposition.h>
#include <ompl/control/planners/syclop/SyclopEST.h>
#include <ompl/control/planners/syclop/SyclopRRT.h>

#include "planner/ompl/stock_planners.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

constexpr int kPlaneDimensions = 2;

/// Equal cells over the places of the finger axis; the rotation is left to the planner.
class PlaceGrid : public oc::GridDecomposition {
 public:
  PlaceGrid(int cells, const ob::RealVectorBounds& bounds)
      : oc::GridDecomposition(cells, kPlaneDimensions, bounds) {}

  void project(const ob::State* state, std::vector<double>& place) const override {
    const double* q = values(state);
    place.assign(q, q + kPlaneDimensions);
  }

  void sampleFullState(const ob::StateSamplerPtr& sampler,
                       const std::vector<double>& place,
                       ob::State* state) const override {
    sampler->sampleUniform(state);
    std::copy(place.begin(), place.end(), values(state));
  }

 private:
  static double* values(ob::State* state) {
    return state->as<ob::RealVectorStateSpace::StateType>()->values;
  }
  static const double* values(const ob::State* state) {
    return state->as<ob::RealVectorStateSpace::StateType>()->values;
  }
};

template <typename Planner>
ob::PlannerPtr make(const PushProblem& problem, int /*cells*/) {
  return std::make_shared<Planner>(problem.space_information());
}

template <typename Planner>
ob::PlannerPtr make_over_grid(const PushProblem& problem, int cells) {
  const ob::RealVectorBounds& all = problem.space().getBounds();
  ob::RealVectorBounds bounds(kPlaneDimensions);
  for (unsigned axis = 0; axis < kPlaneDimensions; ++axis) {
    bounds.setLow(axis, all.low[axis]);
    bounds.setHigh(axis, all.high[axis]);
  }
  return std::make_shared<Planner>(problem.space_information(),
                                   std::make_shared<PlaceGrid>(cells, bounds));
}

using Make = ob::PlannerPtr (*)(const PushProblem&, int);

constexpr std::array<std::pair<const char*, Make>, 7> kControl{
    {{"RRT", make<oc::RRT>},
     {"SST", make<oc::SST>},
     {"EST", make<oc::EST>},
     {"KPIECE1", make<oc::KPIECE1>},
     {"PDST", make<oc::PDST>},
     {"SyclopRRT", make_over_grid<oc::SyclopRRT>},
     {"SyclopEST", make_over_grid<oc::SyclopEST>}}};

}  // namespace

ob::PlannerPtr make_control(const std::string& algorithm, const PushProblem& problem,
                            int cells) {
  for (const auto& [name, make] : kControl) {
    if (name == algorithm) return make(problem, cells);
  }
  return nullptr;
}

}  // namespace prehensile
