/// The quasi-static instant as a short list of pusher modes, each of them one convex or
/// scalar problem over the friction of the pads. Internal to the mechanics layer.
///
/// D(u) is the power that friction takes at twist u; it is the support function of the
/// convex body S of wrenches that the pads can resist, and its gradient is the resisting
/// wrench. Balance: w_g + w_push in S, and normal to S there is the twist (paper eq. (8)
/// with maximum dissipation, eq. (3) and (4), in the limit of slow pushes).
///
///   both ends of a line stick:  u = V
///   both ends slip:             u = V + s t, one scalar equation in s
///   one point sticks:           u = V + s (turn about the point), lowest D on that line
///   one point slips:            the ray from w_g along the edge of the friction cone
///                               leaves S (or, if gravity lies outside, also enters it)
///
/// A `Body` offers D in one of two forms (real pads, ellipsoid):
///   is_point(), dissipation(u), resistance(u, pivot), pivot_at(u), scaled_twist(u,
///   pivot, scale), choose_pivot_force(push, motion), exit(w, e, guess), lowest(u, d, w,
///   guess), slides(question, capacity, roots), nearest_slide(question, root), holds(w,
///   unsupported).
#pragma once

#include <algorithm>

#include <Eigen/Geometry>

#include "mechanics/scaled_push.h"

namespace prehensile {

/// Where the ray w + lambda e, lambda increasing, leaves S; u is the normal there, e.u >
/// 0.
struct RayExit {
  bool hit = false;  ///< false: none, or not found; then u is where the search ended
  double lambda = 0.0;
  PlanarTwist u = PlanarTwist::Zero();
  PivotPoint pivot;
  int steps = 0;
};

/// The lowest point of D(u) - w.u on a line of twists.
struct LowestOnLine {
  bool bounded = false;
  PlanarTwist u = PlanarTwist::Zero();
  PivotPoint pivot;
  int steps = 0;
};

/// A line pusher whose two ends slip: m.f(V + s t) = target, with f the resisting force,
/// V a twist, t a unit translation and m.t = 1. Wanted are roots s beyond `start`, on the
/// side of `slip`.
struct SlideQuestion {
  PlanarTwist V, t;
  Vec2 m;
  double target;
  double start;
  int slip;

  bool slips(double s) const { return (s - start) * slip > 0.0; }
};

/// On the unit sphere f is the direction of the twist, which makes it a quadratic in s.
/// Also exact for pads and pushers that do not turn. Returns the number of roots, <= 2.
inline int slides_on_sphere(const SlideQuestion& question, double* roots) {
  const PlanarTwist& V = question.V;
  const PlanarTwist& t = question.t;
  const Vec2& m = question.m;
  const double target = question.target;
  const double A = m.dot(V.head<2>());
  const double B = V.dot(t);
  const double target2 = target * target;
  const double a = 1.0 - target2;
  const double b = A - target2 * B;
  const double c = A * A - target2 * V.squaredNorm();
  double candidate[2];
  int candidates = 0;
  if (std::abs(a) <= 1e-14) {
    if (b != 0.0) candidate[candidates++] = -0.5 * c / b;
  } else if (const double discriminant = b * b - a * c; discriminant >= 0.0) {
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    candidate[candidates++] = q / a;
    if (q != 0.0) candidate[candidates++] = c / q;
  }
  int count = 0;
  for (int i = 0; i < candidates; ++i) {
    const double s = candidate[i];
    if (question.slips(s) && (A + s) * target >= 0.0) roots[count++] = s;
  }
  return count;
}

/// A proposal is a motion if nothing is off by more than this, in units of ScaledPush.
inline constexpr double kJudged = 1e-9;

/// Rates below this are the rounding of a pusher that moves along its face.
inline constexpr double kGrazing = 1e-13;

/// Two twists that are one motion but for rounding, in units of ScaledPush.
inline bool is_same_motion(const PlanarTwist& u, const PlanarTwist& v) {
  return (u - v).norm() <= 1e-7 * (1.0 + v.norm());
}

template <class Body>
class PushModes {
 public:
  PushModes(const Body& body, const ScaledPush& push) : body_(body), push_(push) {}

  bool both_stick(Motion& motion) const {
    motion = Motion{};
    motion.support = Motion::Support::kBoth;
    motion.u = push_.V;
    motion.pivot = body_.pivot_at(motion.u);
    motion.u = body_.scaled_twist(motion.u, motion.pivot, 1.0);
    return stuck(motion);
  }

  bool point_sticks(int i, const PlanarTwist* guess, Motion& motion) const {
    motion = Motion{};
    motion.support = static_cast<Motion::Support>(i);
    const Vec2& p = push_.p[i];
    const LowestOnLine low =
        body_.lowest(push_.V, {p.y(), -p.x(), 1.0}, push_.w_g, guess);
    if (!low.bounded) return false;
    motion.steps = low.steps;
    motion.u = low.u;
    motion.pivot = low.pivot;
    return stuck(motion);
  }

  /// `enters`: where the ray enters S instead; only if gravity lies outside.
  bool point_slips(int i, int slip, bool enters, const PlanarTwist* guess,
                   Motion& motion) const {
    motion = Motion{};
    motion.support = static_cast<Motion::Support>(i);
    motion.slip = slip;
    const PlanarWrench e = wrench_of(push_.p[i], push_.edge(slip));
    const RayExit exit = body_.exit(push_.w_g, enters ? -e : e, guess);
    if (!exit.hit) return false;
    const double rate = push_.n.dot(point_velocity(exit.u, push_.p[i]));
    const double scale = push_.approach(i) / rate;
    if (!(scale > 0.0) || !std::isfinite(scale)) return false;
    motion.steps = exit.steps;
    motion.pivot = exit.pivot;
    motion.u = body_.scaled_twist(exit.u, exit.pivot, scale);
    return slid(motion);
  }

