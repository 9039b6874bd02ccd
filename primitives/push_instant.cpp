#include "primitives/push_instant.h"

#include <algorithm>
#include <cmath>

#include "primitives/ride_bound.h"

namespace prehensile {
namespace {

/// Slack of gravity, in units of the friction force, at which it counts as held.
constexpr double kHeld = 1e-9;

constexpr double kLooseTolerance = 1e-7;

}  // namespace

PushInstant::PushInstant(const Model& model, const LinearPush& push, const Grasp& start,
                         const TransitionOptions& options)
    : model_(&model),
      contact_(&model.contacts[push.contact]),
      push_(push),
      X_HO_start_(start.X_HO),
      geometry_(model, *contact_, push.place),
      friction_(options.friction_model),
      scales_(scales_of(model, push)) {
  options_.tolerance = std::clamp(1e-3 * options.tolerance / scales_.speed, 1e-12, 1e-9);
}

PlanarPose PushInstant::pose(const Seat& seat, double s, const Vec2& q) const {
  return compose(pusher_pose(push_, X_HO_start_, s), geometry_.object(seat, q));
}

/// The question at this point of the path; no grasp points where the pads are lost.
void PushInstant::pose_question(const Seat& seat, double s, const Vec2& q) noexcept {
  Answer& now = answers_[now_];
  const PlanarPose X_HP = pusher_pose(push_, X_HO_start_, s);
  const PlanarPose X_PO = geometry_.object(seat, q);
  now.X_HO = compose(X_HP, X_PO);
  // The pusher stands still in the world, so gravity is constant in P.
  const Vec2 g_O = rotated(-X_PO.theta, contact_->g_O);
  if (is_ellipsoid()) {
    const Vec2 weight_H = model_->mass * rotated(now.X_HO.theta, g_O);
    now.grasp.w_g = wrench_of(transform(now.X_HO, model_->p_OCom), weight_H);
    now.grasp.count = 1;
  } else {
    now.grasp = grasp_at(*model_, now.X_HO, g_O);
  }
  const SeatGeometry::Touch touch = geometry_.touch(seat, q);
  now.drive.count = touch.count;
  now.drive.p_HC = {transform(X_HP, touch.p_P[0]), transform(X_HP, touch.p_P[1])};
  now.drive.n_H = rotated(X_HP.theta, touch.n_P);
  now.drive.mu = contact_->mu;
  now.drive.V_HP = pusher_twist(push_, X_HO_start_, s);
}

PushStop PushInstant::solve(const Seat& seat, double s, const Vec2& q,
                            Search search) noexcept {
  pose_question(seat, s, q);
  Answer& now = answers_[now_];
  if (now.grasp.count == 0) {
    return {TransitionStatus::kPadLost, EventKind::kPadOffFace, "the pads left the face"};
  }
  ++count_;
  if (is_ellipsoid()) {
    now.instant = solve_limit_surface(model_->surface(), now.grasp.w_g, now.drive);
  } else {
    options_.probe_multiplicity = search == Search::kAllMotions && recedes();
    now.instant = solve_planar(now.grasp, now.drive, options_, &warm_);
    if (now.instant.status == InstantStatus::kOutOfIterations) {
      // A looser answer is better than none; the certificate has the last word.
      PlanarSolveOptions loose = options_;
      loose.tolerance = kLooseTolerance;
      now.instant = solve_planar(now.grasp, now.drive, loose, &warm_);
    }
  }
  const PushStop stop = stop_of(now.instant.status);
  if (stop) {
    warm_.valid = false;
    return stop;
  }
  now.solved = true;
  now.V_HO = now.instant.V_HO;
  now.contact.tangential_force = 0.0;
  for (int k = 0; k < now.drive.count; ++k) {
    now.contact.load[k] = now.instant.pusher[k].normal_force;
    now.contact.tangential_force += now.instant.pusher[k].tangential_force;
  }
  read(seat, now);
  return {};
}

PushInstant::InMode PushInstant::solve_in_mode(const Seat& seat, double s, const Vec2& q,
                                               Regime regime) noexcept {
  pose_question(seat, s, q);
  ++count_;
  return take_mode(seat, regime);
}

PushInstant::InMode PushInstant::check_ride(const Seat& seat, double s) noexcept {
  pose_question(seat, s, Vec2::Zero());
  ++checks_;
  return take_mode(seat, Regime::kStick);
}

PushInstant::InMode PushInstant::take_mode(const Seat& seat, Regime regime) noexcept {
  Answer& now = answers_[now_];
  if (now.grasp.count == 0) return InMode::kUnknown;
  ContactModeOfPush mode;
  if (seat.kind == SeatKind::kFlush) mode.load = ContactModeOfPush::Load::kBoth;
  if (regime != Regime::kStick) mode.slip = regime == Regime::kSlipPlus ? 1 : -1;
  const PlanarTwist* guess = warm_.valid ? &warm_.last.V_HO : nullptr;
  const MotionInMode motion =
      is_ellipsoid()
          ? solve_limit_surface_in_mode(model_->surface(), now.grasp.w_g, now.drive, mode)
          : solve_planar_in_mode(now.grasp, now.drive, mode, guess);
  if (motion.exists && !motion.held) return InMode::kUnheld;
  if (!motion.exists || !motion.advances) return InMode::kUnknown;
  now.solved = false;
  now.pivot = motion.pivot;
  now.V_HO = motion.V_HO;
  now.contact.load = motion.normal_force;
  now.contact.tangential_force = motion.tangential_force[0] + motion.tangential_force[1];
  if (warm_.valid) warm_.last.V_HO = now.V_HO;
  read(seat, now);
  return InMode::kMoves;
}

double PushInstant::ride_lasts(double most) const noexcept {
  const Answer& now = answer();
  // The ellipsoid, and pads that do not turn, resist with a constant wrench in P: loads
  // are linear in the share, so both ends tell.
  if (push_.bend == 0.0 && (is_ellipsoid() || push_.turn == 0.0)) return most;
  if (is_ellipsoid()) return 0.0;
  const double cone = contact_->mu * now.contact.normal_force - now.contact.friction;
  return sure_to_last(now.grasp, now.drive, push_.turn, push_.travel * push_.bend,
                      {now.contact.load, cone}, most);
}

bool PushInstant::recedes() const { return recedes_somewhere(answer().drive); }

PushStop PushInstant::explained(const PushStop& stop) const noexcept {
  using enum TransitionStatus;
  PushStop found = stop;
  if (is_ellipsoid()) {
    const bool held = model_->surface().load(answer().grasp.w_g) < 1.0;
    if (found.status != kAmbiguous || held) return found;
    return {kFalls, EventKind::kGravityLost, "the grasp alone does not hold gravity"};
  }
  if (stop.status == kPusherLost) {
    PlanarSolveOptions thorough = options_;
    thorough.probe_multiplicity = true;
    const PlanarInstant all = solve_planar(answer().grasp, answer().drive, thorough);
    if (all.status == InstantStatus::kAmbiguous) found = stop_of(all.status);
  }
  if (found.status != kAmbiguous || gravity_slack(answer().grasp) > kHeld) return found;
  return {kFalls, EventKind::kGravityLost, "the grasp alone does not hold gravity"};
}

/// What a twist and the forces of the pusher mean for the push.
void PushInstant::read(const Seat& seat, Answer& answer) const noexcept {
  const PlanarDrive& drive = answer.drive;
  const PlanarTwist V_PO = answer.V_HO - drive.V_HP;
  ContactReading& contact = answer.contact;
  contact.normal_force = 0.0;
  contact.slip = 0.0;
  for (int k = 0; k < drive.count; ++k) {
    const Vec2 c = point_velocity(V_PO, drive.p_HC[k]);
    contact.lift[k] = c.dot(drive.n_H);
    contact.slip += c.dot(drive.t_H()) / drive.count;
    contact.normal_force += contact.load[k];
  }
  contact.friction = std::abs(contact.tangential_force);
  contact.tilt_rate = seat.kind == SeatKind::kFlush ? 0.0 : V_PO[2];
}

Sample PushInstant::sample(double s, double psi) const {
  const Answer& now = answer();
  Sample sample = sample_of(now.contact, now.instant.status, now.instant.push_force);
  sample.s = s;
  sample.grasp = {now.X_HO, psi};
  sample.certificate = is_ellipsoid()
                           ? limit_surface_residual(model_->surface(), now.grasp.w_g,
                                                    now.drive, now.instant)
                           : certify(now.grasp, now.drive, now.instant).worst;
  scale_forces(contact_->grip_share, sample);
  return sample;
}

}  // namespace prehensile
