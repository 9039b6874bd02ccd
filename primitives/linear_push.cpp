#include "primitives/linear_push.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "primitives/dormand_prince.h"
#include "primitives/path_limits.h"
#include "primitives/push_instant.h"
#include "primitives/root.h"
#include "primitives/step_control.h"

namespace prehensile {
namespace {

using enum PushInstant::Search;

constexpr double kNever = StepControl::kNever;

/// Length below which a limit does not count as crossed [m].
constexpr double kRoundOff = 1e-12;

/// A ride with a constant wrench is judged by its two ends only if the contact mode holds
/// at both with this margin, which exceeds what the quadrature of a disc changes as it
/// turns.
constexpr double kLeapMargin = 0.02;

/// Share of the tolerance that the location of an event may cost.
constexpr double kLocationShare = 0.1;

/// Reported over computed error of a step: rates change abruptly where the centre of
/// rotation passes a pad point, and estimates of the error there are rough.
constexpr double kCaution = 2.0;

/// Longest step over the wanted spacing of checks: seven instants are solved in a step,
/// at most 0.3 of its length apart.
constexpr double kStepPerCheck = 3.0;

/// Margin below which a stage counts as beyond the contact mode; stages are not accurate.
constexpr double kStageMargin = -1e-3;

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
        instant_(model, push, start, options.tolerance),
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
    return record_.finish(end, s_, error_, instant_.count());
  }

 private:
  void begin();
  void advance();

  bool attempt();
  bool middle_agrees();
  double length_of(const Vec2& error) const;
  double growth() const;
  void block(double at);
  void accept();

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
  bool can_leap() const;

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

