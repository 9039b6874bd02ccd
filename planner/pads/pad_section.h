/// The friction of whole pads at every twist, as boxes over the direction of the motion
/// in the hand. Internal to the planner.
#pragma once

#include <vector>

#include "mechanics/model.h"

namespace prehensile {

/// Friction of the pads for all motions with a kappa = c omega / |v| of some interval, at
/// whatever angle: a box. sigma = sqrt(1 + kappa^2).
struct SectionCell {
  double sigma_low = 0.0, sigma_high = 0.0;
  double drag_low = 0.0, drag_high = 0.0;  ///< force along the motion / F x sigma
  double deviation = 0.0;  ///< greatest |force across the motion| / force along it
  double sine_low = 0.0, sine_high = 0.0;  ///< kappa / sigma
  /// moment / (c x force along the motion x sigma)
  double turning_low = 0.0, turning_high = 0.0;
};

/// Friction over F, and over F c, for some of these motions, kappa = tan(phi): those in
/// some directions in the hand.
struct FrictionBox {
  double along_low = 0.0, along_high = 0.0;    ///< against the motion
  double across = 0.0;                         ///< at most, of either sign
  double moment_low = 0.0, moment_high = 0.0;  ///< over F c
  double cosine_low = 0.0, cosine_high = 0.0;  ///< of phi
  double sine_low = 0.0, sine_high = 0.0;      ///< of phi
};

/// The least box that holds both.
FrictionBox joined(const FrictionBox& a, const FrictionBox& b);

struct PadSection {
  /// moment / (c x force along the motion x kappa) for slow and for fast turning, about.
  double slow_ratio = 0.0, fast_ratio = 0.0;
  std::vector<SectionCell> cells;
  std::vector<FrictionBox> boxes;  ///< of the same motions, closer
};

/// Cells of round pads for either sign of kappa, where no law needs them finer.
inline constexpr int kRingCells = 256;

/// Of round pads (ring_pads.h): cells over all motions. Force and moment are monotone in
/// kappa, so that the ends of a cell bound what lies between.
///
/// Of other pads: boxes that cover |kappa| <= 1e4 and every direction of motion in the
/// hand. Where the centre of rotation lies on a pad point, whose force then has any
/// direction, a box holds all of these. Sampled; widened by what may lie between the
/// samples. Cells of those only that are alike at every quarter turn: the ratios of
/// others say next to nothing.
///
/// Empty where the pads are not the same at each pose, or have no friction or torque.
PadSection pad_section(const Model& model, int ring_cells = kRingCells);

/// Of discs that the face clips elsewhere (has_clipped_discs), where they are whole.
PadSection section_of_whole_discs(const Model& model, int ring_cells = kRingCells);

}  // namespace prehensile
