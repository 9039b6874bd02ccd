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
#include <string>
#include <vector>

#include "planner/pads/local_law.h"
#include "planner/plan.h"

namespace prehensile {

/// Completes a proof of kind kTurn; false if none is found, or `stopped` says so in
/// between, or Ipopt, which finds the functions, is not built. Only for pads with a law
/// at every place of the region, and goals that fix the whole pose. The work is limited.
bool find_turn(const Model& model, Proof& proof, const std::function<bool()>& stopped);

/// What breaks the bounds of a proof.
struct TurnBreaks {
  /// A push that may turn by more than they say, or by less.
  struct Push {
    Vec2 place;  ///< [m]
    DirectionSpan directions;
    double most, least;  ///< c dtheta / |dp_OF| that the laws allow about there
  };
  std::vector<Push> pushes;
  std::vector<Vec2> ends;  ///< [m] places of the goal with an angle between the bounds
};

/// Whether the proof, of kind kTurn, holds: `why` (nullptr: not wanted) says what fails.
/// The places between the regions are covered by squares, which are cut until the laws
/// keep every contact, in every direction, within the bounds. `breaks` (nullptr: not
/// wanted) receives some of what breaks them.
bool verify_turn(const Model& model, const Proof& proof, std::string* why,
                 TurnBreaks* breaks = nullptr);

}  // namespace prehensile
