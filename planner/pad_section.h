/// The friction of whole pads at every twist, as boxes over the angle of the motion in
/// the hand. Internal to the planner.
#pragma once

#include <vector>

#include "mechanics/model.h"

namespace prehensile {

/// Friction of the pads for all motions with a kappa = c omega / |v| of some interval, at
/// whatever angle: a box. sigma = sqrt(1 + kappa^2).
struct SectionCell {
  double sigma_low = 0.0, sigma_high = 0.0;
  double drag_low = 0.0, drag_high = 0.0;  ///< force along the motion / F x sigma; > 0
  double deviation = 0.0;  ///< greatest |force across the motion| / force along it
  double sine_low = 0.0, sine_high = 0.0;  ///< kappa / sigma
  /// moment / (c x force along the motion x sigma)
  double turning_low = 0.0, turning_high = 0.0;
};

struct PadSection {
  /// moment / (c x force along the motion x kappa) for slow and for fast turning, about.
  double slow_ratio = 0.0, fast_ratio = 0.0;
  std::vector<SectionCell> cells;
};

/// Of round pads (ring_pads.h): cells over all motions. Force and moment are monotone in
/// kappa, so that the ends of a cell bound what lies between.
///
/// Of other pads that are alike at every quarter turn: cells that cover |kappa| <= 1e4.
/// Where the centre of rotation lies on a pad point, whose force then has any direction,
/// a cell holds all of these. Sampled; the boxes are widened by what may lie between the
/// samples.
///
/// No cells where the pads are not the same at each pose, are not alike at every quarter
/// turn, or have no friction or torque.
PadSection pad_section(const Model& model);

/// Of discs that the face clips elsewhere (has_clipped_discs), where they are whole.
PadSection section_of_whole_discs(const Model& model);

}  // namespace prehensile
