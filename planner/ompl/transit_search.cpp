#include <memory>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include "planner/arm/transit.h"
#include "planner/ompl/seeded_run.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;

constexpr double kTurn = 6.283185307179586;
constexpr int kMostSteps = 20'000;  // of the planner

/// States are x, y, z and reach x angle, all [m].
using Values = ob::RealVectorStateSpace::StateType;

class HandSpace : public ob::RealVectorStateSpace {
 public:
  HandSpace(const TransitRoom& room, const HandPose& from, const HandPose& to)
      : ob::RealVectorStateSpace(4), reach_(room.reach()) {
    const TransitRoom::Box box = room.box_around(from, to);
    ob::RealVectorBounds bounds(4);
    for (int i = 0; i < 3; ++i) {
      bounds.setLow(i, box.low[i]);
      bounds.setHigh(i, box.high[i]);
    }
    const auto [low, high] = std::minmax(from.X_WH.theta, to.X_WH.theta);
    bounds.setLow(3, reach_ * (low - kTurn));
    bounds.setHigh(3, reach_ * (high + kTurn));
    setBounds(bounds);
  }

  HandPose read(const ob::State* state) const {
    const double* values = state->as<Values>()->values;
    return {{values[0], values[1], values[3] / reach_}, values[2]};
  }

  void write(const HandPose& pose, ob::State* state) const {
    double* values = state->as<Values>()->values;
    values[0] = pose.X_WH.x;
    values[1] = pose.X_WH.y;
    values[2] = pose.z;
    values[3] = reach_ * pose.X_WH.theta;
  }

 private:
  double reach_;
};

class ClearWays : public ob::MotionValidator {
 public:
  ClearWays(const ob::SpaceInformationPtr& si, const TransitRoom& room,
            const HandSpace& space)
      : ob::MotionValidator(si), room_(room), space_(space) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return room_.is_clear(space_.read(from), space_.read(to));
  }

  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    last.second = 0.0;
    if (last.first) si_->copyState(last.first, from);
    return false;
  }

 private:
  const TransitRoom& room_;
  const HandSpace& space_;
};

}  // namespace

std::vector<HandPose> search_transit(const TransitRoom& room, const HandPose& from,
                                     const HandPose& to, std::uint64_t seed) {
  const SeededRun seeded(seed);
  const auto space = std::make_shared<HandSpace>(room, from, to);
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker(
      [&](const ob::State* state) { return room.admits(space->read(state)); });
  si->setMotionValidator(std::make_shared<ClearWays>(si, room, *space));
  si->setup();
  const auto problem = std::make_shared<ob::ProblemDefinition>(si);
  ob::ScopedState<> state(space);
  space->write(from, state.get());
  problem->addStartState(state);
  const auto goals = std::make_shared<ob::GoalStates>(si);
  for (const double turn : {0.0, kTurn, -kTurn}) {
    HandPose goal = to;
    goal.X_WH.theta += turn;
    space->write(goal, state.get());
    if (space->satisfiesBounds(state.get())) goals->addState(state);
  }
  problem->setGoal(goals);
  ompl::geometric::RRTConnect planner(si);
  planner.setProblemDefinition(problem);
  planner.setup();
  int steps = 0;
  planner.solve(
      ob::PlannerTerminationCondition([&steps] { return ++steps > kMostSteps; }));
  std::vector<HandPose> way;
  if (!problem->hasExactSolution()) return way;
  auto* path = problem->getSolutionPath()->as<ompl::geometric::PathGeometric>();
  for (const ob::State* passed : path->getStates()) way.push_back(space->read(passed));
  return way;
}

}  // namespace prehensile
