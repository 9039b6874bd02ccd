#include "mechanics/certificate.h"

#include <algorithm>

#include "mechanics/certificate_findings.h"

namespace prehensile {
namespace {

using Check = Certificate::Check;

/// Velocity of the object relative to the pusher at pusher point i, along (n, t).
Vec2 relative_rate(const PlanarDrive& drive, const PlanarTwist& V_HO, int i) {
  const PlanarTwist V = V_HO - drive.V_HP;
  const Vec2& p = drive.p_HC[i];
  const Vec2 rate(V[0] - V[2] * p.y(), V[1] + V[2] * p.x());
  return {drive.n_H.dot(rate), drive.t_H().dot(rate)};
}

/// Paper eq. (8): pusher, fingers and gravity balance (or accelerate the object); and the
/// net push reported is the sum of its points.
void check_newton(const PlanarGrasp& grasp, const PlanarDrive& drive,
                  const PlanarInstant& answer, const CertificateUnits& units,
                  Findings<Certificate>& findings) {
  PlanarWrench push = PlanarWrench::Zero();
  for (int i = 0; i < answer.pusher_count; ++i) {
    const PusherPoint& point = answer.pusher[i];
    const Vec2 f = point.normal_force * drive.n_H + point.tangential_force * drive.t_H();
    const Vec2& p = drive.p_HC[i];
    push += PlanarWrench(f.x(), f.y(), p.x() * f.y() - p.y() * f.x());
  }
  PlanarWrench sum = grasp.w_g + push - grasp.inertia * answer.V_HO;
  for (int j = 0; j < answer.finger_count; ++j) {
    const Vec2& f = answer.finger[j].force;
    sum += PlanarWrench(f.x(), f.y(), grasp.x[j] * f.y() - grasp.y[j] * f.x());
  }
  const Vec3 balance = units.scaled_wrench(sum);
  const Vec3 reported = units.scaled_wrench(push - answer.w_push);
  for (int row = 0; row < 3; ++row) {
    findings.note(Check::kNewton, std::abs(balance[row]), row);
    findings.note(Check::kNewton, std::abs(reported[row]), row);
  }
  const double size = std::hypot(answer.w_push[0], answer.w_push[1]);
  findings.note(Check::kNewton, std::abs(answer.push_force - size) / units.force, 0);
}

/// Unilateral contact and Coulomb friction of the pusher, paper eq. (1), (3), (4).
void check_pusher(const PlanarDrive& drive, const PlanarInstant& answer,
                  const CertificateUnits& units, int first_index,
                  Findings<Certificate>& findings) {
  for (int i = 0; i < drive.count; ++i) {
    const PusherPoint& point = answer.pusher[i];
    const int index = first_index + i;
    const Vec2 rate = relative_rate(drive, answer.V_HO, i) / units.rate;
    const double normal = point.normal_force / units.force;
    const double friction = point.tangential_force / units.force;
    const double bound = drive.mu * std::max(0.0, normal);
    findings.note(Check::kPusherMotion,
                  std::abs(point.normal_rate / units.rate - rate.x()), index);
    findings.note(Check::kPusherMotion, std::abs(point.slip_rate / units.rate - rate.y()),
                  index);
    findings.note(Check::kPenetration, worse(-normal, -rate.x()), index);
    findings.note(Check::kComplementary,
                  std::min(std::max(0.0, normal), std::max(0.0, rate.x())), index);
    findings.note(Check::kComplementary, mislabelled(point, normal, rate.x(), rate.y()),
                  index);
    findings.note(Check::kFrictionCone, std::abs(friction) - bound, index);
    const double opposed = std::clamp(friction - rate.y(), -bound, bound);
    findings.note(Check::kSlipDirection, std::abs(friction - opposed), index);
    findings.note(Check::kDissipation, friction * rate.y(), index);
  }
}

/// Coulomb friction of the finger points: bound and direction. At a point that hardly
/// moves any force within the bound will do, which the projection knows by itself.
void check_fingers(const PlanarGrasp& grasp, const PlanarInstant& answer,
                   const CertificateUnits& units, Findings<Certificate>& findings) {
  for (int j = 0; j < answer.finger_count; ++j) {
    const Vec2 rate = Vec2(answer.V_HO[0] - answer.V_HO[2] * grasp.y[j],
                           answer.V_HO[1] + answer.V_HO[2] * grasp.x[j]) /
                      units.rate;
    const Vec2 force = answer.finger[j].force / units.force;
    const double bound = grasp.bound[j] / units.force;
    Vec2 opposed = force - rate;
    const double length = opposed.norm();
    if (length > bound) opposed *= bound / length;
    findings.note(Check::kFrictionCone, force.norm() - bound, j);
    findings.note(Check::kSlipDirection, (force - opposed).norm(), j);
    findings.note(Check::kDissipation, force.dot(rate), j);
    if (answer.finger[j].mode == ContactMode::kStick) {
      findings.note(Check::kSlipDirection, rate.norm(), j);
    } else if (answer.finger[j].mode != ContactMode::kSlip) {
      findings.note(Check::kSlipDirection, 1.0, j);
    }
  }
}

void bound_force(const PlanarGrasp& grasp, const PlanarInstant& answer,
                 Certificate& certificate) {
  if (!grasp.inertia.isZero() || !(answer.push_force > 0.0)) return;
  const PlanarWrench p = answer.w_push / answer.push_force;
  certificate.force_high = force_upper_bound(grasp, p, answer.V_HO);
  PlanarWrench carried = -grasp.w_g;
  for (int j = 0; j < answer.finger_count; ++j) {
    Vec2 f = answer.finger[j].force;
    if (f.norm() > grasp.bound[j]) f *= grasp.bound[j] / f.norm();
    carried -= PlanarWrench(f.x(), f.y(), grasp.x[j] * f.y() - grasp.y[j] * f.x());
  }
  certificate.force_low = p.head<2>().dot(carried.head<2>());
}

}  // namespace

std::string_view name(Certificate::Check check) {
  switch (check) {
    case Check::kNewton:
      return "newton";
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
    case Check::kEvidence:
      return "evidence";
    case Check::kCheckCount:
      break;
  }
  return "unknown";
}

Certificate certify(const PlanarGrasp& grasp, const PlanarDrive& drive,
                    const PlanarInstant& answer) noexcept {
  Findings<Certificate> findings;
  const CertificateUnits units = certificate_units(grasp, drive);
  if (!units.sane) {
    findings.note(Check::kEvidence, kNan, -1);
    return findings.certificate();
  }
  if (has_motion(answer.status)) {
    const bool complete =
        answer.pusher_count == drive.count && answer.finger_count == grasp.count;
    if (!complete) {
      findings.note(Check::kNewton, kNan, -1);
      return findings.certificate();
    }
    check_newton(grasp, drive, answer, units, findings);
    check_pusher(drive, answer, units, grasp.count, findings);
    check_fingers(grasp, answer, units, findings);
  }
  findings.note(Check::kEvidence, evidence_violation(grasp, drive, answer, units), -1);
  Certificate certificate = findings.certificate();
  if (has_motion(answer.status)) bound_force(grasp, answer, certificate);
  return certificate;
}

double force_upper_bound(const PlanarGrasp& grasp, const PlanarWrench& p,
                         const PlanarTwist& u) noexcept {
  const double along = p.dot(u);
  if (!(along > 0.0)) return std::numeric_limits<double>::infinity();
  return (friction_power(grasp, u) - grasp.w_g.dot(u)) / along;
}

}  // namespace prehensile