  /// Up to `capacity` motions in which both ends slip; returns how many.
  int both_slip(int slip, Motion* motions, int capacity) const {
    const Vec2 m = push_.t + slip * push_.mu * push_.n;
    const double target = m.dot(push_.w_g.head<2>());
    const PlanarTwist along(push_.t.x(), push_.t.y(), 0.0);
    // Counted from no tangential motion at the contact, so that an object that hardly
    // moves is not the difference of two large rates.
    const double slide = push_.t.dot(point_velocity(push_.V, push_.p[0]));
    const PlanarTwist base = push_.V - slide * along;
    std::array<double, 4> roots;
    const int wanted = std::clamp<int>(capacity, 2, roots.size());
    const int count =
        body_.slides({base, along, m, target, slide, slip}, wanted, roots.data());
    int accepted = 0;
    for (int k = 0; k < count && accepted < capacity; ++k) {
      Motion& motion = motions[accepted];
      motion = Motion{};
      motion.support = Motion::Support::kBoth;
      motion.slip = slip;
      motion.u = base + roots[k] * along;
      if (slid(motion)) ++accepted;
    }
    return accepted;
  }

  /// Both ends slip, with the speed nearest to `guess`: also where the mode is not lawful
  /// because they would slip to the other side.
  bool both_slip_near(int slip, const PlanarTwist* guess, Motion& motion) const {
    motion = Motion{};
    motion.support = Motion::Support::kBoth;
    motion.slip = slip;
    const Vec2 m = push_.t + slip * push_.mu * push_.n;
    const PlanarTwist along(push_.t.x(), push_.t.y(), 0.0);
    const double slide = push_.t.dot(point_velocity(push_.V, push_.p[0]));
    const PlanarTwist base = push_.V - slide * along;
    double root = guess != nullptr ? along.dot(*guess - base) : slide;
    if (!body_.nearest_slide({base, along, m, m.dot(push_.w_g.head<2>()), slide, slip},
                             root)) {
      return false;
    }
    motion.u = base + root * along;
    slid(motion);
    return true;
  }

  /// One loaded point. While the pads hold gravity the directions of force and of motion
  /// turn the same way around S, so the side on which the sticking force leaves the
  /// friction cone is the side to which the point slips.
  bool point_moves(int i, Motion& motion) const {
    if (point_sticks(i, nullptr, motion)) return true;
    const int slip = push_.t.dot(motion.w.head<2>()) > 0.0 ? -1 : 1;
    return point_slips(i, slip, false, nullptr, motion);
  }

  /// Some motion with an advancing pusher, the likely modes first.
  bool any_motion(Motion& motion) const {
    if (push_.count == 1) return point_moves(0, motion) || any_slip(0, motion);
    if (both_stick(motion)) return true;
    const double normal = motion.normal[0] + motion.normal[1];
    const int slip = push_.t.dot(motion.w.head<2>()) > 0.0 ? -1 : 1;
    const int loaded = motion.normal[1] > motion.normal[0] ? 1 : 0;
    const bool pressed =
        motion.normal[0] >= 0.0 && motion.normal[1] >= 0.0 && normal > 0.0;
    if (pressed && both_slip(slip, &motion, 1) > 0) return true;
    for (const int i : {loaded, 1 - loaded}) {
      if (push_.approach(i) > 0.0 && point_moves(i, motion)) return true;
    }
    if (!pressed && both_slip(slip, &motion, 1) > 0) return true;
    return both_slip(-slip, &motion, 1) > 0 || any_slip(0, motion) || any_slip(1, motion);
  }

  /// Every motion, without repetition of twists.
  static constexpr int kMost = 16;
  int all_motions(std::array<Motion, kMost>& motions) const {
    int count = 0;
    const auto keep = [&](const Motion& motion) {
      for (int k = 0; k < count; ++k) {
        if (is_same_motion(motions[k].u, motion.u)) return;
      }
      if (count < kMost) motions[count++] = motion;
    };
    Motion motion;
    if (push_.count == 2) {
      if (both_stick(motion)) keep(motion);
      for (const int slip : {1, -1}) {
        std::array<Motion, 4> slips;
        const int found = both_slip(slip, slips.data(), 4);
        for (int k = 0; k < found; ++k) keep(slips[k]);
      }
    }
    for (int i = 0; i < push_.count; ++i) {
      if (point_sticks(i, nullptr, motion)) keep(motion);
      for (const int slip : {1, -1}) {
        for (const bool enters : {false, true}) {
          if (point_slips(i, slip, enters, nullptr, motion)) keep(motion);
        }
      }
    }
    return count;
  }

 private:
  /// Where rounding decides between the sides.
  bool any_slip(int i, Motion& motion) const {
    if (!(push_.approach(i) > 0.0)) return false;
    return point_slips(i, 1, false, nullptr, motion) ||
           point_slips(i, -1, false, nullptr, motion);
  }

  bool stuck(Motion& motion) const {
    if (motion.pivot.index >= 0) body_.choose_pivot_force(push_, motion);
    return slid(motion);
  }

  bool slid(Motion& motion) const {
    motion.w =
        body_.resistance(motion.u, motion.pivot) - push_.w_g + push_.inertial_force;
    judge(push_, motion);
    return motion.residual <= kJudged;
  }

  const Body& body_;
  const ScaledPush& push_;
};

}  // namespace prehensile
