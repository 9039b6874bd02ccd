/// The search for a push that makes a wanted motion.
#include "primitives/place.h"

#include <algorithm>
#include <cmath>

#include "mechanics/pad_law.h"
#include "optimisation/nonlinear_program.h"
#include "primitives/place_slack.h"
#include "primitives/place_wrench.h"
#include "primitives/space_place.h"

namespace prehensile {
namespace {

/// Moments and cone edges met to this still count as met.
constexpr double kMet = 1e-7;

/// A contact, a place and a grip force, judged over the real pads.
struct Trial {
  double place = 0.0;
  double grip_force = 0.0;
  double slack = kNan;         ///< nominal, least along the path
  double robust_slack = kNan;  ///< over the margin
  double push_force = kNan;    ///< at the start
  double centre = kNan;        ///< of pressure at the start, from the face's centre

  /// Larger is better; trials that do not stick are ordered by how far they are from it.
  double merit(bool least_force) const {
    if (!(slack >= -kMet)) return std::isfinite(slack) ? slack - 10.0 : -1e6;
    if (!least_force) return robust_slack;
    return robust_slack >= 0.0 ? 1.0 / (1.0 + push_force) : robust_slack - 1.0;
  }
};

bool is_better(const PlacedPush& a, const PlacedPush& b, const PlaceOptions& options) {
  if (!b.found) return true;
  if (!options.least_force) return a.robust_slack > b.robust_slack;
  const bool safe_a = a.robust_slack >= 0.0;
  const bool safe_b = b.robust_slack >= 0.0;
  return safe_a != safe_b ? safe_a : a.push_force < b.push_force;
}

void keep(const PlacedPush& placed, const PlaceOptions& options, PlacedPush& best) {
  if (placed.found && is_better(placed, best, options)) best = placed;
  if (!best.found && !placed.found) best = placed;
}

class Search {
 public:
  Search(const Model& model, const WantedMotion& wanted, const PlaceOptions& options)
      : model_of_scene_(model),
        model_(model),
        grip_(grip_limits(model, options)),
        F_low_(with_grip(model, grip_.low).F),
        F_high_(with_grip(model, grip_.high).F),
        wanted_(wanted),
        options_(options) {}

  /// The best place on one contact within these grip forces.
  Trial best_on(const ContactVerdict& verdict, bool least_force) {
    least_force_ = least_force;
    contact_ = &model_.contacts[verdict.contact];
    const double half_face = 0.5 * (contact_->b - contact_->a).norm();
    Trial best;
    const double middle = 0.5 * (verdict.grip_low + verdict.grip_high);
    for (const double grip : {middle, verdict.grip_low, verdict.grip_high}) {
      // Where the load would act: the closed form.
      Trial start = judge(0.0, grip);
      if (!std::isfinite(start.centre)) continue;
      const double centre = std::clamp(start.centre, -half_face, half_face);
      keep_trial(judge(centre, grip), best);
      if (contact_->is_point) {
        improve_grip(verdict, half_face, best);
        if (verdict.grip_low == verdict.grip_high) break;
        continue;
      }
      const double step = std::min(contact_->half_length, half_face) / 3.0;
      for (const double side : {-1.0, 1.0}) {
        keep_trial(judge(std::clamp(centre + side * step, -half_face, half_face), grip),
                   best);
      }
      if (verdict.grip_low == verdict.grip_high) break;
    }
    if (!contact_->is_point) improve(verdict, half_face, best);
    return best;
  }

  /// The push made forward: instant, and the whole path where one is wanted.
  PlacedPush forward(int contact, const Trial& trial) {
    PlacedPush out;
    out.push = wanted_.push(contact, trial.place);
    out.grip_force = trial.grip_force;
    out.slack = trial.slack;
    out.robust_slack = trial.robust_slack;
    const Model model = with_grip(model_of_scene_, trial.grip_force);
    if (model.push_needs_space(model.contacts[contact])) {
      make_in_space(model, wanted_, options_.margin, out);
    } else {
      make_in_plane(model, out);
    }
    if (!wanted_.is_path) return out;
    out.forward = apply(model, {wanted_.X_HO, 0.0}, out.push);
    const PlanarPose end = pusher_pose(out.push, wanted_.X_HO, 1.0);
    const PlanarPose& got = out.forward.end.X_HO;
    out.end_distance = (translation(got) - translation(end)).norm();
    out.end_angle = std::abs(got.theta - end.theta);
    out.found = out.forward.completed() && out.end_distance <= kPlaceDistanceTolerance &&
                out.end_angle <= kPlaceAngleTolerance;
    return out;
  }

