#include "planner/steering/steering.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/segment.h"
#include "planner/obstacles/placement.h"
#include "planner/pads/ring_kappas.h"
#include "planner/pads/spread_pads.h"
#include "planner/steering/clear_places.h"
#include "planner/steering/confines.h"

namespace prehensile {
namespace {

// Spacing of the points at which a pad that is not isotropic is checked along a move.
constexpr double kCheckTurn = 0.1;     // [rad]
constexpr double kCheckTravel = 2e-3;  // [m]
constexpr int kMostChecks = 24;

constexpr int kFewestPlaces = 3;  // of a line pusher shorter than its face
constexpr int kMostPlaces = 9;

constexpr int kPlacesAlong = 3;  // of one that covers its face, to either side

void add_line(const Model& model, int index, double place,
              std::vector<SearchContact>& contacts) {
  const StickContact stick = stick_contact(model, model.contacts[index], place);
  contacts.push_back({stick, index, place, place, place});
}

/// Places so close that the segments of neighbours overlap by half.
void add_short_line(const Model& model, int index, double room,
                    std::vector<SearchContact>& contacts) {
  const double steps = std::ceil(2.0 * room / model.contacts[index].half_length);
  const int count = std::clamp(1 + static_cast<int>(std::min(steps, 1.0 * kMostPlaces)),
                               kFewestPlaces, kMostPlaces);
  for (int i = 0; i < count; ++i) {
    add_line(model, index, room * (2.0 * i / (count - 1) - 1.0), contacts);
  }
}

/// A pusher pushes alike wherever it stands as long as it covers its face; but it matters
/// where that puts the hand and the object among what confines them.
void add_places_along(const Model& model, int index, double margin,
                      std::vector<SearchContact>& contacts) {
  const Scene& scene = model.scene;
  const bool limits_hand =
      scene.limits && (scene.limits->hand_low || scene.limits->hand_high);
  if (!scene.obstacles && !limits_hand) return;
  const double room = farthest_place(model.contacts[index]) - margin;
  if (!(room > 0.0)) return;
  for (int i = 1; i <= kPlacesAlong; ++i) {
    add_line(model, index, i * room / kPlacesAlong, contacts);
    add_line(model, index, -i * room / kPlacesAlong, contacts);
  }
}

/// How far a point may be from the middle of its face; negative if nowhere on it. Not to
/// the very end, where rounding may leave it beside the face.
double room_of_point(const Model& model, int index, const Margin& margin) {
  constexpr double kRounding = 1e-9;  // [m]
  const PushContact& contact = model.contacts[index];
  return 0.5 * (contact.b - contact.a).norm() - margin.place - kRounding;
}

SearchContact point(const Model& model, int index, double room) {
  SearchContact contact{stick_contact(model, model.contacts[index], 0.0), index, 0.0,
                        -room, room};
  contact.stick.a -= room * contact.stick.t;
  contact.stick.b += room * contact.stick.t;
  return contact;
}

void add_contacts(const Model& model, const Margin& margin, int left_out,
                  std::vector<SearchContact>& contacts) {
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const PushContact& contact = model.contacts[i];
    const int index = static_cast<int>(i);
    if (index == left_out) continue;
    const double half_face = 0.5 * (contact.b - contact.a).norm();
    if (contact.is_point) {
      const double room = room_of_point(model, index, margin);
      if (room > 0.0) contacts.push_back(point(model, index, room));
    } else if (contact.half_length >= half_face) {
      add_line(model, index, 0.0, contacts);
      add_places_along(model, index, margin.place, contacts);
    } else {
      add_short_line(model, index, half_face - contact.half_length, contacts);
    }
  }
}

bool held(const SearchModel& search, const PushContact& contact, const Vec2& p_OF) {
  return holding_slack(*search.model, p_OF, contact.g_O, search.margin) > 0.0;
}

/// A move as the mechanics sees it: twist of the object relative to the hand over the
/// whole move, in O.
struct Motion {
  Vec2 velocity;  ///< [m]
  double omega;   ///< [rad]

