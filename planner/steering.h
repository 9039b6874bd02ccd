/// Exact steering in the flat space (p_OF, c theta): which contact does a straight move,
/// and with which rotation. Shared by our search and by OMPL's planners.
///
/// Over an isotropic pad the closed form is exact (sticking_kappas). Other pads are
/// steered by the same closed form with their torque radius, and every move is then
/// checked with the real pad at points along it (`move_survives`), and cut or dropped if
/// it fails.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/plan.h"

namespace prehensile {

/// A point of the search: place of the finger axis in O [m] and angle of O in H [rad],
/// not wrapped. Roll is no part of it: it is additive (PLANNER 5).
struct FlatState {
  Vec2 p_OF = Vec2::Zero();
  double theta = 0.0;
};

/// Counts stick tests against the budget; the only thing that ends a search besides a
/// stop.
struct Work {
  std::int64_t stick_tests = 0;
  std::int64_t propagations = 0;
  std::int64_t budget = 0;
  bool spent() const { return stick_tests + propagations >= budget; }
};

/// A contact at one place, compiled for steering.
struct SearchContact {
  StickContact stick;
  int contact = 0;                           ///< index in Model::contacts
  double place = 0.0;                        ///< [m]
  double place_low = 0.0, place_high = 0.0;  ///< range the place may be moved in [m]
};

/// The model as the search sees it.
struct SearchModel {
  const Model* model = nullptr;
  Margin margin;
  std::vector<SearchContact> contacts;
  bool exact_everywhere = false;  ///< isotropic pad: no move needs the pad check
};

SearchModel prepare_search(const Model& model, const Margin& margin);

/// One straight move by one contact: kappa = c dtheta / |dp|.
struct Move {
  int contact = -1;  ///< index in SearchModel::contacts
  FlatState from, to;
};

/// The push that a move stands for. For point pushers and short lines the place is put
/// where the centre of pressure lies.
LinearPush push_of(const SearchModel& search, const Move& move);

/// Whether the straight move from -> to is a sticking push of this contact for the whole
/// box of uncertainty, stays on the object, and holds gravity at both ends. Directed: the
/// reverse move is another question.
bool move_sticks(const SearchModel& search, int contact, const FlatState& from,
                 const FlatState& to, Work& work) noexcept;

/// The contact that does the move (preferring `preferred`), if any.
std::optional<Move> direct_move(const SearchModel& search, const FlatState& from,
                                const FlatState& to, Work& work,
                                int preferred = -1) noexcept;

/// Least robust slack of a move with the real pad, checked at `points` places along it.
double move_slack(const SearchModel& search, const Move& move, int points,
                  Work& work) noexcept;

/// The finger axis stays on the object along the straight segment (in O).
bool segment_on_object(const Model& model, const Vec2& from_p_OF, const Vec2& to_p_OF);

}  // namespace prehensile
