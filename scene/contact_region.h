/// Where a pad presses: the contact region is pad and object surface together, replaced
/// by points with weights (quadrature, never corner points, which would hold too much
/// torque).
///
/// Flat pad on a flat face: the pad, clipped by the face unless the scene says `ignore`.
/// Flat pad on the curved side of a cylinder: the part of the generator line under the
/// pad. The pressure follows the profile of the scene, uniform unless it says otherwise.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace prehensile {

/// Points of one pad in H; weights are the shares of the normal load and sum to 1.
/// Fixed capacity, no heap: this is rebuilt at every pose of a push.
struct ContactPoints {
  static constexpr int kCapacity = 96;
  int count = 0;  ///< 0: no contact; entries from `count` on are not set
  std::array<double, kCapacity> x;       ///< [m] in H
  std::array<double, kCapacity> y;       ///< [m] in H
  std::array<double, kCapacity> weight;  ///< > 0, sum 1
  double coverage = 0.0;  ///< share of the full contact region that presses, 0..1
};

class PadDensity;
struct PadCell;
struct Triangle;

/// A pad and a surface compiled for repeated evaluation.
class ContactRegion {
 public:
  /// `points`: points of an unclipped pad; one of 1, 4, 8, 16, 32, 64 (clipped pads may
  /// use more, up to the capacity).
  ContactRegion(const Scene& scene, int points);
  ContactRegion(const ContactRegion&);
  ContactRegion(ContactRegion&&) noexcept;
  ContactRegion& operator=(const ContactRegion&);
  ContactRegion& operator=(ContactRegion&&) noexcept;
  ~ContactRegion();

  /// Points at this pose; no heap, no exceptions.
  ContactPoints at(const PlanarPose& X_HO) const noexcept;

  /// The points of the unclipped pad on a flat face.
  const ContactPoints& whole() const { return whole_; }

  /// The same points in the same places of H at every pose (flat face, `ignore`).
  bool is_fixed_in_hand() const { return fixed_in_hand_; }

  /// Disc pad on a flat face: while it is whole its friction does not depend on the
  /// angle.
  bool is_isotropic() const { return isotropic_; }

  /// The pad lies wholly on the face at this pose, so `at` equals the full pad.
  bool is_whole(const PlanarPose& X_HO) const noexcept;

  /// How far the finger axis may move before the pad begins to overhang [m]; negative
  /// where it does overhang: how far it has to move back. Infinite if it never does. It
  /// changes by no more than the finger axis moves.
  double whole_margin(const PlanarPose& X_HO) const noexcept;

  /// Torque radius of the whole region: largest torque about the finger axis over
  /// (friction x normal load), by the points themselves [m].
  double torque_radius() const { return torque_radius_; }

 private:
  ContactPoints clipped_by_face(const PlanarPose& X_HO) const noexcept;
  ContactPoints along_generator(const PlanarPose& X_HO) const noexcept;

  Pad pad_;
  std::shared_ptr<const PadDensity> density_;  // never changes
  ContactPoints whole_;
  std::vector<Vec2> outline_;     // in O
  std::vector<Triangle> pieces_;  // of the outline, in O; empty unless the face clips
  std::vector<PadCell> cells_;    // of the pad, in H; empty unless the face clips
  double pad_reach_ = 0.0;        // [m] farthest pad point from the finger axis
  bool clips_ = false;
  bool convex_ = false;              // the outline, where the face clips
  bool round_side_ = false;          // the pads hold the curved side of a cylinder
  Vec2 generator_a_ = Vec2::Zero();  // ends of the generator line in O
  Vec2 generator_b_ = Vec2::Zero();
  int points_ = 16;
  bool fixed_in_hand_ = false;
  bool isotropic_ = false;
  double torque_radius_ = 0.0;
};

}  // namespace prehensile
