/// The certificate of a spatial instant: residuals computed from the question and the
/// answer alone. Shares no code with any solver; its rows are derived here again, point
/// by point in the hand frame.
///
/// Every entry is dimensionless (units F0, V0, L0, computed here), 0 is perfect, and
/// carries the index of its worst point or row. Source: paper section VI-A, with the
/// foundation in place of rigid contact where a patch has one.
#pragma once

#include <array>
#include <string_view>

#include "mechanics/certificate.h"
#include "mechanics/spatial_instant.h"

namespace prehensile {

struct SpatialCertificate {
  enum Check {
    kNewton,         ///< balance of wrenches, paper eq. (8); and the reported push
    kGripForce,      ///< balance of every jaw rate with its effort, paper eq. (6)
    kPenetration,    ///< normal forces >= 0, gaps do not close (foundation: are not
                     ///< below the floor of their springs; given loads: are met)
    kComplementary,  ///< normal force x gap rate = 0; modes are labelled truly
    kFrictionCone,   ///< |friction| <= mu x normal force, paper eq. (1) with mu^2
    kSlipDirection,  ///< friction opposes slip at full strength, paper eq. (3), (4)
    kDissipation,    ///< friction never gains power
    kPusherMotion,   ///< rates at the pusher follow from its prescribed motion
    kPatchRigidity,  ///< rates at the pads are those of a rigid object, paper eq. (5)
    kEvidence,       ///< what the status claims is so
    kCheckCount
  };
  std::array<CertificateEntry, kCheckCount> entries;
  double worst = kNan;  ///< largest entry

  /// Accepted: every entry finite and at most `tolerance`.
  bool holds(double tolerance = 1e-6) const { return worst <= tolerance; }
};
std::string_view name(SpatialCertificate::Check check);

/// Checks an answer. An answer without a motion is accepted only if its evidence is
/// valid; kNotRun, kOutOfIterations and kBadInput are never accepted.
///
///   with a motion that is not ambiguous, quasi-static: the pads balance gravity without
///               the pusher, by the rest and the forces given
///   kDynamic    the forces and rates given obey all laws of contact, and gravity and
///               the drive of the jaws gain more power than they take: the object falls,
///               whatever its inertia. Not a proof that nothing else is possible.
///   kJammed     the forces given lie in the friction cones, balance each other without
///               gravity and drive, and take power from the pusher: nothing limits them
///   kAmbiguous  a second motion and its forces also obey all laws and balance; or the
///               evidence is such a fall from the pads alone, without the pusher
///   kSeparated, kHolds  the pusher carries nothing, and the object moves by no more
///               than the foundations of the pads yield
///   kNonuniqueForces    the interval holds the force given
SpatialCertificate certify(const SpatialProblem& problem,
                           const SpatialInstant& answer) noexcept;

}  // namespace prehensile
