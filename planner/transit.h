/// Ways of the hand from one placement to the next that keep clear of the obstacles of a
/// scene, with the object at rest in it. Internal to the planner.
///
/// The hand moves in the pad plane and along the closing direction. A straight way is
/// linear in x, y, z and the angle; no point of it is left out: a distance at one pose
/// clears the poses after it up to where the fastest point might touch.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/collision_bodies.h"

namespace prehensile {

/// A planar pose of H in W, lifted along z [m]. Its angle is a number.
struct HandPose {
  PlanarPose X_WH;
  double z = 0.0;
};

/// The share s in [0, 1] of a straight way.
HandPose between(const HandPose& from, const HandPose& to, double s);

/// Hand and object as one body among the fixture, for searches.
class TransitRoom {
 public:
  /// Of a scene with obstacles. `model` must outlive it.
  TransitRoom(const Model& model, const PlanarPose& X_HO);

  /// Whether a pose is clear and within the limits of the hand.
  bool admits(const HandPose& pose) const { return is_clear(pose, pose); }

  /// Whether the whole straight way is.
  bool is_clear(const HandPose& from, const HandPose& to) const;

  /// How far from the origin of H hand and object reach [m], at least a millimetre.
  double reach() const { return reach_; }

  /// Where a way around the fixture may lead: a box of places of H with two poses in it.
  struct Box {
    Vec3 low, high;  ///< [m]
  };
  Box box_around(const HandPose& a, const HandPose& b) const;

 private:
  const Model& model_;
  PlanarPose X_HO_;
  CollisionBodies bodies_;
  double clearance_ = 0.0, reach_ = 0.0;
};

/// Where the hand passes, both ends included; straight in between: at once if that is
/// clear, else over the fixture along z, else as OMPL's RRT-Connect finds it (where it
/// is built), shortened. Checked by separating planes (confines_check.h). Nothing if no
/// such way is found. The angle at the end may differ from that of `to` by whole turns.
std::optional<std::vector<HandPose>> find_transit(const Model& model,
                                                  const PlanarPose& X_HO,
                                                  const HandPose& from,
                                                  const HandPose& to, std::uint64_t seed);

/// The last of the ways that find_transit tries; empty if there is none, or OMPL is not
/// built.
std::vector<HandPose> search_transit(const TransitRoom& room, const HandPose& from,
                                     const HandPose& to, std::uint64_t seed);

}  // namespace prehensile