  Motion(const FlatState& from, const FlatState& to)
      : velocity(from.p_OF - to.p_OF), omega(to.theta - from.theta) {}
  double travel() const { return velocity.norm(); }
  Vec2 direction(const Vec2& if_none) const {
    const double v = travel();
    return v > 0.0 ? Vec2(velocity / v) : if_none;
  }
};

/// A point is looked at where it would have to stand at this instant of the move: the
/// points of a pad pull aside as they turn, so that no one place does for all of it, and
/// a push that ends where the move does is found later (meet_end.h).
StickTest pad_test(const SearchModel& search, const Move& move, double place,
                   double share, const Margin& margin, double least = -kInfinity) {
  const SearchContact& pushing = search.contacts[move.contact];
  const PushContact& contact = search.model->contacts[pushing.contact];
  const Motion motion(move.from, move.to);
  const auto test_at = [&](double there, const Margin& over) {
    return exact_stick_test(*search.model, contact, there,
                            pose_along(move.from, move.to, share),
                            motion.direction(contact.n), motion.travel(), motion.omega,
                            over, share * motion.travel(), least);
  };
  if (contact.is_point) {
    const double wanted = test_at(place, Margin::none()).centre_of_pressure;
    if (std::isfinite(wanted)) {
      place = std::clamp(wanted, pushing.place_low, pushing.place_high);
    }
  }
  return test_at(place, margin);
}

double place_of(const SearchModel& search, const Move& move) {
  const SearchContact& contact = search.contacts[move.contact];
  if (contact.place_low == contact.place_high) return contact.place;
  const double wanted =
      pad_test(search, move, contact.place, 0.5, Margin::none()).centre_of_pressure;
  if (!std::isfinite(wanted)) return contact.place;
  return std::clamp(wanted, contact.place_low, contact.place_high);
}

/// The closed form over the ellipsoid, and gravity.
bool passes_closed_form(const SearchModel& search, int index, const FlatState& from,
                        const FlatState& to, Work& work) {
  ++work.stick_tests;
  const SearchContact& contact = search.contacts[index];
  const Motion motion(from, to);
  const double slack =
      robust_slack(contact.stick, from.p_OF, motion.velocity, motion.omega,
                   search.margin_from(from.p_OF), -kStickTolerance);
  if (!(slack >= -kStickTolerance)) return false;  // NaN: goes nowhere
  const PushContact& pushed = search.model->contacts[contact.contact];
  return held(search, pushed, from.p_OF) && held(search, pushed, to.p_OF);
}

/// Whole discs on the face all along the move: the closed form needs no further check.
bool is_isotropic_along(const SearchModel& search, const FlatState& from,
                        const FlatState& to) {
  if (search.exact_everywhere) return true;
  const Model& model = *search.model;
  const auto* disc = std::get_if<DiscPad>(&model.scene.gripper.pad);
  if (!model.region.is_isotropic() || !disc) return false;
  return distance_to_border(model.pad_face, from.p_OF, to.p_OF) >= disc->radius;
}

/// How many points of a move are looked at.
int check_points(const FlatState& from, const FlatState& to) {
  const Motion motion(from, to);
  const double steps =
      std::max(std::abs(motion.omega) / kCheckTurn, motion.travel() / kCheckTravel);
  return static_cast<int>(std::clamp(std::ceil(steps) + 1.0, 2.0, 1.0 * kMostChecks));
}

/// The real pad at points along the move.
bool passes_pad_check(const SearchModel& search, int contact, const FlatState& from,
                      const FlatState& to, Work& work) {
  if (is_isotropic_along(search, from, to)) return true;
  const Move move{contact, from, to};
  const double place = place_of(search, move);
  const int points = check_points(from, to);
  const Margin margin = search.margin_from(from.p_OF);
  for (int i = 0; i < points; ++i) {
    ++work.stick_tests;
    const double share = static_cast<double>(i) / (points - 1);
    const StickTest test = pad_test(search, move, place, share, margin);
    if (!(test.slack >= -kStickTolerance)) return false;
  }
  return true;
}

/// A move that begins anywhere but at the start begins at a place of the planner's
/// choice; whether it ends at a goal is not known here and left to the exact check of the
/// plan.
bool stays_on_object(const SearchModel& search, const FlatState& from,
                     const FlatState& to) {
  return path_on_object(*search.model, {from.p_OF, from.p_OF == search.p_OF_start},
                        {to.p_OF, true}, search.margin_from(from.p_OF));
}

}  // namespace

