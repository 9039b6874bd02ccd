#include "planner/search/frame.h"

namespace prehensile {

bool frame_is_built() { return false; }

std::vector<std::string> frame_planners() { return {}; }

Plan solve_in_frame(const SearchModel& /*search*/, const Grasp& start,
                    const Goal& /*goal*/, const PlanOptions& options, Work& /*work*/) {
  Plan plan;
  plan.status = PlanStatus::kUnsupported;
  plan.message = "planner " + options.planner + " needs OMPL, which is not built in";
  plan.start = start;
  plan.planner = options.planner;
  return plan;
}

}  // namespace prehensile
