/// The motion cone of a pusher where the loads of the pads shift: no closed form carries
/// over, so its border is found by spatial instants.
#pragma once

#include <optional>
#include <vector>

#include "primitives/motion_cone.h"

namespace prehensile {

struct SpatialVerdict {
  bool is_known = false;  ///< the instant has one answer
  double margin = -1.0;   ///< >= 0: sticks; dimensionless, through zero at the border
};

/// Whether the object follows the pusher that moves as in `sticks`, by the spatial
/// instant with the real pads; up to what these yield (spatial_push_instant.h). A motion
/// that leaves the pad plane is not followed. No heap.
SpatialVerdict sticks_in_space(const Model& model, const Grasp& grasp, int contact,
                               double place, double direction,
                               double omega_per_speed) noexcept;

/// One member of a box of uncertainty, compiled for spatial instants.
struct SpaceMember {
  Model model;
  Grasp grasp;
  double place = 0.0;
  double turned = 0.0;  ///< [rad] error of the direction of the push
};

/// The member of the box around a straight push with this contact and place; none where
/// the scene is none, the pads are off the object or have no friction.
std::optional<SpaceMember> space_member(const Model& model, const Grasp& grasp,
                                        int contact, double place,
                                        const UncertaintyBox& box, const BoxPoint& at);

/// `sticks_in_space` with the member's errors.
SpatialVerdict sticks_in_space(const SpaceMember& member, int contact, double direction,
                               double omega_per_speed) noexcept;

/// The cone of space with the slices of that of the pad plane. The robust part is what of
/// the nominal one sticks with every member; edges of it are found to 1e-6 rad, and every
/// edge of a range sticks with all. Of more than four ranges of rates of turn in one
/// direction the widest are kept. Ranges and gaps narrower than a degree of
/// atan(c omega / speed) may be missed, and gaps that a member leaves within a range.
/// A second or so, and for each hundred members as much again.
MotionCone cone_in_space(const Model& model, const Grasp& grasp, int contact,
                         double place, const MotionCone& flat,
                         const std::vector<SpaceMember>& members = {});

}  // namespace prehensile
