/// The exact spatial instant: six rates of the object and up to two of the jaws, patches
/// of contact points with circular friction cones.
///
/// The unknowns are the rates, not the forces. Each contact force is the projection of
/// (force centre - rate / r) on its friction set, which turns all laws into one
/// semismooth equation in at most eight unknowns; Newton's method solves it, and the
/// force centres move to the forces found (proximal point method). Mass matrices are
/// never inverted, so the quasi-static limit is an ordinary case.
///
/// Source: paper sections IV to VI; De Saxce and Feng 1998 for the exact cone;
/// Rockafellar 1976 for the proximal point method.
#pragma once

#include <array>

#include "mechanics/instant.h"
#include "mechanics/spatial_problem.h"

namespace prehensile {

/// Rates of object and jaws: twist about the origin of H, then the closing rates of
/// `jaw_freedoms` (unused ones are zero).
using SpatialRates = Eigen::Matrix<double, 8, 1>;

/// Force of a contact point on the object. Not initialised.
struct SpatialForce {
  double normal;    ///< [N], >= 0
  Vec2 tangential;  ///< [N] along (t, o)
  double spin;      ///< [N m] about n
};

/// One contact point: force on the object, and rate of the object relative to jaw or
/// pusher, both along (n, t, o) of its patch. Not initialised.
struct SpatialPoint {
  double normal_force;    ///< lambda_n [N], >= 0
  Vec2 tangential_force;  ///< [N] along (t, o)
  double spin_moment;     ///< [N m] about n; 0 unless the point is soft
  double normal_rate;     ///< c_n; > 0 opens (with the jaw's own motion)
  Vec2 slip_rate;         ///< along (t, o)
  double spin_rate;       ///< [rad/s] of turning about n
  ContactMode mode;       ///< open, stick or slip
};

struct SpatialInstant {
  InstantStatus status = InstantStatus::kNotRun;
  SpatialTwist V_HO =
      SpatialTwist::Constant(kNan);          ///< object twist (acceleration if inertia)
  std::array<double, 2> jaw_rate{0.0, 0.0};  ///< [m/s] closing, see jaw_freedoms
  SpatialWrench w_push =
      SpatialWrench::Constant(kNan);  ///< pusher on object, about the origin of H
  double push_force = kNan;           ///< |f| of w_push [N]

  /// In the order of the problem's points; [0, count) are set. kDynamic: forces and rates
  /// of the fall `evidence`. kJammed: a self-balanced set of forces, the largest normal
  /// force being 1 N; rates mean nothing.
  int count = 0;
  std::array<SpatialPoint, SpatialProblem::kMaxPoints> point;

  double residual = kNan;  ///< natural-map residual of the solver in units (F0, V0)
  int iterations = 0;      ///< Newton steps

  /// With a motion, quasi-static: the object at rest in the pads alone, which shows that
  /// they hold gravity; not set where the pusher carries nothing anyway.
  /// kDynamic: a motion in which every contact obeys its law but gravity (and the drive
  /// of the jaws) gains more power than pads and pusher take. kAmbiguous: the same with
  /// the pads alone, so that only the pusher keeps the object from falling.
  SpatialRates evidence = SpatialRates::Constant(kNan);
  /// kAmbiguous: a second motion, if found.
  SpatialRates other = SpatialRates::Constant(kNan);
  /// Forces of `other` if there is one, else those of the pads in `evidence` (but see
  /// `point` for kDynamic).
  std::array<SpatialForce, SpatialProblem::kMaxPoints> other_force;
  double force_low = kNan;   ///< see kNonuniqueForces: least and
  double force_high = kNan;  ///< greatest sum of the pusher's normal forces that this
                             ///< motion allows [N], as far as known
};

struct SpatialSolveOptions {
  double tolerance = 1e-9;  ///< natural-map residual to reach, 1e-12..1e-6
  int max_iterations =
      10000;  ///< Newton steps in search of a motion, all starts together
  bool probe_multiplicity = false;  ///< also solve from other starts, for a second motion
  bool rigid_limit = false;         ///< solve `rigid_limit_of` the problem
};

/// The problem with all its foundations as stiff as rates of 1e-8 pusher rates per unit
/// force resolve: within rounding the limit of rigid contact with the preloaded split.
/// Requires a problem that is not bad input.
SpatialProblem rigid_limit_of(const SpatialProblem& problem) noexcept;

/// Warm start of a sequence of similar instants.
struct SpatialWarmStart {
  bool valid = false;
  SpatialInstant last;
};

/// Solves one instant. No heap, no exceptions. `warm` is read if valid, and written.
///
/// Quasi-statically, a motion is kAmbiguous if the pads alone do not hold gravity, and
/// carries the rest in the pads as witness if they do (a pusher that presses on the
/// object cannot be told from one that holds it up otherwise). kDynamic where no motion
/// is found and the object falls. With inertia, what is found is a motion (kMoves) unless
/// it is lost in a fall. That a motion is the only one is for `probe_multiplicity` to
/// doubt: with two points per pad one in ten has a second, with four or more hardly any.
/// A push against a jaw that stands still is kJammed where its forces grow without bound
/// as the foundations stiffen. kOutOfIterations also where neither hold nor fall could be
/// shown.
///
/// kBadInput: no pusher, no jaw patch, a pusher at rest, values out of the ranges stated
/// in SpatialProblem, patches whose points do not follow each other in the order of the
/// patches, points of a patch off their common plane across n, patches of one jaw with
/// different normals, given loads that contradict the drive of the jaws, or numbers that
/// are not finite.
SpatialInstant solve_spatial(const SpatialProblem& problem,
                             const SpatialSolveOptions& options = {},
                             SpatialWarmStart* warm = nullptr) noexcept;

}  // namespace prehensile
