#include "mechanics/spatial_certificate.h"

#include <algorithm>

#include "mechanics/certificate_findings.h"
#include "mechanics/spatial_evidence.h"

namespace prehensile {
namespace {

using Check = SpatialCertificate::Check;

struct Question {
  const SpatialProblem& problem;
  SpatialCertificateUnits units;
};

/// A label that contradicts the numbers it stands for.
double mislabelled(ContactMode mode, double normal, double slip) {
  switch (mode) {
    case ContactMode::kOpen:
      return std::abs(normal);
    case ContactMode::kStick:
      return slip;
    case ContactMode::kSlip:
      return 0.0;
    case ContactMode::kSlipPlus:
    case ContactMode::kSlipMinus:
      break;
  }
  return 1.0;
}

/// Unilateral contact and Coulomb friction at one point with force f and rates c.
void check_point(const Question& q, const ContactPatch& patch, int index,
                 const SpatialForce& f, const SeenRates& c,
                 Findings<SpatialCertificate>& findings) {
  const SpatialCertificateUnits& units = q.units;
  const double normal = f.normal / units.force;
  double gap = c.normal / units.rate;
  if (patch.pressure == PressureLaw::kFoundation) {
    gap += patch.compliance * (f.normal - q.problem.preload[index]) / units.rate;
  }
  if (patch.pressure == PressureLaw::kGiven) {
    const double off = std::abs(f.normal - q.problem.preload[index]) / units.force;
    findings.note(Check::kPenetration, off, index);
  } else {
    findings.note(Check::kPenetration, worse(-normal, -gap), index);
    const double both = std::min(std::max(0.0, normal), std::max(0.0, gap));
    findings.note(Check::kComplementary, both, index);
  }
  // A soft point's spin moment counts by its spin radius, and its spin likewise.
  const bool soft = patch.spin_radius > 0.0;
  const double spin_force = soft ? f.spin / patch.spin_radius : f.spin / units.length;
  const double spin_rate = soft ? patch.spin_radius * c.spin : 0.0;
  const Vec3 friction(f.tangential.x() / units.force, f.tangential.y() / units.force,
                      spin_force / units.force);
  const Vec3 slip(c.slip.x() / units.rate, c.slip.y() / units.rate,
                  spin_rate / units.rate);
  if (!soft) findings.note(Check::kFrictionCone, std::abs(friction.z()), index);
  const double bound = patch.mu * std::max(0.0, normal);
  findings.note(Check::kFrictionCone, friction.norm() - bound, index);
  Vec3 opposed = friction - slip;
  const double length = opposed.norm();
  if (length > bound) opposed *= bound / length;
  findings.note(Check::kSlipDirection, (friction - opposed).norm(), index);
  // In a fall rates are large, in a wedge forces are, and rounding with them.
  const double gained =
      friction.dot(slip) / std::max({1.0, slip.norm(), friction.norm()});
  findings.note(Check::kDissipation, gained, index);
}

/// All laws of contact for these rates and forces, with the pusher or without.
void check_contacts(const Question& q, const SpatialRates& rates,
                    const SpatialForceList& forces, bool with_pusher,
                    Findings<SpatialCertificate>& findings) {
  for (int k = 0; k < q.problem.patch_count; ++k) {
    const ContactPatch& patch = q.problem.patch[k];
    if (!with_pusher && patch.body == ContactBody::kPusher) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      check_point(q, patch, i, forces[i], rates_at(q.problem, patch, i, rates), findings);
    }
  }
}

void check_balance(const Question& q, const SpatialRates& rates,
                   const SpatialForceList& forces, bool with_pusher,
                   Findings<SpatialCertificate>& findings) {
  const SpatialRates off =
      imbalance(q.problem, rates, forces.data(), with_pusher, q.units);
  for (int row = 0; row < 6; ++row) {
    findings.note(Check::kNewton, std::abs(off[row]), row);
  }
  for (int row = 6; row < 8; ++row) {
    findings.note(Check::kGripForce, std::abs(off[row]), row - 6);
  }
}

/// What the answer says about the push, and the rates and modes of its points.
void check_report(const Question& q, const SpatialInstant& answer,
                  const SpatialForceList& forces,
                  Findings<SpatialCertificate>& findings) {
  const SpatialCertificateUnits& units = q.units;
  const SpatialRates rates = rates_of(answer);
  SpatialWrench push = SpatialWrench::Zero();
  for (int k = 0; k < q.problem.patch_count; ++k) {
    const ContactPatch& patch = q.problem.patch[k];
    const bool pushes = patch.body == ContactBody::kPusher;
    const Check check = pushes ? Check::kPusherMotion : Check::kPatchRigidity;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const SpatialPoint& point = answer.point[i];
      const SeenRates c = rates_at(q.problem, patch, i, rates);
      if (pushes) push += wrench_at(q.problem, patch, i, forces[i]);
      findings.note(check, std::abs(point.normal_rate - c.normal) / units.rate, i);
      findings.note(check, (point.slip_rate - c.slip).norm() / units.rate, i);
      const double spin = std::abs(point.spin_rate - c.spin) * units.length;
      findings.note(check, spin / units.rate, i);
      const double slip =
          std::hypot(c.slip.norm(), patch.spin_radius * c.spin) / units.rate;
      findings.note(Check::kComplementary,
                    mislabelled(point.mode, forces[i].normal / units.force, slip), i);
    }
  }
  const SpatialWrench off = answer.w_push - push;
  const Vec3 moment = off.tail<3>() - units.centre.cross(Vec3(off.head<3>()));
  findings.note(Check::kNewton, off.head<3>().norm() / units.force, -1);
  findings.note(Check::kNewton, moment.norm() / (units.force * units.length), -1);
  const double size = answer.w_push.head<3>().norm();
  findings.note(Check::kNewton, std::abs(answer.push_force - size) / units.force, -1);
}

