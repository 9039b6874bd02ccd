#include "primitives/linear_push.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "primitives/dormand_prince.h"
#include "primitives/path_limits.h"
#include "primitives/push_instant.h"
#include "primitives/root.h"
#include "primitives/rosenbrock.h"
#include "primitives/step_control.h"

namespace prehensile {
namespace {

using enum PushInstant::Search;
using InMode = PushInstant::InMode;

constexpr double kNever = StepControl::kNever;

/// Length below which a limit does not count as crossed [m].
constexpr double kRoundOff = 1e-12;

/// Share of the tolerance that the location of an event may cost.
constexpr double kLocationShare = 0.1;

/// Share of a step to which its own events are located: rates do not jump there, so that
/// events cost no accuracy, and limits are met as closely as numbers allow.
constexpr double kResolution = 1e-11;

/// Longest integrated step over the wanted spacing of checks: the mode is looked at in
/// eight places of it, at most 0.3 of its length apart.
constexpr double kStepPerCheck = 20.0;

/// Shortest step of a ride over that spacing, where nothing is sure.
constexpr double kLeastRide = 0.5;

/// Spacing over that spacing of the search for other motions where the pusher recedes.
constexpr double kProbeSpacing = 4.0;

/// Powers of the step length with which the errors of the methods fall.
constexpr int kOrder = 6;
constexpr int kStiffOrder = 5;

/// Step times rate of decay beyond which an explicit step is at the border of its
/// stability, and below which a stiff one is not needed.
constexpr double kStiff = 2.5;
constexpr double kNotStiff = 1.0;

/// Share of its length by which a step that is to end at an event goes beyond it.
constexpr double kBeyond = 0.02;

/// Reported over computed error of a step: of smooth steps, of others, and where the
/// object begins or ceases to turn about a pad point.
constexpr double kDoubt = 1.5;
constexpr double kDoubtOfRough = 10.0;
constexpr double kDoubtOfKink = 20.0;

/// A place in a step that is far from all its stages, and the share of the change that
/// its rate would make over the step that counts as error.
constexpr double kUnseen = 0.35;
constexpr double kOfUnseen = 0.02;

/// Where in a step the defect of its polynomial changes fastest.
constexpr double kSteepest = 0.09;

/// A step may be continued beyond its end up to this many times its length, where its
/// error is larger by this factor.
constexpr double kContinued = 2.5;
constexpr double kContinuationError = 1e3;

/// Small changes for derivatives of the rate: share of the push, angle.
constexpr double kNudge = 1e-6;

/// Relative error of a rate: the modes are solved to rounding.
constexpr double kRounding = 1e-14;

/// Bound on the exponent of the growth of errors over one step.
constexpr double kMostGrowth = 10.0;

/// Weight of an angle for pads that cannot exert a torque, over the size of the object.
constexpr double kLeastReach = 0.01;

constexpr Obstacle kUnheldPush{TransitionStatus::kFalls, EventKind::kGravityLost,
                               "the grasp alone does not hold gravity"};

/// The first change within a step: where, as a share of the step, and which limit; none:
/// a change of contact mode.
struct Crossing {
  double at = kNever;
  std::optional<Limit> limit;
};

class PushRun {
 public:
  PushRun(const Model& model, const Grasp& start, const LinearPush& push,
          const Guard& guard, const TransitionOptions& options,
          std::vector<Sample>* trace)
      : model_(model),
        push_(push),
        options_(options),
        psi_(start.psi),
        reach_(std::max(model.c, kLeastReach * model.L)),
        instant_(model, push, start, options),
        limits_(model, start, guard, reach_),
        record_(options.certificate_tolerance, trace),
        control_(options.tolerance, std::min(1.0, kStepPerCheck * options.max_step),
                 std::clamp(kLocationShare * options.tolerance / instant_.speed(), 1e-12,
                            1e-3)),
        traced_(trace != nullptr) {}

  Transition run() {
    begin();
    while (!record_.stopped() && s_ < 1.0) advance();
    const Grasp end{instant_.pose(seat_, s_, q_), psi_};
    return record_.finish(end, s_, error_, instant_.count(), instant_.checks());
  }

 private:
  void begin();
  void advance();

  bool ride();
  double ride_length() const;
  bool is_close(double at);
  bool integrate();
  RateDerivatives derivatives(const BaseStep& base);
  bool rate_in_mode(double s, const Vec2& q, Vec2& out);
  bool rate_at_end(double s, const Vec2& q, Vec2& out);
  void look_inside();
  void doubt_step(bool kink);
  double length_of(const Vec2& error) const;
  double growth(double share) const;
  void watch_stiffness(bool accepted);
  void block(double at);
  void look_at_block();
  void stop_at_block(double beyond);
  void accept(double share);
  void trace_inside(double share);