SearchModel prepare_search(const Model& model, const Margin& margin, int left_out) {
  SearchModel search;
  search.model = &model;
  search.margin = margin;
  search.may_end_beside = !margin.has_box();
  search.p_OF_start = finger_in_object(model.scene.start.X_HO);
  search.exact_everywhere =
      model.region.is_isotropic() && model.region.is_fixed_in_hand();
  if (!(model.F > 0.0 && model.c > 0.0)) return search;
  if (has_ring_pads(model)) {
    search.rings = std::make_shared<const RingTable>(model);
  }
  add_contacts(model, margin, left_out, search.contacts);
  search.confines = Confines::of(search);
  add_clear_places(model, search);
  return search;
}

bool has_points(const SearchModel& search) noexcept {
  return std::ranges::any_of(search.contacts, [](const SearchContact& contact) {
    return contact.stick.is_point;
  });
}

std::optional<SearchModel> over_ellipsoid(const SearchModel& search) {
  if (!search.rings || search.margin.is_none()) return std::nullopt;
  SearchModel ellipsoid = search;
  ellipsoid.rings.reset();
  return ellipsoid;
}

SearchModel with_margin(const SearchModel& search, const Margin& margin) {
  SearchModel other = search;
  other.margin = margin;
  for (SearchContact& contact : other.contacts) {
    const int index = contact.contact;
    if (!search.model->contacts[index].is_point) continue;
    const double room = room_of_point(*search.model, index, margin);
    contact = point(*search.model, index, std::max(0.0, room));
  }
  return other;
}

PlanarPose pose_along(const FlatState& from, const FlatState& to, double s) noexcept {
  const Vec2 p_OF(std::lerp(from.p_OF.x(), to.p_OF.x(), s),
                  std::lerp(from.p_OF.y(), to.p_OF.y(), s));
  return pose_from_finger(p_OF, std::lerp(from.theta, to.theta, s));
}

LinearPush push_of(const SearchModel& search, const Move& move) noexcept {
  const SearchContact& contact = search.contacts[move.contact];
  const Motion motion(move.from, move.to);
  LinearPush push;
  push.contact = contact.contact;
  push.place = place_of(search, move);
  push.e = motion.direction(contact.stick.n);
  push.travel = motion.travel();
  push.turn = motion.omega;
  return push;
}

bool move_sticks(const SearchModel& search, int contact, const FlatState& from,
                 const FlatState& to, Work& work) noexcept {
  return passes_closed_form(search, contact, from, to, work) &&
         stays_on_object(search, from, to) &&
         passes_pad_check(search, contact, from, to, work);
}

PushConstraint constraint_of(const SearchContact& contact, const Vec2& from,
                             const Vec2& to) noexcept {
  const Vec2 e = from - to;  // of the object in the hand
  const double e_n = e.dot(contact.stick.n);
  if (e_n < 0.0) return PushConstraint::kBackwards;
  const bool flat = std::abs(e.dot(contact.stick.t)) > contact.stick.mu * e_n;
  return flat ? PushConstraint::kFrictionCone : PushConstraint::kFaceEnds;
}

std::optional<Move> direct_move(const SearchModel& search, const FlatState& from,
                                const FlatState& to, Work& work, int preferred) noexcept {
  const int count = static_cast<int>(search.contacts.size());
  bool on_object = false;
  for (int i = -1; i < count; ++i) {
    const int contact = i < 0 ? preferred : i;
    if (contact < 0 || (i >= 0 && contact == preferred)) continue;
    if (!passes_closed_form(search, contact, from, to, work)) continue;
    on_object = on_object || stays_on_object(search, from, to);
    if (!on_object) return std::nullopt;
    if (passes_pad_check(search, contact, from, to, work)) return Move{contact, from, to};
  }
  return std::nullopt;
}

