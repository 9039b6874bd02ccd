#include "mechanics/reference.h"

#include <algorithm>
#include <cmath>

#include "mechanics/polyhedral_instant.h"
#include "mechanics/polyhedral_polish.h"

namespace prehensile {
namespace {

/// A polished answer is exact on its cones up to rounding; one that is not within this
/// was polished with a wrong pattern.
constexpr double kExact = 1e-9;

struct Candidate {
  PolyhedralAnswer answer;
  double residual = kUnbounded;
};

/// The twist of least |v|^2 + omega^2 (lengths in levers of the pads) that carries point
/// i of the pusher along: how the object would move on a round limit surface.
PlanarTwist turning_about(const PolyhedralInstant& q, int i) {
  const Vec2 v = point_velocity(q.V_HP, q.p[i]);
  const Vec2 lever = perp(q.p[i]);
  const double omega = v.dot(lever) / (1.0 + lever.squaredNorm());
  const Vec2 at_centre = v - omega * lever;
  return {at_centre.x(), at_centre.y(), omega};
}

/// A guess of how the object moves if it does not slip along the pusher: the one end of a
/// line carries it where the other end then opens, else both do.
PlanarTwist guessed_twist(const PolyhedralInstant& q) {
  if (q.pushers == 1) return turning_about(q, 0);
  for (int i = 0; i < 2; ++i) {
    const PlanarTwist u = turning_about(q, i);
    if (q.pusher_rate(1 - i, u).x() > 0.0) return u;
  }
  return q.V_HP;
}

/// Friction is sought around a guessed motion: no slip along the pusher, slip one way, or
/// the other; then the same again with other motions, larger slips and sharper friction.
/// Betas and slacks start away from their bounds, with like products.
std::vector<double> starting_point(const PolyhedralInstant& q, int index) {
  const PolyhedralUnknowns z(q);
  const int round = index / 3;
  const double blur = 0.1 * std::pow(0.25, round);
  const int slip = index % 3 == 0 ? 0 : (index % 3 == 1 ? 1 : -1);
  PlanarTwist u = round % 2 == 0 ? guessed_twist(q) : q.V_HP;
  u.head<2>() += slip * (1.0 + round) * q.t;

  std::vector<double> values(z.count, 0.0);
  std::copy(u.begin(), u.end(), values.begin());
  for (int i = 0; i < z.pushers; ++i) {
    values[z.lambda_n(i)] = 0.5;
    if (!z.pusher_friction) continue;
    values[z.pusher_xi(i)] = blur + std::abs(q.pusher_rate(i, u).y());
    for (int side = 0; side < 2; ++side) {
      const bool opposes = slip == (side == 0 ? -1 : 1);
      values[z.pusher_beta(i, side)] = opposes ? 0.5 * q.mu : 0.1 * q.mu;
    }
  }
  for (int j = 0; j < z.points; ++j) {
    const Vec2 c = point_velocity(u, q.r[j]);
    const double xi = q.gauge(c);
    values[z.xi(j)] = xi + blur;
    double sum = 1.0;
    for (int k = 0; k < z.generators; ++k) {
      const double slack = xi + q.d[k].dot(c);
      values[z.beta(j, k)] = blur / (blur + slack);
      sum += values[z.beta(j, k)];
    }
    for (int k = 0; k < z.generators; ++k) values[z.beta(j, k)] *= q.bound[j] / sum;
  }
  return values;
}

Candidate judged(const PolyhedralInstant& q, PolyhedralAnswer answer) {
  const double residual = residual_of(q, answer);
  return {std::move(answer), residual};
}

/// The best of what the minimiser leaves behind, from several starts until one passes.
Candidate best_candidate(const PolyhedralInstant& q, const ReferenceOptions& options,
                         int& iterations) {
  const ComplementarityProblem problem = complementarity_of(q);
  NonlinearProgram program = program_of(problem);
  Candidate best;
  for (int index = 0; index < options.starts && best.residual > options.gate; ++index) {
    program.start = starting_point(q, index);
    const NlpResult found =
        minimise_ipopt(program, {.max_evaluations = options.max_iterations});
    iterations += found.evaluations;
    const Candidate raw = judged(q, answer_of(q, found.x));
    const Candidate sharp = judged(q, polished(q, found.x));
    for (const Candidate& candidate : {raw, sharp}) {
      if (candidate.residual < best.residual) best = candidate;
    }
  }
  return best;
}

/// While both ends of a line stick, only the sum of their tangential forces is
/// determined: they share it in proportion to their normal forces.
void share_tangential_force(PolyhedralAnswer& answer) {
  const double normal = answer.lambda_n[0] + answer.lambda_n[1];
  const double tangential = answer.lambda_t[0] + answer.lambda_t[1];
  if (!(normal > 0.0)) return;
  for (int i = 0; i < 2; ++i) {
    answer.lambda_t[i] = tangential * answer.lambda_n[i] / normal;
  }
}

ContactMode pusher_mode(double lambda_n, const Vec2& rate, double zero) {
  if (lambda_n <= zero && rate.x() > zero) return ContactMode::kOpen;
  if (std::abs(rate.y()) <= zero) return ContactMode::kStick;
  return rate.y() > 0.0 ? ContactMode::kSlipPlus : ContactMode::kSlipMinus;
}

/// `zero`: rates and forces below it are the residual of the answer.
InstantStatus status_of(const PolyhedralInstant& q, const PolyhedralAnswer& answer,
                        double zero) {
  if (answer.u.cwiseAbs().maxCoeff() > zero) return InstantStatus::kMoves;
  bool apart = true;
  for (int i = 0; i < q.pushers; ++i) {
    apart = apart && q.pusher_rate(i, answer.u).x() > zero;
  }
  return apart ? InstantStatus::kSeparated : InstantStatus::kHolds;
}

void write_pusher(const PolyhedralInstant& q, PolyhedralAnswer answer, double zero,
                  PlanarInstant& instant) {
  std::array<Vec2, 2> rates{Vec2::Zero(), Vec2::Zero()};
  for (int i = 0; i < q.pushers; ++i) rates[i] = q.pusher_rate(i, answer.u);
  if (q.pushers == 2 && std::abs(rates[0].y()) <= zero &&
      std::abs(rates[1].y()) <= zero) {
    share_tangential_force(answer);
  }
  PlanarWrench w = PlanarWrench::Zero();
  instant.pusher_count = q.pushers;
  for (int i = 0; i < q.pushers; ++i) {
    w += wrench_of(q.p[i], answer.lambda_n[i] * q.n + answer.lambda_t[i] * q.t);
    PusherPoint& point = instant.pusher[i];
    point.normal_force = std::max(0.0, answer.lambda_n[i]) * q.units.force;
    point.tangential_force = answer.lambda_t[i] * q.units.force;
    point.normal_rate = rates[i].x() * q.units.rate;
    point.slip_rate = rates[i].y() * q.units.rate;
    point.mode = pusher_mode(answer.lambda_n[i], rates[i], zero);
  }
  instant.w_push = q.wrench_in_hand(w);
  instant.push_force = instant.w_push.head<2>().norm();
}

void write_fingers(const PolyhedralInstant& q, const PolyhedralAnswer& answer,
                   double zero, PlanarInstant& instant) {
  instant.finger_count = static_cast<int>(q.r.size());
  for (int j = 0; j < instant.finger_count; ++j) {
    const bool sticks = q.gauge(point_velocity(answer.u, q.r[j])) <= zero;
    instant.finger[j] = {answer.f[j] * q.units.force,
                         sticks ? ContactMode::kStick : ContactMode::kSlip};
  }
}

}  // namespace

PlanarInstant solve_reference(const PlanarGrasp& grasp, const PlanarDrive& drive,
                              const ReferenceOptions& options) {
  PlanarInstant instant;
  if (!ipopt_is_built()) return instant;
  PolyhedralInstant q;
  if (!pose_polyhedral(grasp, drive, options.generators, q)) {
    instant.status = InstantStatus::kBadInput;
    return instant;
  }
  instant.iterations = 0;
  const Candidate best = best_candidate(q, options, instant.iterations);
  instant.residual = best.residual;
  if (!(best.residual <= options.gate)) {
    instant.status = InstantStatus::kOutOfIterations;
    return instant;
  }
  const double zero = std::max(kExact, best.residual);
  instant.status = status_of(q, best.answer, zero);
  instant.V_HO = q.twist_in_hand(best.answer.u);
  write_pusher(q, best.answer, zero, instant);
  write_fingers(q, best.answer, zero, instant);
  return instant;
}

bool reference_is_built() { return ipopt_is_built(); }

}  // namespace prehensile
