#include "planner/run_slabs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/segment.h"
#include "planner/slab_cost.h"

namespace prehensile {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Directions of u, and shares for either sense of the turn: all are looked at coarsely,
/// and the best finely.
constexpr int kWays = 24;
constexpr double kLeastAhead = 0.1;  // cosine of u and the straight way
constexpr std::array kShares = {0.3, 0.6, 0.85, 0.97};

struct Fineness {
  int slabs, steps;
};
constexpr Fineness kCoarse{4, 40};
constexpr Fineness kFine{12, 300};

/// Where a slab is as wide as that of its width, over the slab's own, a sector of
/// directions is as wide as half a turn.
constexpr double kAsHalfTurn = 4.0;

constexpr double kRounding = 1e-7;  // [m]

/// Places on ways between two places that are no longer than `cap`.
class Ellipse {
 public:
  Ellipse(const Vec2& from, const Vec2& to, double cap)
      : middle_(0.5 * (from + to)),
        axis_((to - from).norm() > 0.0 ? Vec2((to - from).normalized()) : Vec2::UnitX()),
        half_length_(0.5 * cap) {
    const double focus = 0.5 * (to - from).norm();
    is_empty_ = !(half_length_ > focus);
    if (is_empty_) return;
    half_width_ = std::sqrt((half_length_ - focus) * (half_length_ + focus));
  }

  bool is_empty() const { return is_empty_; }
  const Vec2& axis() const { return axis_; }

  /// perp(u).p of its places with low <= u.p <= high. It is the unit disc, stretched.
  Extent across(const Vec2& u, double low, double high) const {
    const Vec2 along = stretched(u);
    const double size = along.norm();
    const double middle = u.dot(middle_);
    const double from = std::max(-1.0, (low - middle) / size);
    const double to = std::min(1.0, (high - middle) / size);
    if (from > to) return {kInfinity, -kInfinity};
    const Vec2 sideways = stretched(perp(u));
    const double skew = sideways.dot(along) / size;
    const double half = std::abs(cross(along, sideways)) / size;
    const double centre = perp(u).dot(middle_);
    return {centre - greatest(-skew, half, from, to),
            centre + greatest(skew, half, from, to)};
  }

 private:
  Vec2 stretched(const Vec2& w) const {
    return {half_length_ * w.dot(axis_), half_width_ * w.dot(perp(axis_))};
  }

  /// The greatest skew t + half sqrt(1 - t^2) for t in [from, to].
  static double greatest(double skew, double half, double from, double to) {
    const double size = std::hypot(skew, half);
    const double t = std::clamp(size > 0.0 ? skew / size : 0.0, from, to);
    return skew * t + half * std::sqrt((1.0 - t) * (1.0 + t));
  }

  Vec2 middle_, axis_;
  double half_length_, half_width_ = 0.0;
  bool is_empty_;
};

/// The bound by slabs across u, for a share of the turn.
double travel_along(const LocalLaw& law, const RunQuestion& run, const Ellipse& ellipse,
                    const Vec2& u, double share, const Fineness& fineness) {
  const double begin = u.dot(run.start) + kRounding;
  const double end = u.dot(run.goal.centre) - run.goal.reach(u) - kRounding;
  if (end <= begin) return 0.0;
  const double width = (end - begin) / fineness.slabs;
  double travel = share * run.c * (share > 0.0 ? run.turn_low : run.turn_high);
  for (int i = 0; i < fineness.slabs && travel < run.cap; ++i) {
    Slab slab{.u = u, .low = begin + i * width, .width = width};
    const double high = slab.low + width;
    const Extent inside =
        extent_across(*run.outline, u, perp(u), slab.low - kRounding, high + kRounding);
    const Extent reached = ellipse.across(u, slab.low, high);
    slab.across = {std::max(inside.low, reached.low - kRounding),
                   std::min(inside.high, reached.high + kRounding)};
    const double extent = slab.across.high - slab.across.low;
    travel += width * least_cost(law, slab,
                                 {.first_contact = run.contact,
                                  .end_contact = run.contact + 1,
                                  .share = share,
                                  .steps = fineness.steps,
                                  .as_half_turn = kAsHalfTurn * extent});
  }
  return travel;
}

}  // namespace

double travel_across_slabs(const LocalLaw& law, const RunQuestion& run) {
  if (!law.is_known()) return 0.0;
  const double off_goal = run.goal.arc.norm() + run.goal.widest();
  const Ellipse ellipse(run.start, run.goal.centre, run.cap + off_goal + kRounding);
  if (ellipse.is_empty()) return run.cap;
  const double sense = run.turn_low + run.turn_high < 0.0 ? -1.0 : 1.0;
  double most = 0.0, best_angle = 0.0, best_share = 0.0;
  const auto look = [&](double angle, double share) {
    if (most >= run.cap || std::cos(angle) <= kLeastAhead) return;
    const Vec2 u = rotated(angle, ellipse.axis());
    const double travel = travel_along(law, run, ellipse, u, share, kCoarse);
    if (travel <= most) return;
    most = travel;
    best_angle = angle;
    best_share = share;
  };
  for (int i = 0; i < kWays; ++i) look(2.0 * kPi * i / kWays, 0.0);
  for (const double share : kShares) {
    const double angle = best_angle;
    for (const int ways : {0, 1, -1, 2, -2}) {
      look(angle + ways * 2.0 * kPi / kWays, sense * share);
    }
  }
  if (most > 0.0 && most < run.cap) {
    most = std::max(most,
                    travel_along(law, run, ellipse, rotated(best_angle, ellipse.axis()),
                                 best_share, kFine));
  }
  return std::min(most, run.cap);
}

}  // namespace prehensile
