// Checks an answer over the ellipsoid from velocities and sums of forces, and what its
// status claims. Shares no code with the solver.

#include <algorithm>
#include <cmath>

#include "mechanics/certificate_evidence.h"
#include "mechanics/cone_balance.h"
#include "mechanics/limit_surface.h"

namespace prehensile {
namespace {

constexpr double kGains = 1e-12;  // gains of power below this are rounding, relative
constexpr double kStill = 1e-14;  // twists below this are rest, in units

struct Question {
  const LimitSurface& surface;
  PlanarWrench w_g;
  const PlanarDrive& drive;
  double force;  // unit [N]: of the surface or of gravity, whichever is larger
  double rate;   // unit [m/s]: of the pusher at its points

  Vec3 scaled_wrench(const PlanarWrench& w) const {
    return {w[0] / force, w[1] / force, w[2] / (surface.c * force)};
  }
  Vec3 scaled_twist(const PlanarTwist& V) const {
    return {V[0] / rate, V[1] / rate, surface.c * V[2] / rate};
  }
  bool is_at_rest(const PlanarTwist& V) const { return scaled_twist(V).norm() <= kStill; }
  // Gap and slip rate at pusher point i, in units.
  Vec2 relative_rate(const PlanarTwist& V, int i) const {
    const Vec2 c = point_velocity(V - drive.V_HP, drive.p_HC[i]) / rate;
    return {drive.n_H.dot(c), drive.t_H().dot(c)};
  }
};

Question question_of(const LimitSurface& surface, const PlanarWrench& w_g,
                     const PlanarDrive& drive) {
  double rate = 0.0;
  for (int i = 0; i < drive.count; ++i) {
    rate = std::max(rate, point_velocity(drive.V_HP, drive.p_HC[i]).norm());
  }
  return {surface, w_g, drive, surface.F * std::max(1.0, surface.load(w_g)), rate};
}

// The pusher's own law at one point, from the answer's forces and rates: how far
// 0 <= normal force _|_ gap rate >= 0 and Coulomb's law are from holding.
double contact_violation(const Question& q, const PlanarInstant& answer, int i) {
  const PusherPoint& point = answer.pusher[i];
  const Vec2 rate = q.relative_rate(answer.V_HO, i);
  const double normal = point.normal_force / q.force;
  const double tangential = point.tangential_force / q.force;
  const double opening = rate.x();
  const double slip = rate.y();
  // Energy form of Coulomb's law: friction takes the greatest power that the cone allows.
  const double power = tangential * slip + q.drive.mu * normal * std::abs(slip);
  return worst_of({std::abs(std::min(normal, opening)),
                   std::abs(tangential) - q.drive.mu * normal, std::abs(power),
                   std::abs(point.normal_rate / q.rate - opening),
                   std::abs(point.slip_rate / q.rate - slip),
                   mislabelled(point, normal, opening, slip)});
}

// What gravity and the push leave to the grasp: its friction at this twist, or anything
// within the surface at rest.
double balance_violation(const Question& q, const PlanarTwist& V, const Vec3& left) {
  if (q.is_at_rest(V)) return left.norm() * q.force / q.surface.F - 1.0;
  return (left + q.scaled_wrench(q.surface.friction(V))).norm();
}

double motion_violation(const Question& q, const PlanarInstant& answer) {
  PlanarWrench push = PlanarWrench::Zero();
  double worst = 0.0;
  for (int i = 0; i < q.drive.count; ++i) {
    const PusherPoint& point = answer.pusher[i];
    worst = worse(worst, contact_violation(q, answer, i));
    const Vec2 f =
        point.normal_force * q.drive.n_H + point.tangential_force * q.drive.t_H();
    push += wrench_of(q.drive.p_HC[i], f);
  }
  return worst_of({worst,
                   balance_violation(q, answer.V_HO, q.scaled_wrench(q.w_g + push)),
                   q.scaled_wrench(push - answer.w_push).norm(),
                   std::abs(answer.push_force - push.head<2>().norm()) / q.force});
}

// How far another twist is from being in balance, over all forces that the pusher may
// exert at it.
double other_violation(const Question& q, const PlanarTwist& V) {
  const bool rests = q.is_at_rest(V);
  const PlanarWrench friction = rests ? PlanarWrench::Zero() : q.surface.friction(V);
  ConeBalance balance(q.scaled_wrench(q.w_g + friction));
  double penetration = 0.0;
  for (int i = 0; i < q.drive.count; ++i) {
    const Vec2 rate = q.relative_rate(V, i);
    penetration = worse(penetration, -rate.x());
    if (rate.x() > kAtRest) continue;
    for (const double side : {1.0, -1.0}) {  // Friction along -t and along +t.
      if (rate.y() * side < -kAtRest) continue;
      const Vec2 f = q.drive.n_H - side * q.drive.mu * q.drive.t_H();
      balance.add_edge(q.scaled_wrench(wrench_of(q.drive.p_HC[i], f)));
    }
  }
  const double strength = rests ? q.surface.F / q.force : 0.0;
  return worse(penetration, balance.least_violation() - strength);
}

// Power that gravity gains by this twist over friction, in units of what the latter
// takes; not a number for no twist.
double gain_of(const Question& q, const PlanarTwist& V) {
  const Vec3 v = q.scaled_twist(V);
  const Vec3 unit = (v / v.cwiseAbs().maxCoeff()).normalized();
  return q.scaled_wrench(q.w_g).dot(unit) * q.force / q.surface.F - 1.0;
}

double ambiguous_violation(const Question& q, const PlanarInstant& answer) {
  double worst = 0.0;
  bool shown = false;
  if (answer.other.allFinite()) {
    const double distance = q.scaled_twist(answer.other - answer.V_HO).norm();
    shown = distance > 1e-8 * (1.0 + q.scaled_twist(answer.V_HO).norm());
    worst = other_violation(q, answer.other);
  }
  if (answer.evidence.allFinite()) {
    worst = worse(worst, -gain_of(q, answer.evidence));
    shown = true;
  }
  return shown ? worst : kFails;
}

// A fall: gravity gains more power than friction can take, and the pusher is not pressed.
double dynamic_violation(const Question& q, const PlanarTwist& v) {
  if (!(gain_of(q, v) > kGains * q.force / q.surface.F)) return kFails;
  const Vec3 unit = q.scaled_twist(v) / q.scaled_twist(v).cwiseAbs().maxCoeff();
  const PlanarTwist fall(unit[0], unit[1], unit[2] / q.surface.c);
  double worst = 0.0;
  for (int i = 0; i < q.drive.count; ++i) {
    const Vec2& p = q.drive.p_HC[i];
    const double reach = std::max(q.surface.c, p.norm());
    const double speed = fall.head<2>().norm() + reach * std::abs(fall[2]);
    worst = worse(worst, -q.drive.n_H.dot(point_velocity(fall, p)) / speed);
  }
  return worst;
}

double claim_violation(const Question& q, const PlanarInstant& answer) {
  switch (answer.status) {
    case InstantStatus::kMoves:
    case InstantStatus::kHolds:
    case InstantStatus::kSeparated: {
      if (q.surface.load(q.w_g) > 1.0 + kClaimed) return kFails;
      const double size = q.scaled_twist(answer.V_HO).norm();
      return motion_claim_violation(q.drive, answer, size, q.force, q.rate);
    }
    case InstantStatus::kAmbiguous:
      return ambiguous_violation(q, answer);
    default:  // The twist determines the push: there is no interval of forces.
      return kFails;
  }
}

}  // namespace

double limit_surface_residual(const LimitSurface& surface, const PlanarWrench& w_g,
                              const PlanarDrive& drive,
                              const PlanarInstant& answer) noexcept {
  if (drive.count < 1 || drive.count > 2) return kNan;
  const Question q = question_of(surface, w_g, drive);
  if (!(q.rate > 0.0) || !(q.force > 0.0)) return kNan;
  if (answer.status == InstantStatus::kDynamic)
    return dynamic_violation(q, answer.evidence);
  if (!has_motion(answer.status) || answer.pusher_count != drive.count) return kNan;
  return worse(motion_violation(q, answer), claim_violation(q, answer));
}

}  // namespace prehensile
