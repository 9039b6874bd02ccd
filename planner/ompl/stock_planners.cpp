#include "planner/ompl/stock_planners.h"

#include <array>
#include <memory>

#include <ompl/control/planners/est/EST.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

namespace prehensile {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

/// Steering reaches a wanted goal exactly, so trying the goal often pays.
constexpr double kGoalBias = 0.2;

ob::PlannerPtr make_rrt(const PushProblem& problem) {
  const auto planner = std::make_shared<oc::RRT>(problem.space_information());
  planner->setGoalBias(kGoalBias);
  return planner;
}

ob::PlannerPtr make_est(const PushProblem& problem) {
  const auto planner = std::make_shared<oc::EST>(problem.space_information());
  planner->setGoalBias(kGoalBias);
  planner->setRange(0.5 * problem.steps()->model().L);
  return planner;
}

ob::PlannerPtr make_kpiece(const PushProblem& problem) {
  return std::make_shared<oc::KPIECE1>(problem.space_information());
}

ob::PlannerPtr make_sst(const PushProblem& problem) {
  const double L = problem.steps()->model().L;
  const auto planner = std::make_shared<oc::SST>(problem.space_information());
  planner->setSelectionRadius(0.04 * L);
  planner->setPruningRadius(0.015 * L);
  return planner;
}

ob::PlannerPtr make_rrt_connect(const PushProblem& problem) {
  const auto planner =
      std::make_shared<ompl::geometric::RRTConnect>(problem.space_information());
  planner->setRange(problem.steps()->model().L);
  return planner;
}

struct Stock {
  const char* name;
  ob::PlannerPtr (*make)(const PushProblem&);
};

constexpr std::array<Stock, 5> kStock{{{"rrt", make_rrt},
                                       {"est", make_est},
                                       {"kpiece1", make_kpiece},
                                       {"sst", make_sst},
                                       {"rrtconnect", make_rrt_connect}}};

}  // namespace

std::vector<std::string> stock_planner_names() {
  std::vector<std::string> names;
  names.reserve(kStock.size());
  for (const Stock& stock : kStock) names.emplace_back(stock.name);
  return names;
}

ob::PlannerPtr make_stock_planner(const std::string& name, const PushProblem& problem) {
  for (const Stock& stock : kStock) {
    if (name != stock.name) continue;
    ob::PlannerPtr planner = stock.make(problem);
    planner->setProblemDefinition(problem.definition());
    planner->setup();
    return planner;
  }
  return nullptr;
}

bool improves_until_stopped(const std::string& name) { return name == "sst"; }

}  // namespace prehensile
