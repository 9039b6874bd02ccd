#include "planner/pads/ring_pads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace prehensile {
namespace {

/// Complete elliptic integrals of the first and the second kind.
struct EllipticIntegrals {
  double K, E;
};

/// Of the complementary modulus k' > 0, by the arithmetic-geometric mean (Abramowitz and
/// Stegun, Handbook of Mathematical Functions, 1964, 17.6). Both at once, in a sixth of
/// the time that the standard library takes, which goes by the modulus and loses what k'
/// near 0 says.
EllipticIntegrals elliptic_integrals(double complement) {
  double a = 1.0, b = complement;
  double sum = 0.5 * (1.0 - b) * (1.0 + b);  // of 2^(n - 1) (a^2 - b^2)
  double power = 1.0;
  while (a - b > 1e-9 * a) {  // squared, it is nothing any more
    const double mean = 0.5 * (a + b);
    const double half = 0.5 * (a - b);
    b = std::sqrt(a * b);
    a = mean;
    sum += power * half * half;
    power *= 2.0;
  }
  const double K = std::numbers::pi / (a + b);
  return {K, K * (1.0 - sum)};
}

/// Of the mean distance D of a circle of radius r from a place at distance d of its
/// centre: its slope by d, that over d, and D - d slope.
struct MeanDistance {
  double slope, slope_over_distance, rest;
};

MeanDistance mean_distance(double r, double d) {
  constexpr double kNear = 1e-6, kFar = 1e-4;  // relative; beyond them a series is exact
  constexpr double kShare = 2.0 / std::numbers::pi;
  if (d <= kNear * r) return {0.5 * d / r, 0.5 / r, r};
  if (r <= kFar * d) {
    const double slope = 1.0 - 0.25 * r * r / (d * d);
    return {slope, slope / d, 0.5 * r * r / d};
  }
  if (r == d) return {kShare, kShare / d, kShare * d};
  const auto [K, E] = elliptic_integrals(std::abs(r - d) / (r + d));
  const double slope = kShare * (E + (E - K) * (r - d) / (2.0 * d));
  return {slope, slope / d, kShare * (r + d) * E - d * slope};
}

}  // namespace

bool has_ring_pads(const Model& model) {
  return model.region.is_isotropic() && model.region.is_fixed_in_hand() &&
         !model.has_soft_points() && model.F > 0.0 && model.c > 0.0;
}

bool has_round_pads(const Model& model) {
  return model.has_soft_points() || has_ring_pads(model);
}

RingFriction ring_friction(const ContactPoints& points, double c, double angle) {
  const double speed = std::cos(angle);
  const double spin = std::sin(angle) / c;
  RingFriction friction;
  double radius = -1.0;
  RingFriction of_circle;  // points of a circle stand in a row
  for (int j = 0; j < points.count; ++j) {
    const double r = std::hypot(points.x[j], points.y[j]);
    if (std::abs(r - radius) > 1e-9 * c) {
      radius = r;
      if (spin <= 0.0) {
        of_circle = {1.0, 0.0, 1.0};
      } else {
        const double d = std::max(0.0, speed) / spin;
        const MeanDistance mean = mean_distance(r, d);
        of_circle.along = mean.slope;
        of_circle.moment = mean.rest;
        of_circle.drag = mean.slope_over_distance / spin;
      }
    }
    friction.along += points.weight[j] * of_circle.along;
    friction.moment += points.weight[j] * of_circle.moment;
    friction.drag += points.weight[j] * of_circle.drag;
  }
  return friction;
}

double slack_of_friction(const Model& model, const PushContact& contact, const Vec2& p_OF,
                         const PadDrag& friction) noexcept {
  const Vec2 gamma = model.mass / model.F * contact.g_O;
  const Vec2 force = friction.force - gamma;
  const double moment = friction.moment - cross(model.p_OCom - p_OF, gamma);
  const double n = force.dot(contact.n);
  const double cone = contact.mu * n - std::abs(force.dot(contact.t));
  const double low = moment + cross(p_OF - contact.b, force);
  const double high = -moment - cross(p_OF - contact.a, force);
  return std::min({cone, contact.mu == 0.0 ? n : cone, low / model.c, high / model.c});
}

double ring_slack(const Model& model, const PushContact& contact, const Vec2& p_OF,
                  const Vec2& e, double travel, double turn,
                  const Margin& margin) noexcept {
  if (travel == 0.0 && turn == 0.0) return kNan;
  const auto friction_of = [&](double stretch) {
    // Stretched pads turn as if faster, by levers that are longer.
    const double spin = stretch * model.c * std::abs(turn);
    const RingFriction friction =
        ring_friction(model.region.whole(), model.c, std::atan2(spin, travel));
    return PadDrag{friction.along * e, std::copysign(stretch * friction.moment, turn)};
  };
  const PadDrag nominal = friction_of(1.0);
  const double slack = slack_of_friction(model, contact, p_OF, nominal);
  if (margin.is_none() || !(slack >= -kStickTolerance)) return slack;
  const double r = margin.torque_radius;
  const std::array frictions = {nominal, friction_of(std::max(0.0, 1.0 - r)),
                                friction_of(1.0 + r)};
  return std::min(
      slack, slack_of_frictions(face_contact(model, contact), p_OF, frictions, margin));
}

}  // namespace prehensile
