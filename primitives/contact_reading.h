/// What an instant says about the contact of a push: loads and lifts of its two ends,
/// slip along the pusher, friction; and from them the contact mode and how firmly it
/// holds. Common to the instants in the pad plane and in space. Internal to the
/// primitives layer.
#pragma once

#include <algorithm>
#include <array>

#include "mechanics/instant.h"
#include "primitives/push_record.h"
#include "primitives/seat.h"

namespace prehensile {

/// What the contact does along the pusher.
enum class Regime { kStick, kSlipPlus, kSlipMinus };

/// `kAllMotions` tries every contact mode where the answer need not be unique.
enum class Search { kOneMotion, kAllMotions };

/// The instant in a prescribed contact mode. `kUnknown` where the mode has no motion or
/// the pusher does not advance; `kUnheld` where the pads alone do not hold gravity, so
/// that no push goes on there.
enum class InMode { kMoves, kUnknown, kUnheld };

/// How firmly each part of the present contact mode holds, dimensionless: positive while
/// it holds, through zero where it changes.
struct ModeMargin {
  std::array<double, 2> pressed;  ///< load against lift of each end of a flush line
  double regime = 0.0;            ///< friction left against slip, or the reverse

  double least() const { return std::min({pressed[0], pressed[1], regime}); }
};

struct ContactReading {
  std::array<double, 2> load{0.0, 0.0};  ///< [N] normal, of each end
  std::array<double, 2> lift{0.0, 0.0};  ///< [m] per unit of s
  double slip = 0.0;              ///< [m] per unit of s, of the object along the pusher
  double tilt_rate = 0.0;         ///< [rad] per unit of s
  double normal_force = 0.0;      ///< [N]
  double tangential_force = 0.0;  ///< [N] along t
  double friction = 0.0;          ///< [N] size of the friction force
  double yield = 0.0;  ///< [m] per unit of s by which pads that yield move the contact:
                       ///< no slip and no lift up to there
};

/// Scales and friction of the contact of one push.
struct ContactScales {
  double mu = 0.0;
  double force = 1.0;  ///< [N]
  double speed = 1.0;  ///< [m] per unit of s
};

ContactScales scales_of(const Model& model, const LinearPush& push) noexcept;

ModeMargin margin_of(const ContactReading& reading, const ContactScales& scales,
                     const Seat& seat, Regime regime) noexcept;

Regime regime_of(const ContactReading& reading, const ContactScales& scales) noexcept;

/// Friction on the object opposes its slip; at the onset only the friction can tell, and
/// without friction only the slip.
Regime slip_side_of(const ContactReading& reading, const ContactScales& scales) noexcept;

/// Only where the pusher advances at all its points is the motion of a held grasp known
/// to be unique; a receding point may drag the object along or leave it.
bool recedes_somewhere(const PlanarDrive& drive) noexcept;

/// The part of a sample that the contact and its instant tell.
Sample sample_of(const ContactReading& reading, InstantStatus status,
                 double push_force) noexcept;

/// Forces and moments of an instant under the scene's grip become those under `share` of
/// it.
void scale_forces(double share, Sample& sample) noexcept;

/// Why a push cannot go on with an instant of this status.
PushStop stop_of(InstantStatus status) noexcept;

}  // namespace prehensile
