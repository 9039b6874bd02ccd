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
constexpr double kStepPerCheck = 8.0;

/// Shortest step of a ride over that spacing, where nothing is sure.
constexpr double kLeastRide = 0.5;

/// Spacing over that spacing of the search for other motions where the pusher recedes.
constexpr double kProbeSpacing = 4.0;

/// Margin below which a stage counts as beyond the contact mode; stages are not accurate.
constexpr double kStageMargin = -1e-3;

/// Step times rate of decay beyond which an explicit step is at the border of its
/// stability, and below which a stiff one is not needed.
constexpr double kStiff = 2.5;
constexpr double kNotStiff = 1.0;

/// Small changes for derivatives of the rate: share of the push, angle.
constexpr double kNudge = 1e-6;

/// Relative error of a rate: the modes are solved to rounding.
constexpr double kRounding = 1e-13;

/// Bound on the exponent of the growth of errors over one step.
constexpr double kMostGrowth = 10.0;

/// Weight of an angle for pads that cannot exert a torque, over the size of the object.
constexpr double kLeastReach = 0.01;

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
  bool integrate();
  RateDerivatives derivatives();
  bool rate_in_mode(double s, const Vec2& q, Vec2& out);
  bool middle_agrees();
  double length_of(const Vec2& error) const;
  double growth() const;
  void watch_stiffness(bool accepted);
  void block(double at);
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

  DenseStep step_;
  Vec2 defect_ = Vec2::Zero();  ///< of the step's middle
  double step_error_ = 0.0;     ///< [m]
  double middle_margin_ = 0.0;  ///< of the contact mode
  double least_margin_ = 0.0;   ///< of the contact mode over its stages
  Obstacle obstacle_;
  Regime regime_ = Regime::kStick;
  int attempts_ = 0;
  const bool traced_;
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
  if (crossing.at > 1.0) return accept(1.0);
  const double location = control_.location();
  if (!crossing.limit && crossing.at == 0.0 && step_.h > 4.0 * location) {
    // Right after an event the new mode may last for less than this step.
    return control_.land(0.25 * step_.h);
  }
  if (crossing.at > 0.0) accept(crossing.at);
  if (!record_.stopped()) pass(crossing);
}

/// The object moves with the pusher: the step is known, and only the pusher's forces at
/// its end are looked at; at the end of the push the instant is solved.
bool PushRun::ride() {
  step_.h = control_.next(s_, ride_length());
  step_.y_end = q_;
  step_.rate_end = step_.rate = Vec2::Zero();
  step_.error.setZero();
  step_.dense.fill(Vec2::Zero());
  step_error_ = 0.0;
  least_margin_ = middle_margin_ = kNever;
  const double end = s_ + step_.h;
  if (instant_.check_ride(seat_, end) && mode_margin() < -instant_.noise()) return true;
  const bool solve = step_.h == 1.0 - s_ || traced_ || instant_.recedes();
  obstacle_ = {};
  if (solve || !instant_.check_ride(seat_, end)) {
    obstacle_ = instant_.solve(seat_, end, q_, kAllMotions);
  }
  if (!obstacle_) return true;
  block(end);
  return false;
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
  least_margin_ = kNever;
  const auto rate = [this](double s, const Vec2& q, Vec2& out) {
    const bool found = rate_in_mode(s, q, out);
    if (found) least_margin_ = std::min(least_margin_, mode_margin());
    return found;
  };
  const double failed_at =
      stiff_ ? rosenbrock(rate, derivatives(), step_) : dormand_prince(rate, step_);
  if (failed_at != kNever) {
    block(failed_at);
    return false;
  }
  if (!middle_agrees()) return false;
  step_error_ = std::max(length_of(step_.error), length_of(defect_));
  const bool accepted = control_.accepts(step_.h, step_error_, stiff_ ? 4 : 5);
  watch_stiffness(accepted);
  if (!accepted || mode_margin() < -instant_.noise()) return accepted;
  // The mode holds at the end: what is more, the instant has this answer and no other.
  const double end = s_ + step_.h;
  obstacle_ = instant_.solve(seat_, end, step_.y_end, kAllMotions);
  if (!obstacle_) return true;
  block(end);
  return false;
}

