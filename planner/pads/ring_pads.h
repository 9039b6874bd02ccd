/// Round pads as friction that is the same in every direction: the points that stand for
/// a disc, each spread evenly over its circle about the finger axis. Internal to the
/// planner.
///
/// The points themselves pull aside by up to 8 degrees where the centre of rotation lies
/// on one of them; a disc does not. Pushes have to stick with both.
///
/// Source: the mean distance of a circle of radius r from a place at distance d of its
/// centre is 2 (r + d) E(k) / pi, k^2 = 4 r d / (r + d)^2, with E the complete elliptic
/// integral of the second kind; force and moment are its derivatives (maximal
/// dissipation: Goyal, Ruina and Papadopoulos, Wear 143, 1991).
#pragma once

#include "mechanics/model.h"
#include "mechanics/sticking.h"

namespace prehensile {

/// Whether the pads are whole discs wherever they are.
bool has_ring_pads(const Model& model);

/// Whether the pads are the same at every place and angle: those, or soft points.
bool has_round_pads(const Model& model);

/// Friction over F for a twist of the object with |v| = cos(a), c omega = sin(a), a in
/// [0, pi / 2].
struct RingFriction {
  double along = 0.0;   ///< force along v
  double moment = 0.0;  ///< [m] about the finger axis
  /// `along` / cos(a), also where both are 0.
  double drag = 0.0;
};
RingFriction ring_friction(const ContactPoints& points, double c, double angle);

/// Least slack of a sticking instant with the finger axis at p_OF, of friction over F
/// that the object overcomes (force in O, moment [m] about the finger axis): of the
/// friction cone over F, and of the moments about the ends of the face over F c. No heap.
double slack_of_friction(const Model& model, const PushContact& contact, const Vec2& p_OF,
                         const PadDrag& friction) noexcept;

/// Least slack of a sticking push with ring pads over a margin, all along it: of the
/// friction cone over F, and of the moments about the ends of the face over F c. The
/// finger axis begins at p_OF and moves by -travel * e in O while the object turns by
/// `turn` in the hand; NaN where nothing moves. No heap.
double ring_slack(const Model& model, const PushContact& contact, const Vec2& p_OF,
                  const Vec2& e, double travel, double turn,
                  const Margin& margin = Margin::none()) noexcept;

}  // namespace prehensile
