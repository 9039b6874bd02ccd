#include "planner/walks/loop_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "planner/chains/shorten.h"
#include "planner/steering/chain.h"
#include "planner/steering/confines.h"
#include "planner/walks/turning_loop.h"
#include "planner/walks/walk_rest.h"
#include "planner/walks/walk_rows.h"
#include "planner/walks/walk_search.h"
#include "planner/walks/walk_turns.h"
#include "scene/constants.h"

namespace prehensile {
namespace {

/// Lattices that are tried: those of other walks, and then some that are not kept. These
/// take a second or so each.
constexpr std::array kFewWays = {24, 48};
constexpr Fineness kManyHeadings = {24, 12};
constexpr std::array<Fineness, 2> kManyWays = {{{64, 8}, {96, 5}}};

/// Lattices in rows along narrow ways: the finest that is small enough.
constexpr std::array<Fineness, 3> kInRows = {{{16, 5}, {12, 5}, {8, 5}}};
constexpr double kMostInRows = 3e4;  // nodes, about

/// What the last of the first leaves between start and goal is closed by many ways if it
/// is not more [spacings].
constexpr double kNear = 4.0;

/// Steps of their nodes by all contacts: what they allow is kept, 16 bytes each.
constexpr int kMostSlopes = 1'500'000;

/// Walks of which some push turns out not to stick; others are looked for.
constexpr int kMostRepairs = 300;

/// Turns of a push that are looked at where one does not stick.
constexpr int kLooks = 9;

/// Pushes of a walk before it is shortened, about.
constexpr std::size_t kMostPushes = 3000;

/// Equal pushes around a loop turn equally [m], but for rounding.
constexpr double kSameTurn = 1e-12;

/// Of what is left of the budget, for shortening what is found.
constexpr double kShareOfShortening = 0.3;

using Steps = std::vector<WalkStep>;

struct Walk {
  Steps steps;
  std::vector<Turned> turned;  ///< before each step, and at the end
  std::size_t around = 0;  ///< steps of the loop: after so many a push comes once more
  double theta = 0.0;      ///< of the goal
  double cost = kInfinity;
};

class LoopSearch {
 public:
  LoopSearch(const SearchModel& search, WalkLattice& lattice, const FlatState& start,
             const GoalPlaces& goals, const Limits& limits, Work& work)
      : search_(search),
        lattice_(lattice),
        start_(start),
        goals_(goals),
        limits_(limits),
        work_(work),
        c_(search.model->c),
        states_(lattice, static_cast<int>(search.contacts.size())),
        is_periodic_(search.model->region.is_isotropic()) {
    const TurnWindow window = turns_from(search, start.theta);
    window_ = {c_ * window.low, c_ * window.high};
  }

  std::optional<std::vector<Move>> run() {
    for (int i = 0; i < kMostRepairs && !limits_.reached(); ++i) {
      const LeastRest rest = rest_of_walks(lattice_, states_.contacts(), limits_, work_);
      if (rest.after(lattice_.start(), -1) == kInfinity) return std::nullopt;
      const Walk walk = cheapest_walk(rest);
      if (walk.steps.empty()) return std::nullopt;
      std::vector<Move> moves = moves_of(walk);
      if (narrow_those_that_slip(walk, moves)) return moves;
    }
    return std::nullopt;
  }

 private:
  const WalkEdge& edge(const WalkStep& step) {
    return lattice_.edges_from(step.node, work_)[step.edge];
  }

  /// Without a loop, or by the best one to either side.
  Walk cheapest_walk(const LeastRest& rest) {
    const WalkWays ways(lattice_, states_, rest, work_);
    Walk best = walk_around({}, {}, ways.way_on_from(-1));
    for (const int side : {1, -1}) {
      const auto loop = turning_loop(lattice_, states_, rest, side, limits_, work_);
      if (!loop) continue;
      const auto by_cost = [&](int state) { return ways.cost_over(state); };
      const auto joint = std::ranges::min_element(loop->states, {}, by_cost);
      if (ways.cost_over(*joint) == kInfinity) continue;
      Steps around = loop->steps;
      std::rotate(around.begin(), around.begin() + (joint - loop->states.begin()),
                  around.end());
      Walk walk = walk_around(ways.way_to(*joint), around, ways.way_on_from(*joint));
      if (walk.cost < best.cost) best = std::move(walk);
    }
    return best;
  }

