/// The friction of whole pads at every twist, as boxes over the angle of the motion in
/// the hand. Internal to the planner.
#pragma once

#include <vector>

#include "mechanics/model.h"

namespace prehensile {

/// Moments are counted from this multiple of c times the force along the motion and
/// kappa. Any value would do; near the middle of what discs have (0.6 for small kappas,
/// 1.7 for large ones) the boxes are small.
inline constexpr double kSectionRatio = 1.3;

/// Friction of the pads for all motions with a kappa = c omega / |v| of some interval, at
/// whatever angle: a box. sigma = sqrt(1 + kappa^2).
struct SectionCell {
  double sigma_low = 0.0, sigma_high = 0.0;
  double drag_low = 0.0, drag_high = 0.0;  ///< force along the motion / F x sigma; > 0
  double deviation = 0.0;  ///< greatest |force across the motion| / force along it
  /// (moment / (c x force along the motion) - kSectionRatio kappa) / sigma
  double turning_low = 0.0, turning_high = 0.0;
};

/// Cells that cover |kappa| <= 1e4. Where the centre of rotation lies on a pad point,
/// whose force then has any direction, a cell holds all of these. Sampled; the boxes are
/// widened by what may lie between the samples. Empty where the pads are not the same at
/// each pose, are not alike at every quarter turn, or have no friction or torque.
std::vector<SectionCell> pad_section(const Model& model);

}  // namespace prehensile
