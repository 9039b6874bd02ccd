/// A chain of straight pushes through given way-points: which rotation each push should
/// do so that their sum is the wanted one and the path is shortest. Exact, no search.
///
/// With lengths l_k and feasible kappas I_k (steering), T = sum l_k sqrt(1 + kappa_k^2)
/// is least subject to sum l_k kappa_k = c dtheta where every kappa_k is one common value
/// clipped to I_k: the stationarity condition of the convex problem. The common value is
/// the root of a piecewise linear function, found from its sorted breakpoints.
#pragma once

#include <array>

#include "mechanics/pad_envelope.h"
#include "planner/steering/confines.h"
#include "planner/steering/steering.h"

namespace prehensile {

/// Where a leg starts or ends. Gravity is held there by the grasp alone: over the margin
/// box at a way-point, nominally at the start and the goal, which are not the planner's
/// choice.
struct Stop {
  Vec2 p_OF = Vec2::Zero();
  bool given = false;  ///< start or goal
};

/// How legs are proposed.
struct Steering {
  SearchModel search;      ///< contacts, and the margin that the proposals keep
  bool real_pads = false;  ///< rotations from the pads themselves, not the closed form
  const PadEnvelope* envelope = nullptr;  ///< of real pads on flat faces
};

/// One straight push of a chain.
struct Leg {
  int contact = -1;                             ///< index in SearchModel::contacts
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  ///< p_OF
  double length = 0.0;                          ///< [m] > 0
  KappaSet kappas;
};

struct Chain {
  static constexpr int kMaxLegs = 24;
  int count = 0;
  std::array<Leg, kMaxLegs> legs;
  std::array<double, kMaxLegs> kappa{};  ///< chosen by solve_chain
  double cost = kNan;                    ///< J of the chain
};

/// Shortest straight push that the search considers [m].
inline constexpr double kShortestLeg = 1e-5;

/// The leg from -> to by a contact; false if it is too short, leaves the object, loses
/// gravity at an end, or sticks for no kappa. No heap.
bool make_leg(const Steering& steering, int contact, const Stop& from, const Stop& to,
              Work& work, Leg& leg) noexcept;

/// By how much the grasp holds gravity at the stop while a contact pushes: 1 - load, of
/// the ellipsoid. 1 for cans, whose pads the exact check looks at. No heap.
double held_slack(const SearchModel& search, int contact, const Stop& stop) noexcept;

/// Whether the grasp holds gravity at the stop while a contact pushes.
bool is_held(const SearchModel& search, int contact, const Stop& stop) noexcept;

/// make_leg from a stop that is known to be held.
bool make_leg_from_held(const Steering& steering, int contact, const Stop& from,
                        const Stop& to, Work& work, Leg& leg) noexcept;

/// make_leg between stops that are known to be held.
bool make_held_leg(const Steering& steering, int contact, const Stop& from,
                   const Stop& to, Work& work, Leg& leg) noexcept;

/// Chooses kappas for a total rotation dtheta [rad] and the cost; false if the chain
/// cannot produce it, or not with the turn done so far within `window` after each leg.
/// Legs with several intervals are tried in all combinations up to 256. The shortest
/// choice, unless the window forbids it: then one near it. No heap.
bool solve_chain(const SearchModel& search, double dtheta, Chain& chain,
                 const TurnWindow& window = {}) noexcept;

/// Moves the kappas of a solved chain by this share towards those that lie equally deep
/// in their intervals and have the same sum: longer, but farther from slipping. No heap.
void centre_chain(const SearchModel& search, double dtheta, double share,
                  Chain& chain) noexcept;

/// Solves a chain, then looks for kappas with which it sticks with the real pad over the
/// margin of `search`: the shortest, half-way to the middle of the
/// intervals, the middle. False if none of them sticks. No heap.
bool make_chain_stick(const SearchModel& search, double theta_start, double dtheta,
                      Chain& chain, Work& work) noexcept;

/// Placements of the chain: runs of legs by one line, legs by points.
int placements(const SearchModel& search, const Chain& chain) noexcept;

/// One move of a solved chain, starting at this angle.
Move move_of(const SearchModel& search, const Chain& chain, int leg, double theta_from);

/// All of them.
std::vector<Move> moves_of(const SearchModel& search, const FlatState& start,
                           const Chain& chain);

/// Rotation of one leg of a solved chain [rad].
double turn_of(const SearchModel& search, const Chain& chain, int leg);

/// Least slack of a move with the real pad over the margin box, at as many points as its
/// pad asks for. No heap.
double exact_slack(const SearchModel& search, const Move& move, Work& work) noexcept;

/// Whether a move stays on the object, sticks with the real pad over the margin box, and
/// the pads alone hold gravity along it; the closed form is not asked, nor what confines
/// the move. No heap.
bool move_holds(const SearchModel& search, const Move& move, Work& work) noexcept;

/// The same, and the move is confined.
bool move_passes(const SearchModel& search, const Move& move, Work& work) noexcept;

/// Whether every move of a solved chain sticks with the real pad over the margin box, the
/// pads alone hold gravity along it, and it is confined; what costs most is asked last.
/// No heap.
bool chain_passes(const SearchModel& search, const Chain& chain, double theta_start,
                  Work& work) noexcept;

}  // namespace prehensile
