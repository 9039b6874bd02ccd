#include <array>
#include <memory>
#include <utility>

#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>

#include "planner/ompl/stock_planners.h"

namespace prehensile {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

template <typename Planner>
ob::PlannerPtr make(const ob::SpaceInformationPtr& si) {
  return std::make_shared<Planner>(si);
}

using Make = ob::PlannerPtr (*)(const ob::SpaceInformationPtr&);

constexpr std::array<std::pair<const char*, Make>, 11> kGeometric{
    {{"RRT", make<og::RRT>},
     {"RRTConnect", make<og::RRTConnect>},
     {"RRTstar", make<og::RRTstar>},
     {"InformedRRTstar", make<og::InformedRRTstar>},
     {"LBTRRT", make<og::LBTRRT>},
     {"BITstar", make<og::BITstar>},
     {"ABITstar", make<og::ABITstar>},
     {"AITstar", make<og::AITstar>},
     {"FMT", make<og::FMT>},
     {"EST", make<og::EST>},
     {"KPIECE1", make<og::KPIECE1>}}};

}  // namespace

ob::PlannerPtr make_geometric(const std::string& algorithm, const PushProblem& problem) {
  for (const auto& [name, make] : kGeometric) {
    if (name == algorithm) return make(problem.space_information());
  }
  return nullptr;
}

}  // namespace prehensile
