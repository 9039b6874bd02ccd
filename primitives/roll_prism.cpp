#include "primitives/roll_prism.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "primitives/prism_attitudes.h"

namespace prehensile {
namespace {

constexpr double kNegligible = 1e-6;
constexpr double kLongestStep = std::numbers::pi / 180.0;  // [rad] between looks
constexpr double kJustAfter = 1e-8;                        // [rad] of a change
constexpr double kNegligibleShare = 1e-12;                 // of the travel
constexpr double kMostTurns = 250.0;                       // that allow more steps

/// Why the roll cannot even begin; empty if it can.
std::string_view refusal(const Model& model, const Grasp& start, const Roll& roll,
                         const TransitionOptions& options) {
  if (roll.contact < 0 || roll.contact >= static_cast<int>(model.contacts.size()))
    return "there is no such contact";
  if (!are_usable(options)) return "an option is out of range";
  const double sum =
      roll.travel + start.psi + start.X_HO.x + start.X_HO.y + start.X_HO.theta;
  if (!std::isfinite(sum)) return "a number is not finite";
  if (!std::isfinite(roll.grip_force) || roll.grip_force < 0.0)
    return "the grip force is no force";
  if (roll.travel == 0.0) return "the pusher does not move";
  const PushContact& contact = model.contacts[roll.contact];
  if (std::abs(contact.t.dot(model.prism->axis)) < 0.5)
    return "the support is not on one of the object's long sides";
  if (contact.is_point) return "a point gives a rolling object no support";
  if (half_pad(model.scene.gripper.pad, rotated(start.X_HO.theta, contact.n)).isZero())
    return "rolling over edges is known for rectangular pads square to the object only";
  if (model.scene.gripper.jaw_mode == JawMode::kIndependent)
    return "independent jaws cannot hold against the support";
  const Vec2 gravity = model.mass * contact.g_O;
  const double rounding = 1e-12 * gravity.norm();
  if (std::abs(contact.t.dot(gravity)) > kNegligible * model.F + rounding)
    return "gravity has a part along the object's axis, which sliding pads cannot hold";
  if (model.scene.g_Wz != 0.0) return "gravity has a part along the closing direction";
  return {};
}

/// Follows a roll from attitude to attitude.
class Walk {
 public:
  Walk(const PrismRoll& roll, double travel, const TransitionOptions& options,
       std::vector<Sample>* trace)
      : roll_(roll),
        travel_(std::abs(travel)),
        options_(options),
        record_(options.certificate_tolerance, trace),
        phi_(roll.first()),
        here_(look(phi_)),
        pivot_(roll.pivot(here_.contacts)) {}

  Transition run() {
    record_.add(roll_.sample(phi_, 0.0, here_));
    if (!here_.rolls) stop(phi_, here_);
    const double longest =
        std::min(kLongestStep, options_.max_step * travel_ / roll_.polygon().size);
    for (int i = 0; !record_.stopped() && done_ < travel_; ++i) {
      if (i >= allowed_steps()) {
        record_.stop({TransitionStatus::kIterationLimit, {}, "too many steps"}, share());
        break;
      }
      advance(longest);
    }
    return record_.finish(roll_.grasp(phi_), share(), 1e-9 * roll_.polygon().size,
                          looks_);
  }

 private:
  PrismLook look(double phi) {
    ++looks_;
    return roll_.look(phi);
  }
  /// The option's number for every turn, so that long rolls end by their travel.
  double allowed_steps() const {
    const double turns = std::abs(phi_ - roll_.first()) / (2.0 * std::numbers::pi);
    return options_.max_steps * (1.0 + std::min(std::floor(turns), kMostTurns));
  }
  double share() const { return std::min(1.0, done_ / travel_); }
  void stop(double phi, const PrismLook& look) {
    const bool failed = !(look.certificate <= options_.certificate_tolerance) &&
                        look.instant.status != InstantStatus::kNotRun;
    const PushStop why = roll_.why_not(phi, look);
    if (failed && why.status != TransitionStatus::kUncertified) {
      record_.stop(
          {TransitionStatus::kUncertified, {}, "an instant failed its certificate"},
          share());
      return;
    }
    record_.stop(why, share());
  }

  /// Travel of the support from the last recorded attitude to phi.
  double travel_to(double phi) const {
    const double from = roll_.place(pivot_, phi_, here_.contacts);
    return roll_.way() * (roll_.place(pivot_, phi, roll_.contacts(phi)) - from);
  }

