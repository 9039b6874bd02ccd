/// What a status claims, checked. Part of the certificate: shares no code with the
/// solvers. Internal to the mechanics layer.
#pragma once

#include "mechanics/instant.h"
#include "mechanics/violation.h"

namespace prehensile {

inline constexpr double kFails = 1.0;     ///< violation by a claim that is plainly false
inline constexpr double kClaimed = 1e-9;  ///< tolerance of inequalities in claims
inline constexpr double kAtRest = 1e-7;   ///< rates below this count as sticking

/// What an answer without inertia claims about rest and motion while the grasp holds
/// gravity: `size` of its twist, and units of force and rate.
double motion_claim_violation(const PlanarDrive& drive, const PlanarInstant& answer,
                              double size, double force, double rate);

/// A label of a pusher point that contradicts the numbers it stands for.
double mislabelled(const PusherPoint& point, double normal, double opening, double slip);

/// Units in which errors are judged. The length is the lever of the pads; but not less
/// than a thousandth of the distance to the pusher, where rounding would show.
struct CertificateUnits {
  bool sane = false;           ///< the question makes sense
  Vec2 centre = Vec2::Zero();  ///< [m] moments are judged about this point
  double lever = 0.0;          ///< [m] mean lever of the pads
  double length = 0.0;         ///< [m]
  double force = 0.0;          ///< [N]
  double rate = 0.0;           ///< [m/s] (or [m/s^2])

  Vec3 scaled_wrench(const PlanarWrench& w) const;  ///< about the centre
  Vec3 scaled_twist(const PlanarTwist& V) const;
  PlanarTwist twist(const Vec3& scaled) const;  ///< undoes scaled_twist
};
/// Units of the pads alone; the rate is 1.
CertificateUnits pad_units(const PlanarGrasp& grasp);
CertificateUnits certificate_units(const PlanarGrasp& grasp, const PlanarDrive& drive);

/// Power that the pads take at twist u [N m/s].
double friction_power(const PlanarGrasp& grasp, const PlanarTwist& u);

/// How far the object with this twist is from being in balance, over all forces that
/// pusher and fingers may exert at it; units of force. `normal_sum` >= 0 also prescribes
/// the sum of the pusher's normal forces [N].
double motion_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                        const PlanarTwist& V_HO, const CertificateUnits& units,
                        double normal_sum = -1.0);

/// 0 if the claim of the status is true, otherwise how badly it fails.
///   moves, holds, separated, non-unique forces: the pads hold gravity (quasi-static),
///     and the object does or does not move as claimed; the ends of a force interval can
///     occur
///   ambiguous: `other` is another motion, or `evidence` a twist by which gravity gains
///     at least as much power as the pads take
///   dynamic: `evidence` is a twist by which gravity gains more power than the pads take,
///     and against which the pusher cannot work: either no force of its friction cones
///     does (then nothing is in balance), or the twist parts from the pusher (then the
///     object can fall away, although friction at the pusher might hold it for a while)
double evidence_violation(const PlanarGrasp& grasp, const PlanarDrive& drive,
                          const PlanarInstant& answer, const CertificateUnits& units);

}  // namespace prehensile
