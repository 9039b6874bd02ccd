/// One push, from its start to its end or to the event that ends it.
///
/// The object follows one contact mode at a time (seat and regime), and the mode beyond
/// its end: rates are smooth there, so steps are long, and where the mode ends is a root
/// of its margin along the step. While a line sticks flush to the face the object rides:
/// its motion is known, and bounds on the pusher's forces say how far nothing can happen
/// (ride_bound.h). Otherwise steps are integrated (integration_step.h), by an explicit
/// method or a stiff one. Internal to the primitives layer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "primitives/integration_step.h"
#include "primitives/linear_push.h"
#include "primitives/path_limits.h"
#include "primitives/push_instant.h"
#include "primitives/rosenbrock.h"
#include "primitives/step_control.h"

namespace prehensile {

/// The first change within a step: where, as a share of the step, and which limit; none:
/// a change of contact mode.
struct Crossing {
  double at = StepControl::kNever;
  std::optional<Limit> limit;
  bool returns = false;  ///< the limit is kept again farther on
};

/// A place inside a step, as a share of it, and the margin of the contact mode there.
struct Look {
  double at = 0.0;
  double margin = StepControl::kNever;
};

/// `Instant` is the source of the rates: `PushInstant` in the pad plane,
/// `SpatialPushInstant` in space.
template <class Instant>
class PushRun {
 public:
  PushRun(const Model& model, const Grasp& start, const LinearPush& push,
          const Guard& guard, const TransitionOptions& options,
          std::vector<Sample>* trace)
      : model_(model),
        push_(push),
        options_(closer(options, push)),
        psi_(start.psi),
        reach_(std::max(model.c, kLeastReach * model.L)),
        instant_(model, push, start, options),
        limits_(model, start, guard, reach_),
        record_(options.certificate_tolerance, trace),
        control_(kStepShare * options.tolerance, longest_step(options_),
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
  static constexpr double kNever = StepControl::kNever;

  /// Share of the tolerance that steps may spend: errors grow after they were made.
  static constexpr double kStepShare = 0.5;

  /// Share of the tolerance that the location of an event may cost.
  static constexpr double kLocationShare = 0.1;

  /// Longest integrated step over the wanted spacing of checks: the mode is looked at in
  /// eight places of it. Pads, unlike the ellipsoid, have kinks to be found as well.
  static double longest_step(const TransitionOptions& options) {
    const bool is_smooth = options.friction_model == FrictionModel::kEllipsoid;
    return std::min(1.0, (is_smooth ? 14.0 : 7.0) * options.max_step);
  }

  /// A push that turns by more than half a turn is looked at as closely as if its half
  /// turns were pushes of their own; where they are more than these, as if it had these.
  static constexpr double kMostHalfTurns = 16.0;
  static TransitionOptions closer(TransitionOptions options, const LinearPush& push) {
    const double turned = std::max(std::abs(push.turn), std::abs(push.bend));
    options.max_step /= std::clamp(turned / std::numbers::pi, 1.0, kMostHalfTurns);
    return options;
  }

  /// Share of its length by which a step that is to end at an event goes beyond it.
  static constexpr double kBeyond = 0.02;

  /// So often may a regime be left at once for the one before, and may a change of
  /// contact mode come right after another one.
  static constexpr int kMostReturns = 32;
  static constexpr int kMostCloseChanges = 16;

  /// Length over the location of events of a step that is not made shorter for one.
  static constexpr double kShortest = 4.0;
  static constexpr PushStop kAlternates{
      TransitionStatus::kIterationLimit, {}, "the contact mode alternates"};

  /// Weight of an angle for pads that cannot exert a torque, over the size of the object.
  static constexpr double kLeastReach = 0.01;
  static constexpr PushStop kUnheldPush{TransitionStatus::kFalls, EventKind::kGravityLost,
                                        "the grasp alone does not hold gravity"};

  void begin();
  void advance();

  bool ride();
  double ride_length() const;
  bool is_close(double at);
  bool is_of_other_motion(const Crossing& crossing);
  bool integrate();
  void land_at_kink();
  RateDerivatives derivatives(const BaseStep& base);
  bool rate_in_mode(double s, const Vec2& q, Vec2& out);
  bool rate_at_end(double s, const Vec2& q, Vec2& out);
  void look_inside();
  template <class Rate>
  double look_at_nodes(const BaseStep& base, const Rate& rate);
  double counted_error() const;
  void doubt_stiff_step(bool kink);
  double length_of(const Vec2& error) const;
  double growth(double share) const;
  void watch_stiffness(bool accepted);
  void block(double at);
  void look_at_block();
  void stop_at_block(double beyond);
  void accept(double share);
  void trace_inside(double share);

  Crossing first_crossing();
  Crossing crossing_by_end(const PathLimits::Values& at_start,
                           const PathLimits::Values& at_end);
  StepBound bound_within(double to) const;
  Crossing crossing_between(double from, const PathLimits::Values& at_from, double to,
                            const PathLimits::Values& at_to) const;
  PathLimits::Values limits(double s, const Vec2& q) const;
  double mode_margin() const { return instant_.margin(seat_, regime_).least(); }

  void pass(const Crossing& crossing);
  void change_mode();
  void take_seat(const Seat& seat, EventKind event);
  void take_regime(Regime regime);
  void add(EventKind event);
  bool solve_here();
  void stop(const PushStop& why);
  bool rides() const {
    return seat_.kind == SeatKind::kFlush && regime_ == Regime::kStick;
  }

  const Model& model_;
  const LinearPush push_;
  const TransitionOptions options_;
  const double psi_;
  const double reach_;  ///< [m] weight of an angle

  Instant instant_;
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
  double inside_error_ = 0.0;  ///< [m] of the state where an event was found
  double step_error_ = 0.0;    ///< [m]
  std::array<Look, 2> looks_;  ///< between both ends
  double least_margin_ = 0.0;  ///< of the contact mode over its stages
  double least_at_ = 0.0;      ///< [share of the push] where that is
  double dip_at_ = kNever;     ///< [share of the step] a place inside, beyond the mode
  double dip_margin_ = 0.0;
  PushStop stop_;
  Regime regime_ = Regime::kStick;
  int attempts_ = 0;
  const bool traced_;
  bool landed_ = false;  ///< the step was made to end at its event
  Regime regime_before_ = Regime::kStick;
  double regime_since_ = -1.0;  ///< share of the push at which the regime was taken
  int returns_ = 0;             ///< how often a regime was left at once
  double changed_at_ = -1.0;    ///< share of the push of the last change of contact mode
  int close_changes_ = 0;       ///< right after another
  bool was_stiff_ = false;      ///< when the regime before was left
  bool stiff_ = false;
  double stiffness_ =
      0.0;  ///< of the last stiff step: its length times the rate of decay
  int stiffness_seen_ = 0;  ///< in how many steps in a row
  bool whole_ = true;       ///< the pad does not overhang
};

}  // namespace prehensile
