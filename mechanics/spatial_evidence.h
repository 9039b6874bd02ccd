/// Units, rates and powers of the spatial certificate. Shares no code with the solvers.
/// Internal to the mechanics layer.
#pragma once

#include "mechanics/spatial_instant.h"

namespace prehensile {

/// Units in which errors are judged.
struct SpatialCertificateUnits {
  bool sane = false;
  Vec3 centre = Vec3::Zero();  ///< [m] moments are judged about this point
  double length = 0.0;         ///< [m]
  double force = 0.0;          ///< [N]
  double rate = 0.0;           ///< [m/s] (or [m/s^2])
};
SpatialCertificateUnits spatial_certificate_units(const SpatialProblem& problem);

/// Rates of the object relative to jaw or pusher at a point, along (n, t, o), and about
/// n.
struct SeenRates {
  double normal;
  Vec2 slip;
  double spin;
};
SeenRates rates_at(const SpatialProblem& problem, const ContactPatch& patch, int point,
                   const SpatialRates& rates);

/// Net wrench of a point's force, about the origin of H.
SpatialWrench wrench_at(const SpatialProblem& problem, const ContactPatch& patch,
                        int point, const SpatialForce& force);

/// Wrench and jaw efforts that the forces leave unbalanced, with the pusher's or without:
/// scaled, 6 + jaw rates.
SpatialRates imbalance(const SpatialProblem& problem, const SpatialRates& rates,
                       const SpatialForce* forces, bool with_pusher,
                       const SpatialCertificateUnits& units);

/// Forces of an answer's points.
using SpatialForceList = std::array<SpatialForce, SpatialProblem::kMaxPoints>;
void list_forces(const SpatialInstant& answer, SpatialForceList& forces);

/// The object's twist and the jaw rates of an answer.
SpatialRates rates_of(const SpatialInstant& answer);

/// 0 if the claim of the status is true, otherwise how badly it fails. Laws of contact
/// are not checked here.
double evidence_violation(const SpatialProblem& problem, const SpatialInstant& answer,
                          const SpatialCertificateUnits& units);

}  // namespace prehensile
