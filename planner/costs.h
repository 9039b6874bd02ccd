/// What plans cost.
///
/// J = S + a T / L + b W + g G, with placements S and travel T as in plan.h, W [J] what
/// the friction of the pads takes, G how often the grip force changes, and the prices
/// a, b, g of the scene (scene/cost_weights.h); J = S + T / L where it states none.
///
/// While a push sticks, pusher and object stand still to each other, so gravity does no
/// work, and the arm's work is that of the pads' friction. Over pads whose limit surface
/// is the ellipsoid this is F T: work is travel, priced by the grip. So a search for S +
/// T / (one length) covers it, and what other pads add to F T is counted afterwards.
#pragma once

#include <cmath>
#include <vector>

#include "planner/plan.h"

namespace prehensile {

CostWeights prices(const Model& model);

/// Travel that costs as much as one placement [m], its work F T included: what searches
/// minimise with. The same for every grip force.
inline double placement_length(const Model& model) noexcept {
  if (!model.scene.cost) return model.L;
  const CostWeights& price = *model.scene.cost;
  return model.L / (price.travel + price.work * model.F * model.L);
}

/// J of so many placements and one straight way in (p_OF, c theta), of which `length` [m]
/// is in the pad plane and `turn` [rad]: no pushes that go and turn as far cost less.
inline double straight_cost(const Model& model, int placements, double length,
                            double turn) noexcept {
  return placements + std::hypot(length, model.c * turn) / placement_length(model);
}

/// At least as long as the travel of any plan that costs one placement [m]: for bounds.
/// Counts work only where no pose or grip force makes it less than so much per travel.
double longest_placement_length(const Model& model) noexcept;

/// What the friction of the pads takes along a push, by the straight way in (p_OF, theta)
/// from its start to its end [J], loaded as at rest; in a roll, what the support gives to
/// both jaws, NaN where the object would not roll.
double friction_work(const Model& model, const PlannedPush& push) noexcept;

/// While the hand goes from a push to the next, or to the first or away from the last
/// [N]: that of the scene, or of a push beside the way if that is greater. `push`: index
/// of the next, 0..size. Rolls count with the scene's: a support carries what they
/// loosen.
double grip_force_on_way(const Model& model, const std::vector<PlannedPush>& pushes,
                         std::size_t push);

/// The greatest of these, over the scene's grip force: at least 1.
double greatest_grip_share(const Model& model);

/// Changes of the grip force on the way between two pushes, either of which may be
/// missing, and at its ends.
int grip_changes_on_way(const Model& model, const Push* before, const Push* after);

/// From the grip on the way to the first push to that on the way from the last.
int grip_changes(const Model& model, const std::vector<PlannedPush>& pushes);

/// Whether a push needs no new placement of the pusher after another.
bool same_placement(const Push& push, const Push& before);

/// Fills S, T, W, G, J and the published cost from the pushes.
void account(const Model& model, Plan& plan);

}  // namespace prehensile
