#include "planner/pads/weak_contact.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace prehensile {
namespace {

/// Laws without any torque say nothing.
constexpr double kMostShrunk = 0.5;

}  // namespace

std::array<double, 2> stretches_of(const Margin& margin) {
  return {1.0 - std::min(margin.torque_radius, kMostShrunk), 1.0 + margin.torque_radius};
}

/// The moment about an end of a motion tilted by so much is that of the motion about
/// another place, moved across the lever from the end to where the motion began: before a
/// push begins the tilt of those before it takes its finger axis off its place, by so
/// much at least as the lever is shorter.
WeakContact::WeakContact(const StickContact& stick, const Margin& margin,
                         const Vec2& begin)
    : n(stick.n),
      t(stick.t),
      end{stick.b - margin.place * stick.t, stick.a + margin.place * stick.t},
      tilted_end(end),
      mu(stick.mu * std::max(0.0, 1.0 - margin.friction)),
      w{mu * n + t, mu * n - t},
      half_angle(std::max(0.0, std::atan(mu) - margin.tilt)),
      stretch(stretches_of(margin)),
      stick_(stick),
      margin_(margin) {
  const auto [low, high] = std::minmax({t.dot(end[0]), t.dot(end[1])});
  face = {low + margin.grasp, high - margin.grasp};
  if (stick.is_point) return;
  tilted_end[0] -= margin.tilt * perp(begin - end[0]);
  tilted_end[1] += margin.tilt * perp(begin - end[1]);
}

double WeakContact::asked_of_edge(int k, double weight) const {
  return weight * asked_by_gravity(stick_, mu, k == 0 ? 1.0 : -1.0, margin_.tilt);
}

double WeakContact::asked_about(int k) const {
  return asked_about_end(stick_, end[k], k == 0 ? 1.0 : -1.0, margin_);
}

double WeakContact::help_at_end(int k, double weight) const {
  return -weight * asked_about(k);
}

double WeakContact::most_asked_of_edge(int k) const {
  return most_asked(asked_of_edge(k, 1.0), margin_);
}

double WeakContact::least_help_at_end(int k) const {
  return -most_asked(asked_about(k), margin_);
}

}  // namespace prehensile
