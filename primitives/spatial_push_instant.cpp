#include "primitives/spatial_push_instant.h"

#include <cmath>

#include "mechanics/spatial_certificate.h"
#include "mechanics/spatial_model.h"

namespace prehensile {
namespace {

constexpr double kLooseTolerance = 1e-7;

/// Difference of two motions over the pusher's speed from which on they are not the same.
constexpr double kOtherMotion = 1e-5;

/// Of the answers that those to other questions start from.
constexpr double kFirstTolerance = 1e-9;

/// Motion across the pads over the largest deflection of a loaded point, from which on
/// the object leaves the pad plane.
constexpr double kMostYield = 10.0;

/// Share of the pusher's speed below which motion across the pads is none.
constexpr double kGrazing = 1e-6;

/// Factor on the weight by which a grasp is seen to be about to fall.
constexpr double kHeavier = 1.01;

/// Looks at a ride over the wanted spacing of checks, of a pusher that does not turn.
constexpr double kStraightRide = 2.0;

bool is_pad(const ContactPatch& patch) { return patch.body != ContactBody::kPusher; }

/// A number that changes when a point of a pad gains or loses its load, or one of the
/// pusher its grip.
int pattern_of(const SpatialProblem& problem, const SpatialInstant& instant) {
  int pattern = 0;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const ContactMode mode = instant.point[i].mode;
      if (mode != ContactMode::kOpen) ++pattern;
      if (!is_pad(patch) && mode == ContactMode::kSlip) {
        pattern += SpatialProblem::kMaxPoints;
      }
    }
  }
  return pattern;
}

/// Velocity of the object along the closing direction at a point of it.
double rate_across(const SpatialTwist& V, double x, double y) {
  return V[2] + V[3] * y - V[4] * x;
}

bool same(const Seat& a, const Seat& b) {
  return a.kind == b.kind && a.side == b.side && a.p_P == b.p_P && a.p_O == b.p_O;
}

}  // namespace

SpatialPushInstant::SpatialPushInstant(const Model& model, const LinearPush& push,
                                       const Grasp& start,
                                       const TransitionOptions& options)
    : model_(&model),
      contact_(&model.contacts[push.contact]),
      push_(push),
      X_HO_start_(start.X_HO),
      geometry_(model, *contact_, push.place),
      scales_(scales_of(model, push)),
      ride_spacing_(options.max_step *
                    (push.turn == 0.0 && push.bend == 0.0 ? kStraightRide : 1.0)) {
  options_.tolerance = std::clamp(1e-3 * options.tolerance / scales_.speed, 1e-11, 1e-9);
}

PlanarPose SpatialPushInstant::pose(const Seat& seat, double s, const Vec2& q) const {
  return compose(pusher_pose(push_, X_HO_start_, s), geometry_.object(seat, q));
}

void SpatialPushInstant::pose_question(const Seat& seat, double s,
                                       const Vec2& q) noexcept {
  Answer& now = answers_[now_];
  if (now.s == s && now.q == q && same(now.seat, seat)) return;
  now.seat = seat;
  now.s = s;
  now.q = q;
  now.answered = now.probed = false;
  const PlanarPose X_HP = pusher_pose(push_, X_HO_start_, s);
  const PlanarPose X_PO = geometry_.object(seat, q);
  now.X_HO = compose(X_HP, X_PO);
  const SeatGeometry::Touch touch = geometry_.touch(seat, q);
  now.drive.count = touch.count;
  now.drive.p_HC = {transform(X_HP, touch.p_P[0]), transform(X_HP, touch.p_P[1])};
  now.drive.n_H = rotated(X_HP.theta, touch.n_P);
  now.drive.mu = contact_->mu;
  now.drive.V_HP = pusher_twist(push_, X_HO_start_, s);
  // The pusher stands still in the world, so gravity is constant in P.
  const Vec2 g_O = rotated(-X_PO.theta, contact_->g_O);
  now.problem = spatial_problem_at(*model_, *contact_, now.drive, now.X_HO, g_O,
                                   {.follow_free_pressure = true});
}

PushStop SpatialPushInstant::solve(const Seat& seat, double s, const Vec2& q,
                                   Search search) noexcept {
  pose_question(seat, s, q);
  Answer& now = answers_[now_];
  const bool probe = search == Search::kAllMotions && recedes();
  if (now.answered && (now.probed || !probe)) return now.stop;
  options_.probe_multiplicity = probe;
  now.answered = true;
  now.probed = probe;
  now.stop = ask(now);
  return now.stop;
}

