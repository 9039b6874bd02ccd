/// Where a margin goes through zero, for the borders of what sticks. Internal to the
/// primitives layer.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace prehensile {

struct MarginAt {
  double at = 0.0;
  double margin = -1.0;
};

/// A place with `margin` >= 0, no farther than `precision` from one where it is negative,
/// between such an `inside` and such an `outside`. The margin may have a kink at zero, so
/// a line is laid through the last two places of one side, as in root.h; it may as well
/// jump, so guesses are kept near enough to the middle for at most six looks more than
/// bisection takes.
template <class Margin>
double border(const Margin& margin, MarginAt inside, MarginAt outside, double precision) {
  constexpr double kMoreLooks = 64.0;  // two to the power of six
  struct Side {
    MarginAt now, before;
    double zero() const {
      return now.at - now.margin * (now.at - before.at) / (now.margin - before.margin);
    }
  };
  // No line through one place: its zero is none, and so outside of every bracket.
  Side in{inside, inside};
  Side out{outside, outside};
  bool in_moved = true;
  double allowed = precision;
  while (allowed < std::abs(outside.at - inside.at)) allowed *= 2.0;
  allowed *= kMoreLooks;
  while (std::abs(out.now.at - in.now.at) > precision) {
    const double low = std::min(in.now.at, out.now.at);
    const double high = std::max(in.now.at, out.now.at);
    const auto between = [&](double x) { return x >= low && x <= high; };
    double at = (in_moved ? in : out).zero();
    if (!between(at)) at = (in_moved ? out : in).zero();
    if (!between(at)) at = Side{in.now, out.now}.zero();
    const double middle = 0.5 * (low + high);
    if (!between(at)) at = middle;
    // A guess at an end is moved inward, so that the bracket closes around it.
    at = std::clamp(at, low + 0.5 * precision, high - 0.5 * precision);
    allowed *= 0.5;
    const double most = std::max(0.0, allowed - 0.5 * (high - low));
    at = std::clamp(at, middle - most, middle + most);
    const double here = margin(at);
    in_moved = here >= 0.0;
    Side& moved = in_moved ? in : out;
    moved = {{at, here}, moved.now};
  }
  return in.now.at;
}

}  // namespace prehensile
