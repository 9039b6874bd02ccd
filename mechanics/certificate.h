/// The certificate of an instant: residuals computed from the question and the answer
/// alone. Shares no code with any solver; its rows are derived here again.
///
/// Every entry is dimensionless (units F0, V0, L0, computed here), 0 is
/// perfect, and carries the index of its worst point. Source: paper section VI-A, the
/// entries of the checks below in that order.
#pragma once

#include <array>
#include <string_view>

#include "mechanics/instant.h"

namespace prehensile {

struct CertificateEntry {
  double value = kNan;
  int worst =
      -1;  ///< index of the contact point (pusher points after finger points), or row
};

struct Certificate {
  enum Check {
    kNewton,         ///< balance of wrenches, paper eq. (8)
    kPenetration,    ///< normal forces and normal rates >= 0
    kComplementary,  ///< normal force x normal rate = 0
    kFrictionCone,   ///< |friction| <= mu x normal force, paper eq. (1) with mu^2
    kSlipDirection,  ///< friction opposes slip at full strength, paper eq. (3), (4)
    kDissipation,    ///< friction never gains power
    kPusherMotion,   ///< pusher rates are those prescribed
    kEvidence,       ///< what the status claims is so (DYNAMIC, AMBIGUOUS, HOLDS, ...)
    kCheckCount
  };
  std::array<CertificateEntry, kCheckCount> entries;
  double worst = kNan;  ///< largest entry

  /// With a motion of a quasi-static instant, bounds on the push force [N] in the
  /// direction of the push that was answered (limit analysis): what balanced friction
  /// forces within their cones carry is a lower one, what the motion dissipates an upper
  /// one. They meet where the answer is right; the lower one is sure up to the entry of
  /// kNewton.
  double force_low = kNan;
  double force_high = kNan;

  /// Accepted: every entry finite and at most `tolerance`.
  bool holds(double tolerance = 1e-6) const { return worst <= tolerance; }
};
std::string_view name(Certificate::Check check);

/// Checks an answer. An answer without a motion is accepted only if its evidence is
/// valid; kNotRun, kOutOfIterations, kBadInput and (pads and one flat pusher cannot wedge
/// an object) kJammed are never accepted. The evidence of kDynamic is a twist by which
/// gravity gains more power than the pads take, and against which either no force in the
/// pusher's friction cones works (then nothing can be in balance) or no normal force does
/// (then the object can fall away from the pusher, whose friction alone might hold it).
Certificate certify(const PlanarGrasp& grasp, const PlanarDrive& drive,
                    const PlanarInstant& answer) noexcept;

/// Two-sided bounds on the push force for a given direction of the push wrench p (per
/// unit of force): any twist u with p.u = 1 gives an upper bound. Valid in the
/// quasi-static limit with known finger loads.
double force_upper_bound(const PlanarGrasp& grasp, const PlanarWrench& p,
                         const PlanarTwist& u) noexcept;

/// Whether the fingers alone hold gravity: least slack of D(u) - w_g.u over unit twists
/// u, in units of F0 and pad lever; positive means held. The sign is sure (a convex
/// question); a positive slack is the least of many starts, good to about 1e-3. `worst`
/// receives the minimising twist.
double gravity_slack(const PlanarGrasp& grasp, PlanarTwist* worst = nullptr) noexcept;

/// gravity_slack(grasp) > least, for much less work where that is clear; false if the
/// grasp makes no sense.
bool gravity_slack_exceeds(const PlanarGrasp& grasp, double least) noexcept;

}  // namespace prehensile
