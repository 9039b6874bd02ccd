/// The parts of a plan between its rolls, as chains whose way-points may be moved.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "planner/steering/chain.h"

namespace prehensile {

/// Straight pushes between two rolls.
struct Stretch {
  FlatState start, end;
  double psi = 0.0;
  std::vector<int> contacts;       // by push, index in SearchModel::contacts
  std::vector<double> way_points;  // x, y of p_OF between the pushes
};

/// False if a push is none of the search.
bool read_stretch(const SearchModel& search, std::span<const PlannedPush> pushes,
                  Stretch& stretch);

/// The chain of a stretch through these way-points, solved; false if there is none.
bool chain_of(const Steering& steering, const Stretch& stretch,
              std::span<const double> way_points, Work& work, Chain& chain);

/// The pushes of a solved chain.
std::vector<PlannedPush> pushes_of(const SearchModel& search, const Stretch& stretch,
                                   const Chain& chain);

/// Lets `change` have the pushes of every part of a plan between its rolls.
void change_stretches(Plan& plan,
                      const std::function<void(std::vector<PlannedPush>&)>& change);

/// Whether a push is by a point: the object turns about it as the pads let it, so that
/// its angle is not for a planner to choose.
bool any_by_point(const SearchModel& search, const Stretch& stretch);

/// Moves the way-points of pushes before which the finger axis has travelled so far [m];
/// false, and leaves them as they are, where that is not possible.
using StretchMender =
    std::function<bool(std::vector<PlannedPush>& pushes, double travelled)>;

/// Lets `mend` have every part of a plan between its rolls of 2 to `most` pushes; whether
/// it mended any.
bool repair_stretches(Plan& plan, std::size_t most, const StretchMender& mend);

}  // namespace prehensile
