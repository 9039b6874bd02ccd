/// What a way of the finger axis across the object costs in travel, whichever contacts
/// push it: deep in a stem every contact turns the object a lot for each millimetre.
/// Internal to the planner.
///
/// The object is cut into slabs across a direction u. A way between two sides of a slab
/// advances by its width at least, and pays for each u.dp the least that any contact asks
/// anywhere in the slab, by the laws of single instants (local_law.h), so that
///     T >= share c dtheta + sum over slabs of width x least (dT - share c dtheta) / u.dp
/// for every share in (-1, 1). That least is bounded from below by branch and bound over
/// places, directions of motion and contacts.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "planner/bounds/run_bound.h"
#include "planner/pads/local_law.h"

namespace prehensile {

class SlabTravel {
 public:
  /// Of plans that survive a margin. `model` must outlive it.
  SlabTravel(const Model& model, const Margin& margin) : model_(model), margin_(margin) {}

  /// The law of single instants, made when it is first asked for.
  const LocalLaw& law();

  /// Least travel [m] of plans that carry the finger axis from one place to one of others
  /// while the object turns by between two angles [rad]; 0 where the local law is not
  /// known. Remembers what it found out about slabs, up to a tenth of a millisecond each.
  double least(const Vec2& from, const GoalArc& to, double turn_low, double turn_high);

 private:
  static constexpr int kWays = 8;    // directions of u
  static constexpr int kShares = 5;  // of the turn

  /// Slabs of one width across one way, with their costs for each share; NaN: unknown.
  struct Slabs {
    Vec2 u;
    double low = 0.0, width = 0.0;  // [m] u.p of where the first begins; width of each
    int steps = 0;                  // of the branch and bound, for one cost
    std::vector<std::array<double, kShares>> costs;
  };

  Slabs slabs_across(const Vec2& u, int count, int steps) const;
  double cost_of(Slabs& slabs, int index, int share) const;
  double least_along(Slabs& slabs, int share, const Vec2& from, const GoalArc& to,
                     double turn_low, double turn_high) const;

  void prepare_slabs();

  const Model& model_;
  Margin margin_;
  std::optional<LocalLaw> law_;  // from the first question on
  bool has_slabs_ = false;
  std::array<Slabs, kWays> coarse_, fine_;
};

}  // namespace prehensile
