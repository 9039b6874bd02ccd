#include "mechanics/spatial_reference.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "mechanics/linear_cone.h"
#include "mechanics/mixed_lemke.h"

namespace prehensile {
namespace {

/// An answer that is exact on its cones up to rounding needs no second start.
constexpr double kExact = 1e-10;

/// Keeps the better of what is there and z.
void offer(const SpatialProblem& problem, const LinearCone& cone, int generators,
           std::span<const double> z, SpatialReference& best) {
  const LinearConeForces found = forces_of(problem, cone, generators, z);
  const double residual = linear_cone_residual(problem, generators, found);
  if (!(residual < best.residual)) return;
  best.residual = residual;
  best.V_HO = found.V_HO;
  best.jaw_rate = found.jaw_rate;
  best.w_push = found.w_push;
  best.point.clear();
  for (const LinearConePoint& point : found.point) {
    best.point.push_back({point.normal_force, point.tangential_force, point.spin_moment});
  }
}

void set_status(double gate, SpatialReference& best) {
  best.status = best.residual <= gate ? SpatialReferenceStatus::kSolved
                                      : SpatialReferenceStatus::kNotFound;
}

/// Rates about which friction is sought: the object rides with the pusher, is dragged
/// along straight, or stands; then the same with more slip along the pusher.
Eigen::VectorXd guessed_rates(const SpatialProblem& q, const LinearCone& cone,
                              int index) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(cone.freedoms);
  const Vec3 centre_rate =
      (q.V_HP.head<3>() + Vec3(q.V_HP.tail<3>()).cross(cone.centre)) / cone.rate;
  if (index % 3 != 2) v.head<3>() = centre_rate;
  if (index % 3 == 0) v.segment<3>(3) = q.V_HP.tail<3>() * cone.length / cone.rate;
  for (int k = 0; k < q.patch_count && index >= 3; ++k) {
    if (q.patch[k].body != ContactBody::kPusher) continue;
    const double turn = 2.4 * index;  // the golden angle
    v.head<3>() +=
        0.5 * (std::cos(turn) * q.patch[k].t + std::sin(turn) * q.patch[k].o());
  }
  return v;
}

/// Betas and slacks start away from their bounds, with like products.
std::vector<double> starting_point(const SpatialProblem& q, const LinearCone& cone,
                                   int index) {
  const double blur = 0.1 * std::pow(0.3, index / 3);
  const Eigen::VectorXd v = guessed_rates(q, cone, index);
  std::vector<double> z(cone.unknowns, 0.0);
  std::copy(v.begin(), v.end(), z.begin());
  for (const LinearConeContact& contact : cone.contact) {
    const double normal_force = std::max(contact.preload, 0.1);
    if (!contact.given) z[contact.lambda_n] = normal_force;
    if (contact.xi < 0) continue;
    const Eigen::VectorXd slip =
        contact.D.topRows(cone.freedoms).transpose() * v - contact.D_drive;
    const double xi = std::max(0.0, -slip.minCoeff());
    z[contact.xi] = xi + blur;
    const Eigen::ArrayXd share = blur / (blur + xi + slip.array());
    for (int k = 0; k < share.size(); ++k) {
      z[contact.beta + k] = contact.mu * normal_force * share[k] / (share.sum() + 0.1);
    }
  }
  return z;
}

/// With some inertia the search hardly ever fails. Its pattern is that of the answer
/// asked for once the inertia is small enough; where nothing holds the object, its rates
/// grow without end instead, and nothing passes.
void ease_with_inertia(const SpatialProblem& problem, const LinearCone& cone,
                       const SpatialReferenceOptions& options, SpatialReference& best) {
  const ComplementarityProblem rows = complementarity_of(cone);
  for (const double inertia : {1e-2, 1e-4, 1e-6}) {
    if (best.residual <= options.gate) return;
    LinearCone eased = cone;
    eased.inertia.diagonal().array() += inertia;
    const PivotingResult found =
        solve_by_pivoting(complementarity_of(eased), {.starts = options.starts});
    best.steps += found.pivots;
    if (found.z.empty()) continue;
    offer(problem, cone, options.generators, sharpened(rows, found.z), best);
  }
}

}  // namespace

SpatialReference solve_spatial_pivoting(const SpatialProblem& problem,
                                        const SpatialReferenceOptions& options) {
  SpatialReference best;
  LinearCone cone;
  if (options.starts < 1 || !pose_linear_cone(problem, options.generators, cone)) {
    best.status = SpatialReferenceStatus::kBadInput;
    return best;
  }
  const PivotingResult found =
      solve_by_pivoting(complementarity_of(cone), {.starts = options.starts});
  best.steps = found.pivots;
  if (found.status == LcpStatus::kInfeasible) {
    best.status = SpatialReferenceStatus::kInfeasible;
    return best;
  }
  if (!found.z.empty()) offer(problem, cone, options.generators, found.z, best);
  ease_with_inertia(problem, cone, options, best);
  set_status(options.gate, best);
  return best;
}

SpatialReference solve_spatial_reference(const SpatialProblem& problem,
                                         const SpatialReferenceOptions& options) {
  SpatialReference best;
  if (!ipopt_is_built()) return best;
  LinearCone cone;
  if (options.starts < 1 || !pose_linear_cone(problem, options.generators, cone)) {
    best.status = SpatialReferenceStatus::kBadInput;
    return best;
  }
  const ComplementarityProblem rows = complementarity_of(cone);
  NonlinearProgram program = program_of(rows);
  for (int index = 0; index < options.starts && best.residual > options.gate; ++index) {
    program.start = starting_point(problem, cone, index);
    const NlpResult found =
        minimise_ipopt(program, {.max_evaluations = options.max_iterations});
    best.steps += found.evaluations;
    if (found.x.size() != program.start.size()) continue;
    offer(problem, cone, options.generators, found.x, best);
    if (best.residual > kExact) {
      offer(problem, cone, options.generators, sharpened(rows, found.x), best);
    }
  }
  set_status(options.gate, best);
  return best;
}

bool spatial_reference_is_built() { return ipopt_is_built(); }

}  // namespace prehensile
