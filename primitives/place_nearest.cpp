/// The nearest motion that is possible, where the wanted one is not.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "optimisation/nonlinear_program.h"
#include "primitives/place_wrench.h"

namespace prehensile {
namespace {

/// Directions of (v, c omega) that are looked at: about 2 degrees apart near the wanted
/// one, coarser farther away.
constexpr int kRings = 45;
constexpr int kAround = 32;

using Direction = Eigen::Vector3d;  // of (v_x, v_y, c omega) in O, unit

Direction direction_of(const WantedMotion& motion, double c) {
  return Direction(motion.velocity.x(), motion.velocity.y(), c * motion.turn)
      .normalized();
}

/// As fast as the motion that was wanted.
WantedMotion motion_along(const Direction& d, const WantedMotion& like, double c) {
  const double size = std::hypot(like.velocity.norm(), c * like.turn);
  return {.X_HO = like.X_HO, .velocity = size * d.head<2>(), .turn = size * d[2] / c};
}

/// Some contact can exert what the motion asks for, and advances.
bool is_possible(const GripEnds& ends, const WantedMotion& motion,
                 const PlaceOptions& options) {
  const std::vector<ContactVerdict> verdicts = verdicts_of(ends, motion, options);
  return std::any_of(verdicts.begin(), verdicts.end(),
                     [](const ContactVerdict& verdict) { return verdict.possible; });
}

/// On the arc from `from` (possible) towards `to` (not), the last possible direction.
Direction border(const GripEnds& ends, const WantedMotion& wanted,
                 const PlaceOptions& options, double c, Direction from,
                 const Direction& to) {
  Direction outside = to;
  for (int i = 0; i < 40; ++i) {
    const Direction middle = (from + outside).normalized();
    const bool inside = is_possible(ends, motion_along(middle, wanted, c), options);
    (inside ? from : outside) = middle;
  }
  return from;
}

}  // namespace

NearestMotion nearest_motion(const Model& model, const WantedMotion& wanted,
                             const PlaceOptions& options) {
  NearestMotion out;
  const GripEnds ends(model, options);
  const double c = std::max(model.c, 1e-6);
  const Direction goal = direction_of(wanted, c);
  const Direction side = goal.unitOrthogonal();
  const Direction other = goal.cross(side);
  const auto at = [&](double angle, double around) -> Direction {
    return std::cos(angle) * goal +
           std::sin(angle) * (std::cos(around) * side + std::sin(around) * other);
  };
  // Rings of growing angle: the first possible directions, and one ring more.
  std::vector<std::pair<double, double>> starts;
  int rings_left = kRings;
  for (int i = 1; i <= kRings && rings_left > 0; ++i) {
    const double share = static_cast<double>(i) / kRings;
    const double angle = std::numbers::pi * share * share;
    for (int k = 0; k < kAround; ++k) {
      const double around = 2.0 * std::numbers::pi * k / kAround;
      if (is_possible(ends, motion_along(at(angle, around), wanted, c), options)) {
        starts.emplace_back(angle, around);
      }
    }
    if (!starts.empty()) rings_left = std::min(rings_left, 3) - 1;
  }
  Direction best = -goal;
  const auto improve = [&](double angle, double around) {
    const Direction d = border(ends, wanted, options, c, at(angle, around), goal);
    if (d.dot(goal) > best.dot(goal)) best = d;
    return std::acos(std::clamp(d.dot(goal), -1.0, 1.0));
  };
  for (const auto& [angle, around] : starts) improve(angle, around);
  if (starts.empty()) return out;
  // The way around the goal is the only freedom left: each arc ends at the border.
  const double angle0 = std::acos(std::clamp(best.dot(goal), -1.0, 1.0));
  const double around0 = std::atan2(best.dot(other), best.dot(side));
  NonlinearProgram program;
  program.start = {0.0};
  program.lower = {-0.3};
  program.upper = {0.3};
  program.objective = [&](std::span<const double> x, std::span<double>) {
    const double reach = std::min(angle0 + 0.05, std::numbers::pi);
    if (!is_possible(ends, motion_along(at(reach, around0 + x[0]), wanted, c), options)) {
      return 10.0;
    }
    return improve(reach, around0 + x[0]);
  };
  minimise_nlopt(program, LocalMethod::kSubplex,
                 {.tolerance = 1e-6, .max_evaluations = 40}, 0.05);
  // A little inside, so that rounding does not decide; then the forward check decides.
  for (const double inward : {1e-7, 1e-5, 1e-3, 1e-2, 3e-2, 0.1}) {
    const double angle = std::acos(std::clamp(best.dot(goal), -1.0, 1.0)) + inward;
    const double around = std::atan2(best.dot(other), best.dot(side));
    out.motion = motion_along(at(angle, around), wanted, c);
    out.angle = angle;
    out.answer = find_place(model, out.motion, options);
    out.found = out.answer.status == PlaceAnswer::Status::kFound;
    if (out.found) break;
  }
  return out;
}

}  // namespace prehensile
