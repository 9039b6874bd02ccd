/// What a margin leaves of a contact that the laws of run_law.h are made of: its friction
/// cone, its face, and what gravity asks of them at worst. Internal to the planner.
///
/// The rows of exact_stick_test (mechanics/sticking.h) at the worst of the box that is
/// known beforehand, so that what passes it obeys these.
#pragma once

#include <array>

#include "mechanics/stick_rows.h"

namespace prehensile {

struct WeakContact {
  /// Of pushes of a plan that begins with the finger axis at `begin`.
  WeakContact(const StickContact& stick, const Margin& margin, const Vec2& begin);

  /// What gravity asks of edge k of the cone, over F, at so much of the weight: w_k.f has
  /// to be as much.
  double asked_of_edge(int k, double weight) const;
  /// Moment of gravity about end k of the face (0: b, 1: a) over F, at so much of the
  /// weight, that helps to stay on it [m].
  double help_at_end(int k, double weight) const;
  /// At the worst of the margin's weights.
  double most_asked_of_edge(int k) const;
  double least_help_at_end(int k) const;

  Vec2 n, t;
  std::array<Vec2, 2> end;  ///< b and a, moved inwards
  /// The same for motions as planned, of which the tilted ones turn about `begin`.
  std::array<Vec2, 2> tilted_end;
  double mu = 0.0;             ///< least
  std::array<Vec2, 2> w;       ///< dual edges of the cone, mu n + t and mu n - t
  double half_angle = 0.0;     ///< [rad] of the motions in it that may be tilted
  std::array<double, 2> face;  ///< [m] least and greatest t.p at which the object turns
  /// Of the torque radius, least and greatest.
  std::array<double, 2> stretch;

 private:
  double asked_about(int k) const;

  const StickContact stick_;
  const Margin margin_;
};

/// Of the torque radius, the least and the greatest that laws are made of.
std::array<double, 2> stretches_of(const Margin& margin);

}  // namespace prehensile
