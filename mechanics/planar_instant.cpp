#include "mechanics/planar_instant.h"

#include "mechanics/contact_mode.h"
#include "mechanics/motion_in_mode.h"
#include "mechanics/pad_friction.h"
#include "mechanics/proximal_newton.h"
#include "mechanics/push_verdict.h"

namespace prehensile {
namespace {

/// Pads whose mean lever is this small against their distance from the pusher are one
/// point: their torque is below the rounding of the pusher's.
constexpr double kPointPad = 5e-10;

/// Finger points slower than this, relative to the pusher, are said to stick.
constexpr double kSticks = 1e-8;

/// Accelerations this much larger than the pusher's are those of a fall.
constexpr double kFallsFreely = 1e6;

struct Problem {
  PadFriction pads;
  ScaledPush push;
};

/// Pads and push in common units; false if the data make no sense.
bool is_posed(const PlanarGrasp& grasp, const PlanarDrive& drive,
              const PadFriction::Frame& frame) {
  const double rate = contact_rate(drive);
  return frame.force > 0.0 && std::isfinite(frame.force) && std::isfinite(frame.length) &&
         is_sane(grasp.w_g, drive) && rate > 0.0 && std::isfinite(rate) &&
         grasp.inertia.allFinite();
}

Problem pose(const PlanarGrasp& grasp, const PlanarDrive& drive,
             PadFriction::Frame frame) {
  const double distance = (drive.p_HC[0] - frame.centre).norm();
  const bool is_point = !(frame.torque_radius > kPointPad * distance);
  if (is_point) frame.length = distance > 0.0 ? 1e-3 * distance : 1.0;
  return {PadFriction(grasp, frame, is_point),
          scaled(grasp.w_g, drive, frame.centre, frame.length, frame.force)};
}

/// Friction of the pads on the object, point by point.
void report_fingers(const PlanarGrasp& grasp, const Problem& problem,
                    const Motion& motion, PlanarInstant& answer) {
  const PadFriction& pads = problem.pads;
  const bool rests = motion.u.isZero(0.0);
  std::array<Vec2, PlanarGrasp::kCapacity> forces;
  if (rests) {
    pads.rest_forces(problem.push.w_g + motion.w, forces.data());
  } else {
    pads.moving_forces(motion.u, motion.pivot, forces.data());
  }
  answer.finger_count = pads.count();
  for (int j = 0; j < pads.count(); ++j) {
    const Vec2 rate = point_velocity(answer.V_HO, {grasp.x[j], grasp.y[j]});
    const bool sticks = rate.norm() <= kSticks * problem.push.units.rate;
    answer.finger[j].force = -problem.push.units.force * forces[j];
    answer.finger[j].mode = sticks ? ContactMode::kStick : ContactMode::kSlip;
  }
}

/// The motion of the last instant, tried on this one.
bool follow(const Problem& problem, const PlanarInstant& last, Motion& motion) {
  const ScaledPush& push = problem.push;
  if (last.pusher_count != push.count || !last.V_HO.allFinite()) return false;
  const PushModes<PadFriction> modes(problem.pads, push);
  const PlanarUnits& units = push.units;
  const Vec2 v = point_velocity(last.V_HO, push.centre) / units.rate;
  const PlanarTwist guess(v.x(), v.y(), last.V_HO[2] * units.length / units.rate);
  int loaded = -1;
  int count = 0;
  for (int i = 0; i < push.count; ++i) {
    if (last.pusher[i].mode == ContactMode::kOpen) continue;
    loaded = i;
    ++count;
  }
  if (count == 0) return false;
  const ContactMode mode = last.pusher[loaded].mode;
  const int slip = mode == ContactMode::kStick      ? 0
                   : mode == ContactMode::kSlipPlus ? 1
                                                    : -1;
  if (count == 2) {
    return slip == 0 ? modes.both_stick(motion) : modes.both_slip(slip, &motion, 1) > 0;
  }
  return slip == 0 ? modes.point_sticks(loaded, &guess, motion)
                   : modes.point_slips(loaded, slip, false, &guess, motion);
}

/// Motion with the forces and modes of a Newton answer.
void report_newton(const Problem& problem, const NewtonAnswer& newton,
                   const Eigen::Matrix3d&, PlanarInstant& answer) {
  const ScaledPush& push = problem.push;
  const double F0 = push.units.force;
  Motion motion;
  motion.support = Motion::Support::kBoth;
  motion.u = newton.u;
  motion.normal = newton.normal;
  motion.tangential = newton.tangential;
  motion.residual = newton.residual;
  motion.steps = newton.steps;
  for (int i = 0; i < push.count; ++i) {
    const Vec2 f = newton.normal[i] * push.n + newton.tangential[i] * push.t;
    motion.w += wrench_of(push.p[i], f);
  }
  report(push, motion, answer);
  answer.evaluations = newton.steps;
  for (int i = 0; i < push.count; ++i) {
    const double bound = push.mu * newton.normal[i];
    ContactMode& mode = answer.pusher[i].mode;
    if (newton.normal[i] <= 0.0) {
      mode = ContactMode::kOpen;
    } else if (std::abs(newton.tangential[i]) < bound) {
      mode = ContactMode::kStick;
    } else {
      mode = answer.pusher[i].slip_rate > 0.0 ? ContactMode::kSlipPlus
                                              : ContactMode::kSlipMinus;
    }
  }
  answer.finger_count = problem.pads.count();
  for (int j = 0; j < problem.pads.count(); ++j) {
    const Vec2& force = newton.finger[j];
    const bool sticks = force.norm() < problem.pads.bound(j) * (1.0 - 1e-12);
    answer.finger[j].force = F0 * force;
    answer.finger[j].mode = sticks ? ContactMode::kStick : ContactMode::kSlip;
  }
}

/// Inertia about the centre of the pads, in the units of the push.
Eigen::Matrix3d scaled_inertia(const PlanarGrasp& grasp, const ScaledPush& push) {
  const PlanarUnits& units = push.units;
  Eigen::Matrix3d to_origin = Eigen::Matrix3d::Identity();
  to_origin(0, 2) = push.centre.y();
  to_origin(1, 2) = -push.centre.x();
  const Vec3 stretch(1.0, 1.0, 1.0 / units.length);
  return units.rate / units.force *
         (stretch.asDiagonal() * to_origin.transpose() * grasp.inertia * to_origin *
          stretch.asDiagonal());
}

void solve_with_newton(const Problem& problem, const Eigen::Matrix3d& M,
                       const PlanarSolveOptions& options, PlanarInstant& answer) {
  const NewtonAnswer newton =
      solve_proximal_newton(problem.pads, problem.push, M, PlanarTwist::Zero(),
                            options.tolerance, options.max_iterations);
  report_newton(problem, newton, M, answer);
  answer.status =
      newton.converged ? InstantStatus::kMoves : InstantStatus::kOutOfIterations;
}

/// Accelerations from rest.
void solve_inertial(const PlanarGrasp& grasp, Problem& problem,
                    const PlanarSolveOptions& options, PlanarInstant& answer) {
  const Eigen::Matrix3d M = scaled_inertia(grasp, problem.push);
  problem.push.inertial_force = M * problem.push.V;
  Motion motion;
  const PushModes<PadFriction> modes(problem.pads, problem.push);
  if (problem.push.count == 2 && modes.both_stick(motion)) {
    answer.status = InstantStatus::kMoves;
    report(problem.push, motion, answer);
    report_fingers(grasp, problem, motion, answer);
    return;
  }
  solve_with_newton(problem, M, options, answer);
  const double rate = std::max(answer.V_HO.head<2>().norm(),
                               problem.push.units.length * std::abs(answer.V_HO[2]));
  if (answer.status != InstantStatus::kMoves ||
      !(rate > kFallsFreely * problem.push.units.rate)) {
    return;
  }
  // The push is lost in the rounding of a fall.
  answer = PlanarInstant{};
  answer.status = InstantStatus::kOutOfIterations;
  PlanarTwist unsupported;
  if (problem.pads.holds(problem.push.w_g, &unsupported)) return;
  const PushVerdict fall = judge_unheld(problem.pads, problem.push, unsupported);
  if (fall.status == InstantStatus::kDynamic) report(problem.push, fall, answer);
}

void solve_quasi_static(const PlanarGrasp& grasp, Problem& problem,
                        const PlanarSolveOptions& options, const PlanarWarmStart* warm,
                        PlanarInstant& answer) {
  Motion known;
  const bool follows =
      warm != nullptr && warm->valid && follow(problem, warm->last, known);
  PushVerdict verdict = judge_push(problem.pads, problem.push, follows ? &known : nullptr,
                                   options.probe_multiplicity);
  if (!usable(verdict.status) && problem.pads.merge_near_points()) {
    verdict = judge_push(problem.pads, problem.push, nullptr, options.probe_multiplicity);
  }
  if (verdict.status == InstantStatus::kOutOfIterations) {
    solve_with_newton(problem, Eigen::Matrix3d::Zero(), options, answer);
    if (verdict.has_evidence && answer.status == InstantStatus::kMoves) {
      answer.status = InstantStatus::kAmbiguous;
      answer.evidence = twist_in_hand(problem.push, verdict.evidence);
    }
    return;
  }
  report(problem.push, verdict, answer);
  if (usable(answer.status) || answer.status == InstantStatus::kAmbiguous) {
    report_fingers(grasp, problem, verdict.motion, answer);
  }
}

}  // namespace

PlanarInstant solve_planar(const PlanarGrasp& grasp, const PlanarDrive& drive,
                           const PlanarSolveOptions& options,
                           PlanarWarmStart* warm) noexcept {
  PlanarInstant answer;
  const PadFriction::Frame frame = PadFriction::frame_of(grasp);
  if (!is_posed(grasp, drive, frame)) {
    answer.status = InstantStatus::kBadInput;
    return answer;
  }
  Problem problem = pose(grasp, drive, frame);
  if (!is_within_range(problem.push)) {
    answer.status = InstantStatus::kBadInput;
    return answer;
  }
  if (grasp.inertia.isZero(0.0)) {
    solve_quasi_static(grasp, problem, options, warm, answer);
  } else {
    solve_inertial(grasp, problem, options, answer);
  }
  answer.evaluations += problem.pads.sums();
  if (warm != nullptr) {
    warm->valid = usable(answer.status);
    warm->last = answer;
  }
  return answer;
}

MotionInMode solve_planar_in_mode(const PlanarGrasp& grasp, const PlanarDrive& drive,
                                  const ContactModeOfPush& mode,
                                  const PlanarTwist* guess) noexcept {
  const PadFriction::Frame frame = PadFriction::frame_of(grasp);
  if (!is_posed(grasp, drive, frame)) return {};
  const Problem problem = pose(grasp, drive, frame);
  return motion_in_mode(problem.pads, problem.push, mode, guess);
}

}  // namespace prehensile
