/// What may be off about a push, as a box around the nominal values, and the pushes
/// inside it. Every member of the box is a scene of its own and is solved like any other:
/// nothing is linearised.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "mechanics/sticking.h"
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
  kTilt,  ///< [rad] of the pushers in the world: the object, flush with a pusher, stands
          ///< otherwise against gravity and against the motion of the hand
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

/// The small errors that are meant if nothing else is said, as shares: friction of the
/// pushers 0.10, of the fingers 0.05, grip force 0.03, mass 0.01, torque radius 0.10; and
/// centre of mass 0.7 mm, pusher 1 mm and 0.5 deg, object in the hand 0.5 mm.
UncertaintyBox usual_box();

/// The scene's own uncertainty as a box: half widths, or of a normal distribution as many
/// standard deviations as it says; zero if the scene states none.
UncertaintyBox box_of(const Scene& scene);

/// The widths as stated: standard deviations where the distribution is normal.
UncertaintyBox stated_box(const Scene& scene);

/// The margin of the stick tests that covers every member of a box: a push with robust
/// slack >= 0 over it sticks for all of them. Exact intervals where the tests are
/// monotone (friction; weight over friction force, from the corners of mass, grip and
/// finger friction), else a disc or an angle around the box. kTravel and kGraspAngle ask
/// for nothing: neither enters the tests of a disc. A friction force that may vanish
/// gives an infinite margin, which nothing survives.
Margin margin_of(const Model& model, const UncertaintyBox& box);

/// What plans survive if nothing else is said: the usual box. Over soft points its torque
/// radius is uncertain by 20 %: they stand for pads whose limit surface is an ellipsoid
/// only nearly. An even disc of the same torque radius c, say, has the moment over force
/// of an ellipsoid of 0.75 c where it turns slowly and of 1.22 c where it spins.
Margin usual_margin(const Model& model);

/// A place in the box: each coordinate in [-1, 1] half widths.
using BoxPoint = std::array<double, kUnknowns>;

/// Uniform in the box, the same for the same seed and index; coordinates of width zero
/// are drawn too, so that leaving one unknown out does not change the others.
BoxPoint random_point(std::uint64_t seed, std::uint64_t index);

/// The same with a normal distribution of deviation 1 in every coordinate (Box, Muller
/// 1958).
BoxPoint random_normal_point(std::uint64_t seed, std::uint64_t index);

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

/// The contact of a varied scene that stands for one of the nominal: the same pusher,
/// face and grip force, or the scene's own where no other is tried; or -1.
int counterpart(const Model& nominal, int contact, const Model& varied) noexcept;

}  // namespace prehensile
