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
      gamma_(stick.gamma),
      p_OCom_(stick.p_OCom),
      margin_(margin) {
  const auto [low, high] = std::minmax({t.dot(end[0]), t.dot(end[1])});
  face = {low + margin.grasp, high - margin.grasp};
  if (stick.is_point) return;
  tilted_end[0] -= margin.tilt * perp(begin - end[0]);
  tilted_end[1] += margin.tilt * perp(begin - end[1]);
}

double WeakContact::asked_of_edge(int k, double weight) const {
  return -weight * least_turned(-w[k].dot(gamma_), cross(w[k], gamma_), margin_.tilt);
}

double WeakContact::help_at_end(int k, double weight) const {
  const double side = k == 0 ? 1.0 : -1.0;
  const Vec2 lever = p_OCom_ - end[k];
  return weight *
         (least_turned(-side * cross(lever, gamma_), lever.dot(gamma_), margin_.tilt) -
          margin_.centre_of_mass * gamma_.norm());
}

double WeakContact::most_asked_of_edge(int k) const {
  return std::max(asked_of_edge(k, margin_.least_weight()),
                  asked_of_edge(k, margin_.most_weight()));
}

double WeakContact::least_help_at_end(int k) const {
  return std::min(help_at_end(k, margin_.least_weight()),
                  help_at_end(k, margin_.most_weight()));
}

}  // namespace prehensile
