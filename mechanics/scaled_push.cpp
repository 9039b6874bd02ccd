#include "mechanics/scaled_push.h"

#include <algorithm>

namespace prehensile {
namespace {

/// How far (force, slack) is from 0 <= force _|_ slack >= 0.
double complementarity_gap(double force, double slack) {
  return std::abs(std::min(force, slack));
}

/// How far the friction force is from opposing the slip at full strength.
double friction_gap(double tangential, double bound, double slip_rate) {
  return std::abs(tangential - std::clamp(tangential - slip_rate, -bound, bound));
}

/// The force at the point that comes nearest to the wrench; what is left is the misfit.
double put_on_point(const ScaledPush& push, int i, Motion& motion) {
  const Vec2& p = push.p[i];
  const double moment = motion.w[2] - cross(p, motion.w.head<2>());
  const double nearness = 1.0 / (1.0 + p.squaredNorm());
  const Vec2 f = motion.w.head<2>() + moment * nearness * perp(p);
  motion.w = wrench_of(p, f);
  motion.normal = {0.0, 0.0};
  motion.tangential = {0.0, 0.0};
  motion.normal[i] = push.n.dot(f);
  motion.tangential[i] = push.t.dot(f);
  return std::abs(moment) * std::sqrt(nearness);
}

/// Splits the wrench between the two ends of a line: the line of action of its force
/// meets the face at a share of the way from the first end to the second.
double share_on_line(const ScaledPush& push, Motion& motion) {
  const Vec2 f = motion.w.head<2>();
  const Vec2 along = push.p[1] - push.p[0];
  const double moment = motion.w[2] - cross(push.p[0], f);
  const double per_share = cross(along, f);
  const double normal = push.n.dot(f);
  const double tangential = push.t.dot(f);
  if (std::abs(per_share) <= 1e-300) {
    return put_on_point(push, 0, motion);
  }
  const double share = moment / per_share;
  motion.normal = {(1.0 - share) * normal, share * normal};
  motion.tangential = {(1.0 - share) * tangential, share * tangential};
  return 0.0;
}

double distribute(const ScaledPush& push, Motion& motion) {
  switch (motion.support) {
    case Motion::Support::kFirst:
      return put_on_point(push, 0, motion);
    case Motion::Support::kSecond:
      return put_on_point(push, 1, motion);
    case Motion::Support::kBoth:
      return share_on_line(push, motion);
    case Motion::Support::kNone:
      break;
  }
  motion.normal = {0.0, 0.0};
  motion.tangential = {0.0, 0.0};
  return motion.w.lpNorm<Eigen::Infinity>();
}

}  // namespace

bool is_sane(const PlanarWrench& w_g, const PlanarDrive& drive) noexcept {
  bool finite = w_g.allFinite() && drive.V_HP.allFinite() && drive.n_H.allFinite() &&
                std::isfinite(drive.mu);
  for (int i = 0; i < drive.count && i < 2; ++i) {
    finite = finite && drive.p_HC[i].allFinite();
  }
  return finite && drive.count >= 1 && drive.count <= 2 && drive.mu >= 0.0 &&
         std::abs(drive.n_H.squaredNorm() - 1.0) <= 1e-6;
}

double contact_rate(const PlanarDrive& drive) noexcept {
  double rate = point_velocity(drive.V_HP, drive.p_HC[0]).norm();
  if (drive.count == 2) {
    rate = std::max(rate, point_velocity(drive.V_HP, drive.p_HC[1]).norm());
  }
  return rate;
}

ScaledPush scaled(const PlanarWrench& w_g, const PlanarDrive& drive, const Vec2& centre,
                  double length, double force) noexcept {
  ScaledPush push;
  push.units = {length, force, contact_rate(drive)};
  const double per_length = 1.0 / length;
  const double per_force = 1.0 / force;
  const double per_rate = 1.0 / push.units.rate;
  push.centre = centre;
  push.count = drive.count;
  for (int i = 0; i < drive.count; ++i) push.p[i] = per_length * (drive.p_HC[i] - centre);
  push.n = drive.n_H;
  push.t = drive.t_H();
  push.mu = drive.mu;
  const Vec2 v = per_rate * point_velocity(drive.V_HP, centre);
  push.V = {v.x(), v.y(), drive.V_HP[2] * length * per_rate};
  const Vec2 f = per_force * w_g.head<2>();
  push.w_g = {f.x(), f.y(), per_length * (w_g[2] * per_force - cross(centre, f))};
  return push;
}

bool is_within_range(const ScaledPush& push) noexcept {
  double sum = push.w_g.squaredNorm() + push.V.squaredNorm();
  for (int i = 0; i < push.count; ++i) sum += push.p[i].squaredNorm();
  return std::isfinite(sum);
}

PlanarTwist twist_in_hand(const ScaledPush& push, const PlanarTwist& u) noexcept {
  const PlanarUnits& units = push.units;
  const double omega = u[2] * units.rate / units.length;
  return {u[0] * units.rate + omega * push.centre.y(),
          u[1] * units.rate - omega * push.centre.x(), omega};
}

PlanarWrench wrench_in_hand(const ScaledPush& push, const PlanarWrench& w) noexcept {
  const Vec2 f = w.head<2>() * push.units.force;
  return {f.x(), f.y(),
          w[2] * push.units.force * push.units.length + cross(push.centre, f)};
}

void judge(const ScaledPush& push, Motion& motion) noexcept {
  const PlanarTwist relative = motion.u - push.V;
  double residual = distribute(push, motion);
  for (int i = 0; i < push.count; ++i) {
    const Vec2 c = point_velocity(relative, push.p[i]);
    const double bound = push.mu * std::max(0.0, motion.normal[i]);
    residual = std::max({residual, complementarity_gap(motion.normal[i], push.n.dot(c)),
                         friction_gap(motion.tangential[i], bound, push.t.dot(c))});
  }
  motion.residual = residual;
}

void report(const ScaledPush& push, const Motion& motion,
            PlanarInstant& answer) noexcept {
  const PlanarUnits& units = push.units;
  answer.V_HO = twist_in_hand(push, motion.u);
  answer.w_push = wrench_in_hand(push, motion.w);
  answer.push_force = answer.w_push.head<2>().norm();
  answer.pusher_count = push.count;
  answer.residual = motion.residual;
  answer.iterations = motion.steps;
  answer.force_low = motion.force_low * units.force;
  answer.force_high = motion.force_high * units.force;
  const PlanarTwist relative = motion.u - push.V;
  for (int i = 0; i < push.count; ++i) {
    PusherPoint& point = answer.pusher[i];
    const Vec2 c = point_velocity(relative, push.p[i]);
    point.normal_force = std::max(0.0, motion.normal[i]) * units.force;
    point.tangential_force = motion.tangential[i] * units.force;
    point.normal_rate = push.n.dot(c) * units.rate;
    point.slip_rate = push.t.dot(c) * units.rate;
    const bool carries =
        motion.support == Motion::Support::kBoth || static_cast<int>(motion.support) == i;
    if (!carries) {
      point.mode = ContactMode::kOpen;
    } else if (motion.slip == 0) {
      point.mode = ContactMode::kStick;
    } else {  // Without friction or load both signs are the same proposal.
      point.mode =
          point.slip_rate > 0.0 ? ContactMode::kSlipPlus : ContactMode::kSlipMinus;
    }
  }
}

}  // namespace prehensile