  /// The best push of a contact that needs space: that of the pad plane, if there is one,
  /// and of a line the place where it sticks most firmly. The verdict becomes what was
  /// found; that a contact cannot is not proved where the loads of the pads shift.
  void place_in_space(ContactVerdict& verdict, PlacedPush& best) {
    const int contact = verdict.contact;
    PlacedPush own;
    if (verdict.possible) {
      const Trial trial = best_on(verdict, options_.least_force);
      if (trial.slack >= -kMet) own = forward(contact, trial);
    }
    if (!model_of_scene_.contacts[contact].is_point) {
      const SpacePlace found =
          best_place_in_space(model_of_scene_, wanted_, contact, grip_.low, grip_.high);
      evaluations_ += found.evaluations;
      if (found.slack >= 0.0) {
        const double grip =
            options_.least_force
                ? loosest_in_space(model_of_scene_, wanted_, contact, found.place,
                                   grip_.low, found.grip_force, options_.margin)
                : found.grip_force;
        keep(forward(contact, {.place = found.place, .grip_force = grip}), options_, own);
      }
    }
    verdict = {.contact = contact, .possible = own.found};
    if (own.found) {
      verdict.grip_low = verdict.grip_high = own.grip_force;
    } else {
      verdict.reason = "no push found that does it in space, which proves nothing";
    }
    if (std::isfinite(own.grip_force)) keep(own, options_, best);
  }

  int evaluations() const { return evaluations_; }

 private:
  /// The first instant by the exact planar solver.
  void make_in_plane(const Model& model, PlacedPush& out) const {
    const PushContact& pusher = model.contacts[out.push.contact];
    const PlanarGrasp grasp = grasp_at(model, wanted_.X_HO, pusher.g_O);
    const PlanarDrive drive =
        drive_at(pusher, out.push.place, wanted_.X_HO, wanted_.twist_HO());
    const PlanarInstant instant = solve_by_pad_law(model, grasp, drive);
    out.status = instant.status;
    out.push_force = instant.push_force;
    out.certificate = certify_by_pad_law(model, grasp, drive, instant);
    const double c = std::max(model.c, 1e-9);
    const PlanarTwist difference = instant.V_HO - drive.V_HP;
    out.twist_error = std::hypot(difference[0], difference[1], c * difference[2]) /
                      std::hypot(drive.V_HP[0], drive.V_HP[1], c * drive.V_HP[2]);
    out.found = usable(out.status) && out.twist_error <= kPlaceTwistTolerance &&
                out.certificate <= 1e-6;
  }

  void set_grip(double force) {
    const double range = grip_.high - grip_.low;
    const double share = range > 0.0 ? (force - grip_.low) / range : 0.0;
    model_.F = F_low_ + share * (F_high_ - F_low_);
  }

  Trial judge(double place, double grip) {
    ++evaluations_;
    set_grip(grip);
    Trial trial{.place = place, .grip_force = grip};
    const StickAlong along =
        stick_along(model_, *contact_, wanted_, place, options_.margin);
    trial.slack = along.slack;
    trial.robust_slack = along.robust_slack;
    trial.push_force = along.push_force;
    trial.centre = along.centre;
    return trial;
  }

  void keep_trial(const Trial& trial, Trial& best) const {
    const bool better = !std::isfinite(best.slack) ||
                        trial.merit(least_force_) > best.merit(least_force_);
    if (std::isfinite(trial.slack) && better) best = trial;
  }

  /// Place and grip force by NLopt's subplex method, which bears the kinks of a least
  /// slack; without NLopt the starts remain.
  void improve(const ContactVerdict& verdict, double half_face, Trial& best) {
    if (!std::isfinite(best.slack)) return;
    const double range = verdict.grip_high - verdict.grip_low;
    NonlinearProgram program;
    program.start = {best.place / half_face};
    program.lower = {-1.0};
    program.upper = {1.0};
    if (range > 0.0) {
      program.start.push_back((best.grip_force - verdict.grip_low) / range);
      program.lower.push_back(0.0);
      program.upper.push_back(1.0);
    }
    program.objective = [&](std::span<const double> x, std::span<double>) {
      const double grip = verdict.grip_low + (x.size() > 1 ? x[1] * range : 0.0);
      const Trial trial = judge(x[0] * half_face, grip);
      keep_trial(trial, best);
      const double merit = trial.merit(least_force_);
      return std::isfinite(merit) ? -merit : 1e6;
    };
    minimise_nlopt(program, LocalMethod::kSubplex,
                   {.tolerance = 1e-7, .max_evaluations = 120}, 0.1);
  }