/// Does the pusher press on the object?
bool presses(const Question& q, const SpatialInstant& answer) {
  for (int k = 0; k < q.problem.patch_count; ++k) {
    const ContactPatch& patch = q.problem.patch[k];
    if (patch.body != ContactBody::kPusher) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      if (!(answer.point[i].normal_force <= 1e-9 * q.units.force)) return true;
    }
  }
  return false;
}

/// That the pads hold gravity by themselves: the answer shows them doing it.
void check_hold(const Question& q, const SpatialInstant& answer,
                Findings<SpatialCertificate>& findings) {
  const bool has_inertia = !q.problem.inertia.isZero(0.0) || q.problem.jaw_mass > 0.0;
  if (has_inertia || !presses(q, answer)) return;
  if (!answer.evidence.allFinite()) {
    findings.note(Check::kEvidence, kNan, -1);
    return;
  }
  check_contacts(q, answer.evidence, answer.other_force, false, findings);
  check_balance(q, answer.evidence, answer.other_force, false, findings);
}

}  // namespace

std::string_view name(SpatialCertificate::Check check) {
  switch (check) {
    case Check::kNewton:
      return "newton";
    case Check::kGripForce:
      return "grip force";
    case Check::kPenetration:
      return "penetration";
    case Check::kComplementary:
      return "complementary";
    case Check::kFrictionCone:
      return "friction cone";
    case Check::kSlipDirection:
      return "slip direction";
    case Check::kDissipation:
      return "dissipation";
    case Check::kPusherMotion:
      return "pusher motion";
    case Check::kPatchRigidity:
      return "patch rigidity";
    case Check::kEvidence:
      return "evidence";
    case Check::kCheckCount:
      break;
  }
  return "unknown";
}

SpatialCertificate certify(const SpatialProblem& problem,
                           const SpatialInstant& answer) noexcept {
  Findings<SpatialCertificate> findings;
  const Question q{problem, spatial_certificate_units(problem)};
  const bool falls = answer.status == InstantStatus::kDynamic;
  const bool needs_points =
      has_motion(answer.status) || falls || answer.status == InstantStatus::kJammed;
  if (!q.units.sane || (needs_points && answer.count != problem.count)) {
    findings.note(Check::kEvidence, kNan, -1);
    return findings.certificate();
  }
  if (has_motion(answer.status) || falls) {
    SpatialForceList forces;
    list_forces(answer, forces);
    const SpatialRates rates = falls ? answer.evidence : rates_of(answer);
    check_contacts(q, rates, forces, true, findings);
    if (!falls) {
      check_balance(q, rates, forces, true, findings);
      check_report(q, answer, forces, findings);
    }
  }
  if (answer.status == InstantStatus::kAmbiguous) {
    const bool moves = answer.other.allFinite();
    const SpatialRates& rates = moves ? answer.other : answer.evidence;
    check_contacts(q, rates, answer.other_force, moves, findings);
    if (moves) check_balance(q, rates, answer.other_force, true, findings);
  }
  if (usable(answer.status)) check_hold(q, answer, findings);
  findings.note(Check::kEvidence, evidence_violation(problem, answer, q.units), -1);
  return findings.certificate();
}

}  // namespace prehensile
