/// The spatial instant on polyhedral friction cones, for comparison with the exact one,
/// in two ways that share the question but no solver: complementary pivoting, and the
/// paper's own, which minimises the sum of all complementarity products under linear
/// constraints by an interior-point method (paper section VI-B).
///
/// Source: paper eq. (2), (3), (4), (8), (10); the preloaded foundation stands in for the
/// pressure that the paper leaves free, and gives its problem one answer.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "mechanics/spatial_problem.h"

namespace prehensile {

enum class SpatialReferenceStatus {
  kNotRun,      ///< built without the library
  kSolved,      ///< within the gate; whether it is the only answer is not examined
  kInfeasible,  ///< proved: no forces and rates meet even the inequalities
  kNotFound,  ///< nothing passed the gate, be it that there is no answer (the grasp does
              ///< not hold gravity) or that it was not found
  kBadInput,  ///< a pusher at rest or none, no jaw point, numbers that are not finite or
              ///< out of range, generators odd or out of 4..64
};

struct SpatialReferenceOptions {
  int generators = 8;        ///< g of paper eq. (2): even, 4..64
  int starts = 8;            ///< of the pivoting or of the interior point, tried in turn
  double gate = 1e-7;        ///< largest accepted residual in units (F0, V0)
  int max_iterations = 500;  ///< of the interior-point method, per start
};

/// One contact point, along (n, t, o) of its patch.
struct SpatialReferencePoint {
  double normal_force = 0.0;        ///< [N]
  Vec2 tangential_force{0.0, 0.0};  ///< [N]
  double spin_moment = 0.0;         ///< [N m] about n; 0 unless the point is soft
};

struct SpatialReference {
  SpatialReferenceStatus status = SpatialReferenceStatus::kNotRun;
  SpatialTwist V_HO = SpatialTwist::Zero();  ///< object twist (acceleration if inertia)
  std::array<double, 2> jaw_rate{0.0, 0.0};  ///< [m/s] closing, see jaw_freedoms
  SpatialWrench w_push = SpatialWrench::Zero();  ///< pusher on object, about H's origin
  std::vector<SpatialReferencePoint> point;      ///< in the order of the problem's points

  /// Of the polyhedral laws, by code that the solvers do not share: largest imbalance and
  /// largest |min(force, slack)|, in units (F0, V0).
  double residual = std::numeric_limits<double>::infinity();
  int steps = 0;  ///< pivots or interior-point iterations, of all starts
};

/// By pivoting: exact on the polyhedral cones up to rounding. Rates are unknowns of the
/// pivoting, so the quasi-static limit needs no inertia; where the search ends without an
/// answer it is repeated with some, which is then let go. Cost grows with the third power
/// of points times generators.
SpatialReference solve_spatial_pivoting(const SpatialProblem& problem,
                                        const SpatialReferenceOptions& options = {});

/// The paper's way, with its result sharpened by the linear equations of the pattern it
/// found. kInfeasible is never claimed.
SpatialReference solve_spatial_reference(const SpatialProblem& problem,
                                         const SpatialReferenceOptions& options = {});

bool spatial_reference_is_built();

}  // namespace prehensile
