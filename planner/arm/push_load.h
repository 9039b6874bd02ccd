/// What the held object bears, at rest and along a planned push: where its weight hangs
/// in the hand, and the force of the pusher. Internal to the planner.
#pragma once

#include <vector>

#include "planner/plan.h"
#include "primitives/roll_load.h"

namespace prehensile {

/// In H.
struct HeldLoad {
  Vec3 p_HCom = Vec3::Zero();  ///< [m] centre of mass of the object
  Vec3 p_HP = Vec3::Zero();    ///< [m] where the pusher's force acts
  Vec3 f_H = Vec3::Zero();     ///< [N] the pusher's force on the object
};

HeldLoad load_at_rest(const Model& model, const PlanarPose& X_HO);

/// Along one push, by the mechanics that it was planned with.
class PushLoads {
 public:
  /// The hand is at the height z_WH when the push begins. Keeps references.
  PushLoads(const Model& model, const PlannedPush& planned, double z_WH);

  /// After the share s in [0, 1] of the push.
  HeldLoad at(double s) const;

 private:
  const PushContact& contact() const;
  HeldLoad of_push(double s) const;
  HeldLoad of_roll(double s) const;

  const Model& model_;
  const PlannedPush& planned_;
  double z_WH_;
  std::vector<RollLoad> rolling_;  // empty unless it rolls
};

}  // namespace prehensile
