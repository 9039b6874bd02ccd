#include "mechanics/solvers.h"

#include <cmath>

#include "mechanics/certificate.h"
#include "mechanics/planar_instant.h"
#include "mechanics/reference.h"
#include "mechanics/spatial_certificate.h"

namespace prehensile {
namespace {

bool is_spatial(Solver solver) {
  return solver == Solver::kSpatial || solver == Solver::kSpatialPivoting ||
         solver == Solver::kSpatialReference;
}

void take(const PlanarInstant& instant, double certificate, InstantAnswer& answer) {
  answer.status = instant.status;
  answer.V_HO = in_space(instant.V_HO);
  answer.w_push << instant.w_push[0], instant.w_push[1], 0.0, 0.0, 0.0, instant.w_push[2];
  answer.push_force = instant.push_force;
  answer.residual = instant.residual;
  answer.certificate = certificate;
  answer.iterations = instant.iterations;
  answer.detail = instant;
}

InstantStatus status_of(SpatialReferenceStatus status) {
  switch (status) {
    case SpatialReferenceStatus::kNotRun:
      return InstantStatus::kNotRun;
    case SpatialReferenceStatus::kSolved:
      return InstantStatus::kMoves;
    case SpatialReferenceStatus::kBadInput:
      return InstantStatus::kBadInput;
    case SpatialReferenceStatus::kInfeasible:
    case SpatialReferenceStatus::kNotFound:
      break;
  }
  return InstantStatus::kOutOfIterations;
}

void solve_in_space(const InstantQuestion& question, const SolverOptions& options,
                    InstantAnswer& answer) {
  if (answer.solver == Solver::kSpatial) {
    const SpatialProblem problem =
        options.rigid_limit ? rigid_limit_of(question.spatial) : question.spatial;
    const SpatialInstant instant =
        solve_spatial(problem, {.probe_multiplicity = options.probe_multiplicity});
    answer.status = instant.status;
    answer.V_HO = instant.V_HO;
    answer.w_push = instant.w_push;
    answer.push_force = instant.push_force;
    answer.residual = instant.residual;
    answer.certificate = certify(problem, instant).worst;
    answer.iterations = instant.iterations;
    answer.detail = instant;
    return;
  }
  const SpatialReferenceOptions reference_options{.generators = options.generators};
  const SpatialReference reference =
      answer.solver == Solver::kSpatialPivoting
          ? solve_spatial_pivoting(question.spatial, reference_options)
          : solve_spatial_reference(question.spatial, reference_options);
  answer.status = status_of(reference.status);
  answer.residual = reference.residual;
  answer.iterations = reference.steps;
  if (reference.status == SpatialReferenceStatus::kSolved) {
    answer.V_HO = reference.V_HO;
    answer.w_push = reference.w_push;
    answer.push_force = reference.w_push.head<3>().norm();
  }
  answer.detail = reference;
}

}  // namespace

std::string_view name(Solver solver) {
  switch (solver) {
    case Solver::kChoose:
      return "auto";
    case Solver::kClosedForm:
      return "closed";
    case Solver::kPlanar:
      return "exact";
    case Solver::kPlanarReference:
      return "ipopt";
    case Solver::kSpatial:
      return "spatial";
    case Solver::kSpatialPivoting:
      return "pivoting";
    case Solver::kSpatialReference:
      return "spatial-ipopt";
  }
  return "";
}

std::vector<Solver> built_solvers() {
  std::vector<Solver> built = {Solver::kClosedForm, Solver::kPlanar};
  if (reference_is_built()) built.push_back(Solver::kPlanarReference);
  built.push_back(Solver::kSpatial);
  built.push_back(Solver::kSpatialPivoting);
  if (spatial_reference_is_built()) built.push_back(Solver::kSpatialReference);
  return built;
}

InstantQuestion question_at(const Model& model, const PushContact& contact, double place,
                            const PlanarPose& X_HO, const SpatialTwist& V_HP,
                            const SpatialQuestionOptions& options) {
  InstantQuestion question;
  question.surface = model.surface();
  question.grasp = grasp_at(model, X_HO, contact.g_O);
  if (options.from_rest) add_inertia(model, X_HO, question.grasp);
  question.drive = drive_at(contact, place, X_HO, in_pad_plane(V_HP));
  question.spatial = spatial_problem_at(model, contact, place, X_HO, V_HP, options);
  question.falls =
      model.scene.g_Wz != 0.0 && model.jaw_force[0] == 0.0 && model.jaw_force[1] == 0.0;
  question.from_rest = options.from_rest;
  question.is_planar = lies_in_pad_plane(V_HP) && model.load_shifts.empty() &&
                       (options.height ? *options.height == 0.0 : contact.is_symmetric());
  const auto* point = std::get_if<PointPad>(&model.scene.gripper.pad);
  question.is_soft_point = point && point->spin_radius.has_value();
  return question;
}

SolverChoice chosen_solver(const InstantQuestion& question) {
  if (!question.is_planar) {
    return {Solver::kSpatial,
            "pushers, push or loads are not symmetric about the mid-plane"};
  }
  if (question.is_soft_point) {
    return question.from_rest ? SolverChoice{Solver::kSpatial, "soft points with inertia"}
                              : SolverChoice{Solver::kClosedForm,
                                             "the ellipsoid is the law of soft points"};
  }
  return {Solver::kPlanar,
          "pushers, push and loads are symmetric about the mid-plane, where the loads "
          "of the pads are known"};
}

const char* refusal(Solver solver, const InstantQuestion& question) {
  if (solver == Solver::kChoose) return nullptr;
  if (is_spatial(solver)) {
    return question.spatial.count > 0
               ? nullptr
               : "the pads have lost the object, or have too many points for the spatial "
                 "solvers";
  }
  if (!question.is_planar) return "it knows the pad plane only";
  if (question.from_rest && solver == Solver::kClosedForm) {
    return "it is asked in the quasi-static limit";
  }
  if (question.is_soft_point && solver != Solver::kClosedForm) {
    return "it knows hard points only";
  }
  return nullptr;
}

InstantAnswer solve(const InstantQuestion& question, const SolverOptions& options) {
  InstantAnswer answer;
  answer.solver =
      options.solver == Solver::kChoose ? chosen_solver(question).solver : options.solver;
  if (question.falls) {
    answer.status = InstantStatus::kDynamic;
    return answer;
  }
  if (refusal(answer.solver, question) != nullptr) {
    answer.status = InstantStatus::kBadInput;
    return answer;
  }
  if (is_spatial(answer.solver)) {
    solve_in_space(question, options, answer);
  } else if (answer.solver == Solver::kClosedForm) {
    const PlanarInstant instant =
        solve_limit_surface(question.surface, question.grasp.w_g, question.drive);
    take(instant,
         limit_surface_residual(question.surface, question.grasp.w_g, question.drive,
                                instant),
         answer);
  } else {
    const PlanarInstant instant =
        answer.solver == Solver::kPlanarReference
            ? solve_reference(question.grasp, question.drive,
                              {.generators = options.generators})
            : solve_planar(question.grasp, question.drive,
                           {.probe_multiplicity = options.probe_multiplicity});
    take(instant, certify(question.grasp, question.drive, instant).worst, answer);
  }
  return answer;
}

}  // namespace prehensile
