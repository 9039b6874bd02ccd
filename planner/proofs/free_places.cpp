#include "planner/proofs/free_places.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "planner/pads/local_law.h"
#include "planner/pads/ring_kappas.h"
#include "planner/pads/ring_pads.h"
#include "planner/steering/steering.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

/// Over pads of other shapes a contact's pushes count as ended for lack of grip only
/// where more than this share of it is missing: the check wants to be sure.
constexpr double kNearlyHeld = 0.05;

/// Half of the directions that are looked at as one where the law says what sticks [rad].
constexpr double kHalfLooked = 1e-3;

/// Directions in which a contact that the grasp holds at a place may move the finger
/// axis; so much of the grip may be missing.
template <class MayMove>
FreeDirections free_where_held(const Model& model, const Vec2& place, double missing,
                               const MayMove& may_move) {
  if (depth_inside(model.pad_face, place) < 0.0) return {};
  std::vector<int> held;
  for (int k = 0; k < static_cast<int>(model.contacts.size()); ++k) {
    const Vec2& g_O = model.contacts[k].g_O;
    if (holding_slack(model, place, g_O, Margin::none()) >= -missing) held.push_back(k);
  }
  if (held.empty()) return {};
  return FreeDirections::where([&](double angle) {
    return std::ranges::any_of(held, [&](int k) { return may_move(k, angle); });
  });
}

/// What sticks at a place, over soft points and round pads that are whole everywhere.
class RoundPads {
 public:
  explicit RoundPads(const Model& model)
      : model_(model), search_(prepare_search(model, Margin::none())) {}

  FreeDirections operator()(const Vec2& place) const {
    return free_where_held(model_, place, 0.0, [&](int contact, double angle) {
      return std::ranges::any_of(search_.contacts, [&](const SearchContact& pushed) {
        return pushed.contact == contact && sticks(pushed.stick, place, -towards(angle));
      });
    });
  }

 private:
  bool sticks(const StickContact& contact, const Vec2& place, const Vec2& e) const {
    const bool ring = search_.rings && !contact.is_point;
    const KappaSet kappas = ring ? search_.rings->kappas(contact, place, e)
                                 : sticking_kappas(contact, place, e);
    return !kappas.empty();
  }

  const Model& model_;
  const SearchModel search_;
};

/// What the law lets stick at a place, over pads of other shapes, which deflect the
/// friction by more than what the field allows for.
class LawfulPads {
 public:
  explicit LawfulPads(const Model& model) : model_(model), law_(model) {}

  FreeDirections operator()(const Vec2& place) const {
    return free_where_held(model_, place, kNearlyHeld, [&](int contact, double angle) {
      return law_.may_move(contact, {place, place}, {towards(angle), kHalfLooked});
    });
  }

 private:
  const Model& model_;
  const LocalLaw law_;
};

FreeDirections free_where_clipped(const Model& model, PlaceSlacks& slacks, double allowed,
                                  const Vec2& place) {
  if (depth_inside(model.pad_face, place) < 0.0) return {};
  return FreeDirections::above(slacks.at(place), -allowed);
}

template <class Pads>
FreeAt free_over(const Model& model) {
  return [pads = std::make_shared<const Pads>(model)](const Vec2& place) {
    return (*pads)(place);
  };
}

}  // namespace

FreeAt free_over_whole_pads(const Model& model) {
  return has_round_pads(model) ? free_over<RoundPads>(model)
                               : free_over<LawfulPads>(model);
}

FreeAt free_over_clipped_discs(const Model& model, PlaceSlacks& slacks, double allowed) {
  return [&, allowed](const Vec2& place) {
    return free_where_clipped(model, slacks, allowed, place);
  };
}

FreeAt free_closely_over_clipped_discs(const Model& model, PlaceSlacks& slacks,
                                       double allowed) {
  return
      [&, allowed, pads = std::make_shared<const RoundPads>(model)](const Vec2& place) {
        const bool whole = model.region.is_whole(pose_from_finger(place, 0.0));
        return whole ? (*pads)(place) : free_where_clipped(model, slacks, allowed, place);
      };
}

}  // namespace prehensile
