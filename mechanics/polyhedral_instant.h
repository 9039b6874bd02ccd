/// The paper's instant in the pad plane, on polyhedral friction cones (eq. (2) to (4)):
/// the question in units, its complementarity problem, answers and their residual.
/// Internal to the mechanics layer; cold path.
///
/// Finger loads are known in the plane, so the bound of a finger point replaces mu
/// lambda_n in eq. (2), (3), and eq. (6) holds by construction. Finger points carry the g
/// generators d_k = (cos 2 pi k / g, sin 2 pi k / g) in H; a pusher point, whose tangent
/// in the plane is a line, the two generators +t and -t.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mechanics/complementarity.h"
#include "mechanics/planar_problem.h"

namespace prehensile {

/// The question, dimensionless: lengths in L0, forces in F0, rates in V0, about the
/// centre of the friction bounds.
struct PolyhedralInstant {
  PlanarUnits units;
  Vec2 centre;                ///< [m] in H
  std::vector<Vec2> d;        ///< generators
  std::vector<Vec2> r;        ///< finger points
  std::vector<double> bound;  ///< B_j
  int pushers = 0;
  std::array<Vec2, 2> p;  ///< pusher points
  Vec2 n, t;
  double mu = 0.0;
  PlanarTwist V_HP;
  PlanarWrench w_g;
  Eigen::Matrix3d inertia;

  /// Rates of the object relative to the pusher at point i: (normal, tangential), eq.
  /// (10) with (8) and (9) for rigid bodies.
  Vec2 pusher_rate(int i, const PlanarTwist& u) const;

  /// Back to SI, about the origin of H.
  PlanarTwist twist_in_hand(const PlanarTwist& u) const;
  PlanarWrench wrench_in_hand(const PlanarWrench& w) const;

  /// Largest -d_k.c over the generators: xi of eq. (3), (4) for slip c.
  double gauge(const Vec2& c) const;
};

/// What an answer consists of, in the same units.
struct PolyhedralAnswer {
  PlanarTwist u = PlanarTwist::Zero();
  std::vector<Vec2> f;  ///< on the object, per finger point
  std::array<double, 2> lambda_n{}, lambda_t{};
};

/// Indices of the unknowns, in this order: u, then per pusher point lambda_n, then (with
/// friction) beta of +t and -t, xi; then per finger point g betas and xi.
struct PolyhedralUnknowns {
  explicit PolyhedralUnknowns(const PolyhedralInstant& instant);

  int lambda_n(int i) const { return 3 + i; }
  int pusher_beta(int i, int side) const { return 3 + pushers + 2 * i + side; }
  int pusher_xi(int i) const { return 3 + 3 * pushers + i; }
  int beta(int j, int k) const { return fingers_from + j * generators + k; }
  int xi(int j) const { return fingers_from + points * generators + j; }

  int pushers, points, generators;
  bool pusher_friction;
  int fingers_from;
  int count;
};

/// Centre and units from the data; false where the data do not allow an answer: a zero
/// push rate, no finger points, values that are not finite, an odd number of generators.
bool pose_polyhedral(const PlanarGrasp& grasp, const PlanarDrive& drive, int generators,
                     PolyhedralInstant& instant);

/// Rows: eq. (8); unilateral contact of the pusher; eq. (4) per generator; eq. (3) per
/// point. Rates are eliminated by eq. (10).
ComplementarityProblem complementarity_of(const PolyhedralInstant& instant);

PolyhedralAnswer answer_of(const PolyhedralInstant& instant, std::span<const double> z);

/// How far an answer is from the laws: the largest of the imbalance of eq. (8) and of
/// min(force, slack) over all complementarity pairs. Forces are read anew as betas, so
/// that only motion and forces are judged. Infinite if a number is not finite.
double residual_of(const PolyhedralInstant& instant, const PolyhedralAnswer& answer);

}  // namespace prehensile