  /// The first angle in (good, bad] from which `is_bad` holds, as the last good one.
  template <typename Predicate>
  static double last_good(double good, double bad, const Predicate& is_bad) {
    for (int i = 0; i < 60 && std::abs(bad - good) > 1e-13; ++i) {
      const double middle = 0.5 * (good + bad);
      (is_bad(middle) ? bad : good) = middle;
    }
    return good;
  }

  void move_to(double phi, PrismLook look) {
    done_ += travel_to(phi);
    phi_ = phi;
    here_ = std::move(look);
    record_.add(roll_.sample(phi_, share(), here_));
  }

  /// What each contact touches: while it stays the same, forces change smoothly.
  std::array<int, 2> touched(double phi) const {
    const PrismContacts contacts = roll_.contacts(phi);
    return {contacts.touch[kJaw1].vertex[0], contacts.touch[kJaw2].vertex[0]};
  }

  /// Cuts a step where a jaw comes to touch something else. True if it did.
  bool cut_at_a_change(double& end) const {
    const double from = phi_ + roll_.way() * kJustAfter;
    if (roll_.way() * (end - from) <= 0.0) return false;
    const std::array<int, 2> first = touched(from);
    if (touched(end) == first) return false;
    end = last_good(from, end, [&](double phi) { return touched(phi) != first; });
    return true;
  }

  void advance(double longest) {
    bool is_flat = false;
    double target = roll_.next(phi_, longest, is_flat);
    // Just before a flat the contacts are still those of this step.
    double before = is_flat ? target - roll_.way() * kJustBefore : target;
    if (roll_.way() * (before - phi_) <= 0.0) before = target;
    const bool is_change = cut_at_a_change(before);
    if (is_change) is_flat = false;
    if (done_ + travel_to(before) >= travel_) {
      const double left = travel_ - done_;
      before = last_good(phi_, before, [&](double phi) { return travel_to(phi) > left; });
      is_flat = false;
      ends_ = true;
    }
    const PrismLook ahead = look(before);
    if (!ahead.rolls) return end_within(before);
    if (!is_flat) {
      move_to(before, ahead);
      if (is_change && !ends_) check_just_after();
    } else {
      arrive_at(target);
    }
    if (ends_) done_ = travel_;
  }

  /// Beyond a change of what the jaws touch the forces may jump.
  void check_just_after() {
    const double after = phi_ + 2.0 * roll_.way() * kJustAfter;
    const PrismLook at = look(after);
    if (!at.rolls && !record_.stopped()) stop(after, at);
  }

  /// A side lies flat on the support or at a jaw.
  void arrive_at(double target) {
    const PrismLook at = look(target);
    if (!at.contacts.held()) return stop(target, at);
    move_to(target, at);
    const int pivot = roll_.pivot(at.contacts);
    if (pivot != pivot_) record_.add(EventKind::kOverEdge, share());
    pivot_ = pivot;
    ends_ = done_ >= travel_ * (1.0 - kNegligibleShare);
    if (!at.rolls && !ends_ && !record_.stopped()) stop(target, at);
  }

  /// The object stops to roll between here and there.
  void end_within(double bad) {
    const double last =
        last_good(phi_, bad, [&](double phi) { return !look(phi).rolls; });
    if (last != phi_) move_to(last, look(last));
    const double beyond = last + roll_.way() * 1e-12;
    PrismLook why = look(beyond);
    if (why.rolls) why = look(bad);
    if (!record_.stopped()) stop(beyond, why);
  }

  const PrismRoll& roll_;
  double travel_;
  const TransitionOptions& options_;
  PushRecord record_;
  int looks_ = 0;
  double done_ = 0.0;  // [m]
  bool ends_ = false;
  double phi_;
  PrismLook here_;
  int pivot_;
};

}  // namespace

Transition apply_prism_roll(const Model& model, const Grasp& start, const Roll& roll,
                            const TransitionOptions& options,
                            std::vector<Sample>* trace) noexcept {
  PushRecord record(options.certificate_tolerance, trace);
  const std::string_view reason = refusal(model, start, roll, options);
  if (!reason.empty()) {
    record.stop({TransitionStatus::kRefused, {}, reason}, 0.0);
    return record.finish(start, 0.0, kNan, 0);
  }
  const PrismRoll prism(model, start, roll);
  if (!prism.contacts(prism.first()).held()) {
    record.stop({TransitionStatus::kRefused, {}, "the pads are not on the object"}, 0.0);
    return record.finish(start, 0.0, kNan, 0);
  }
  return Walk(prism, roll.travel, options, trace).run();
}

}  // namespace prehensile
