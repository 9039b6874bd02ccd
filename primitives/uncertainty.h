/// What may be off about a push, as a box around the nominal values, and the pushes
/// inside it. Every member of the box is a scene of its own and is solved like any other:
/// nothing is linearised.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "primitives/push.h"

namespace prehensile {

enum class Unknown {
  kFriction,        ///< of the pusher
  kFingerFriction,  ///< of both jaws
  kGripForce,
  kMass,
  kTorqueRadius,  ///< how the pressure spreads: pads larger or smaller about their centre
  kCentreOfMassX,
  kCentreOfMassY,
  kPlace,      ///< [m] of the pusher along the face
  kTravel,     ///< [m] the pusher meets the object late or early
  kDirection,  ///< [rad] of the push
  kGraspX,     ///< [m] of the object in the hand, along x of H
  kGraspY,
  kGraspAngle,  ///< [rad] of the object in the hand, about the finger axis
  kCount
};
inline constexpr int kUnknowns = static_cast<int>(Unknown::kCount);

/// "friction", "grip force", ...
std::string_view name(Unknown unknown);

/// The first five may be given as shares of their nominal values; lengths and angles, of
/// which many are nominally zero, may not.
bool may_be_relative(Unknown unknown);

struct UncertaintyBox {
  std::array<double, kUnknowns> half_width{};  ///< >= 0, [share], [m] or [rad]
  /// For those that may be relative: the half width is in units of the field instead
  /// ([N], [kg], [m], or none).
  std::array<bool, kUnknowns> is_absolute{};

  double& operator[](Unknown unknown) {
    return half_width[static_cast<std::size_t>(unknown)];
  }
  double operator[](Unknown unknown) const {
    return half_width[static_cast<std::size_t>(unknown)];
  }
  /// Those of positive width, in ascending order.
  std::vector<Unknown> active() const;
};

/// What stayed uncertain after a calibration.
UncertaintyBox box_of(const CalibrationRecord& record);

/// A place in the box: each coordinate in [-1, 1] half widths.
using BoxPoint = std::array<double, kUnknowns>;

/// Uniform in the box, the same for the same seed and index; coordinates of width zero
/// are drawn too, so that leaving one unknown out does not change the others.
BoxPoint random_point(std::uint64_t seed, std::uint64_t index);

/// A corner of the active coordinates: bit k of `index` is the sign of the k-th of them.
BoxPoint corner(const UncertaintyBox& box, std::uint64_t index);

/// One member of the box.
struct UncertainPush {
  Scene scene;
  Grasp start;
  Push push;
};

/// The push as it is at this place of the box. Frictions, forces and masses stay positive
/// or zero; a travel that would become negative is zero. The result may be a scene that
/// `check` rejects, where a width is too large for it.
UncertainPush vary(const Scene& scene, const Grasp& start, const Push& push,
                   const UncertaintyBox& box, const BoxPoint& at);

}  // namespace prehensile
