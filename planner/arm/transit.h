/// Ways of the hand from one placement to the next, with the object at rest in it: clear
/// of the obstacles of a scene, within the limits of the hand, and the grasp alone holds
/// the object in every attitude that it is turned to. Internal to the planner.
///
/// The hand moves in the pad plane and along the closing direction. No point of a
/// straight way is left out: a distance at one pose clears the poses after it up to where
/// the fastest point might touch.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/obstacles/collision_bodies.h"
#include "planner/obstacles/hand_pose.h"

namespace prehensile {

/// What searches ask of hand and object on their way.
class TransitRoom {
 public:
  /// `model` must outlive it.
  TransitRoom(const Model& model, const HeldObject& held);

  /// Whether a pose is allowed.
  bool admits(const HandPose& pose) const { return is_clear(pose, pose); }

  /// Whether the whole straight way is. Gravity is looked at every few degrees.
  bool is_clear(const HandPose& from, const HandPose& to) const;

  /// How far from the origin of H hand and object reach [m], at least a millimetre.
  double reach() const { return reach_; }

  /// Where a way around the fixture may lead: a box of places of H with two poses in it.
  struct Box {
    Vec3 low, high;  ///< [m]
  };
  Box box_around(const HandPose& a, const HandPose& b) const;

 private:
  bool stays_within_limits(const HandPose& from, const HandPose& to) const;
  bool holds(const HandPose& from, const HandPose& to) const;
  bool keeps_clear(const HandPose& from, const HandPose& to) const;

  const Model& model_;
  HeldObject held_;
  CollisionBodies bodies_;
  double clearance_ = 0.0, reach_ = 0.0;
};

/// Where the hand passes, both ends included; straight in between: at once if that is
/// allowed, else over the fixture along z, else as OMPL's RRT-Connect finds it (where it
/// is built), shortened. Checked by other code (transit_is_clear). Nothing if no such way
/// is found. The angle at the end may differ from that of `to` by whole turns.
std::optional<std::vector<HandPose>> find_transit(const Model& model,
                                                  const HeldObject& held,
                                                  const HandPose& from,
                                                  const HandPose& to, std::uint64_t seed);

/// The last of the ways that find_transit tries; empty if there is none, or OMPL is not
/// built.
std::vector<HandPose> search_transit(const TransitRoom& room, const HandPose& from,
                                     const HandPose& to, std::uint64_t seed);

}  // namespace prehensile
