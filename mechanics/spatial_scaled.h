/// A spatial problem without dimensions, in the form that the solver sums over: per patch
/// a frame, local coordinates and lanes of points. Internal to the mechanics layer.
///
/// Units: F0 force, V0 rate, L0 length, about the centre of the pads. Within a patch with
/// frame (n, t, o) a point stands at (height, a, b) from that centre, and the local rates
/// (v_n, w_t, w_o | v_t, v_o, w_n), taken at the foot (height, 0, 0) of the centre on the
/// patch, give
///
///   c_n = v_n + b w_t - a w_o,   c_t = v_t - b w_n,   c_o = v_o + a w_n
///
/// so normal and tangential rates see three numbers each.
#pragma once

#include <array>

#include "mechanics/spatial_instant.h"

namespace prehensile {

struct SpatialUnits {
  Vec3 centre = Vec3::Zero();  ///< [m] in H
  double length = 1.0;         ///< L0 [m]
  double force = 1.0;          ///< F0 [N]
  double rate = 1.0;           ///< V0
};

using LocalRates = Eigen::Matrix<double, 6, 1>;

struct ScaledPatch {
  Eigen::Matrix3d Q;                           ///< columns n, t, o in H
  double height = 0.0;                         ///< along n, from the centre
  std::array<double, 2> closing{0.0, 0.0};     ///< advance of its jaw per jaw rate
  LocalRates prescribed = LocalRates::Zero();  ///< of the pusher
  double mu = 0.0;
  double R = 0.0;  ///< compliance
  double e = 0.0;  ///< spin radius
  int first = 0;   ///< lane of its first point
  int count = 0;   ///< points
  int padded = 0;  ///< whole lanes
  int source = 0;  ///< its first point in the problem
  ContactBody body = ContactBody::kPusher;
  bool given = false;
  bool soft = false;

  /// Of the object relative to the jaw, without what is prescribed.
  LocalRates local_rates(const SpatialRates& v) const {
    const Vec3 u = Q.transpose() * v.head<3>();
    const Vec3 w = Q.transpose() * v.segment<3>(3);
    LocalRates y;
    y[0] = u[0] - closing[0] * v[6] - closing[1] * v[7];
    y[1] = w[1];
    y[2] = w[2];
    y[3] = u[1] + height * w[2];
    y[4] = u[2] - height * w[1];
    y[5] = w[0];
    return y;
  }
  LocalRates relative_rates(const SpatialRates& v) const {
    return local_rates(v) - prescribed;
  }
};

struct ScaledSpatial {
  static constexpr int kLanes = 4;
  static constexpr int kCapacity =
      SpatialProblem::kMaxPoints + SpatialProblem::kMaxPatches * (kLanes - 1) + 4;
  static_assert(kCapacity % kLanes == 0);
  using Column = std::array<double, kCapacity>;

  alignas(32) Column a;        ///< along t
  alignas(32) Column b;        ///< along o
  alignas(32) Column preload;  ///< 0 on padding

  Eigen::Matrix<double, 8, 8> M = Eigen::Matrix<double, 8, 8>::Zero();
  SpatialRates f = SpatialRates::Zero();       ///< gravity and efforts of the jaws
  SpatialRates pusher = SpatialRates::Zero();  ///< the pusher's own rates
  std::array<ScaledPatch, SpatialProblem::kMaxPatches> patch;
  SpatialUnits units;
  int freedoms = 6;  ///< 6 + jaw rates
  int patch_count = 0;
  int padded = 0;
  bool has_inertia = false;

  /// Of the stiffest foundation; infinite if there is none.
  double least_compliance() const noexcept;
};

/// False if the data make no sense; see solve_spatial.
bool is_posed(const SpatialProblem& problem) noexcept;

/// Units that make a problem dimensionless. The force contains the friction of the pads
/// where that exceeds 1.
SpatialUnits spatial_units(const SpatialProblem& problem) noexcept;

/// Requires is_posed.
void scale(const SpatialProblem& problem, ScaledSpatial& scaled) noexcept;

/// Back to SI, about the origin of H, and forth.
SpatialRates rates_in_hand(const ScaledSpatial& scaled, const SpatialRates& v) noexcept;
SpatialRates scaled_rates(const ScaledSpatial& scaled, const SpatialRates& v) noexcept;

}  // namespace prehensile