  /// As few times around as it takes. No steps if however many do not meet an angle of
  /// the goal, or are too many.
  Walk walk_around(const Steps& to_loop, const Steps& around,
                   const std::pair<Steps, int>& way_on) {
    const auto& [to_goal, end] = way_on;
    Walk walk{.steps = to_loop, .turned = {Turned{}}, .around = around.size()};
    bool is_inside = follow(to_loop, walk.turned);
    while (is_inside && walk.steps.size() < kMostPushes) {
      std::vector<Turned> ending = {walk.turned.back()};
      if (follow(to_goal, ending)) {
        const auto theta = angle_met(states_.node(end), ending.back());
        if (theta) {
          walk.theta = *theta;
          walk.steps.insert(walk.steps.end(), to_goal.begin(), to_goal.end());
          walk.turned.insert(walk.turned.end(), ending.begin() + 1, ending.end());
          walk.cost = cost_of_steps(walk.steps);
          return walk;
        }
      }
      const Turned before = walk.turned.back();
      is_inside = follow(around, walk.turned);
      const Turned& after = walk.turned.back();
      if (after.lo == before.lo && after.hi == before.hi) break;
      walk.steps.insert(walk.steps.end(), around.begin(), around.end());
    }
    return {};
  }

  /// Adds what has been produced after each step; false where none of it is within the
  /// limits.
  bool follow(const Steps& steps, std::vector<Turned>& turned) {
    for (const WalkStep& step : steps) {
      const Turned after = turned_after(turned.back(), edge(step), window_);
      if (after.lo > after.hi) return false;
      turned.push_back(after);
    }
    return true;
  }

  std::optional<double> angle_met(int node, const Turned& turned) const {
    const GoalPlace& goal =
        goals_.places[static_cast<std::size_t>(lattice_.goal_at(node))];
    return angle_between(*search_.model, goal, start_.theta + turned.lo / c_,
                         start_.theta + turned.hi / c_);
  }

  double cost_of_steps(const Steps& steps) {
    double cost = 0.0;
    int contact = -1;
    for (const WalkStep& step : steps) {
      const WalkEdge& pushed = edge(step);
      cost += pushed.cost + (pushed.contact != contact ? 1.0 : 0.0);
      contact = pushed.contact;
    }
    return cost;
  }

  /// Each as deep in what it may turn as the whole walk is.
  std::vector<Move> moves_of(const Walk& walk) {
    std::vector<Move> moves(walk.steps.size());
    double turned = c_ * (walk.theta - start_.theta);
    for (std::size_t i = walk.steps.size(); i-- > 0;) {
      const WalkEdge& pushed = edge(walk.steps[i]);
      const double before =
          turned_before(walk.turned[i], pushed, walk.turned[i + 1], turned);
      moves[i] = {pushed.contact, state(walk.steps[i].node, before),
                  state(pushed.to, turned)};
      turned = before;
    }
    return moves;
  }

  FlatState state(int node, double c_turned) const {
    return {lattice_.place(node), start_.theta + c_turned / c_};
  }

  /// Whether all pushes stick with the real pads; the edges of those that do not keep
  /// what does.
  bool narrow_those_that_slip(const Walk& walk, const std::vector<Move>& moves) {
    std::vector<std::size_t> slipping;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      if (is_once_more(walk, moves, i) || move_passes(search_, moves[i], work_)) continue;
      slipping.push_back(i);
    }
    for (const std::size_t i : slipping) narrow(walk.steps[i], moves[i].from);
    return slipping.empty();
  }

  /// Whether a push is that of the last time around, over pads that are alike at every
  /// angle.
  bool is_once_more(const Walk& walk, const std::vector<Move>& moves,
                    std::size_t i) const {
    if (!is_periodic_ || walk.around == 0 || i < walk.around) return false;
    const std::size_t before = i - walk.around;
    const auto turn = [&](std::size_t k) {
      return c_ * (moves[k].to.theta - moves[k].from.theta);
    };
    return walk.steps[before].node == walk.steps[i].node &&
           walk.steps[before].edge == walk.steps[i].edge &&
           std::abs(turn(before) - turn(i)) < kSameTurn;
  }

  /// To the longest run of turns that stick, from a state on.
  void narrow(const WalkStep& step, const FlatState& from) {
    const WalkEdge whole = edge(step);
    if (whole.lo > whole.hi) return;  // already, as a push of the same walk
    Turned kept{1.0, 0.0};
    Turned run;
    int length = 0;
    int longest = 0;
    for (int i = 0; i < kLooks; ++i) {
      const double turn = std::lerp(whole.lo, whole.hi, (i + 0.5) / kLooks);
      const Move move{
          whole.contact, from, {lattice_.place(whole.to), from.theta + turn / c_}};
      if (!move_holds(search_, move, work_)) {
        length = 0;
        continue;
      }
      run = {length == 0 ? turn : run.lo, turn};
      if (++length <= longest) continue;
      longest = length;
      kept = run;
    }
    lattice_.narrow(step.node, step.edge, kept.lo, kept.hi);
  }