double slack_of_spread_pads(const SearchModel& search, const Move& move, int parts,
                            Work& work) noexcept {
  constexpr int kTestsForPlace = 10;
  const Model& model = *search.model;
  const Motion motion(move.from, move.to);
  const PushContact& contact = model.contacts[search.contacts[move.contact].contact];
  const Vec2 e = motion.direction(contact.n);
  if (has_ring_pads(model)) {
    return ring_slack(model, contact, move.from.p_OF, e, motion.travel(), motion.omega);
  }
  if (!has_clipped_discs(model)) return std::numeric_limits<double>::infinity();
  int clipped = 0;
  const double slack = spread_slack_along(model, contact, move.from.p_OF, e,
                                          motion.travel(), motion.omega, parts, &clipped);
  work.other += kTestsForPlace * clipped;
  return slack;
}

double move_slack(const SearchModel& search, const Move& move, int points,
                  Work& work) noexcept {
  constexpr int kSpreadParts = 3;
  const double place = place_of(search, move);
  const Margin margin = search.margin_from(move.from.p_OF);
  double least = std::numeric_limits<double>::infinity();
  work.stick_tests += points;
  for (int i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / (points - 1);
    least = std::min(
        least, pad_test(search, move, place, share, margin, -kStickTolerance).slack);
    if (!(least >= -kStickTolerance)) return least;
  }
  return std::min(least, slack_of_spread_pads(search, move, kSpreadParts, work));
}

namespace {

/// By how much the part of a path that begins at the share `from_s` and ends at `to_s` is
/// farther from the border than it has to be [m].
double room_of_part(const Model& model, const PathEnd& from, const PathEnd& to,
                    const Margin& margin, double from_s, double to_s, double most) {
  const Vec2 d = to.p_OF - from.p_OF;
  const double needed = std::min(most, carried(margin, to_s * d.norm()).grasp);
  return distance_to_border(model.pad_face, from.p_OF + from_s * d,
                            from.p_OF + to_s * d) -
         needed;
}

}  // namespace

double path_room(const Model& model, const PathEnd& from, const PathEnd& to,
                 const Margin& margin) noexcept {
  constexpr int kParts = 8;
  constexpr double kRounding = 1e-9;  // [m]
  const double whole = room_of_part(model, from, to, margin, 0.0, 1.0, kInfinity);
  const bool is_alike = margin.tilt == 0.0 && !from.given && !to.given;
  if (whole >= -kRounding || is_alike) return whole + kRounding;
  const auto given_room = [&](const PathEnd& end) {
    return end.given ? distance_to_border(model.pad_face, end.p_OF, end.p_OF) : kInfinity;
  };
  const double of_from = given_room(from);
  const double of_to = given_room(to);
  const double length = (to.p_OF - from.p_OF).norm();
  double least = kInfinity;
  for (int i = 0; i < kParts; ++i) {
    const double begin = static_cast<double>(i) / kParts;
    const double end = static_cast<double>(i + 1) / kParts;
    const double most = std::min(of_from + begin * length, of_to + (1.0 - end) * length);
    least = std::min(least, room_of_part(model, from, to, margin, begin, end, most));
  }
  return least + kRounding;
}

bool path_on_object(const Model& model, const PathEnd& from, const PathEnd& to,
                    const Margin& margin) noexcept {
  if (!segment_inside(model.pad_face, from.p_OF, to.p_OF)) return false;
  if (margin.grasp + margin.tilt == 0.0) return true;
  return path_room(model, from, to, margin) >= 0.0;
}

bool segment_on_object(const Model& model, const Vec2& from_p_OF,
                       const Vec2& to_p_OF) noexcept {
  return segment_inside(model.pad_face, from_p_OF, to_p_OF);
}

}  // namespace prehensile
