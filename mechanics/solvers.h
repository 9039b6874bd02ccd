/// All instant solvers behind one door: the question as every solver wants it, the choice
/// of a solver, and the answer in common terms.
///
///   const InstantQuestion question = question_at(model, contact, place, X_HO, V_HP);
///   const InstantAnswer now = solve(question);
///   if (now.certified()) use(now.V_HO, now.push_force);
///
/// Inner loops that know what they need call solve_planar, solve_limit_surface or
/// solve_spatial themselves and save the conversions.
#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "mechanics/limit_surface.h"
#include "mechanics/spatial_instant.h"
#include "mechanics/spatial_model.h"
#include "mechanics/spatial_reference.h"

namespace prehensile {

enum class Solver {
  kChoose,            ///< the exact one that the question needs
  kClosedForm,        ///< ellipsoidal limit surface, pad plane
  kPlanar,            ///< exact, pad plane
  kPlanarReference,   ///< the paper's formulation in the pad plane, interior point
  kSpatial,           ///< exact, six rates and the jaws
  kSpatialPivoting,   ///< polyhedral cones, complementary pivoting
  kSpatialReference,  ///< the paper's formulation in space, interior point
};

/// As in `--solver`: auto, closed, exact, ipopt, spatial, pivoting, spatial-ipopt.
std::string_view name(Solver solver);

/// Every solver but kChoose that this build has.
std::vector<Solver> built_solvers();

struct InstantQuestion {
  LimitSurface surface;
  PlanarGrasp grasp;
  PlanarDrive drive;
  SpatialProblem spatial;      ///< no points: see spatial_problem_at
  bool is_planar = true;       ///< the pad plane says all there is to say
  bool is_soft_point = false;  ///< the ellipsoid is the law of the pads, not a stand-in
  bool falls = false;          ///< the jaws cannot carry gravity along the closing
                               ///< direction, whatever the pusher does: kDynamic
  bool from_rest = false;      ///< rates are accelerations from rest
};

/// The question for a contact of the model at a pose: `place` as in PushContact::segment,
/// `V_HP` the pusher's twist (or acceleration from rest) about the origin of H.
InstantQuestion question_at(const Model& model, const PushContact& contact, double place,
                            const PlanarPose& X_HO, const SpatialTwist& V_HP,
                            const SpatialQuestionOptions& options = {});

/// The exact solver that answers this question, and why it is the one.
struct SolverChoice {
  Solver solver = Solver::kPlanar;
  const char* why = "";
};
SolverChoice chosen_solver(const InstantQuestion& question);

/// Why this solver cannot answer this question; null if it can.
const char* refusal(Solver solver, const InstantQuestion& question);

struct SolverOptions {
  Solver solver = Solver::kChoose;
  int generators = 8;               ///< g of paper eq. (2), for polyhedral cones
  bool probe_multiplicity = false;  ///< exact solvers: look for a second motion
  bool rigid_limit = false;         ///< exact spatial: pads as stiff as can be resolved
};

struct InstantAnswer {
  Solver solver = Solver::kPlanar;  ///< that answered; never kChoose
  InstantStatus status = InstantStatus::kNotRun;
  SpatialTwist V_HO = SpatialTwist::Constant(kNan);      ///< object twist (acceleration)
  SpatialWrench w_push = SpatialWrench::Constant(kNan);  ///< about the origin of H
  double push_force = kNan;                              ///< [N]
  double residual = kNan;     ///< the solver's own, in units (F0, V0)
  double certificate = kNan;  ///< largest entry, by code that the solver does not share;
                              ///< of circular cones, which polyhedral answers in the pad
                              ///< plane need not pass; none for those in space
  int iterations = 0;

  /// As the solver gave it.
  std::variant<PlanarInstant, SpatialInstant, SpatialReference> detail;

  bool certified(double tolerance = 1e-6) const { return certificate <= tolerance; }
};

/// kDynamic where the object falls through the jaws, without a solver; kBadInput where
/// `refusal` has something to say. Cold path: the answer is large.
InstantAnswer solve(const InstantQuestion& question, const SolverOptions& options = {});

}  // namespace prehensile
