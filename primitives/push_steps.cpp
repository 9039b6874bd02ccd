/// Steps of a push that is integrated.
#include <algorithm>
#include <cmath>
#include <limits>

#include "primitives/dormand_prince.h"
#include "primitives/push_run.h"
#include "primitives/spatial_push_instant.h"

namespace prehensile {
namespace {

using enum Search;

/// Powers of the step length with which the errors of the methods fall.
constexpr int kOrder = 6;
constexpr int kStiffOrder = 5;

/// Step times rate of decay beyond which an explicit step is at the border of its
/// stability, and below which a stiff one is not needed.
constexpr double kStiff = 2.5;
constexpr double kNotStiff = 1.0;

/// Longest step with an overhanging pad over the wanted spacing of checks.
constexpr double kOverhangStep = 4.0;

/// Counted over computed error of a single step, and over the defect of one with a kink.
/// And the share of the embedded error that counts where the computed one is small by
/// chance.
constexpr double kDoubt = 5.0;
constexpr double kDoubtOfKink = 1.0;
constexpr double kOfEmbedded = 0.05;

/// Embedded over allowed error of a whole stiff step whose halves need not be tried, and
/// over the error that the step would have.
constexpr double kHopeless = 500.0;
constexpr double kHopelessIsMore = 100.0;

/// Counted over computed error of a stiff step, and of one with a kink.
constexpr double kDoubtOfStiff = 1.5;
constexpr double kDoubtOfStiffKink = 9.0;

/// A place in a stiff step that is far from all its stages, and the share of the change
/// that its rate would make over the step that counts as error.
constexpr double kUnseen = 0.35;
constexpr double kOfUnseen = 0.015;

/// Small changes for derivatives of the rate: share of the push, angle.
constexpr double kNudge = 1e-6;

/// Bound on the exponent of the growth of errors over one step.
constexpr double kMostGrowth = 10.0;

/// Share of the decay of errors that counts: not all directions decay alike.
constexpr double kContraction = 0.2;

}  // namespace

/// A step that was refused because rates have a kink at the end of the contact mode: the
/// next one shall end there.
template <class Instant>
void PushRun<Instant>::land_at_kink() {
  if (Instant::kSmoothBeyondMode || !(least_margin_ < -instant_.noise())) return;
  if (!(margin_ > 0.0)) return;
  const double share = margin_ / (margin_ - least_margin_);
  control_.land((1.0 + kBeyond) * share * (least_at_ - s_));
}

/// Computes the step and its end; false if there is no motion or the error is too large.
template <class Instant>
bool PushRun<Instant>::integrate() {
  // The points of a pad that overhangs move over it, with a kink now and then.
  const bool is_smooth = whole_ || options_.friction_model == FrictionModel::kEllipsoid;
  step_.h = control_.next(s_, is_smooth ? kNever : kOverhangStep * options_.max_step);
  const double middle = s_ + 0.5 * step_.h;
  int low_pivot = std::numeric_limits<int>::max();
  int high_pivot = -2;
  looks_ = {};
  least_margin_ = dip_at_ = kNever;
  const auto rate = [this, middle, &low_pivot, &high_pivot](double s, const Vec2& q,
                                                            Vec2& out) {
    if (!rate_in_mode(s, q, out)) return false;
    if (stiff_ && s == middle) looks_[0] = {0.5, mode_margin()};
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
  const auto is_hopeless = [this](const Vec2& error) {
    return length_of(error) > kHopeless * control_.allowed(step_.h);
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
    failed_at = doubled(method, rate, end_rate, is_hopeless, kStiffOrder, step_);
  } else {
    const auto method = [](const auto& f, BaseStep& base) {
      return dormand_prince(f, base);
    };
    BaseStep base;
    failed_at = single(method, rate, end_rate, base, step_);
    if (failed_at == kNever) failed_at = look_at_nodes(base, rate);
  }
  if (failed_at != kNever) {
    block(failed_at);
    return false;
  }
  if (step_.gave_up) {
    (void)control_.accepts(step_.h, length_of(step_.error) / kHopelessIsMore, kOrder);
    land_at_kink();
    return false;
  }
  step_error_ = counted_error();
  const bool accepted =
      control_.accepts(step_.h, step_error_, stiff_ ? kStiffOrder : kOrder);
  watch_stiffness(accepted);
  if (!accepted) {
    land_at_kink();
    return false;
  }
  const bool kink = low_pivot != high_pivot;
  if (stiff_) {
    doubt_stiff_step(kink);
  } else if (kink && !Instant::kSmoothBeyondMode) {
    // In space a change of the loaded points is known for a kink, however small.
    step_error_ = std::max(step_error_, kDoubtOfKink * length_of(step_.defect));
  }
  look_inside();
  return true;
}

/// The rates at the places that tell the error of a single step; a place without motion,
/// or infinity.
template <class Instant>
template <class Rate>
double PushRun<Instant>::look_at_nodes(const BaseStep& base, const Rate& rate) {
  instant_.set_aside();
  instant_.resume();
  double failed_at = kNever;
  std::array<Vec2, 2> rates;
  for (std::size_t i = 0; i < 2 && failed_at == kNever; ++i) {
    const double x = kQuadratureNodes[i];
    const double s = s_ + x * step_.h;
    if (!rate(s, base.at(x), rates[i])) failed_at = s;
    looks_[i] = {x, mode_margin()};
  }
  instant_.bring_back();
  if (failed_at == kNever) judge(base, rates, step_);
  return failed_at;
}

/// What the error of a step is counted as.
template <class Instant>
double PushRun<Instant>::counted_error() const {
  const double error = length_of(step_.error);
  if (step_.is_doubled) return kDoubtOfStiff * error;
  const double seen = kDoubt * std::max(error, kOfEmbedded * length_of(step_.embedded));
  return step_.is_smooth ? seen : std::max(seen, kDoubtOfKink * length_of(step_.defect));
}

/// What a stiff step's error may be, with what its computation cannot see: a kink between
/// the stages, which a place that no stage looked at may show, and the random size of the
/// error where there is one.
template <class Instant>
void PushRun<Instant>::doubt_stiff_step(bool kink) {
  if (kink) step_error_ *= kDoubtOfStiffKink;
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
template <class Instant>
bool PushRun<Instant>::rate_at_end(double s, const Vec2& q, Vec2& out) {
  stop_ = instant_.solve(seat_, s, q, kAllMotions);
  if (stop_ || mode_margin() < -instant_.noise()) {
    // Beyond the end of the mode, if the mode says so.
    const PushStop met = stop_;
    instant_.set_aside();
    const bool beyond = instant_.solve_in_mode(seat_, s, q, regime_) == InMode::kMoves &&
                        mode_margin() < -instant_.noise();
    if (!beyond) instant_.bring_back();
    if (!beyond && met) return false;
    stop_ = {};
  }
  out = instant_.rate();
  return true;
}

/// Rate within the contact mode, also beyond its end; where the mode alone does not tell
/// the motion, that of the instant.
template <class Instant>
bool PushRun<Instant>::rate_in_mode(double s, const Vec2& q, Vec2& out) {
  const InMode found = instant_.solve_in_mode(seat_, s, q, regime_);
  if (found != InMode::kMoves) {
    stop_ = found == InMode::kUnheld ? kUnheldPush : instant_.solve(seat_, s, q);
    if (stop_) return false;
  }
  out = instant_.rate();
  return true;
}

template <class Instant>
RateDerivatives PushRun<Instant>::derivatives(const BaseStep& base) {
  RateDerivatives found;
  const double nudge = std::min(kNudge, 0.5 * base.h);
  Vec2 rate;
  if (rate_in_mode(base.s + nudge, base.y, rate)) found.by_s = (rate - base.rate) / nudge;
  const bool slips = regime_ != Regime::kStick;
  const bool tilts = seat_.kind != SeatKind::kFlush;
  for (const int k : {0, 1}) {
    if (!(k == 0 ? slips : tilts)) continue;
    Vec2 q = base.y;
    // Small against the way in which the object swings to where it trails.
    const double swing = kNudge * std::min(1.0, reach_ / model_.L);
    const double change = k == 0 ? swing * model_.L : swing;
    q[k] += change;
    if (!rate_in_mode(base.s, q, rate)) continue;
    found.by_state.col(k) = (rate - base.rate) / change;
  }
  stiffness_ = base.h * found.by_state.cwiseAbs().maxCoeff();
  return found;
}

/// Where a stage seemed to leave a contact mode that holds wherever the step was looked
/// at, the place itself is looked at.
template <class Instant>
void PushRun<Instant>::look_inside() {
  const double looked = std::min({looks_[0].margin, looks_[1].margin, mode_margin()});
  if (least_margin_ >= -instant_.noise() || looked < -instant_.noise()) return;
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
template <class Instant>
double PushRun<Instant>::length_of(const Vec2& error) const {
  const PlanarPose one = instant_.geometry().object(seat_, step_.y_end);
  const PlanarPose other = instant_.geometry().object(seat_, step_.y_end - error);
  return Vec3(one.x - other.x, one.y - other.y, reach_ * error[1]).norm();
}

/// Explicit steps that are kept short by stability call for a stiff method, and its steps
/// for an explicit one where that would do as well.
template <class Instant>
void PushRun<Instant>::watch_stiffness(bool accepted) {
  if (stiff_) {
    stiffness_seen_ = accepted && stiffness_ < kNotStiff ? stiffness_seen_ - 1 : 2;
    stiff_ = stiffness_seen_ > 0;
    return;
  }
  const Vec2 lengths(1.0, reach_);
  const double apart = step_.probe.cwiseProduct(lengths).norm();
  const double change = step_.h * step_.probe_rate.cwiseProduct(lengths).norm();
  const double noise = Instant::kSmoothBeyondMode
                           ? 0.0
                           : 1e3 * instant_.rounding() * instant_.speed() * step_.h;
  stiffness_seen_ = change > kStiff * apart && apart >= noise ? stiffness_seen_ + 1 : 0;
  stiff_ = stiffness_seen_ >= 2;
}

/// How much of an error made before this step is there after it, by the change of rate
/// between two states at its end. A pusher that trails the pads is unstable.
template <class Instant>
double PushRun<Instant>::growth(double share) const {
  const Vec2 lengths(1.0, reach_);
  const Vec2 apart = step_.probe.cwiseProduct(lengths);
  const Vec2 rate = step_.probe_rate.cwiseProduct(lengths);
  if (!(apart.norm() > 1e3 * instant_.rounding() * instant_.speed() * step_.h))
    return 1.0;
  const double exponent = share * step_.h * apart.dot(rate) / apart.squaredNorm();
  const double trusted = exponent < 0.0 ? kContraction * exponent : exponent;
  return std::exp(std::clamp(trusted, -kMostGrowth, kMostGrowth));
}

template class PushRun<PushInstant>;
template class PushRun<SpatialPushInstant>;

}  // namespace prehensile
