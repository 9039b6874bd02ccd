/// What the friction of the pads lets a contact do at an instant: whether a sticking push
/// can carry the finger axis through a place in a direction, whatever the object turns by
/// and at whatever angle. Internal to the planner.
///
/// The pads' friction is one of the boxes of their section (pad_section.h), of which each
/// inequality of a sticking instant takes the side that leaves most: what is denied here
/// no friction in the boxes allows.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mechanics/model.h"
#include "mechanics/sticking.h"
#include "planner/pads/pad_section.h"

namespace prehensile {

/// Places p_OF from a to b, a straight line [m].
struct PlaceSpan {
  Vec2 a, b;
};

/// Directions in which the finger axis moves through the object that differ from `middle`
/// (unit, in O) by up to half_angle [rad].
struct DirectionSpan {
  Vec2 middle;
  double half_angle = 0.0;
};

/// The least (dT - share c dtheta) / |dp| of some motions, and the box of friction that
/// it takes.
struct LeastTravel {
  double cost = 0.0;    ///< infinity if there are none
  std::size_t box = 0;  ///< 0: none
};

class LocalLaw {
 public:
  /// What a contact asks of the friction of the pads, at the worst of a margin
  /// (weak_contact.h).
  struct Demand {
    Vec2 n;
    std::array<Vec2, 2> w;         ///< edges of the dual cone
    std::array<double, 2> asked;   ///< by gravity, of w.f over F
    std::array<Vec2, 2> end;       ///< of the face, b and a, moved inwards
    std::array<double, 2> help;    ///< [m] moment of gravity about it over F
    std::array<Vec2, 2> face_end;  ///< not moved
    double tilt = 0.0;             ///< [rad] of the motion in the cone
    double grasp = 0.0;            ///< [m] of the finger axis off its place
  };

  /// Known of pads that are whole wherever they are (pad_section.h), and of soft points.
  /// Of pushes that survive a margin, of which it knows what it makes of a contact: not
  /// the tilt about the ends of its face, nor other torque radii.
  explicit LocalLaw(const Model& model, const Margin& margin = Margin::none());

  /// Of discs that the face clips elsewhere (has_clipped_discs), at places where they are
  /// whole.
  static LocalLaw of_whole_discs(const Model& model);

  /// False: these pads have none, or pushes need the mechanics in space.
  bool is_known() const { return !tree_.empty(); }

  /// Whether the contact, wherever along its face its pusher stands, may stick and move
  /// the finger axis in one of these directions at one of these places. No heap.
  bool may_move(int contact, const PlaceSpan& places,
                const DirectionSpan& directions) const noexcept;

  /// Of such motions at places with these corners, a convex polygon. `share` in (-1, 1).
  /// `before`: of places and directions that these are some of; where its box still
  /// serves, nothing else is looked at. No heap.
  LeastTravel least_travel(int contact, std::span<const Vec2> corners,
                           const DirectionSpan& directions, double share,
                           const LeastTravel& before = {}) const noexcept;

  /// The greatest sense c dtheta / |dp| of such motions; -infinity if there are none,
  /// infinity if the object may turn about the finger axis. `sense` is 1 or -1. No heap.
  double most_turn(int contact, std::span<const Vec2> corners,
                   const DirectionSpan& directions, double sense) const noexcept;

 private:
  LocalLaw(const Model& model, const Margin& margin,
           const std::vector<FrictionBox>& boxes);

  /// Whether any friction of the pads is within the friction cone.
  bool is_in_cone(int contact, const DirectionSpan& directions) const noexcept;

  double c_;
  std::vector<Demand> demands_;  // as in Model::contacts
  /// The boxes, by the sine of phi, are the leaves; node i is the union of 2 i and
  /// 2 i + 1, and node 1 that of all.
  std::vector<FrictionBox> tree_;
};

}  // namespace prehensile
