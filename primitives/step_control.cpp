#include "primitives/step_control.h"

#include <algorithm>
#include <cmath>

namespace prehensile {
namespace {

/// Least share of the tolerance that a step may spend. Very short steps, which a kink or
/// a jump of the rate enforces, are rare.
constexpr double kLeastShare = 0.05;

/// Wanted over largest length of the next step. What made a step fail often lies just
/// ahead and is worse than the error of the longer step told.
constexpr double kCaution = 0.8;
constexpr double kCautionAfterRefusal = 0.7;

/// Share of what is left of the push from which on a step is stretched to its end: better
/// than a last one that is short for no reason.
constexpr double kNearlyAll = 0.75;

}  // namespace

StepControl::StepControl(double tolerance, double longest, double location)
    : tolerance_(tolerance), longest_(longest), location_(location), natural_(longest) {}

double StepControl::next(double s, double cap) {
  const double left = 1.0 - s;
  double h = std::min({natural_, cap, landing_});
  if (blocked_ != kNever) {
    const double free = blocked_ - s;
    // Right before the block: look whether it is still there.
    h = free <= location_ ? free + location_ : std::min(h, 0.5 * free);
  } else if (landing_ == kNever && left <= std::min(cap, longest_) &&
             h >= kNearlyAll * left) {
    h = left;
  }
  landing_ = kNever;
  return h >= left * (1.0 - 1e-12) ? left : h;
}

double StepControl::allowed(double h) const {
  return tolerance_ * std::max(h, kLeastShare);
}

bool StepControl::accepts(double h, double error, int order) {
  const double allowed = this->allowed(h);
  const bool accepted = error <= allowed || h <= location_;
  // Stages of a step that was too long may have met a block where there is none.
  if (!accepted) blocked_ = kNever;
  // A step that was cut for another reason says nothing about longer ones.
  if (!accepted || h >= 0.999 * natural_) {
    const double caution = accepted ? kCaution : kCautionAfterRefusal;
    const double factor =
        caution * std::pow(allowed / std::max(error, 1e-300), 1.0 / order);
    const double most = was_refused_ ? 1.0 : 3.0;
    natural_ = std::clamp(h * std::clamp(factor, 0.2, most), 0.5 * location_, longest_);
  }
  was_refused_ = !accepted;
  return accepted;
}

void StepControl::renew() {
  natural_ = longest_;
  was_refused_ = false;
}

bool StepControl::is_at_block(double s, double at) {
  if (at - s <= 2.0 * location_) return true;
  blocked_ = at;
  return false;
}

void StepControl::passed(double s) {
  if (s >= blocked_) blocked_ = kNever;
}

}  // namespace prehensile