/// Rate within the contact mode, also beyond its end; where the mode alone does not tell
/// the motion, that of the instant.
bool PushRun::rate_in_mode(double s, const Vec2& q, Vec2& out) {
  if (!instant_.solve_in_mode(seat_, s, q, regime_)) {
    obstacle_ = instant_.solve(seat_, s, q);
    if (obstacle_) return false;
  }
  out = instant_.rate();
  return true;
}

RateDerivatives PushRun::derivatives() {
  RateDerivatives found;
  const double nudge = std::min(kNudge, 0.5 * step_.h);
  Vec2 rate;
  if (rate_in_mode(s_ + nudge, q_, rate)) found.by_s = (rate - rate_) / nudge;
  const bool slips = regime_ != Regime::kStick;
  const bool tilts = seat_.kind != SeatKind::kFlush;
  for (const int k : {0, 1}) {
    if (!(k == 0 ? slips : tilts)) continue;
    Vec2 q = q_;
    const double change = k == 0 ? kNudge * model_.L : kNudge;
    q[k] += change;
    if (rate_in_mode(s_, q, rate)) found.by_state.col(k) = (rate - rate_) / change;
  }
  stiffness_ = step_.h * found.by_state.cwiseAbs().maxCoeff();
  return found;
}

/// Looks into the middle of the step, where the stages may have missed a kink or jump of
/// the rate: its defect joins the error. A contact mode that some stage has left and that
/// holds in the middle and at the end calls for a shorter step.
bool PushRun::middle_agrees() {
  instant_.set_aside();
  const double middle = s_ + 0.5 * step_.h;
  Vec2 rate;
  if (!rate_in_mode(middle, step_.at(0.5), rate)) {
    block(middle);
    instant_.bring_back();
    return false;
  }
  defect_ = step_.h * (rate - step_.middle_rate());
  middle_margin_ = mode_margin();
  instant_.bring_back();
  const bool holds = std::min(middle_margin_, mode_margin()) >= -instant_.noise();
  if (!holds || least_margin_ >= kStageMargin || step_.h <= control_.location()) {
    return true;
  }
  control_.land(0.5 * step_.h);
  return false;
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
  const double change = step_.h * step_.probe_rate.cwiseProduct(lengths).norm();
  stiffness_seen_ = change > kStiff * apart ? stiffness_seen_ + 1 : 0;
  stiff_ = stiffness_seen_ >= 2;
}

/// There is no motion at `at`.
void PushRun::block(double at) {
  if (control_.is_at_block(s_, at)) stop(instant_.explained(obstacle_));
}

/// Takes the step up to this share.
void PushRun::accept(double share) {
  const bool whole = share == 1.0;
  const Vec2 q = whole ? step_.y_end : step_.at(share);
  if (!rides()) {
    const double noise = kRounding * instant_.speed() * step_.h;
    const double error = whole ? step_error_ : length_of(defect_);
    error_ = error_ * growth() + error + noise;
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
}

/// How much of an error made before this step is there after it, by the change of rate
/// between two states at its end. A pusher that trails the pads is unstable.
double PushRun::growth() const {
  const Vec2 lengths(1.0, reach_);
  const Vec2 apart = step_.probe.cwiseProduct(lengths);
  const Vec2 rate = step_.probe_rate.cwiseProduct(lengths);
  if (!(apart.norm() > 1e3 * kRounding * instant_.speed() * step_.h)) return 1.0;
  return std::exp(std::clamp(step_.h * apart.dot(rate) / apart.squaredNorm(),
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
    const bool found =
        rides() ? instant_.check_ride(seat_, s) : rate_in_mode(s, step_.at(x), rate);
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