/// Solves the question that was posed and reads the answer.
PushStop SpatialPushInstant::ask(Answer& now) noexcept {
  using enum TransitionStatus;
  if (now.problem.count == 0) {
    const bool falls = model_->F <= 0.0;
    if (!falls) return {kPadLost, EventKind::kPadOffFace, "the pads left the face"};
    return {kFalls, EventKind::kGravityLost,
            "the jaws cannot carry gravity along the closing direction"};
  }
  ++count_;
  SpatialWarmStart warm = warm_;
  const bool is_first = !warm.valid || warm.last.count != now.problem.count;
  if (is_first) {
    // Which of several motions is met first shall not depend on the tolerance.
    SpatialSolveOptions first = options_;
    first.tolerance = kFirstTolerance;
    first.probe_multiplicity = false;
    now.instant = solve_spatial(now.problem, first, &warm);
  }
  const SpatialWarmStart from = warm;
  // From nothing a sharper answer would be sought all over again, and not be found.
  if (!is_first || from.valid) {
    now.instant = solve_spatial(now.problem, options_, &warm);
  }
  // A looser answer is better than none; the certificate has the last word.
  SpatialSolveOptions loose = options_;
  loose.tolerance = kLooseTolerance;
  for (const bool from_last : {true, false}) {
    if (now.instant.status != InstantStatus::kOutOfIterations) break;
    if (from_last && !from.valid) continue;
    warm = from_last ? from : SpatialWarmStart{};
    now.instant = solve_spatial(now.problem, loose, &warm);
  }
  if (const PushStop stop = stop_of(now.instant.status)) return stop;
  read(now);
  now.out_of_plane = leaves_plane(now);
  now.pattern = pattern_of(now.problem, now.instant);
  if (now.out_of_plane <= 1.0) {
    warm_ = warm;
    return {};
  }
  return {kLeavesPlane, EventKind::kOutOfPlane, way_out(now)};
}

void SpatialPushInstant::keep() {
  const Answer& now = answer();
  kept_ = {.valid = !now.stop, .last = now.instant};
  kept_seat_ = now.seat;
  kept_s_ = now.s;
  kept_q_ = now.q;
  kept_pattern_ = now.pattern;
}

bool SpatialPushInstant::hopped() noexcept {
  const Answer& ahead = answer();
  const bool differs = kept_.valid && !ahead.stop && ahead.pattern != kept_pattern_;
  if (!differs || !same(ahead.seat, kept_seat_)) return false;
  const SpatialWarmStart from{.valid = true, .last = ahead.instant};
  set_aside();
  answers_[now_].s = kNan;
  warm_ = from;
  const PushStop stop = solve(kept_seat_, kept_s_, kept_q_);
  const SpatialTwist apart = answer().instant.V_HO - kept_.last.V_HO;
  const double speed = apart.head<3>().norm() + model_->L * apart.tail<3>().norm();
  bring_back();
  warm_ = from;
  return stop ? stop.status != TransitionStatus::kIterationLimit
              : speed > kOtherMotion * scales_.speed;
}

InMode SpatialPushInstant::solve_in_mode(const Seat& seat, double s, const Vec2& q,
                                         Regime /*regime*/) noexcept {
  return solve(seat, s, q) ? InMode::kUnknown : InMode::kMoves;
}

InMode SpatialPushInstant::check_ride(const Seat& seat, double s) noexcept {
  return solve_in_mode(seat, s, Vec2::Zero(), Regime::kStick);
}

/// The pusher's points of the pad plane are ends; each may touch at two heights.
void SpatialPushInstant::read(Answer& now) const noexcept {
  const SpatialProblem& problem = now.problem;
  const ContactPatch& pusher = problem.patch[problem.patch_count - 1];
  const int heights = pusher.count / now.drive.count;
  const SpatialTwist& V = now.instant.V_HO;
  ContactReading& contact = now.contact;
  contact = {};
  Vec2 friction = Vec2::Zero();
  for (int k = 0; k < now.drive.count; ++k) {
    contact.lift[k] = std::numeric_limits<double>::infinity();
    for (int h = 0; h < heights; ++h) {
      const int i = pusher.first + heights * k + h;
      const SpatialPoint& point = now.instant.point[i];
      contact.load[k] += point.normal_force;
      contact.lift[k] = std::min(contact.lift[k], point.normal_rate);
      contact.slip += point.slip_rate.x() / pusher.count;
      friction += point.tangential_force;
      const Vec3 p = problem.p_HC(i);
      const Vec3 yield(V[4] * p.z(), -V[3] * p.z(), rate_across(V, p.x(), p.y()));
      contact.yield = std::max(contact.yield, yield.norm());
    }
    contact.normal_force += contact.load[k];
  }
  contact.tangential_force = friction.x();
  contact.friction = friction.norm();
  contact.tilt_rate = now.seat.kind == SeatKind::kFlush ? 0.0 : V[5] - now.drive.V_HP[2];
  // What symmetric scenes have by rounding is no yield.
  if (contact.yield < noise() * scales_.speed) contact.yield = 0.0;
  const bool slips = std::abs(contact.slip) > contact.yield;
  now.slip_beyond_yield = slips ? contact.slip : 0.0;
}

