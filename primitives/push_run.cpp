#include "primitives/push_run.h"

#include <cmath>
#include <utility>

#include "primitives/spatial_push_instant.h"

namespace prehensile {
namespace {

using enum Search;

/// Shortest step of a ride over that spacing, where nothing is sure.
constexpr double kLeastRide = 0.5;

/// Spacing over that spacing of the search for other motions where the pusher recedes.
constexpr double kProbeSpacing = 4.0;

}  // namespace

template <class Instant>
void PushRun<Instant>::begin() {
  seat_ = instant_.geometry().first();
  whole_ = model_.region.is_whole(instant_.pose(seat_, s_, q_));
  if (!solve_here()) return;
  const ModeMargin margin = instant_.margin(seat_, Regime::kStick);
  for (const int lifted : {0, 1}) {
    if (margin.pressed[lifted] >= -instant_.noise()) continue;
    take_seat(instant_.geometry().tipped(seat_, q_[0], 1 - lifted), EventKind::kCorner);
    break;
  }
  if (record_.stopped()) return;
  regime_ = instant_.regime();
  margin_ = mode_margin();
  record_.add(instant_.sample(s_, psi_));
}

/// One attempt at a step: it is refused, taken up to an event, or taken.
template <class Instant>
void PushRun<Instant>::advance() {
  if (++attempts_ > options_.max_steps) {
    return record_.stop(
        {TransitionStatus::kIterationLimit, {}, "the step limit was reached"}, s_);
  }
  step_.s = s_;
  step_.y = q_;
  step_.rate = rate_;
  instant_.resume();
  if (!(rides() ? ride() : integrate())) return;
  if (step_.h > 2.0 * control_.location() && instant_.hopped()) {
    // The motion that is followed ends within this step, or was lost from sight.
    return control_.land(0.5 * step_.h);
  }

  const Crossing crossing = first_crossing();
  if (crossing.at > 1.0) {
    landed_ = false;
    return accept(1.0);
  }
  const double location = control_.location();
  if (step_.h > 2.0 * location && is_of_other_motion(crossing)) {
    return control_.land(0.5 * step_.h);
  }
  const bool may_be_later = !crossing.limit || crossing.returns;
  if (may_be_later && crossing.at == 0.0 && step_.h > kShortest * location) {
    // Right after an event the new mode may last for less than this step.
    return control_.land(0.25 * step_.h);
  }
  if (crossing.at > 0.0) {
    if (!rides() && !is_close(crossing.at)) {
      // Again, with an end a little beyond the event: there the state is as good as the
      // step.
      landed_ = true;
      return control_.land((1.0 + kBeyond) * crossing.at * step_.h);
    }
    accept(crossing.at);
  }
  landed_ = false;
  if (!record_.stopped()) pass(crossing);
}

/// The object moves with the pusher: the step is known, and only the pusher's forces at
/// its end are looked at; at the end of the push the instant is solved.
template <class Instant>
bool PushRun<Instant>::ride() {
  step_.h = control_.next(s_, ride_length());
  step_.y_end = q_;
  step_.rate_end = step_.rate = Vec2::Zero();
  step_.error.setZero();
  step_.y_middle = q_;
  step_.rate_middle = Vec2::Zero();
  step_error_ = 0.0;
  looks_ = {};
  dip_at_ = kNever;
  const double end = s_ + step_.h;
  const InMode found = instant_.check_ride(seat_, end);
  if (found == InMode::kMoves && mode_margin() < -instant_.noise()) return true;
  const bool last = step_.h == 1.0 - s_ || traced_ || instant_.recedes();
  stop_ = {};
  if (found == InMode::kUnheld) {
    stop_ = kUnheldPush;
  } else if (last || found == InMode::kUnknown) {
    stop_ = instant_.solve(seat_, end, q_, kAllMotions);
  }
  if (!stop_) return true;
  block(end);
  return false;
}

/// As long as nothing can happen: bounds on the pusher's forces, and on how far the
/// finger axis comes.
template <class Instant>
double PushRun<Instant>::ride_length() const {
  double length = 1.0 - s_;
  if (traced_) length = std::min(length, options_.max_step);
  if (instant_.recedes()) length = std::min(length, kProbeSpacing * options_.max_step);
  const PlanarPose X_HO = instant_.pose(seat_, s_, q_);
  const double depth = depth_inside(model_.pad_face, finger_in_object(X_HO));
  const double room = std::min(depth, std::abs(model_.region.whole_margin(X_HO)));
  double sure = whole_ ? instant_.ride_lasts(length) : options_.max_step;
  if (push_.travel > 0.0) sure = std::min(sure, room / push_.travel);
  return std::min(length, std::max(sure, kLeastRide * options_.max_step));
}

/// Takes the step up to this share.
template <class Instant>
void PushRun<Instant>::accept(double share) {
  const bool whole = share == 1.0;
  const Vec2 q = whole ? step_.y_end : step_.at(share);
  if (!rides()) {
    const double noise = instant_.rounding() * instant_.speed() * step_.h;
    error_ = error_ * growth(share) + noise +
             (whole ? step_error_ : step_error_ * share + inside_error_);
    record_.add_slip(std::abs(q[0] - q_[0]));
  }
  if (traced_) trace_inside(share);
  s_ = !whole ? s_ + share * step_.h : step_.h == 1.0 - s_ ? 1.0 : s_ + step_.h;
  q_ = q;
  control_.passed(s_);
  if (!whole) return;  // the instant there is still to be solved
  rate_ = instant_.rate();
  instant_.keep();
  margin_ = mode_margin();
  if (instant_.is_solved()) record_.add(instant_.sample(s_, psi_));
  const bool looks = !rides() && control_.blocked() != kNever && !record_.stopped();
  if (looks && mode_margin() >= -instant_.noise()) look_at_block();
}

/// Samples of a traced push between the ends of its steps.
template <class Instant>
void PushRun<Instant>::trace_inside(double share) {
  const int count = static_cast<int>(share * step_.h / options_.max_step);
  instant_.set_aside();
  for (int i = 1; i <= count && !record_.stopped(); ++i) {
    const double x = share * i / (count + 1);
    const double s = s_ + x * step_.h;
    if (instant_.solve(seat_, s, step_.at(x))) continue;
    record_.add(instant_.sample(s, psi_));
  }
  instant_.bring_back();
}

template <class Instant>
PathLimits::Values PushRun<Instant>::limits(double s, const Vec2& q) const {
  return limits_.at(instant_.geometry(), seat_, q, instant_.pose(seat_, s, q), whole_);
}

template <class Instant>
void PushRun<Instant>::pass(const Crossing& crossing) {
  // The last instant may be that at the end of a step that was not taken.
  if (!solve_here()) return;
  record_.add(instant_.sample(s_, psi_));
  if (record_.stopped()) return;
  if (!crossing.limit) return change_mode();
  if (*crossing.limit == Limit::kFlush) {
    take_seat(instant_.geometry().flush(seat_, q_[0]), EventKind::kFlush);
  } else if (*crossing.limit == Limit::kWholePad) {
    whole_ = !whole_;
  } else {
    stop(limits_.why_not(*crossing.limit, seat_));
  }
}

/// Leaves the contact mode whose margin is used up.
template <class Instant>
void PushRun<Instant>::change_mode() {
  const ModeMargin margin = instant_.margin(seat_, regime_);
  for (const int lifted : {0, 1}) {
    if (margin.pressed[lifted] > margin.least()) continue;
    return take_seat(instant_.geometry().tipped(seat_, q_[0], 1 - lifted),
                     EventKind::kCorner);
  }
  if (regime_ == Regime::kStick) return take_regime(instant_.slip_side());
  const Regime opposite =
      regime_ == Regime::kSlipPlus ? Regime::kSlipMinus : Regime::kSlipPlus;
  const bool frictionless = model_.contacts[push_.contact].mu == 0.0;
  take_regime(frictionless ? opposite : Regime::kStick);
}

template <class Instant>
void PushRun<Instant>::take_regime(Regime regime) {
  // A mode that is left at once for the one before was never taken: where a stiff motion
  // settles, its slip is rounding of the state times a large rate.
  const bool returns =
      regime == regime_before_ && s_ - regime_since_ <= control_.location();
  regime_before_ = regime_;
  regime_since_ = s_;
  regime_ = regime;
  was_stiff_ = std::exchange(stiff_, returns && was_stiff_);
  stiffness_seen_ = stiff_ ? 2 : 0;
  margin_ = mode_margin();
  if (returns) {
    regime_since_ = -1.0;
    record_.take_back();
    if (++returns_ > kMostReturns) stop(kAlternates);
    return;
  }
  control_.renew();
  add(regime == Regime::kStick ? EventKind::kStick : EventKind::kSlip);
}

/// A change of contact mode. Many are no reason to stop a push, but modes too short to be
/// told apart are.
template <class Instant>
void PushRun<Instant>::add(EventKind event) {
  record_.add(event, s_);
  if (s_ - changed_at_ <= kShortest * control_.location()) ++close_changes_;
  changed_at_ = s_;
  if (close_changes_ > kMostCloseChanges) stop(kAlternates);
}

template <class Instant>
void PushRun<Instant>::take_seat(const Seat& seat, EventKind event) {
  seat_ = seat;
  q_ = Vec2::Zero();
  add(event);
  if (!solve_here()) return;
  control_.renew();
  regime_ = regime_before_ = instant_.regime();
  regime_since_ = -1.0;
  margin_ = mode_margin();
}

template <class Instant>
void PushRun<Instant>::stop(const PushStop& why) {
  record_.stop(why, s_);
}

/// Solves the instant at the present state; stops the push if there is no motion.
template <class Instant>
bool PushRun<Instant>::solve_here() {
  const PushStop why = instant_.solve(seat_, s_, q_, kAllMotions);
  if (why) {
    record_.stop(instant_.explained(why), s_);
    return false;
  }
  rate_ = instant_.rate();
  instant_.keep();
  return true;
}

template class PushRun<PushInstant>;
template class PushRun<SpatialPushInstant>;

}  // namespace prehensile
