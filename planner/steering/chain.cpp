#include "planner/steering/chain.h"

#include <algorithm>
#include <cmath>

#include "planner/costs.h"
#include "planner/pads/ring_kappas.h"
#include "planner/steering/holding.h"
#include "planner/steering/pad_kappas.h"

namespace prehensile {
namespace {

constexpr int kMaxCombinations = 256;
constexpr double kMostKappa = 1e4;   // beyond it a leg is a rotation on the spot
constexpr double kMostTurn = 100.0;  // [rad] of a leg: as far as angles of a scene go

using Intervals = std::array<KappaSet::Interval, Chain::kMaxLegs>;
using Kappas = std::array<double, Chain::kMaxLegs>;

/// The common value whose clipped copies sum up to `wanted` = c dtheta; NaN if out of
/// reach. sum_k l_k clip(x, I_k) rises with x and is linear between the ends of the I_k.
double common_kappa(const Chain& chain, const Intervals& intervals, double wanted) {
  const auto sum_at = [&](double x) {
    double sum = 0.0;
    for (int k = 0; k < chain.count; ++k) {
      sum += chain.legs[k].length * std::clamp(x, intervals[k].lo, intervals[k].hi);
    }
    return sum;
  };
  std::array<double, 2 * Chain::kMaxLegs> ends;
  double least = 0.0;
  double greatest = 0.0;
  for (int k = 0; k < chain.count; ++k) {
    ends[2 * k] = intervals[k].lo;
    ends[2 * k + 1] = intervals[k].hi;
    least += chain.legs[k].length * intervals[k].lo;
    greatest += chain.legs[k].length * intervals[k].hi;
  }
  if (!(wanted >= least && wanted <= greatest)) return kNan;
  const auto last = ends.begin() + 2 * chain.count;
  std::sort(ends.begin(), last);
  const auto end = std::partition_point(ends.begin() + 1, last - 1,
                                        [&](double x) { return sum_at(x) < wanted; });
  const double low = *(end - 1);
  const double sum_low = sum_at(low);
  const double sum = sum_at(*end);
  return sum > sum_low ? low + (*end - low) * (wanted - sum_low) / (sum - sum_low) : low;
}

/// Leaves of each interval what is not steeper than this.
void leave_out_steep(double most, KappaSet& set) {
  int count = 0;
  for (int i = 0; i < set.count; ++i) {
    const KappaSet::Interval& whole = set.intervals[i];
    const KappaSet::Interval part{std::max(whole.lo, -most), std::min(whole.hi, most)};
    if (part.lo <= part.hi) set.intervals[count++] = part;
  }
  set.count = count;
}

/// The interval of the set that contains a value chosen from it.
KappaSet::Interval interval_around(const KappaSet& set, double kappa) {
  for (int i = 0; i < set.count; ++i) {
    if (kappa <= set.intervals[i].hi) return set.intervals[i];
  }
  return set.intervals[set.count - 1];
}

double travel_of(const Chain& chain, const Kappas& kappas) {
  double travel = 0.0;
  for (int k = 0; k < chain.count; ++k) {
    travel += chain.legs[k].length * std::sqrt(1.0 + kappas[k] * kappas[k]);
  }
  return travel;
}

/// Whether the sums of l_k kappa_k after each leg stay within the window.
bool stays_within(const Chain& chain, const Kappas& kappas, const TurnWindow& ways) {
  double way = 0.0;
  for (int k = 0; k < chain.count; ++k) {
    way += chain.legs[k].length * kappas[k];
    if (!ways.contains(way)) return false;
  }
  return true;
}

/// Changes the kappas as little as it takes, leg by leg, for their sums to stay within
/// the window and to end at `wanted`; false if no kappas of these intervals do that.
///
/// Backwards, `rest[k]` is where the sum after k legs may be; forwards, the sum goes as
/// the kappas say, clipped to it.
bool bring_within(const Chain& chain, const Intervals& intervals, double wanted,
                  const TurnWindow& ways, Kappas& kappas) {
  std::array<TurnWindow, Chain::kMaxLegs + 1> rest;
  rest[chain.count] = {wanted, wanted};
  for (int k = chain.count - 1; k >= 0; --k) {
    const double length = chain.legs[k].length;
    rest[k] = {std::max(ways.low, rest[k + 1].low - length * intervals[k].hi),
               std::min(ways.high, rest[k + 1].high - length * intervals[k].lo)};
    if (rest[k].low > rest[k].high) return false;
  }
  if (!rest[0].contains(0.0)) return false;
  double way = 0.0;
  for (int k = 0; k < chain.count; ++k) {
    const double length = chain.legs[k].length;
    const double next =
        std::clamp(way + length * kappas[k], rest[k + 1].low, rest[k + 1].high);
    kappas[k] = std::clamp((next - way) / length, intervals[k].lo, intervals[k].hi);
    way = next;
  }
  return true;
}

/// The kappas of least travel, or where these leave the window, some near them that do
/// not.
bool choose_kappas(const Chain& chain, const Intervals& intervals, double wanted,
                   const TurnWindow& ways, Kappas& kappas) {
  const double kappa = common_kappa(chain, intervals, wanted);
  if (std::isnan(kappa)) return false;
  for (int k = 0; k < chain.count; ++k) {
    kappas[k] = std::clamp(kappa, intervals[k].lo, intervals[k].hi);
  }
  return stays_within(chain, kappas, ways) ||
         bring_within(chain, intervals, wanted, ways, kappas);
}

/// Steps to the next choice of one interval per leg, like an odometer.
bool next_choice(const Chain& chain, std::array<int, Chain::kMaxLegs>& choice) {
  for (int k = 0; k < chain.count; ++k) {
    if (++choice[k] < chain.legs[k].kappas.count) return true;
    choice[k] = 0;
  }
  return false;
}

/// A whole disc feels the same along a straight move up to its quadrature: with this much
/// slack its ends decide, unless the centre of rotation passes between its points.
constexpr double kDiscReserve = 5e-3;
constexpr double kTurnsOutsideDisc = 0.5;  // kappa; the disc reaches to c / kappa = 3/2 c

bool ends_decide(const SearchModel& search, const Move& move, double slack) {
  const double turn = search.model->c * std::abs(move.to.theta - move.from.theta);
  const double travel = (move.to.p_OF - move.from.p_OF).norm();
  return search.exact_everywhere && slack >= kDiscReserve &&
         turn <= kTurnsOutsideDisc * travel;
}

/// Every 2 mm and 0.1 rad, as the exact check of a plan does.
int points_along(const Move& move) {
  const double steps = std::max((move.to.p_OF - move.from.p_OF).norm() / 2e-3,
                                std::abs(move.to.theta - move.from.theta) / 0.1);
  return static_cast<int>(std::clamp(std::ceil(steps) + 1.0, 3.0, 50.0));
}

}  // namespace

// By the ellipsoid; a can's line of contact need not pass under the finger axis, so it is
// judged with the real pads only.
double held_slack(const SearchModel& search, int contact, const Stop& stop) noexcept {
  if (can_roll(search.model->scene.object)) return 1.0;
  const Vec2& g_O = search.model->contacts[search.contacts[contact].contact].g_O;
  const Margin margin = stop.given ? Margin::none() : search.margin_from(stop.p_OF);
  return holding_slack(*search.model, stop.p_OF, g_O, margin);
}

bool is_held(const SearchModel& search, int contact, const Stop& stop) noexcept {
  if (!(held_slack(search, contact, stop) > 0.0)) return false;
  if (stop.given || !search.exact_everywhere) return true;
  // What a disc holds is a little less than the ellipsoid, and the same at every angle.
  const Model& model = *search.model;
  const Vec2& g_O = model.contacts[search.contacts[contact].contact].g_O;
  Work aside;
  return pads_hold_gravity(model, pose_from_finger(stop.p_OF, 0.0), g_O,
                           search.margin_from(stop.p_OF), aside);
}

bool make_leg(const Steering& steering, int contact, const Stop& from, const Stop& to,
              Work& work, Leg& leg) noexcept {
  if ((to.p_OF - from.p_OF).norm() < kShortestLeg) return false;
  if (!is_held(steering.search, contact, from)) {
    work.stopped_by.add(PushConstraint::kGravity);
    return false;
  }
  return make_leg_from_held(steering, contact, from, to, work, leg);
}

bool make_leg_from_held(const Steering& steering, int contact, const Stop& from,
                        const Stop& to, Work& work, Leg& leg) noexcept {
  if ((to.p_OF - from.p_OF).norm() < kShortestLeg) return false;
  if (!is_held(steering.search, contact, to)) {
    work.stopped_by.add(PushConstraint::kGravity);
    return false;
  }
  return make_held_leg(steering, contact, from, to, work, leg);
}

bool make_held_leg(const Steering& steering, int contact, const Stop& from,
                   const Stop& to, Work& work, Leg& leg) noexcept {
  const SearchModel& search = steering.search;
  const Vec2 d = to.p_OF - from.p_OF;
  const double length = d.norm();
  if (length < kShortestLeg) return false;
  if (search.confines) {
    const auto broken = search.confines->broken_between(contact, from.p_OF, to.p_OF);
    if (broken) {
      work.stopped_by.add(*broken);
      return false;
    }
  }
  if (steering.envelope) {
    ++work.stick_tests;
    leg.kappas =
        steering.envelope->kappas(search.contacts[contact].stick, from.p_OF, to.p_OF);
  } else if (steering.real_pads) {  // slow: loops look at their limits too rarely
    if (work.interrupted()) return false;
    if (work.meter) work.meter->tick(work.done());
    leg.kappas = measured_kappas(search, contact, from.p_OF, to.p_OF, work);
  } else {
    ++work.stick_tests;
    const StickContact& stick = search.contacts[contact].stick;
    const bool ring = search.rings && !stick.is_point;
    const Margin margin = search.margin_from(from.p_OF);
    const Vec2 e = -d / length;
    leg.kappas = ring ? search.rings->kappas(stick, from.p_OF, e, margin)
                      : robust_kappas(stick, from.p_OF, e, margin);
  }
  if (leg.kappas.empty()) {
    work.stopped_by.add(constraint_of(search.contacts[contact], from.p_OF, to.p_OF));
    return false;
  }
  if (!path_on_object(*search.model, {from.p_OF, from.given}, {to.p_OF, to.given},
                      search.margin_from(from.p_OF))) {
    work.stopped_by.add(PushConstraint::kOffObject);
    return false;
  }
  leave_out_steep(std::min(kMostKappa, kMostTurn * search.model->c / length), leg.kappas);
  if (leg.kappas.empty()) {
    work.stopped_by.add(PushConstraint::kRotation);
    return false;
  }
  leg.contact = contact;
  leg.from = from.p_OF;
  leg.to = to.p_OF;
  leg.length = length;
  return true;
}

int placements(const SearchModel& search, const Chain& chain) noexcept {
  int placed = 0;
  int before = -1;
  for (int k = 0; k < chain.count; ++k) {
    const int contact = chain.legs[k].contact;
    if (is_placed_anew(search, contact, before)) ++placed;
    before = contact;
  }
  return placed;
}

bool solve_chain(const SearchModel& search, double dtheta, Chain& chain,
                 const TurnWindow& window) noexcept {
  const double c = search.model->c;
  const double wanted = c * dtheta;
  const TurnWindow ways{c * window.low, c * window.high};
  if (!ways.contains(wanted)) return false;
  double best_travel = std::numeric_limits<double>::infinity();
  std::array<int, Chain::kMaxLegs> choice{};
  for (int tried = 0; tried < kMaxCombinations; ++tried) {
    Intervals intervals;
    for (int k = 0; k < chain.count; ++k) {
      intervals[k] = chain.legs[k].kappas.intervals[choice[k]];
    }
    Kappas kappas;
    if (choose_kappas(chain, intervals, wanted, ways, kappas)) {
      const double travel = travel_of(chain, kappas);
      if (travel < best_travel) {
        best_travel = travel;
        chain.kappa = kappas;
      }
    }
    if (!next_choice(chain, choice)) break;
  }
  chain.cost = placements(search, chain) + best_travel / placement_length(*search.model);
  return std::isfinite(best_travel);
}

double turn_of(const SearchModel& search, const Chain& chain, int leg) {
  return chain.kappa[leg] * chain.legs[leg].length / search.model->c;
}

Move move_of(const SearchModel& search, const Chain& chain, int leg, double theta_from) {
  return {chain.legs[leg].contact,
          {chain.legs[leg].from, theta_from},
          {chain.legs[leg].to, theta_from + turn_of(search, chain, leg)}};
}

double exact_slack(const SearchModel& search, const Move& move, Work& work) noexcept {
  const double slack = move_slack(search, move, search.exact_everywhere ? 2 : 3, work);
  if (!(slack >= -kStickTolerance) || ends_decide(search, move, slack)) return slack;
  return move_slack(search, move, points_along(move), work);
}

std::vector<Move> moves_of(const SearchModel& search, const FlatState& start,
                           const Chain& chain) {
  std::vector<Move> moves;
  moves.reserve(static_cast<std::size_t>(chain.count));
  double theta = start.theta;
  for (int k = 0; k < chain.count; ++k) {
    moves.push_back(move_of(search, chain, k, theta));
    theta = moves.back().to.theta;
  }
  return moves;
}

void centre_chain(const SearchModel& search, double dtheta, double share,
                  Chain& chain) noexcept {
  double low = 0.0;
  double width = 0.0;
  std::array<KappaSet::Interval, Chain::kMaxLegs> intervals;
  for (int k = 0; k < chain.count; ++k) {
    intervals[k] = interval_around(chain.legs[k].kappas, chain.kappa[k]);
    low += chain.legs[k].length * intervals[k].lo;
    width += chain.legs[k].length * (intervals[k].hi - intervals[k].lo);
  }
  if (!(width > 0.0)) return;
  const double position = std::clamp((search.model->c * dtheta - low) / width, 0.0, 1.0);
  double travel = 0.0;
  for (int k = 0; k < chain.count; ++k) {
    const auto [lo, hi] = intervals[k];
    chain.kappa[k] += share * (lo + position * (hi - lo) - chain.kappa[k]);
    travel += chain.legs[k].length * std::hypot(1.0, chain.kappa[k]);
  }
  chain.cost = placements(search, chain) + travel / placement_length(*search.model);
}

bool make_chain_stick(const SearchModel& search, double theta_start, double dtheta,
                      Chain& chain, Work& work) noexcept {
  if (!solve_chain(search, dtheta, chain, turns_from(search, theta_start))) {
    work.stopped_by.add(PushConstraint::kRotation);
    return false;
  }
  const auto sticks = [&] { return chain_passes(search, chain, theta_start, work); };
  if (sticks()) return true;
  if (chain.count == 1) return false;
  centre_chain(search, dtheta, 0.5, chain);
  if (sticks()) return true;
  centre_chain(search, dtheta, 1.0, chain);
  return sticks();
}

bool move_passes(const SearchModel& search, const Move& move, Work& work) noexcept {
  return move_holds(search, move, work) && is_confined(search, move, work);
}

bool move_holds(const SearchModel& search, const Move& move, Work& work) noexcept {
  return segment_on_object(*search.model, move.from.p_OF, move.to.p_OF) &&
         exact_slack(search, move, work) >= -kStickTolerance &&
         pads_hold_gravity(search, move, work);
}

bool chain_passes(const SearchModel& search, const Chain& chain, double theta_start,
                  Work& work) noexcept {
  std::array<Move, Chain::kMaxLegs> moves;
  double theta = theta_start;
  for (int k = 0; k < chain.count; ++k) {
    moves[k] = move_of(search, chain, k, theta);
    if (!(exact_slack(search, moves[k], work) >= -kStickTolerance)) {
      work.stopped_by.add(PushConstraint::kRealPads);
      return false;
    }
    theta = moves[k].to.theta;
  }
  const bool held = std::all_of(
      moves.begin(), moves.begin() + chain.count,
      [&](const Move& move) { return pads_hold_gravity(search, move, work); });
  if (!held) work.stopped_by.add(PushConstraint::kGravity);
  return held &&
         std::all_of(moves.begin(), moves.begin() + chain.count,
                     [&](const Move& move) { return is_confined(search, move, work); });
}

}  // namespace prehensile
