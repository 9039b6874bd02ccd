/// The friction of pads at one motion, which sections have to hold.
#pragma once

#include <algorithm>
#include <cmath>

#include "planner/pads/pad_section.h"

namespace prehensile::testing {

/// Sums the pads' friction for the motion (e, omega) at this angle of the object, over F.
struct Drag {
  double along, across, moment;
};
inline Drag drag_of(const Model& model, double theta, const Vec2& e, double omega) {
  const ContactPoints points = model.region.at(pose_from_finger({0.0, 0.0}, theta));
  const Vec2 e_H = rotated(theta, e);
  Vec2 force = Vec2::Zero();
  double moment = 0.0;
  for (int j = 0; j < points.count; ++j) {
    const Vec2 r(points.x[j], points.y[j]);
    const Vec2 slip = e_H + omega * perp(r);
    const Vec2 f = points.weight[j] * slip.normalized();
    force += f;
    moment += cross(r, f);
  }
  return {force.dot(e_H), std::abs(cross(e_H, force)), moment};
}

/// Whether a cell holds a drag. Cells of kappa and -kappa have the same sigma.
inline bool is_held(const PadSection& section, const Drag& drag, double kappa, double c) {
  const double sigma = std::hypot(1.0, kappa);
  const double turning = drag.moment / (c * drag.along) / sigma;
  return std::any_of(section.cells.begin(), section.cells.end(),
                     [&](const SectionCell& cell) {
                       return sigma >= cell.sigma_low && sigma <= cell.sigma_high &&
                              drag.along * sigma >= cell.drag_low &&
                              drag.along * sigma <= cell.drag_high &&
                              drag.across / drag.along <= cell.deviation + 1e-9 &&
                              turning >= cell.turning_low && turning <= cell.turning_high;
                     });
}

/// Whether a box holds a drag.
inline bool is_boxed(const PadSection& section, const Drag& drag, double kappa,
                     double c) {
  const double cosine = 1.0 / std::hypot(1.0, kappa);
  return std::ranges::any_of(section.boxes, [&](const FrictionBox& box) {
    return kappa * cosine >= box.sine_low && kappa * cosine <= box.sine_high &&
           drag.along >= box.along_low && drag.along <= box.along_high &&
           drag.across <= box.across + 1e-9 && drag.moment >= c * box.moment_low &&
           drag.moment <= c * box.moment_high;
  });
}

}  // namespace prehensile::testing
