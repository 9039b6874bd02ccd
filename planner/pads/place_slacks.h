/// How nearly sticking pushes can carry the finger axis through a place in each
/// direction, over discs that the face clips in places: what the finder of barriers keeps
/// clear of. Internal to the planner.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "planner/geometry/free_directions.h"
#include "planner/geometry/level_set.h"
#include "planner/pads/clipped_law.h"

namespace prehensile {

class PlaceSlacks {
 public:
  /// By direction of the finger axis in O (FreeDirections::direction): the most that the
  /// inequalities of a sticking instant leave, over F, with some contact at some rate of
  /// turn, but no more than, and a little, what the friction has left over for the
  /// contact's gravity; -1 where the pads are lost or fall under all contacts.
  using Profile = std::array<double, FreeDirections::kLookedAt>;

  /// `model` has clipped discs (has_clipped_discs) and must outlive this.
  explicit PlaceSlacks(const Model& model);

  /// Linear between the nodes of a grid, each of which is looked at when first asked for.
  Profile at(const Vec2& p_OF);

 private:
  const Profile& at_node(int node);
  Profile looked_at(const Vec2& p_OF) const;
  /// At this angle of (1, kappa), for motions of the object along e: force and moment /
  /// c.
  Eigen::Vector3d friction_of_whole(double angle, const Vec2& e) const;

  struct Whole {
    double along, moment;  // friction over F and F c
  };
  const Model& model_;
  std::vector<Whole> whole_;  // by the angle of (1, kappa)
  PlaceGrid grid_;
  std::vector<std::optional<Profile>> profiles_;  // of nodes looked at
};

}  // namespace prehensile
