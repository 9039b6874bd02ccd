/// Exact steering in the flat space (p_OF, c theta): which contact does a straight move,
/// and with which rotation. Shared by our search and by OMPL's planners.
///
/// Over an isotropic pad the closed form decides (sticking_kappas). Other pads are
/// steered by the same closed form with their torque radius, and every move is then
/// checked with the real pad at points along it, and dropped if it fails there.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "planner/plan.h"
#include "planner/progress.h"

namespace prehensile {

/// A point of the search: place of the finger axis in O [m] and angle of O in H [rad],
/// not wrapped. Roll is no part of it: turning a round object about its own axis changes
/// neither.
struct FlatState {
  Vec2 p_OF = Vec2::Zero();
  double theta = 0.0;
};

/// In the flat space (p_OF, c theta) [m].
inline double flat_distance(const Model& model, const FlatState& a, const FlatState& b) {
  return std::hypot((b.p_OF - a.p_OF).norm(), model.c * (b.theta - a.theta));
}

/// Counts stick tests against the budget, the only thing that ends a search besides a
/// stop, and what went wrong on the way.
struct Work {
  std::int64_t stick_tests = 0;
  std::int64_t propagations = 0;
  std::int64_t other = 0;  ///< of other kinds, in the time of a stick test
  std::int64_t budget = 0;
  int found_cheaper = 0;           ///< plans that took the place of the first one found
  ConstraintCounts stopped_by;     ///< what stopped the pushes tried
  ProgressMeter* meter = nullptr;  ///< told how far the search is, if there is one
  const std::atomic<bool>* stop = nullptr;  ///< as in PlanOptions
  bool interrupted() const { return stop && stop->load(std::memory_order_relaxed); }
  std::int64_t done() const { return stick_tests + propagations + other; }
  bool spent() const { return done() >= budget; }
};

/// A contact compiled for steering. A line pusher stands at `place`. A point pusher
/// stands wherever from place_low to place_high the push needs it (see push_of); its
/// `stick` spans that range, so it is steered like a line.
struct SearchContact {
  StickContact stick;
  int contact = 0;                           ///< index in Model::contacts
  double place = 0.0;                        ///< [m]
  double place_low = 0.0, place_high = 0.0;  ///< [m] equal to `place` for a line pusher
};

class Confines;
class RingTable;

/// The model as the search sees it.
struct SearchModel {
  const Model* model = nullptr;
  Margin margin;
  std::vector<SearchContact> contacts;
  bool exact_everywhere = false;  ///< isotropic pad: no move needs the pad check
  bool looks_for_cheaper = true;  ///< than the first plan found; see plane_search.h
  bool points_stay = false;       ///< pushes by one point cost one placement: not what
                                  ///< they do, but so plans of more of them are found
  bool may_end_beside = true;     ///< beside the goal, within its tolerances, where that
                                  ///< is cheaper
  Vec2 p_OF_start = Vec2::Zero();
  std::shared_ptr<const Confines> confines;  ///< null where the scene names none
  std::shared_ptr<const RingTable> rings;    ///< of round pads

  /// The margin of a push that begins here: tilted pushes have carried the finger axis
  /// off its place by a share of its way, of which the straight one is the least. The
  /// exact check of a plan counts the whole way.
  Margin margin_from(const Vec2& p_OF) const {
    if (margin.tilt == 0.0) return margin;
    return carried(margin, (p_OF - p_OF_start).norm());
  }
};

/// Whether the pusher has to be placed anew for a push by one contact after a push by
/// another (negative: none): a point stands where each push needs it.
inline bool is_placed_anew(const SearchModel& search, int contact, int before) noexcept {
  return contact != before ||
         (search.contacts[contact].stick.is_point && !search.points_stay);
}

/// Whether any pusher is a point.
bool has_points(const SearchModel& search) noexcept;

/// Compiles the contacts: a line pusher that covers its face stands at the face's centre,
/// a shorter one at places so close that they cover the face, a point pusher anywhere on
/// the face but `margin.place` from its ends. No contacts where the grasp has no friction
/// or no torque (point pads). `left_out`: a contact of the model that makes no push; -1:
/// none. With a margin plans end at the goal itself where a way leads there. `model` must
/// outlive the result.
SearchModel prepare_search(const Model& model, const Margin& margin, int left_out = -1);

/// Steered by the ellipsoid where a margin is kept over rings: its laws lead to some ways
/// that those of rings do not, and which stick with rings, too. None elsewhere.
std::optional<SearchModel> over_ellipsoid(const SearchModel& search);

/// The same contacts in the same order, at another margin: points that it would drive off
/// their face stay in its middle.
SearchModel with_margin(const SearchModel& search, const Margin& margin);

/// One straight move by one contact: kappa = c dtheta / |dp|.
struct Move {
  int contact = -1;  ///< index in SearchModel::contacts
  FlatState from, to;
};

/// Pose of O in H when the share s in [0, 1] of a move is done.
PlanarPose pose_along(const FlatState& from, const FlatState& to, double s) noexcept;

/// The push that a move stands for. For point pushers the place is put where the centre
/// of pressure of the real pad lies at the middle of the move.
LinearPush push_of(const SearchModel& search, const Move& move) noexcept;

/// Whether the straight move from -> to is a sticking push of this contact for the whole
/// box of uncertainty, stays on the object, and holds gravity at both ends. Directed: the
/// reverse move is another question. A move that goes nowhere is no push: false. No heap.
bool move_sticks(const SearchModel& search, int contact, const FlatState& from,
                 const FlatState& to, Work& work) noexcept;

/// What keeps a contact from a straight move that sticks for no rotation, by the nominal
/// direction alone. No heap.
PushConstraint constraint_of(const SearchContact& contact, const Vec2& from,
                             const Vec2& to) noexcept;

/// The contact that does the move (preferring `preferred`, else the first), if any. No
/// heap.
std::optional<Move> direct_move(const SearchModel& search, const FlatState& from,
                                const FlatState& to, Work& work,
                                int preferred = -1) noexcept;

/// Least robust slack of a move with the real pad, checked at `points` >= 2 places along
/// it, its ends included; of one that does not stick, any slack that says so. No heap.
double move_slack(const SearchModel& search, const Move& move, int points,
                  Work& work) noexcept;

/// Least slack of a move with discs spread over all angles, without a margin, looked at
/// at the ends of up to `parts` parts of it where the face clips them; infinity of other
/// pads. No heap.
double slack_of_spread_pads(const SearchModel& search, const Move& move, int parts,
                            Work& work) noexcept;

/// Whether an end of a path is the planner's choice.
struct PathEnd {
  Vec2 p_OF = Vec2::Zero();
  bool given = false;  ///< start or goal
};

/// The finger axis stays on the object along a straight path even where it is off its
/// place by what the margin says; but no farther from the border than a given end is,
/// and the way from there. `margin` is that of where the path begins. No heap.
bool path_on_object(const Model& model, const PathEnd& from, const PathEnd& to,
                    const Margin& margin) noexcept;

/// By how much a straight path inside the face keeps farther from its border than that
/// asks of it [m]; what tilted pushes carry the finger axis off, and the way from a given
/// end, count by eighths of the path. No heap.
double path_room(const Model& model, const PathEnd& from, const PathEnd& to,
                 const Margin& margin) noexcept;

/// The finger axis stays on the object along the straight segment (in O), border
/// included. Exact for any simple outline, up to rounding. No heap.
bool segment_on_object(const Model& model, const Vec2& from_p_OF,
                       const Vec2& to_p_OF) noexcept;

}  // namespace prehensile
