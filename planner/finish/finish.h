/// What becomes of a plan that a search found, until it may be returned.
#pragma once

#include <string>

#include "planner/steering/limits.h"

namespace prehensile {

struct Finished {
  /// Why no version passes, of the plan as it was found; empty if one does.
  std::string fault;
  bool is_repaired = false;  ///< none but a repaired one does
};

/// Polishes a plan, loosens the grip where the scene lets it, and puts it to the exact
/// check: the cheapest version first, as it was found last; then, if all fail, each of
/// them repaired. `plan` becomes the first that passes, off the border of its margin for
/// the share of its cost that the options allow.
Finished finish(const SearchModel& search, const PlanOptions& options,
                const Limits& limits, Work& work, Plan& plan);

}  // namespace prehensile