  Crossing first_crossing();
  PathLimits::Values limits(double s, const Vec2& q) const;
  double mode_margin() const { return instant_.margin(seat_, regime_).least(); }

  void pass(const Crossing& crossing);
  void change_mode();
  void take_seat(const Seat& seat, EventKind event);
  void take_regime(Regime regime);
  bool solve_here();
  void stop(const Obstacle& obstacle);
  bool rides() const {
    return seat_.kind == SeatKind::kFlush && regime_ == Regime::kStick;
  }

  const Model& model_;
  const LinearPush push_;
  const TransitionOptions options_;
  const double psi_;
  const double reach_;  ///< [m] weight of an angle

  PushInstant instant_;
  PathLimits limits_;
  PushRecord record_;
  StepControl control_;

  Seat seat_;
  double s_ = 0.0;
  Vec2 q_ = Vec2::Zero();
  Vec2 rate_ = Vec2::Zero();
  double margin_ = 0.0;  ///< of the contact mode at s_
  double error_ = 0.0;   ///< [m] estimate for the pose at s_

  DoubledStep step_;
  double inside_error_ = 0.0;   ///< [m] of the state where an event was found
  double step_error_ = 0.0;     ///< [m]
  double middle_margin_ = 0.0;  ///< of the contact mode
  double least_margin_ = 0.0;   ///< of the contact mode over its stages
  double least_at_ = 0.0;       ///< [share of the push] where that is
  double dip_at_ = kNever;      ///< [share of the step] a place inside, beyond the mode
  double dip_margin_ = 0.0;
  Obstacle obstacle_;
  Regime regime_ = Regime::kStick;
  int attempts_ = 0;
  const bool traced_;
  bool landed_ = false;  ///< the step was made to end at its event
  bool stiff_ = false;
  double stiffness_ =
      0.0;  ///< of the last stiff step: its length times the rate of decay
  int stiffness_seen_ = 0;  ///< in how many steps in a row
  bool whole_ = true;       ///< the pad does not overhang
};

void PushRun::begin() {
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
void PushRun::advance() {
  if (++attempts_ > options_.max_steps) {
    return record_.stop(
        {TransitionStatus::kIterationLimit, {}, "the step limit was reached"}, s_);
  }
  step_.s = s_;
  step_.y = q_;
  step_.rate = rate_;
  if (!(rides() ? ride() : integrate())) return;

  const Crossing crossing = first_crossing();
  if (crossing.at > 1.0) {
    landed_ = false;
    return accept(1.0);
  }
  const double location = control_.location();
  if (!crossing.limit && crossing.at == 0.0 && step_.h > 4.0 * location) {
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
bool PushRun::ride() {
  step_.h = control_.next(s_, ride_length());
  step_.y_end = q_;
  step_.rate_end = step_.rate = Vec2::Zero();
  step_.error.setZero();
  step_.y_middle = q_;
  step_.rate_middle = Vec2::Zero();
  step_error_ = 0.0;
  middle_margin_ = dip_at_ = kNever;
  const double end = s_ + step_.h;
  const InMode found = instant_.check_ride(seat_, end);
  if (found == InMode::kMoves && mode_margin() < -instant_.noise()) return true;
  const bool last = step_.h == 1.0 - s_ || traced_ || instant_.recedes();
  obstacle_ = {};
  if (found == InMode::kUnheld) {
    obstacle_ = kUnheldPush;
  } else if (last || found == InMode::kUnknown) {
    obstacle_ = instant_.solve(seat_, end, q_, kAllMotions);
  }
  if (!obstacle_) return true;
  block(end);
  return false;
}

/// Whether the state inside the step is as good as steps have to be. What the polynomial
/// lacks is a constant times the square of its distance from the nodes, x (x - 1/2)
/// (x - 1); the constant is read off the rate where the slope of that is greatest.
bool PushRun::is_close(double at) {
  const double x = at < 0.5 ? kSteepest : 1.0 - kSteepest;
  const auto node = [](double z) { return z * (z - 0.5) * (z - 1.0); };
  const double slope =
      2.0 * std::abs(node(x)) * (0.5 - 3.0 * kSteepest * (1.0 - kSteepest));
  Vec2 rate;
  instant_.set_aside();
  const bool found = rate_in_mode(s_ + x * step_.h, step_.at(x), rate);
  instant_.bring_back();
  inside_error_ = 0.0;
  if (!found) return true;
  inside_error_ =
      step_.h * length_of(rate - step_.rate_at(x)) * node(at) * node(at) / slope;
  return landed_ || inside_error_ <= control_.allowed(step_.h);
}

/// As long as nothing can happen: bounds on the pusher's forces, and on how far the
/// finger axis comes.
double PushRun::ride_length() const {
  double length = 1.0 - s_;
  if (traced_) length = std::min(length, options_.max_step);
  if (instant_.recedes()) length = std::min(length, kProbeSpacing * options_.max_step);
  const PlanarPose X_HO = instant_.pose(seat_, s_, q_);
  const double depth = depth_inside(model_.outline, finger_in_object(X_HO));
  const double room = std::min(depth, std::abs(model_.region.whole_margin(X_HO)));
  double sure = whole_ ? instant_.ride_lasts(length) : options_.max_step;
  if (push_.travel > 0.0) sure = std::min(sure, room / push_.travel);
  return std::min(length, std::max(sure, kLeastRide * options_.max_step));
}

/// Computes the step and its end; false if there is no motion or the error is too large.
bool PushRun::integrate() {
  step_.h = control_.next(s_, kNever);
  const double middle = s_ + 0.5 * step_.h;
  int low_pivot = 99, high_pivot = -2;
  least_margin_ = dip_at_ = kNever;
  const auto rate = [this, middle, &low_pivot, &high_pivot](double s, const Vec2& q,
                                                            Vec2& out) {
    if (!rate_in_mode(s, q, out)) return false;
    if (s == middle) middle_margin_ = mode_margin();
    low_pivot = std::min(low_pivot, instant_.pivot());
    high_pivot = std::max(high_pivot, instant_.pivot());
    if (const double margin = mode_margin(); margin < least_margin_) {
      least_margin_ = margin;
      least_at_ = s;
    }
    return true;
  };
  const auto end_rate = [this](double s, const Vec2& q, Vec2& out) {
    return rate_at_end(s, q, out);
  };
  double failed_at = kNever;
  if (stiff_) {
    RateDerivatives at_start;
    double known_at = kNever;
    const auto method = [&](const auto& f, BaseStep& base) {
      if (base.s != known_at) at_start = derivatives(base);
      known_at = base.s;
      return rosenbrock(f, at_start, base);
    };
    failed_at = doubled(method, rate, end_rate, kStiffOrder, step_);
  } else {
    const auto method = [](const auto& f, BaseStep& base) {
      return dormand_prince(f, base);
    };
    failed_at = doubled(method, rate, end_rate, kOrder, step_);
  }
  if (failed_at != kNever) {
    block(failed_at);
    return false;
  }
  step_error_ = length_of(step_.error);
  const bool accepted =
      control_.accepts(step_.h, step_error_, stiff_ ? kStiffOrder : kOrder);
  watch_stiffness(accepted);
  if (!accepted) return false;
  doubt_step(low_pivot != high_pivot);
  look_inside();
  return true;
}

/// What the step's error may be, with what its computation cannot see: a kink between
/// the stages, which a place that no stage looked at may show, and the random size of the
/// error where there is one.
void PushRun::doubt_step(bool kink) {
  step_error_ *= kink ? kDoubtOfKink : step_.is_smooth ? kDoubt : kDoubtOfRough;
  instant_.set_aside();
  Vec2 rate;
  if (rate_in_mode(s_ + kUnseen * step_.h, step_.at(kUnseen), rate)) {
    const double lacks = step_.h * length_of(rate - step_.rate_at(kUnseen));
    step_error_ = std::max(step_error_, kOfUnseen * lacks);
  }
  instant_.bring_back();
}

/// At the end of a step the instant is asked whether its answer is that of the mode, and
/// no other.
bool PushRun::rate_at_end(double s, const Vec2& q, Vec2& out) {
  obstacle_ = instant_.solve(seat_, s, q, kAllMotions);
  if (obstacle_ || mode_margin() < -instant_.noise()) {
    // Beyond the end of the mode, if the mode says so.
    const Obstacle met = obstacle_;
    instant_.set_aside();
    const bool beyond = instant_.solve_in_mode(seat_, s, q, regime_) == InMode::kMoves &&
                        mode_margin() < -instant_.noise();
    if (!beyond) instant_.bring_back();
    if (!beyond && met) return false;
    obstacle_ = {};
  }
  out = instant_.rate();
  return true;
}

/// Rate within the contact mode, also beyond its end; where the mode alone does not tell
/// the motion, that of the instant.
bool PushRun::rate_in_mode(double s, const Vec2& q, Vec2& out) {
  const InMode found = instant_.solve_in_mode(seat_, s, q, regime_);
  if (found != InMode::kMoves) {
    obstacle_ = found == InMode::kUnheld ? kUnheldPush : instant_.solve(seat_, s, q);
    if (obstacle_) return false;
  }
  out = instant_.rate();
  return true;
}

RateDerivatives PushRun::derivatives(const BaseStep& base) {
  RateDerivatives found;
  const double nudge = std::min(kNudge, 0.5 * base.h);
  Vec2 rate;
  if (rate_in_mode(base.s + nudge, base.y, rate)) found.by_s = (rate - base.rate) / nudge;
  const bool slips = regime_ != Regime::kStick;
  const bool tilts = seat_.kind != SeatKind::kFlush;
  for (const int k : {0, 1}) {
    if (!(k == 0 ? slips : tilts)) continue;
    Vec2 q = base.y;
    const double change = k == 0 ? kNudge * model_.L : kNudge;
    q[k] += change;
    if (!rate_in_mode(base.s, q, rate)) continue;
    found.by_state.col(k) = (rate - base.rate) / change;
  }
  stiffness_ = base.h * found.by_state.cwiseAbs().maxCoeff();
  return found;
}

/// Where a stage seemed to leave a contact mode that holds in the middle and at the end
/// of the step, the place itself is looked at.
void PushRun::look_inside() {
  if (least_margin_ >= -instant_.noise() || middle_margin_ < -instant_.noise() ||
      mode_margin() < -instant_.noise()) {
    return;
  }
  const double x = (least_at_ - s_) / step_.h;
  instant_.set_aside();
  Vec2 rate;
  const bool found = rate_in_mode(least_at_, step_.at(x), rate);
  if (found && mode_margin() < -instant_.noise()) {
    dip_at_ = x;
    dip_margin_ = mode_margin();
  }
  instant_.bring_back();
}

/// What an error of the coordinates at the end of the step makes of the pose [m].
double PushRun::length_of(const Vec2& error) const {
  const PlanarPose one = instant_.geometry().object(seat_, step_.y_end);
  const PlanarPose other = instant_.geometry().object(seat_, step_.y_end - error);
  return Vec3(one.x - other.x, one.y - other.y, reach_ * error[1]).norm();
}

/// Explicit steps that are kept short by stability call for a stiff method, and its steps
/// for an explicit one where that would do as well.
void PushRun::watch_stiffness(bool accepted) {
  if (stiff_) {
    stiffness_seen_ = accepted && stiffness_ < kNotStiff ? stiffness_seen_ - 1 : 2;
    stiff_ = stiffness_seen_ > 0;
    return;
  }
  const Vec2 lengths(1.0, reach_);
  const double apart = step_.probe.cwiseProduct(lengths).norm();
  const double change = 0.5 * step_.h * step_.probe_rate.cwiseProduct(lengths).norm();
  stiffness_seen_ = change > kStiff * apart ? stiffness_seen_ + 1 : 0;
  stiff_ = stiffness_seen_ >= 2;
}

/// There is no motion at `at`: steps close in on it.
void PushRun::block(double at) {
  if (control_.is_at_block(s_, at)) stop_at_block(s_ + control_.location());
}

/// After a step towards a place without motion: is that place still there, now that it is
/// nearer? If the step is good enough to be continued up to it, the end of the motion is
/// located on its continuation.
void PushRun::look_at_block() {
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
    lawful = lawful && found && continued <= control_.allowed(step_.h);
    if (lawful && *std::min_element(left.begin(), left.end()) >= 0.0) {
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
void PushRun::stop_at_block(double beyond) {
  error_ += (beyond - s_) * instant_.speed();
  if (obstacle_.status == TransitionStatus::kFalls) return record_.stop(obstacle_, s_);
  const Vec2 q = rides() ? q_ : Vec2(q_ + (beyond - s_) * rate_);
  const Obstacle met = instant_.solve(seat_, beyond, q, kAllMotions);
  record_.stop(instant_.explained(met ? met : obstacle_), s_);
}

/// Takes the step up to this share.
void PushRun::accept(double share) {
  const bool whole = share == 1.0;
  const Vec2 q = whole ? step_.y_end : step_.at(share);
  if (!rides()) {
    const double noise = kRounding * instant_.speed() * step_.h;
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
  margin_ = mode_margin();
  if (instant_.is_solved()) record_.add(instant_.sample(s_, psi_));
  const bool looks = !rides() && control_.blocked() != kNever && !record_.stopped();
  if (looks && mode_margin() >= -instant_.noise()) look_at_block();
}

/// How much of an error made before this step is there after it, by the change of rate
/// between two states at its end. A pusher that trails the pads is unstable.
double PushRun::growth(double share) const {
  const Vec2 lengths(1.0, reach_);
  const Vec2 apart = step_.probe.cwiseProduct(lengths);
  const Vec2 rate = step_.probe_rate.cwiseProduct(lengths);
  if (!(apart.norm() > 1e3 * kRounding * instant_.speed() * step_.h)) return 1.0;
  return std::exp(std::clamp(share * step_.h * apart.dot(rate) / apart.squaredNorm(),
                             -kMostGrowth, kMostGrowth));
}

/// Samples of a traced push between the ends of its steps.
void PushRun::trace_inside(double share) {
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

Crossing PushRun::first_crossing() {
  Crossing first;
  const PathLimits::Values at_start = limits(s_, q_);
  const PathLimits::Values at_end = limits(s_ + step_.h, step_.y_end);
  for (int i = 0; i < PathLimits::kCount; ++i) {
    if (at_end[i] >= -kRoundOff) continue;
    const auto limit = [&](double x) { return limits(s_ + x * step_.h, step_.at(x))[i]; };
    const double at = at_start[i] <= 0.0 ? 0.0
                                         : falling_root(limit, 0.0, at_start[i], 1.0,
                                                        at_end[i], kResolution);
    if (at < first.at) first = {at, static_cast<Limit>(i)};
  }
  const double noise = instant_.noise();
  double high = 1.0;
  double margin_at_high = mode_margin();
  if (middle_margin_ < -noise) {
    high = 0.5;
    margin_at_high = middle_margin_;
  } else if (dip_at_ < 1.0) {
    high = dip_at_;
    margin_at_high = dip_margin_;
  }
  if (margin_at_high >= -noise) return first;
  double low = 0.0;
  double margin_at_low = margin_;
  if (high == 1.0 && middle_margin_ > 0.0 && !rides()) {
    low = 0.5;
    margin_at_low = middle_margin_;
  }
  if (margin_at_low <= 0.0) return {0.0, {}};
  const auto margin = [&](double x) {
    const double s = s_ + x * step_.h;
    Vec2 rate;
    const bool found = rides() ? instant_.check_ride(seat_, s) == InMode::kMoves
                               : rate_in_mode(s, step_.at(x), rate);
    // Where no motion exists the mode has certainly changed.
    return found ? mode_margin() : -1.0;
  };
  instant_.set_aside();
  const double at =
      falling_root(margin, low, margin_at_low, high, margin_at_high, kResolution);
  instant_.bring_back();
  if (at < first.at) first = {at, {}};
  return first;
}

PathLimits::Values PushRun::limits(double s, const Vec2& q) const {
  return limits_.at(instant_.geometry(), seat_, q, instant_.pose(seat_, s, q), whole_);
}

void PushRun::pass(const Crossing& crossing) {
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
    stop(limits_.obstacle(*crossing.limit, seat_));
  }
}

/// Leaves the contact mode whose margin is used up.
void PushRun::change_mode() {
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

void PushRun::take_regime(Regime regime) {
  regime_ = regime;
  stiff_ = false;
  stiffness_seen_ = 0;
  margin_ = mode_margin();
  record_.add(regime == Regime::kStick ? EventKind::kStick : EventKind::kSlip, s_);
}

void PushRun::take_seat(const Seat& seat, EventKind event) {
  seat_ = seat;
  q_ = Vec2::Zero();
  record_.add(event, s_);
  if (!solve_here()) return;
  regime_ = instant_.regime();
  margin_ = mode_margin();
}

void PushRun::stop(const Obstacle& obstacle) { record_.stop(obstacle, s_); }

/// Solves the instant at the present state; stops the push if there is no motion.
bool PushRun::solve_here() {
  const Obstacle obstacle = instant_.solve(seat_, s_, q_, kAllMotions);
  if (obstacle) {
    record_.stop(instant_.explained(obstacle), s_);
    return false;
  }
  rate_ = instant_.rate();
  return true;
}

}  // namespace

Transition follow(const Model& model, const Grasp& start, const LinearPush& push,
                  const Guard& guard, const TransitionOptions& options,
                  std::vector<Sample>* trace) noexcept {
  return PushRun(model, start, push, guard, options, trace).run();
}

}  // namespace prehensile