  DormandPrinceStep step_;
  Vec2 defect_ = Vec2::Zero();  ///< of the step's middle
  double step_error_ = 0.0;     ///< [m]
  double least_margin_ = 0.0;   ///< of the contact mode over its stages
  Obstacle obstacle_;
  Regime regime_ = Regime::kStick;
  int attempts_ = 0;
  const bool traced_;
  bool leaping_ = false;
  bool leaps_allowed_ = true;
  bool whole_ = true;  ///< the pad does not overhang
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

/// One attempt at a step: it is refused, shortened to land on an event, or taken.
void PushRun::advance() {
  if (++attempts_ > options_.max_steps) {
    return record_.stop(
        {TransitionStatus::kIterationLimit, {}, "the step limit was reached"}, s_);
  }
  step_.s = s_;
  step_.y = q_;
  step_.rate = rate_;
  leaping_ = rides() && can_leap();
  step_.h = leaping_ ? 1.0 - s_ : control_.next(s_, rides() ? options_.max_step : kNever);
  if (!attempt()) return;

  const Crossing crossing = first_crossing();
  const bool crosses = crossing.at <= 1.0;
  if (leaping_ && (crosses || mode_margin() < kLeapMargin)) {
    leaps_allowed_ = false;
    return;
  }
  const double location = control_.location();
  const double before = crosses ? crossing.at * step_.h : kNever;
  if (!crossing.limit && before == 0.0 && step_.h > 4.0 * location) {
    // Right after an event the new mode may last for less than this step.
    return control_.land(0.25 * step_.h);
  }
  if (before <= location) return pass(crossing);
  if (crosses && crossing.limit) {
    control_.land(before - 0.5 * location);  // ends on the valid side
    return;
  }
  if (crosses && before < step_.h - location) {
    control_.land(std::min(before + 0.5 * location, 0.999 * step_.h));
    return;
  }
  accept();
  if (crosses && !record_.stopped()) pass(crossing);
}

/// Between two whole ends of a ride nothing can happen if the wrench is constant: the
/// finger axis runs straight, so friction and gravity keep their moments about the face.
bool PushRun::can_leap() const {
  if (!leaps_allowed_ || traced_ || margin_ < kLeapMargin) return false;
  if (push_.turn != 0.0 && !model_.region.is_isotropic()) return false;
  const int checks = static_cast<int>(std::ceil((1.0 - s_) / options_.max_step));
  for (int i = 0; i <= checks; ++i) {
    const double s = s_ + (1.0 - s_) * i / checks;
    const PlanarPose X_HO = instant_.pose(seat_, s, q_);
    if (!model_.region.is_whole(X_HO)) return false;
    if (depth_inside(model_.pad_face, finger_in_object(X_HO)) < 0.0) return false;
  }
  return true;
}

/// Computes the step and its end; false if there is no motion or the error is too large.
bool PushRun::attempt() {
  const auto rate = [this](double s, const Vec2& q, Vec2& out) {
    // Uniqueness is asked for where the push may be left to rest, not at every stage.
    obstacle_ = instant_.solve(seat_, s, q, s < s_ + step_.h ? kOneMotion : kAllMotions);
    if (obstacle_) return false;
    out = instant_.rate();
    least_margin_ = std::min(least_margin_, mode_margin());
    return true;
  };
  least_margin_ = kNever;
  double failed_at = kNever;
  if (rides()) {
    step_.y_end = q_;
    step_.error.setZero();
    step_.dense.fill(Vec2::Zero());
    if (!rate(s_ + step_.h, q_, step_.rate_end)) failed_at = s_ + step_.h;
  } else {
    failed_at = dormand_prince(rate, step_);
  }
  if (failed_at != kNever) {
    block(failed_at);
    return false;
  }
  if (rides()) return true;
  if (!middle_agrees()) return false;
  step_error_ = std::max(length_of(step_.error), length_of(defect_));
  return control_.accepts(step_.h, step_error_);
}

/// Looks into the middle of the step, where the stages may have missed a kink or jump of
/// the rate: its defect joins the error. A contact mode that is left on the way and holds
/// again at the end calls for a shorter step.
bool PushRun::middle_agrees() {
  instant_.set_aside();
  const double middle = s_ + 0.5 * step_.h;
  obstacle_ = instant_.solve(seat_, middle, step_.at(0.5));
  if (obstacle_) {
    block(middle);
    instant_.bring_back();
    return false;
  }
  defect_ = step_.h * (instant_.rate() - step_.middle_rate());
  const bool leaves = mode_margin() < -instant_.noise() || least_margin_ < kStageMargin;
  instant_.bring_back();
  const bool returns = mode_margin() >= -instant_.noise();
  if (!(leaves && returns) || step_.h <= control_.location()) return true;
  control_.land(0.5 * step_.h);
  return false;
}

/// What an error of the coordinates at the end of the step makes of the pose [m].
double PushRun::length_of(const Vec2& error) const {
  const PlanarPose one = instant_.geometry().object(seat_, step_.y_end);
  const PlanarPose other = instant_.geometry().object(seat_, step_.y_end - error);
  return Vec3(one.x - other.x, one.y - other.y, reach_ * error[1]).norm();
}

/// There is no motion at `at`.
void PushRun::block(double at) {
  if (leaping_) {
    leaps_allowed_ = false;
  } else if (control_.is_at_block(s_, at)) {
    stop(instant_.explained(obstacle_));
  }
}

void PushRun::accept() {
  if (!rides()) {
    const double noise = instant_.noise() * instant_.speed() * step_.h;
    error_ = error_ * growth() + kCaution * step_error_ + noise;
  }
  record_.add_slip(std::abs(step_.y_end[0] - q_[0]));
  s_ = step_.h == 1.0 - s_ ? 1.0 : s_ + step_.h;
  q_ = step_.y_end;
  rate_ = instant_.rate();
  margin_ = mode_margin();
  control_.passed(s_);
  record_.add(instant_.sample(s_, psi_));
}

/// How much of an error made before this step is there after it, by the change of rate
/// between two states at its end. A pusher that trails the pads is unstable.
double PushRun::growth() const {
  const Vec2 lengths(1.0, reach_);
  const Vec2 apart = step_.probe.cwiseProduct(lengths);
  const Vec2 rate = step_.probe_rate.cwiseProduct(lengths);
  if (!(apart.norm() > 1e3 * instant_.noise() * instant_.speed() * step_.h)) return 1.0;
  return std::exp(
      std::clamp(step_.h * apart.dot(rate) / apart.squaredNorm(), 0.0, kMostGrowth));
}

Crossing PushRun::first_crossing() {
  Crossing first;
  const PathLimits::Values at_start = limits(s_, q_);
  const PathLimits::Values at_end = limits(s_ + step_.h, step_.y_end);
  const double resolution = 0.1 * control_.location() / step_.h;
  for (int i = 0; i < PathLimits::kCount; ++i) {
    if (at_end[i] >= -kRoundOff) continue;
    const auto limit = [&](double x) { return limits(s_ + x * step_.h, step_.at(x))[i]; };
    const double at = at_start[i] <= 0.0 ? 0.0
                                         : falling_root(limit, 0.0, at_start[i], 1.0,
                                                        at_end[i], resolution);
    if (at < first.at) first = {at, static_cast<Limit>(i)};
  }
  const double margin_at_end = mode_margin();
  if (margin_at_end >= -instant_.noise()) return first;
  const auto margin = [&](double x) {
    // Where no motion exists the mode has certainly changed.
    const bool solved = !instant_.solve(seat_, s_ + x * step_.h, step_.at(x));
    return solved ? mode_margin() : -1.0;
  };
  instant_.set_aside();
  const double at =
      margin_ <= 0.0 ? 0.0
                     : falling_root(margin, 0.0, margin_, 1.0, margin_at_end, resolution);
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

/// Stops where a motion ends, known within the location of events.
void PushRun::stop(const Obstacle& obstacle) {
  error_ += 2.0 * control_.location() * instant_.speed();
  record_.stop(obstacle, s_);
}

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
