#include "planner/bounds/run_slabs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/bounds/slab_cost.h"
#include "planner/geometry/segment.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Directions of u, and shares for either sense of the turn: all are looked at coarsely,
/// and the best finely.
constexpr int kWays = 24;
constexpr double kLeastAhead = 0.1;  // cosine of u and the straight way
constexpr std::array kShares = {0.3, 0.6, 0.85, 0.97};

/// `steps` of the branch and bound for each slab; `sampled` directions to either side.
struct Fineness {
  int slabs, steps, sampled;
};
constexpr Fineness kCoarse{4, 40, 4};
constexpr Fineness kFine{12, 300, 16};
constexpr double kWidestSample = 0.45 * kPi;  // [rad] from u

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

/// Slabs across u from the start to the goal, and a share of the turn.
class Look {
 public:
  Look(const LocalLaw& law, const RunQuestion& run, const Vec2& u, double share)
      : law_(law),
        run_(run),
        u_(u),
        share_(share),
        begin_(u.dot(run.start) + kRounding),
        end_(u.dot(run.goal.centre) - run.goal.reach(u) - kRounding) {}

  bool is_ahead() const { return end_ > begin_; }

  /// The bound.
  double travel(const Ellipse& ellipse, const Fineness& fineness) const {
    const double width = (end_ - begin_) / fineness.slabs;
    double travel = travel_of_turn();
    for (int i = 0; i < fineness.slabs && travel < run_.cap; ++i) {
      Slab slab{.u = u_, .low = begin_ + i * width, .width = width};
      const double high = slab.low + width;
      const Extent inside = extent_across(*run_.outline, u_, perp(u_),
                                          slab.low - kRounding, high + kRounding);
      const Extent reached = ellipse.across(u_, slab.low, high);
      slab.across = {std::max(inside.low, reached.low - kRounding),
                     std::min(inside.high, reached.high + kRounding)};
      const double extent = slab.across.high - slab.across.low;
      travel += width * least_cost(law_, slab,
                                   {.first_contact = run_.contact,
                                    .end_contact = run_.contact + 1,
                                    .share = share_,
                                    .steps = fineness.steps,
                                    .as_half_turn = kAsHalfTurn * extent});
    }
    return travel;
  }

  /// What it cannot exceed, by motions that stick on the straight way; infinity if none
  /// of those that are looked at do. Where that way leaves the object the bound may be
  /// more, so that a look may be left out that would say more.
  double most_travel(const Fineness& fineness) const {
    const double width = (end_ - begin_) / fineness.slabs;
    double travel = travel_of_turn();
    for (int i = 0; i < fineness.slabs && travel < kInfinity; ++i) {
      travel += width * cost_at(begin_ + (i + 0.5) * width, fineness.sampled);
    }
    return travel;
  }

 private:
  double travel_of_turn() const {
    return share_ * run_.c * (share_ > 0.0 ? run_.turn_low : run_.turn_high);
  }

  double cost_at(double depth, int sampled) const {
    const Vec2 way = run_.goal.centre - run_.start;
    const double done = (depth - u_.dot(run_.start)) / u_.dot(way);
    const std::array place = {Vec2(run_.start + done * way)};
    double least = kInfinity;
    for (int k = -sampled; k <= sampled; ++k) {
      const double off = k * kWidestSample / sampled;
      const DirectionSpan direction{rotated(off, u_), 0.0};
      const double cost = law_.least_travel(run_.contact, place, direction, share_).cost;
      least = std::min(least, cost / std::cos(off));
    }
    return least;
  }

  const LocalLaw& law_;
  const RunQuestion& run_;
  Vec2 u_;
  double share_, begin_, end_;
};

}  // namespace

double travel_across_slabs(const LocalLaw& law, const RunQuestion& run, double known) {
  if (!law.is_known()) return 0.0;
  const double off_goal = run.goal.arc.norm() + run.goal.widest();
  const Ellipse ellipse(run.start, run.goal.centre, run.cap + off_goal + kRounding);
  if (ellipse.is_empty()) return run.cap;
  const double sense = run.turn_low + run.turn_high < 0.0 ? -1.0 : 1.0;
  double most = 0.0, best_angle = 0.0, best_share = 0.0;
  const auto look_at = [&](double angle, double share, const Fineness& fineness) {
    if (most >= run.cap || std::cos(angle) <= kLeastAhead) return;
    const Look look(law, run, rotated(angle, ellipse.axis()), share);
    if (!look.is_ahead() || look.most_travel(fineness) <= std::max(most, known)) return;
    const double travel = look.travel(ellipse, fineness);
    if (travel <= most) return;
    most = travel;
    best_angle = angle;
    best_share = share;
  };
  for (int i = 0; i < kWays; ++i) look_at(2.0 * kPi * i / kWays, 0.0, kCoarse);
  for (const double share : kShares) {
    const double angle = best_angle;
    for (const int ways : {0, 1, -1, 2, -2}) {
      look_at(angle + ways * 2.0 * kPi / kWays, sense * share, kCoarse);
    }
  }
  if (most > 0.0) look_at(best_angle, best_share, kFine);
  return std::min(most, run.cap);
}

}  // namespace prehensile