  /// A point must stand where the load acts, so its place follows from the grip force.
  void improve_grip(const ContactVerdict& verdict, double half_face, Trial& best) {
    const double range = verdict.grip_high - verdict.grip_low;
    if (range <= 0.0 || !std::isfinite(best.slack)) return;
    NonlinearProgram program;
    program.start = {(best.grip_force - verdict.grip_low) / range};
    program.lower = {0.0};
    program.upper = {1.0};
    program.objective = [&](std::span<const double> x, std::span<double>) {
      const double grip = verdict.grip_low + x[0] * range;
      const Trial start = judge(0.0, grip);
      if (!std::isfinite(start.centre)) return 1e6;
      const Trial trial = judge(std::clamp(start.centre, -half_face, half_face), grip);
      keep_trial(trial, best);
      const double merit = trial.merit(least_force_);
      return std::isfinite(merit) ? -merit : 1e6;
    };
    minimise_nlopt(program, LocalMethod::kSubplex,
                   {.tolerance = 1e-7, .max_evaluations = 80}, 0.1);
  }

  const Model& model_of_scene_;
  Model model_;  // its friction changes with the grip force
  GripLimits grip_;
  double F_low_, F_high_;
  const WantedMotion& wanted_;
  const PlaceOptions& options_;
  const PushContact* contact_ = nullptr;
  bool least_force_ = false;
  int evaluations_ = 0;
};

std::string_view fault_of(const Model& model, const WantedMotion& wanted,
                          const PlaceOptions& options) {
  const GripLimits grip = grip_limits(model, options);
  if (!(model.F > 0.0)) return "the grasp has no friction or no grip force";
  if (!(grip.low > 0.0 && grip.low <= grip.high && std::isfinite(grip.high))) {
    return "the grip forces are not a range above 0";
  }
  const bool finite = wanted.velocity.allFinite() && std::isfinite(wanted.turn);
  if (!finite || (wanted.velocity.isZero(0.0) && wanted.turn == 0.0)) {
    return "no motion is wanted";
  }
  if (!pads_on_object(model, wanted.X_HO)) return "the pads are not on the object";
  return {};
}

}  // namespace

PlanarTwist WantedMotion::twist_HO() const {
  const Vec2 v = rotated(X_HO.theta, velocity);
  return {v.x(), v.y(), turn};
}

LinearPush WantedMotion::push(int contact, double place) const {
  const double travel = velocity.norm();
  return {.contact = contact,
          .place = place,
          .e = travel > 0.0 ? Vec2(velocity / travel) : Vec2(1.0, 0.0),
          .travel = travel,
          .turn = turn};
}

WantedMotion motion_of_twist(const PlanarPose& X_HO, const PlanarTwist& V_HO) {
  return {
      .X_HO = X_HO, .velocity = rotated(-X_HO.theta, V_HO.head<2>()), .turn = V_HO[2]};
}

WantedMotion motion_between(const PlanarPose& from, const PlanarPose& to) {
  return {.X_HO = from,
          .velocity = finger_in_object(from) - finger_in_object(to),
          .turn = to.theta - from.theta,
          .is_path = true};
}

std::string_view name(PlaceAnswer::Status status) {
  switch (status) {
    case PlaceAnswer::Status::kFound:
      return "found";
    case PlaceAnswer::Status::kImpossible:
      return "impossible";
    case PlaceAnswer::Status::kNotFound:
      return "not found";
    case PlaceAnswer::Status::kBadInput:
      return "bad input";
  }
  return "unknown";
}

PlaceAnswer find_place(const Model& model, const WantedMotion& wanted,
                       const PlaceOptions& options) {
  PlaceAnswer answer;
  answer.reason = fault_of(model, wanted, options);
  if (!answer.reason.empty()) return answer;
  answer.verdicts = verdicts_of(model, wanted, options);
  Search search(model, wanted, options);
  bool all_proved = true;
  for (ContactVerdict& verdict : answer.verdicts) {
    if (model.push_needs_space(model.contacts[verdict.contact])) {
      all_proved = false;
      search.place_in_space(verdict, answer.best);
      continue;
    }
    if (!verdict.possible) {
      all_proved = all_proved && proves(model, wanted, options, verdict);
      continue;
    }
    all_proved = false;
    Trial trial = search.best_on(verdict, options.least_force);
    if (!(trial.slack >= -kMet)) continue;
    PlacedPush placed = search.forward(verdict.contact, trial);
    if (!placed.found && options.least_force) {
      trial = search.best_on(verdict, false);
      placed = search.forward(verdict.contact, trial);
    }
    keep(placed, options, answer.best);
  }
  answer.evaluations = search.evaluations();
  if (answer.best.found) {
    answer.status = PlaceAnswer::Status::kFound;
  } else if (all_proved && !answer.verdicts.empty()) {
    answer.status = PlaceAnswer::Status::kImpossible;
    answer.reason = "no contact can exert the wrench that this motion needs";
  } else {
    answer.status = PlaceAnswer::Status::kNotFound;
    answer.reason =
        answer.verdicts.empty() ? "the scene has no contact"
        : answer.best.status == InstantStatus::kAmbiguous
            ? "the pads alone do not hold the object: the motion would not be "
              "the only one"
            : "no push passed the forward check";
  }
  return answer;
}

}  // namespace prehensile
