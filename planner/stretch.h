/// The parts of a plan between its rolls, as chains whose way-points may be moved.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "planner/chain.h"

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

}  // namespace prehensile
