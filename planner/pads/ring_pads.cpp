#include "planner/pads/ring_pads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace prehensile {
namespace {

/// Derivative of the mean distance of a circle of radius r from a place at distance d of
/// its centre by d, and that divided by d.
struct Slope {
  double value, over_distance;
};

Slope slope_of_mean_distance(double r, double d) {
  constexpr double kNear = 1e-6;  // relative; closer than that a series is exact
  if (d <= kNear * r) return {0.5 * d / r, 0.5 / r};
  if (r <= kNear * d) return {1.0, 1.0 / d};
  const double k = std::min(1.0, 2.0 * std::sqrt(r * d) / (r + d));
  const double E = std::comp_ellint_2(k);
  const double K = k < 1.0 ? std::comp_ellint_1(k) : 0.0;
  const double aside = k < 1.0 ? (E - K) * (r - d) / (2.0 * d) : 0.0;
  const double value = 2.0 / std::numbers::pi * (E + aside);
  return {value, value / d};
}

double mean_distance(double r, double d) {
  if (r + d == 0.0) return 0.0;
  const double k = std::min(1.0, 2.0 * std::sqrt(r * d) / (r + d));
  return 2.0 / std::numbers::pi * (r + d) * std::comp_ellint_2(k);
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
        const Slope slope = slope_of_mean_distance(r, d);
        of_circle.along = slope.value;
        of_circle.moment = mean_distance(r, d) - d * slope.value;
        of_circle.drag = slope.over_distance / spin;
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
                  const Vec2& e, double travel, double turn) noexcept {
  const double spin = model.c * std::abs(turn);
  if (travel == 0.0 && spin == 0.0) return kNan;
  const RingFriction friction =
      ring_friction(model.region.whole(), model.c, std::atan2(spin, travel));
  return slack_of_friction(model, contact, p_OF,
                           {friction.along * e, std::copysign(friction.moment, turn)});
}

}  // namespace prehensile
