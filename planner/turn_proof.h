/// Turns that no way to the goal makes: the object gets to the goal's place, and not at
/// its angle. Internal to the planner.
///
/// What sticks has, at each place of the finger axis, a rate of turn c dtheta / |dp_OF|
/// for each direction, with bounds that hold at every angle (local_law.h). On a way that
/// is known to stay in some region of places, two functions of the place, whose gradients
/// bound the rate, bound its turn from both sides. The region is what two others leave:
/// one that holds the start and is never left, and one, also never left, that does not
/// hold the goal.
#pragma once

#include <functional>

#include "planner/plan.h"

namespace prehensile {

/// Completes a proof of kind kTurn; false if none is found, or `stopped` says so in
/// between, or Ipopt, which finds the functions, is not built. Only for pads with a law
/// at every place of the region, and goals that fix the whole pose. The work is limited.
bool find_turn(const Model& model, Proof& proof, const std::function<bool()>& stopped);

/// Whether the proof, of kind kTurn, holds: `why` (nullptr: not wanted) says what fails.
/// The places between the regions are covered by squares, which are cut until the laws
/// keep every contact, in every direction, within the bounds.
bool verify_turn(const Model& model, const Proof& proof, std::string* why);

}  // namespace prehensile
