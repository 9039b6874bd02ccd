#include "benchmarks/fixed_step.h"

#include <algorithm>
#include <cmath>

#include "primitives/dormand_prince.h"
#include "primitives/push_instant.h"

namespace prehensile::benchmarks {
namespace {

/// Secant steps that close in on an event.
constexpr int kLocationSteps = 8;

/// Events of a push; more are a contact mode that alternates.
constexpr int kMostEvents = 50;

/// Attempted steps of the adaptive scheme.
constexpr int kMostSteps = 3000;

class Plain {
 public:
  Plain(const Model& model, const Grasp& start, const LinearPush& push,
        const TransitionOptions& options, Scheme scheme)
      : instant_(model, push, start, options),
        tolerance_(options.tolerance),
        reach_(std::max(model.c, 0.01 * model.L)),
        located_(scheme == Scheme::kEulerLocated || scheme == Scheme::kRungeKuttaLocated),
        order_(scheme == Scheme::kEuler || scheme == Scheme::kEulerLocated ? 1 : 4),
        seat_(instant_.geometry().first()) {}

  PlainRun run(Scheme scheme, int steps) {
    PlainRun result;
    result.completed =
        begin() && (scheme == Scheme::kAdaptive ? adaptive() : fixed(steps));
    result.end = instant_.pose(seat_, s_, q_);
    result.evaluations = instant_.count();
    result.events = events_;
    return result;
  }

 private:
  bool begin() {
    if (instant_.solve(seat_, 0.0, q_)) return false;
    regime_ = instant_.regime();
    return true;
  }

  bool rate(double s, const Vec2& q, Vec2& out) {
    const bool found = located_ ? instant_.solve_in_mode(seat_, s, q, regime_) ==
                                      PushInstant::InMode::kMoves
                                : !instant_.solve(seat_, s, q);
    if (found) out = instant_.rate();
    return found;
  }

  bool step(double h, const Vec2& k1, Vec2& end) {
    if (order_ == 1) {
      end = q_ + h * k1;
      return true;
    }
    Vec2 k2, k3, k4;
    if (!rate(s_ + 0.5 * h, q_ + 0.5 * h * k1, k2)) return false;
    if (!rate(s_ + 0.5 * h, q_ + 0.5 * h * k2, k3)) return false;
    if (!rate(s_ + h, q_ + h * k3, k4)) return false;
    end = q_ + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    return true;
  }

  double margin() const { return instant_.margin(seat_, regime_).least(); }

  bool fixed(int steps) {
    Vec2 k1, next;
    if (!rate(0.0, q_, k1)) return false;
    double margin_here = margin();
    for (int i = 0; i < steps;) {
      const double until = static_cast<double>(i + 1) / steps;
      const double h = until - s_;
      if (!step(h, k1, next)) return false;
      Vec2 rate_next;
      if (!rate(until, next, rate_next)) return false;
      const double margin_next = margin();
      if (located_ && margin_next < -instant_.noise() && margin_here > 0.0) {
        if (!pass_event(h, k1, margin_here, margin_next)) return false;
        if (!rate(s_, q_, k1)) return false;
        margin_here = std::max(margin(), 1e-300);
        if (until - s_ < 1e-14) ++i;
        continue;
      }
      q_ = next;
      s_ = until;
      k1 = rate_next;
      margin_here = margin_next;
      ++i;
    }
    return true;
  }

  /// Shortens the step until it ends where the contact mode does, and takes the next one.
  bool pass_event(double h, const Vec2& k1, double low_margin, double high_margin) {
    double low = 0.0;
    double high = h;
    double length = h;
    Vec2 end = q_;
    Vec2 unused;
    for (int i = 0; i < kLocationSteps; ++i) {
      length = low + (high - low) * low_margin / (low_margin - high_margin);
      if (!step(length, k1, end) || !rate(s_ + length, end, unused)) return false;
      const double there = margin();
      if (std::abs(there) < 1e-13) break;
      (there >= 0.0 ? low : high) = length;
      (there >= 0.0 ? low_margin : high_margin) = there;
    }
    q_ = end;
    s_ += length;
    if (++events_ > kMostEvents) return false;
    const bool sticks = regime_ == Regime::kStick;
    if (instant_.solve(seat_, s_, q_)) return false;
    regime_ = sticks ? instant_.slip_side() : Regime::kStick;
    return true;
  }

  bool adaptive() {
    BaseStep step;
    step.y = q_;
    if (!rate(0.0, q_, step.rate)) return false;
    double h = 0.1;
    const auto f = [this](double s, const Vec2& q, Vec2& out) { return rate(s, q, out); };
    for (int i = 0; i < kMostSteps && s_ < 1.0; ++i) {
      step.s = s_;
      step.h = std::min(h, 1.0 - s_);
      const bool found = std::isinf(dormand_prince(f, step));
      const double error = std::hypot(step.error[0], reach_ * step.error[1]);
      const double allowed = tolerance_ * std::max(step.h, 0.05);
      const bool accepted = found && (error <= allowed || step.h < 1e-9);
      if (!found && step.h < 1e-9) return false;
      const double factor = 0.9 * std::pow(allowed / std::max(error, 1e-300), 0.2);
      h = step.h * (found ? std::clamp(factor, 0.2, 3.0) : 0.25);
      if (!accepted) continue;
      s_ = step.h >= 1.0 - s_ ? 1.0 : s_ + step.h;
      q_ = step.y = step.y_end;
      step.rate = step.rate_end;
    }
    return s_ == 1.0;
  }

  PushInstant instant_;
  double tolerance_;
  double reach_;
  bool located_;
  int order_;
  Seat seat_;
  Regime regime_ = Regime::kStick;
  double s_ = 0.0;
  Vec2 q_ = Vec2::Zero();
  int events_ = 0;
};

}  // namespace

const char* name(Scheme scheme) {
  switch (scheme) {
    case Scheme::kEuler:
      return "Euler";
    case Scheme::kRungeKutta:
      return "RK4";
    case Scheme::kAdaptive:
      return "DP5(4)";
    case Scheme::kEulerLocated:
      return "Euler + events";
    case Scheme::kRungeKuttaLocated:
      return "RK4 + events";
  }
  return "unknown";
}

PlainRun integrate_plainly(const Model& model, const Grasp& start, const LinearPush& push,
                           const TransitionOptions& options, Scheme scheme, int steps) {
  return Plain(model, start, push, options, scheme).run(scheme, steps);
}

}  // namespace prehensile::benchmarks
