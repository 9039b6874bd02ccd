#include "scene/frames.h"

#include <numbers>

namespace prehensile {

double wrapped(double angle) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double r = std::remainder(angle, kTurn);
  return r <= -std::numbers::pi ? r + kTurn : r;
}

}  // namespace prehensile