/// Motion along the closing direction, as a share of what ends a push.
double SpatialPushInstant::leaves_plane(const Answer& now) const noexcept {
  const SpatialProblem& problem = now.problem;
  double fastest = 0.0;
  double yield = 0.0;
  for (int k = 0; k < problem.patch_count; ++k) {
    const ContactPatch& patch = problem.patch[k];
    if (!is_pad(patch)) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const SpatialPoint& point = now.instant.point[i];
      const double across = rate_across(now.instant.V_HO, problem.x[i], problem.y[i]);
      fastest = std::max({fastest, std::abs(across), std::abs(point.normal_rate)});
      if (point.normal_force <= 0.0) continue;
      yield = std::max(
          yield, patch.compliance * std::abs(point.normal_force - problem.preload[i]));
    }
  }
  return fastest / (kMostYield * yield + kGrazing * scales_.speed);
}

std::string_view SpatialPushInstant::way_out(const Answer& now) const noexcept {
  const SpatialTwist& V = now.instant.V_HO;
  const double turning = std::hypot(V[3], V[4]) * model_->half_thickness;
  if (turning >= std::abs(V[2])) return "the object tilts between the jaws";
  const std::array<double, 2>& jaws = now.instant.jaw_rate;
  if (-(jaws[0] + jaws[1]) > std::abs(V[2])) return "the object opens the jaws";
  return "the object moves along the closing direction";
}

PushStop SpatialPushInstant::explained(const PushStop& stop) const noexcept {
  using enum TransitionStatus;
  PushStop found = stop;
  if (stop.status == kIterationLimit && answer().problem.count > 0) {
    // Where a grasp all but falls it takes for ever to tell whether it does.
    SpatialProblem heavier = answer().problem;
    heavier.w_g *= kHeavier;
    const SpatialInstant fall = solve_spatial(heavier, options_);
    const bool falls =
        fall.status == InstantStatus::kDynamic ||
        (fall.status == InstantStatus::kAmbiguous && fall.evidence.allFinite());
    if (!falls) return found;
    return {kFalls, EventKind::kGravityLost, "the grasp alone hardly holds gravity"};
  }
  const SpatialInstant* seen = &answer().instant;
  SpatialInstant again;
  if (stop.status == kPusherLost) {
    SpatialSolveOptions thorough = options_;
    thorough.probe_multiplicity = true;
    again = solve_spatial(answer().problem, thorough);
    seen = &again;
    if (again.status == InstantStatus::kAmbiguous) found = stop_of(again.status);
  }
  if (found.status == kAmbiguous && !seen->evidence.allFinite()) {
    // A second motion leaves no evidence of a fall.
    SpatialSolveOptions plain = options_;
    plain.probe_multiplicity = false;
    SpatialWarmStart warm = warm_;
    again = solve_spatial(answer().problem, plain, &warm);
    seen = &again;
    if (again.status != InstantStatus::kAmbiguous) return found;
  }
  if (found.status != kAmbiguous || !seen->evidence.allFinite()) return found;
  return {kFalls, EventKind::kGravityLost, "the grasp alone does not hold gravity"};
}

Sample SpatialPushInstant::sample(double s, double psi) const {
  const Answer& now = answer();
  Sample sample = sample_of(now.contact, now.instant.status, now.instant.push_force);
  sample.s = s;
  sample.grasp = {now.X_HO, psi};
  sample.certificate = certify(now.problem, now.instant).worst;
  sample.jaw_force = {0.0, 0.0};
  int points = 0;
  int pressed = 0;
  for (int k = 0; k < now.problem.patch_count; ++k) {
    const ContactPatch& patch = now.problem.patch[k];
    if (!is_pad(patch)) continue;
    for (int i = patch.first; i < patch.first + patch.count; ++i) {
      const double force = now.instant.point[i].normal_force;
      sample.jaw_force[patch.body == ContactBody::kJaw1 ? 0 : 1] += force;
      ++points;
      pressed += force > 0.0 ? 1 : 0;
    }
  }
  sample.pressed = static_cast<double>(pressed) / points;
  sample.moment_across = now.instant.w_push.segment<2>(3).norm();
  sample.out_of_plane = now.out_of_plane;
  scale_forces(contact_->grip_share, sample);
  return sample;
}

}  // namespace prehensile
