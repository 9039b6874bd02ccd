/// A plate that slides on a board under its own weight while one or two round tips push
/// its edge: the experiment of several public data sets, and the friction problem of a
/// pad under a known grip force. Seen from the board; the same instants as in the hand.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scene/frames.h"

namespace prehensile {

/// What touches the board, in O. Only ratios of friction count, so loads are shares.
struct Plate {
  std::vector<Vec2> outline;   ///< [m] counter-clockwise, simple
  std::vector<Vec2> support;   ///< [m] points that carry the plate
  std::vector<double> shares;  ///< of the load on each point, > 0, sum 1

  Vec2 centre() const;           ///< [m] of the pressure
  double torque_radius() const;  ///< [m] mean distance of the load from `centre`
};

/// The outline carries the plate with uniform pressure: about `points` points (at most
/// 90) at the centroids of equal cells of a grid, spread by the few parts in a thousand
/// that give them the torque radius of the outline.
Plate uniform_plate(const std::vector<Vec2>& outline, int points);

/// The same with pressure that grows towards the edge (edge_load > 0) or the middle: the
/// factor max(0.02, 1 + p (r^2 / mean r^2 - 1)) on each share, -1 <= p <= 3, tilted so
/// that the centre of pressure stays, as statics demands under a centre of mass.
Plate loaded_plate(const Plate& plate, double edge_load);

enum class SupportModel {
  kPoints,     ///< exact friction of the points (solve_planar)
  kEllipsoid,  ///< the ellipsoid of the same centre and torque radius
};

/// One tip, or two that move as one rigid body (a line pusher by its ends).
struct Tips {
  int count = 1;        ///< 1 or 2
  double radius = 0.0;  ///< [m], >= 0
  double mu = 0.0;      ///< friction of tips and edge, >= 0
};

/// Where the centres of the tips are [m]; the second counts only for two tips.
using TipPlaces = std::array<Vec2, 2>;

struct PushedPlate {
  PlanarPose X_WO;           ///< at the end
  bool touched = false;      ///< a tip pushed at some step
  bool kept_contact = true;  ///< from the first touch on, and to the end
  bool slipped = false;      ///< a tip slid along the edge at some step
  int failures = 0;          ///< steps without an answer; the plate then stands still
};

/// Moves the tips along a path (in W) and the plate as it is pushed, in steps of at most
/// `step` [m]. In every step each contact point moves out of its tip along the normal and
/// with the tip along the edge, or slips (paper section VI in the quasi-static limit).
/// Tips do not turn, so a contact rolls along the rim. Two tips on different edges: the
/// deeper one pushes.
PushedPlate push_plate(const Plate& plate, SupportModel model, const Tips& tips,
                       const PlanarPose& X_WO, std::span<const TipPlaces> path,
                       double step = 2.5e-4);

/// Distance from the rim of the tip to the outline [m], negative where they overlap, and
/// the normal of the contact that is nearest, into the plate.
struct TipGap {
  double gap = 0.0;
  Vec2 p_OC = Vec2::Zero();  ///< [m] nearest point of the outline
  Vec2 n_O = Vec2::Zero();
};
TipGap tip_gap(const Plate& plate, const Vec2& p_OTip, double radius);

}  // namespace prehensile
