/// The paper's instant in space, on polyhedral friction cones (eq. (2) to (4)): the
/// question in units, its complementarity problem, answers and their residual. Internal
/// to the mechanics layer; cold path.
///
/// Unknowns are the rates (object twist, jaw rates), which are free, and per contact
/// point lambda_n, the g betas and xi. Rates are not eliminated: in the quasi-static
/// limit there is no inertia to divide by, and a tiny one in its place would cost digits.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mechanics/complementarity.h"
#include "mechanics/spatial_problem.h"

namespace prehensile {

/// One point, dimensionless. Rates of the object relative to jaw or pusher are linear in
/// the rates v: c_n = n . v - n_drive, along generator k: D.col(k) . v - D_drive[k]; the
/// same columns take forces to the rows of eq. (8).
struct LinearConeContact {
  using Column = Eigen::Matrix<double, 8, 1>;

  Column n;
  double n_drive = 0.0;
  Eigen::Matrix<double, 8, Eigen::Dynamic> D;  ///< no columns without friction
  Eigen::VectorXd D_drive;
  double mu = 0.0;
  double compliance = 0.0;
  double preload = 0.0;
  bool given = false;  ///< normal force is the preload

  int lambda_n = -1;  ///< indices of the unknowns; -1: there is none
  int beta = -1;      ///< of the first generator
  int xi = -1;
};

/// Lengths in L0, forces in F0, rates in V0, about the centre of the pads.
struct LinearCone {
  Vec3 centre = Vec3::Zero();  ///< [m] in H
  double length = 1.0;         ///< L0 [m]
  double force = 1.0;          ///< F0 [N]
  double rate = 1.0;           ///< V0 [m/s] (or [m/s^2])

  int freedoms = 6;  ///< 6 + jaw rates
  Eigen::Matrix<double, 8, 8> inertia = Eigen::Matrix<double, 8, 8>::Zero();
  LinearConeContact::Column load = LinearConeContact::Column::Zero();
  std::vector<LinearConeContact> contact;
  int unknowns = 0;  ///< the rates come first
};

/// A point of an answer, in SI along (n, t, o) of its patch.
struct LinearConePoint {
  double normal_force = 0.0;        ///< [N]
  Vec2 tangential_force{0.0, 0.0};  ///< [N]
  double spin_moment = 0.0;         ///< [N m] about n, of a soft point
  std::vector<double> beta;         ///< [N] per generator
};

struct LinearConeForces {
  SpatialTwist V_HO = SpatialTwist::Zero();
  std::array<double, 2> jaw_rate{0.0, 0.0};
  SpatialWrench w_push = SpatialWrench::Zero();
  std::vector<LinearConePoint> point;
};

/// Generators of a point in (t, o) and, for a soft point, (spin moment) / e: g directions
/// on the unit circle from t on, or, on the unit sphere, g / 2 - 1 such circles and the
/// poles. Each comes with its opposite.
Eigen::Matrix3Xd friction_generators(int g, bool soft);

/// Units and rows from the data; false where the data do not allow an answer: a pusher at
/// rest or none, no jaw point, values that are not finite or out of range, an odd number
/// of generators or one out of 4..64.
bool pose_linear_cone(const SpatialProblem& problem, int generators, LinearCone& cone);

/// Rows: eq. (8) and the drive of the jaws; then per point unilateral contact (with the
/// compliance of a foundation), eq. (4) per generator, eq. (3).
ComplementarityProblem complementarity_of(const LinearCone& cone);

LinearConeForces forces_of(const SpatialProblem& problem, const LinearCone& cone,
                           int generators, std::span<const double> z);

/// How far an answer is from the polyhedral laws, in units (F0, V0): the largest of the
/// imbalance of eq. (8) and of the jaws' drive and of |min(force, slack)| over all pairs,
/// with xi as large as the slip asks for. Computed from the problem, not from the rows
/// that were solved. Infinite if a number is not finite.
double linear_cone_residual(const SpatialProblem& problem, int generators,
                            const LinearConeForces& answer);

}  // namespace prehensile
