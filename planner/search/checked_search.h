/// A search, its exact check, and what is tried where that fails. Internal to the
/// planner.
#pragma once

#include <string>

#include "planner/steering/limits.h"

namespace prehensile {

/// What the last search found before anything was checked.
struct Found {
  Plan plan;
  double drift = 0.0;  ///< [m] by how much the ways of the plan carry the finger axis
                       ///< further off than the straight ones that searches count with
  bool is_repaired = false;  ///< what passed the check is the plan repaired
};

/// What a search is for. A part of a margin is asked for where the whole failed with all
/// that is tried here: with double the part nothing is tried again.
enum class Asked { kWholeMargin, kPartOfMargin };

/// A plan that fails its exact check is searched again, first, if points make pushes, as
/// if these did not cost a placement each, then without a look for what is
/// cheaper than the first plan found, if it took its place, then farther from slipping by
/// what its detours carry the finger axis off, then with double the margin, then with
/// less friction than there is, then without one of its contacts. A dear one that passes
/// once it is repaired is searched again once, and the cheaper is kept.
Plan search_and_check(const Model& model, const PlanOptions& options,
                      const Margin& margin, Work& work, Found& found,
                      Asked asked = Asked::kWholeMargin);

/// Empties a plan that fails a check, and says why.
void set_undecided(Plan& plan, std::string message);

}  // namespace prehensile
