/// The question that every planar instant solver answers, and nothing else: finger points
/// with known loads, gravity, one pusher with one or two points, and its motion.
/// Everything in H, about the origin of H (the finger axis).
///
/// Source: paper sections IV to VI, reduced to the pad plane, where finger loads are
/// known: the two fingers are merged, so point j carries the friction bound B_j.
#pragma once

#include <array>

#include "scene/frames.h"

namespace prehensile {

/// Finger points with their friction bounds, gravity, and inertia.
struct PlanarGrasp {
  static constexpr int kCapacity = 96;
  int count = 0;
  std::array<double, kCapacity> x;      ///< [m] in H
  std::array<double, kCapacity> y;      ///< [m] in H
  std::array<double, kCapacity> bound;  ///< B_j = mu_1 l_1j + mu_2 l_2j [N], > 0

  PlanarWrench w_g = PlanarWrench::Zero();  ///< gravity [N, N, N m]

  /// Generalised inertia about the origin of H; zero is the quasi-static limit, in which
  /// the rates below are velocities. Otherwise they are accelerations from rest.
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< [kg, kg m, kg m^2]

  /// Sum of the bounds: the largest friction force of both pads together [N].
  double capacity() const {
    double sum = 0.0;
    for (int j = 0; j < count; ++j) sum += bound[j];
    return sum;
  }
};

/// One pusher: the points that touch (a line pusher by its two ends, paper section IV-D
/// because the ends span its support) and its prescribed rigid motion.
struct PlanarDrive {
  int count = 1;                                         ///< 1 point, 2 line
  std::array<Vec2, 2> p_HC{Vec2::Zero(), Vec2::Zero()};  ///< [m]
  Vec2 n_H = {1.0, 0.0};                                 ///< unit normal, into the object
  double mu = 0.0;                                       ///< friction of the pusher, >= 0
  PlanarTwist V_HP = PlanarTwist::Zero();  ///< twist (or acceleration) of the pusher

  Vec2 t_H() const { return perp(n_H); }
};

/// Units that make a problem dimensionless. Solver and certificate compute
/// their own.
struct PlanarUnits {
  double length = 0.0;  ///< L0 [m]
  double force = 0.0;   ///< F0 [N]
  double rate = 0.0;    ///< V0 [m/s] (or [m/s^2])
};

}  // namespace prehensile