  const SearchModel& search_;
  WalkLattice& lattice_;
  const FlatState start_;
  const GoalPlaces& goals_;
  const Limits& limits_;
  Work& work_;
  const double c_;  // [m]
  const WalkStates states_;
  const bool is_periodic_;  // pads alike at every angle
  TurnWindow window_;       // of c dtheta [m]
};

/// A margin of the place closes ways that narrow, and so do pads that have to hold at
/// every angle and are not alike there.
bool has_room_for_narrow_ways(const SearchModel& search) {
  return search.margin.place == 0.0 && search.model->region.is_isotropic();
}

/// Lattice by lattice, until one has a walk.
class LoopSearches {
 public:
  LoopSearches(const SearchModel& search, const FlatState& start, const GoalPlaces& goals,
               const GoalPlaces& beside, const Limits& limits, Work& work)
      : search_(search),
        start_(start),
        goals_(goals),
        beside_(beside),
        limits_(limits),
        work_(work) {}

  const std::optional<std::vector<Move>>& moves() const { return moves_; }

  void search_kept(WalkLattices& kept, Steepness steepness) {
    for (const int per_side : kFewWays) {
      if (moves_) return;
      search_over(kept.between(search_, start_, goals_, {per_side}, steepness));
    }
  }

  /// Those of more headings, and in rows, where `last` leaves a gap that they may close.
  void search_narrow_ways(WalkLattice& last) {
    if (last.slopes() > kMostSlopes) return;
    const std::vector<WalkGap> gaps = gaps_left_by(last);
    const std::vector<Rows> ways = rows_across(last, gaps, work_);
    const bool are_near = std::ranges::any_of(
        gaps, [](const WalkGap& gap) { return gap.spacings <= kNear; });
    if (are_near || !ways.empty()) search_anew(kManyHeadings);
    for (const Rows& rows : ways) search_in(rows);
    for (const Fineness& fineness : kManyWays) {
      if (are_near) search_anew(fineness);
    }
  }

 private:
  /// False if the lattice is too large.
  bool search_over(WalkLattice& lattice) {
    if (lattice.slopes() > kMostSlopes) return false;
    moves_ = LoopSearch(search_, lattice, start_, goals_, limits_, work_).run();
    if (moves_ || beside_.count == 0) return true;
    lattice.set_ends(start_, beside_);
    moves_ = LoopSearch(search_, lattice, start_, beside_, limits_, work_).run();
    return true;
  }

  bool search_anew(const Fineness& fineness, const Rows& rows = {}) {
    if (moves_) return true;
    WalkLattice lattice(search_, start_, goals_, fineness, Steepness::kUsualFinely, rows);
    return search_over(lattice);
  }

  void search_in(const Rows& rows) {
    for (const Fineness& fineness : kInRows) {
      if (fineness.per_side * fineness.per_side * rows.closer > kMostInRows) continue;
      if (search_anew(fineness, rows)) return;
    }
  }

  /// To the goals, and to those beside them.
  std::vector<WalkGap> gaps_left_by(WalkLattice& lattice) {
    std::vector<WalkGap> gaps;
    for (const GoalPlaces* ends : {&goals_, &beside_}) {
      if (ends->count == 0) continue;
      lattice.set_ends(start_, *ends);
      if (const auto gap = walk_gap(lattice, limits_, work_)) gaps.push_back(*gap);
    }
    return gaps;
  }

  const SearchModel& search_;
  const FlatState start_;
  const GoalPlaces& goals_;
  const GoalPlaces& beside_;
  const Limits& limits_;
  Work& work_;
  std::optional<std::vector<Move>> moves_;
};

}  // namespace

std::optional<std::vector<Move>> search_loops(const SearchModel& search,
                                              const FlatState& start,
                                              const GoalPlaces& goals,
                                              const GoalPlaces& beside,
                                              Steepness steepness, WalkLattices& kept,
                                              const Limits& limits, Work& work) {
  if (!is_for_walks(search)) return std::nullopt;
  LoopSearches searches(search, start, goals, beside, limits, work);
  searches.search_kept(kept, steepness);
  if (!searches.moves() && steepness == Steepness::kUsual &&
      has_room_for_narrow_ways(search)) {
    searches.search_narrow_ways(
        kept.between(search, start, goals, {kFewWays.back()}, steepness));
  }
  if (!searches.moves()) return std::nullopt;
  return within_budget(work, share_of_left(work, kShareOfShortening), [&] {
    return shortened(search, joined_moves(search, *searches.moves()), limits, work);
  });
}

}  // namespace prehensile
