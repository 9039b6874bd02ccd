/// A drive and its gravity without dimensions, and one motion that might answer it.
/// Internal to the mechanics layer.
///
/// Lengths are measured from the centre of the pads in units of their size, forces in
/// units of their capacity, rates in units of the pusher's own rate at the contact: then
/// the friction of the pads is of order one in every direction of twist space, whatever
/// the scene. Without this the same solver is wrong on ordinary scenes in SI units.
#pragma once

#include <array>

#include "mechanics/instant.h"

namespace prehensile {

struct ScaledPush {
  PlanarUnits units;
  Vec2 centre;  ///< [m] in H, the reference point of everything below

  int count = 1;
  std::array<Vec2, 2> p{Vec2::Zero(), Vec2::Zero()};
  Vec2 n, t;
  double mu = 0.0;
  PlanarTwist V;                                       ///< of the pusher
  PlanarWrench w_g;                                    ///< gravity
  PlanarWrench inertial_force = PlanarWrench::Zero();  ///< M V, if the object sticks

  double approach(int i) const { return n.dot(point_velocity(V, p[i])); }

  /// Direction of the pusher's force on the object while the object slips along
  /// sigma * t; sigma = +1 or -1.
  Vec2 edge(int sigma) const { return n - sigma * mu * t; }
};

/// False if a number is not finite, the normal is not a unit vector, or the friction is
/// negative.
bool is_sane(const PlanarWrench& w_g, const PlanarDrive& drive) noexcept;

/// Largest speed of the pusher at the points that touch [m/s].
double contact_rate(const PlanarDrive& drive) noexcept;

ScaledPush scaled(const PlanarWrench& w_g, const PlanarDrive& drive, const Vec2& centre,
                  double length, double force) noexcept;

/// Nothing is so large in these units that its square would overflow.
bool is_within_range(const ScaledPush& push) noexcept;

/// Back to SI, about the origin of H.
PlanarTwist twist_in_hand(const ScaledPush& push, const PlanarTwist& u) noexcept;
PlanarWrench wrench_in_hand(const ScaledPush& push, const PlanarWrench& w) noexcept;

/// A finger point at the centre of rotation: it may carry any force within its bound.
struct PivotPoint {
  int index = -1;             ///< of the pad point; -1: none
  Vec2 force = Vec2::Zero();  ///< resistance that it contributes (object on pads)
};

/// Which pusher points carry load, and whether they slip. A motion is proposed by a mode
/// and then judged like any other.
struct Motion {
  enum class Support { kFirst = 0, kSecond = 1, kBoth = 2, kNone = 3 };
  Support support = Support::kNone;
  int slip = 0;  ///< sign of the slip of the object along t; 0: sticks
  PlanarTwist u = PlanarTwist::Zero();
  PivotPoint pivot;

  PlanarWrench w = PlanarWrench::Zero();  ///< pusher on object
  std::array<double, 2> normal{0.0, 0.0};
  std::array<double, 2> tangential{0.0, 0.0};
  double force_low = kNan;   ///< range of the sum of normal forces
  double force_high = kNan;  ///< if the pivot leaves a choice
  double residual = kNan;    ///< natural map of everything but the pads' own law
  int steps = 0;             ///< Newton steps of the last problem solved
};

/// Distributes w over the supporting points and measures how far the motion is from
/// obeying balance and the pusher's contact law. A line pusher that sticks determines
/// only the sum of its tangential forces; it is shared in proportion to the normal ones.
void judge(const ScaledPush& push, Motion& motion) noexcept;

/// Writes a motion into an answer: twist, pusher points, forces; not the finger points.
void report(const ScaledPush& push, const Motion& motion, PlanarInstant& answer) noexcept;

}  // namespace prehensile
