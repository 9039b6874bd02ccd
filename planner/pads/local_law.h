/// What the friction of the pads lets a contact do at an instant: whether a sticking push
/// can carry the finger axis through a place in a direction, whatever the object turns by
/// and at whatever angle. Internal to the planner.
///
/// The pads' friction is one of the boxes of their section (pad_section.h), of which each
/// inequality of a sticking instant takes the side that leaves most: what is denied here
/// no friction in the boxes allows.
#pragma once

#include <span>
#include <vector>

#include "mechanics/model.h"
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
  /// Known of pads that are whole wherever they are (pad_section.h), and of soft points.
  /// `model` must outlive the law. `weightless`: of pushes that stick without gravity as
  /// well (Margin::weightless).
  explicit LocalLaw(const Model& model, bool weightless = false);

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
  LocalLaw(const Model& model, bool weightless, const std::vector<FrictionBox>& boxes);

  /// Whether any friction of the pads is within the friction cone.
  bool is_in_cone(const PushContact& contact,
                  const DirectionSpan& directions) const noexcept;

  const Model& model_;
  bool weightless_;
  /// The boxes, by the sine of phi, are the leaves; node i is the union of 2 i and
  /// 2 i + 1, and node 1 that of all.
  std::vector<FrictionBox> tree_;
};

}  // namespace prehensile
