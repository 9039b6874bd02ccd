#include "planner/steering/clear_places.h"

#include <algorithm>
#include <cmath>

#include "planner/obstacles/placement.h"
#include "planner/steering/confines.h"
#include "planner/steering/goal.h"

namespace prehensile {
namespace {

constexpr double kSpacing = 1e-3;      // [m] of places that are looked at
constexpr double kMostPlaces = 600.0;  // of one contact
constexpr int kMostStretches = 3;      // of clear ones, of one contact
constexpr std::size_t kMostGoals = 8;  // the nearest, of a goal that leaves some free

/// Whether the hand is clear at a state while the contact touches, and may come and go.
bool is_clear(const SearchModel& search, std::size_t contact, const FlatState& at) {
  Work work;
  const Move still{static_cast<int>(contact), at, at};
  return !search.confines->broken_by(search, still, work);
}

bool is_clear_at_any(const SearchModel& search, std::size_t contact,
                     const std::vector<FlatState>& states) {
  return std::ranges::any_of(
      states, [&](const FlatState& at) { return is_clear(search, contact, at); });
}

bool has_clear_contact(const SearchModel& search, const std::vector<FlatState>& states) {
  for (std::size_t i = 0; i < search.contacts.size(); ++i) {
    const SearchContact& contact = search.contacts[i];
    const bool stands_anywhere = contact.place_low != contact.place_high;
    if (stands_anywhere || is_clear_at_any(search, i, states)) return true;
  }
  return false;
}

/// The contact at places all along its face.
SearchModel along_face(const Model& model, const SearchContact& contact, double room) {
  SearchModel search;
  search.model = &model;
  const double steps = std::min(kMostPlaces, std::ceil(2.0 * room / kSpacing));
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    SearchContact there = contact;
    there.place = there.place_low = there.place_high = room * (2.0 * i / steps - 1.0);
    there.stick = stick_contact(model, model.contacts[contact.contact], there.place);
    search.contacts.push_back(there);
  }
  search.confines = Confines::of(search);
  return search;
}

/// The middles of the stretches of places that are clear at one of the states.
void add_places(const SearchModel& along, const std::vector<FlatState>& states,
                std::vector<SearchContact>& contacts) {
  const std::size_t count = along.contacts.size();
  int stretches = 0;
  for (std::size_t i = 0; i < count && stretches < kMostStretches; ++i) {
    std::size_t end = i;
    while (end < count && is_clear_at_any(along, end, states)) ++end;
    if (end == i) continue;
    contacts.push_back(along.contacts[(i + end - 1) / 2]);
    ++stretches;
    i = end;
  }
}

std::vector<FlatState> states_of(const GoalPlaces& goals) {
  std::vector<FlatState> states;
  for (int i = 0; i < goals.count && states.size() < kMostGoals; ++i) {
    const GoalPlace& place = goals.places[static_cast<std::size_t>(i)];
    if (place.count > 0) states.push_back({place.p_OF, place.theta[0]});
  }
  return states;
}

}  // namespace

void add_clear_places(const Model& model, SearchModel& search) {
  if (!model.scene.obstacles || !model.scene.goal || !collisions_are_built()) return;
  const FlatState start = flat_state(model.scene.start);
  const std::vector<SearchContact> contacts = search.contacts;
  const auto goals = goal_places(model, *model.scene.goal, start, search.margin);
  for (const auto& states : {std::vector{start}, states_of(goals)}) {
    if (has_clear_contact(search, states)) continue;
    int last = -1;
    for (const SearchContact& contact : contacts) {
      const double room =
          farthest_place(model.contacts[contact.contact]) - search.margin.place;
      if (contact.contact == last || !(room > 0.0)) continue;
      last = contact.contact;
      add_places(along_face(model, contact, room), states, search.contacts);
    }
  }
  if (search.contacts.size() > contacts.size()) search.confines = Confines::of(search);
}

}  // namespace prehensile
