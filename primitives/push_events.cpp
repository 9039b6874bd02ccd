/// Where the motion of a step changes or ends.
#include <algorithm>
#include <array>
#include <cmath>

#include "primitives/push_run.h"
#include "primitives/root.h"
#include "primitives/spatial_push_instant.h"

namespace prehensile {
namespace {

using enum Search;

/// Length below which a limit does not count as crossed [m].
constexpr double kRoundOff = 1e-12;

/// Share of a step to which limits are met: as closely as numbers allow.
constexpr double kResolution = 1e-11;

/// Share of the margin at the start of a step that counts as used up at its event.
constexpr double kUsedUp = 0.1;

/// A step may be continued beyond its end up to this many times its length, where its
/// error is larger by this factor.
constexpr double kContinued = 2.5;
constexpr double kContinuationError = 1e3;

/// Half of the depth to which a limit may be crossed unseen inside of a step: over the
/// tolerance, and over the way within the step, which bounds the work along a limit.
constexpr double kDepthUnseen = 0.5;
constexpr double kOfWayUnseen = 1e-4;

/// How far apart clearances are looked at where nothing bounds them, at most and at
/// least: shares of the step.
constexpr double kClearanceSpacing = 0.25;
constexpr double kLeastSpacing = 1e-3;

/// Halvings of a step: as many as numbers allow.
constexpr int kMostHalvings = 60;

}  // namespace

template <class Instant>
Crossing PushRun<Instant>::first_crossing() {
  const PathLimits::Values at_start = limits(s_, q_);
  const PathLimits::Values at_end = limits(s_ + step_.h, step_.y_end);
  const Crossing first = crossing_by_end(at_start, at_end);
  if (first.at == 0.0) return first;
  const Crossing before =
      first.at > 1.0
          ? crossing_between(0.0, at_start, 1.0, at_end)
          : crossing_between(0.0, at_start, first.at,
                             limits(s_ + first.at * step_.h, step_.at(first.at)));
  return before.limit ? before : first;
}

/// Bounds on the motion along the step up to the share `to`.
template <class Instant>
StepBound PushRun<Instant>::bound_within(double to) const {
  StepBound bound;
  bound.way = step_.h * push_.travel;
  bound.turn = step_.h * std::abs(push_.turn);
  if (rides()) return bound;
  const auto [least, most] = step_.change_within(to);
  const Vec2 change = least.cwiseAbs().cwiseMax(most.cwiseAbs());
  const Vec2 back = (-least).cwiseMin(most).cwiseMax(0.0);
  const SeatGeometry& geometry = instant_.geometry();
  const Vec2 p_OF = finger_in_object(instant_.pose(seat_, step_.s, step_.y));
  const Vec2 p_PF = transform(geometry.object(seat_, step_.y), p_OF);
  const double arm = (p_PF - geometry.touch(seat_, step_.y).p_P[0]).norm();
  bound.way += change[0];
  bound.way += change[1] * (arm + to * bound.way);
  bound.turn += change[1];
  bound.slide_back = back[0];
  bound.tilt_back = back[1];
  const PushContact& contact = model_.contacts[push_.contact];
  if (contact.is_point) return bound;
  // Clearances of a line without ends depend on the tilt alone, and are least at the ends
  // of its range.
  const double moved =
      std::isinf(contact.half_length) ? 0.0 : change[0] + change[1] * model_.L;
  if (moved == 0.0 && back[1] * model_.L <= options_.tolerance) return bound;
  bound.spacing = kClearanceSpacing;
  // No corner passes the whole of a shorter line between two looks.
  if (moved > 0.0) {
    bound.spacing =
        std::clamp(2.0 * contact.half_length / moved, kLeastSpacing, bound.spacing);
  }
  return bound;
}

/// The first limit, kWholePad aside, that is crossed between two places of the step where
/// it may well be kept. Bounds on the motion say where it has to be looked for.
template <class Instant>
Crossing PushRun<Instant>::crossing_between(double from,
                                            const PathLimits::Values& at_from, double to,
                                            const PathLimits::Values& at_to) const {
  struct Place {
    double at;
    PathLimits::Values values;
  };
  Crossing first;
  const StepBound bound = bound_within(to);
  const double depth = std::max(kDepthUnseen * options_.tolerance,
                                kOfWayUnseen * std::max(bound.way, reach_ * bound.turn));
  if (limits_.are_kept(at_from, at_to, bound, to - from, depth)) return first;
  Place low{from, at_from};
  std::array<Place, kMostHalvings + 1> ahead;  // the nearest one last
  ahead[0] = {to, at_to};
  int count = 1;
  while (count > 0) {
    const Place& high = ahead[count - 1];
    const double width = high.at - low.at;
    if (count > kMostHalvings ||
        limits_.are_kept(low.values, high.values, bound, width, depth)) {
      low = high;
      --count;
      continue;
    }
    const double middle = low.at + 0.5 * width;
    const auto values_at = [&](double x) {
      return limits(step_.s + x * step_.h, step_.at(x));
    };
    ahead[count] = {middle, values_at(middle)};
    const PathLimits::Values& there = ahead[count].values;
    ++count;
    Crossing met;
    for (int i = 0; i < PathLimits::kCount; ++i) {
      const auto limit = static_cast<Limit>(i);
      if (limit == Limit::kWholePad || there[i] >= -depth) continue;
      const double at_low = low.values[i];
      const double at = at_low <= 0.0
                            ? low.at
                            : falling_root([&](double x) { return values_at(x)[i]; },
                                           low.at, at_low, middle, there[i], kResolution);
      if (at < met.at) met = {at, limit, true};
    }
    if (!met.limit) continue;
    // Nothing lies before it but what may have been crossed and left again.
    first = met;
    if (first.at <= low.at) return first;
    ahead[0] = {first.at, values_at(first.at)};
    count = 1;
  }
  return first;
}

/// The first change that the end of the step, or a look at the contact mode inside, tells
/// of.
template <class Instant>
Crossing PushRun<Instant>::crossing_by_end(const PathLimits::Values& at_start,
                                           const PathLimits::Values& at_end) {
  Crossing first;
  for (int i = 0; i < PathLimits::kCount; ++i) {
    if (at_end[i] >= -kRoundOff) continue;
    const auto limit = [&](double x) { return limits(s_ + x * step_.h, step_.at(x))[i]; };
    // A seat begins on its limit: does the step first leave it?
    double low = 0.0;
    double at_low = at_start[i];
    for (const double x : {1e-6, 1e-3, 0.05, 0.5}) {
      if (at_low > 0.0) break;
      low = x;
      at_low = limit(x);
    }
    const double at = at_low <= 0.0
                          ? 0.0
                          : falling_root(limit, low, at_low, 1.0, at_end[i], kResolution);
    if (at < first.at) first = {at, static_cast<Limit>(i)};
  }
  const double noise = instant_.noise();
  Look low{0.0, margin_};
  Look high{1.0, mode_margin()};
  if (dip_at_ < 1.0) high = {dip_at_, dip_margin_};
  for (const Look& look : looks_) {
    if (look.margin == kNever || look.at >= high.at) continue;
    if (look.margin < -noise) {
      high = look;
    } else if (look.margin > 0.0) {
      low = look;
    }
  }
  if (high.margin >= -noise) return first;
  if (low.margin <= 0.0) return {0.0, {}};
  const auto margin = [&](double x) {
    const double s = s_ + x * step_.h;
    Vec2 rate;
    const bool found = rides() ? instant_.check_ride(seat_, s) == InMode::kMoves
                               : rate_in_mode(s, step_.at(x), rate);
    // Where no motion exists the mode has certainly changed.
    return found ? mode_margin() : -1.0;
  };
  instant_.set_aside();
  const double resolution = std::max(kResolution, control_.location() / step_.h);
  // Beyond the root, where the next mode holds already.
  const double root =
      falling_root(margin, low.at, low.margin, high.at, high.margin, resolution);
  const double at = std::min(high.at, root + 0.5 * resolution);
  instant_.bring_back();
  if (at < first.at) first = {at, {}};
  return first;
}

/// Whether the motion that is followed holds its contact mode where the end of the mode
/// was found, so that the end is one of another motion.
template <class Instant>
bool PushRun<Instant>::is_of_other_motion(const Crossing& crossing) {
  if (Instant::kSmoothBeyondMode || crossing.limit || crossing.at == 0.0) return false;
  instant_.set_aside();
  instant_.resume();
  Vec2 rate;
  const double s = s_ + crossing.at * step_.h;
  const bool holds = rate_in_mode(s, step_.at(crossing.at), rate) &&
                     mode_margin() > kUsedUp * margin_ + instant_.noise();
  instant_.bring_back();
  return holds;
}

/// Whether the state inside the step is as good as steps have to be.
template <class Instant>
bool PushRun<Instant>::is_close(double at) {
  const double x = step_.telling(at);
  Vec2 rate;
  instant_.set_aside();
  const bool found = rate_in_mode(s_ + x * step_.h, step_.at(x), rate);
  instant_.bring_back();
  inside_error_ = 0.0;
  if (!found) return true;
  inside_error_ = step_.h * length_of(rate - step_.rate_at(x)) * step_.lack_of_state(at);
  return landed_ || inside_error_ <= control_.allowed(step_.h);
}

/// There is no motion at `at`: steps close in on it.
template <class Instant>
void PushRun<Instant>::block(double at) {
  if (control_.is_at_block(s_, at)) stop_at_block(s_ + control_.location());
}

/// After a step towards a place without motion: is that place still there, now that it is
/// nearer? If the step is good enough to be continued up to it, the end of the motion is
/// located on its continuation.
template <class Instant>
void PushRun<Instant>::look_at_block() {
  const double x = (control_.blocked() - step_.s) / step_.h;
  if (x > kContinued) return;
  double high = x;
  const auto goes_on = [this](double share) {
    Vec2 rate;
    return rate_in_mode(step_.s + share * step_.h, step_.at(share), rate);
  };
  instant_.set_aside();
  if (goes_on(high)) {
    control_.unblock();
  } else if (kContinuationError * step_error_ < options_.tolerance) {
    double low = 1.0;
    const double resolution = control_.location() / step_.h;
    bool lawful = true;
    while (lawful && high - low > resolution) {
      const double share = 0.5 * (low + high);
      const bool found = goes_on(share);
      lawful = !found || mode_margin() >= -instant_.noise();
      (found ? low : high) = share;
    }
    const double end = step_.s + low * step_.h;
    const PathLimits::Values left = limits(end, step_.at(low));
    Vec2 rate = Vec2::Zero();
    const bool found = rate_in_mode(end, step_.at(low), rate);
    const double lacks = length_of(rate - step_.rate_at(low));
    const double continued = (low - 1.0) * step_.h * lacks;
    lawful = lawful && found && continued <= control_.allowed(step_.h) &&
             !crossing_between(1.0, limits(s_, q_), low, left).limit;
    // From afar another motion may have been met there than from here.
    if (goes_on(high)) {
      control_.unblock();
    } else if (lawful && *std::min_element(left.begin(), left.end()) >= 0.0) {
      error_ += continued;
      record_.add_slip(std::abs(step_.at(low)[0] - q_[0]));
      q_ = step_.at(low);
      s_ = end;
      return stop_at_block(step_.s + high * step_.h);
    }
  }
  instant_.bring_back();
}

/// Ends the push where its motion ends; `beyond` is past that, and has the reason.
template <class Instant>
void PushRun<Instant>::stop_at_block(double beyond) {
  error_ += (beyond - s_) * instant_.speed();
  if (traced_ && !instant_.solve(seat_, s_, q_)) record_.add(instant_.sample(s_, psi_));
  if (stop_.status == TransitionStatus::kFalls) return record_.stop(stop_, s_);
  const Vec2 q = rides() ? q_ : Vec2(q_ + (beyond - s_) * rate_);
  const PushStop met = instant_.solve(seat_, beyond, q, kAllMotions);
  record_.stop(instant_.explained(met ? met : stop_), s_);
}

template class PushRun<PushInstant>;
template class PushRun<SpatialPushInstant>;

}  // namespace prehensile
