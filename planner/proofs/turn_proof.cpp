#include "planner/proofs/turn_proof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "optimisation/nonlinear_program.h"
#include "planner/pads/clipped_law.h"
#include "planner/pads/local_law.h"
#include "planner/proofs/barrier.h"
#include "planner/proofs/free_places.h"
#include "planner/proofs/goal_cover.h"
#include "planner/proofs/traced_regions.h"
#include "planner/proofs/turn_bounder.h"
#include "scene/constants.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

/// Where the face clips the discs: so much slack, over F, may be missing on the lines
/// around a region.
constexpr double kAllowed = 0.01;

/// Shares of the headings that are left by which such a line turns aside. Tried in order.
constexpr std::array kAside = {0.006, 0.03, 0.15};

/// How far behind the start the region ahead of it begins [m], and how far beyond the
/// goal, in its tolerances, the one from which it is reached ends. Tried in order.
constexpr std::array kBehindStart = {1e-5, 5e-5, 3e-4, 1e-3};
constexpr std::array kBeyondGoal = {1.01, 1.2, 1.5, 2.0, 4.0, 8.0};

/// Places where the turn is looked at, at most, of a grid over the longer side.
constexpr int kNodesPerSide = 200;
constexpr std::size_t kMostPlaces = 60;

/// Directions that are looked at there, and half of how far around each [rad].
constexpr int kDirections = 360;
constexpr double kHalfLooked = 1e-4;

/// How often bounds are looked for with what their check finds to break them.
constexpr int kMostRounds = 10;
constexpr int kMostRoundsForEnds = 2;  // of which no push does

/// What the bounds leave of the way to the angles of the goal [rad], for the check. Tried
/// in order.
constexpr std::array kLeft = {0.1, 0.03, 0.01};

/// A turn that no bound needs to keep below [rad].
constexpr double kAnyTurn = 1e3;

/// The middle of what is free at a place, as long as it is less than half a turn.
std::optional<Vec2> middle_way(const FreeDirections& free) {
  if (free.are_none()) return std::nullopt;
  const auto gap = free.widest_gap();
  if (gap.width <= kHalfTurn) return std::nullopt;
  return towards(gap.from + 0.5 * gap.width + kHalfTurn);
}

using Stopped = std::function<bool()>;

/// Length [m] of a straight way from the start to beyond the goal.
double way_to_goal(const Model& model) {
  const Goal& goal = *model.scene.goal;
  const Vec2 way =
      goal_place(goal, *goal.theta) - finger_in_object(model.scene.start.X_HO);
  return way.norm() + 3.0 * goal.position_tolerance;
}

/// A region that is never left and holds the start, or none.
Loops region_of_start(const Model& model, const FreeAt& free_at, const Stopped& stopped) {
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  const auto way = middle_way(free_at(start));
  if (!way) return {};
  const double closely = way_to_goal(model);
  for (const double aside : kAside) {
    for (const double behind : kBehindStart) {
      if (stopped && stopped()) return {};
      Loops region = region_ahead(model, start - behind * *way, free_at, aside, closely);
      if (region.empty() || depth_in_region(region, start) <= 0.0) continue;
      if (is_never_left(model, region)) return region;
    }
  }
  return {};
}

/// A region that is never left and holds no pose of the goal, or none.
Loops region_beyond_goal(const Model& model, const FreeAt& free_at,
                         const Stopped& stopped) {
  const Goal& goal = *model.scene.goal;
  const Vec2 place = goal_place(goal, *goal.theta);
  const auto way = middle_way(free_at(place));
  if (!way) return {};
  const double closely = way_to_goal(model);
  for (const double aside : kAside) {
    for (const double tolerances : kBeyondGoal) {
      if (stopped && stopped()) return {};
      const Vec2 apex = place + tolerances * goal.position_tolerance * *way;
      Loops region = region_not_behind(model, apex, free_at, aside, closely);
      if (region.empty() || !goal_is_outside(region, goal)) continue;
      if (is_never_left(model, region)) return region;
    }
  }
  return {};
}

/// Places between the regions: evenly spaced, and not too many.
std::vector<Vec2> places_between(const Model& model, const Proof& proof) {
  const PlaceGrid grid = PlaceGrid::over(model.pad_face, kNodesPerSide);
  std::vector<Vec2> places;
  for (int node = 0; node < grid.count(); ++node) {
    const Vec2 place = grid.place(node);
    if (depth_inside(model.pad_face, place) < 0.0) continue;
    if (!proof.region.empty() && !is_between(proof.region, place)) continue;
    if (is_between(proof.turn->beyond, place)) continue;
    places.push_back(place);
  }
  const std::size_t stride = places.size() / kMostPlaces + 1;
  std::vector<Vec2> some{finger_in_object(model.scene.start.X_HO)};
  for (std::size_t i = 0; i < places.size(); i += stride) some.push_back(places[i]);
  return some;
}

/// From the start to places of the goal between the regions.
std::vector<Vec2> ways_to_goal(const Model& model, const Proof& proof) {
  constexpr int kAngles = 2;
  constexpr int kPlaces = 5;
  const Goal& goal = *model.scene.goal;
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  std::vector<Vec2> ways;
  for (int a = -kAngles; a <= kAngles; ++a) {
    const double theta = *goal.theta + angle_tolerance(goal) * a / kAngles;
    for (int i = -kPlaces; i <= kPlaces; ++i) {
      for (int j = -kPlaces; j <= kPlaces; ++j) {
        const Vec2 off = goal.position_tolerance / kPlaces * Vec2(i, j);
        const Vec2 place = goal_place(goal, theta) + rotated(-theta, off);
        if (!proof.region.empty() && !is_between(proof.region, place)) continue;
        if (!is_between(proof.turn->beyond, place)) ways.push_back(place - start);
      }
    }
  }
  return ways;
}

/// Completes the regions of a proof; false if neither is found.
bool enclose(const Model& model, Proof& proof, const Stopped& stopped) {
  const bool clips = has_clipped_discs(model);
  std::optional<PlaceSlacks> slacks;
  if (clips) slacks.emplace(model);
  const FreeAt free_at = clips ? free_closely_over_clipped_discs(model, *slacks, kAllowed)
                               : free_over_whole_pads(model);
  proof.turn.emplace();
  proof.region = region_of_start(model, free_at, stopped);
  proof.turn->beyond = region_beyond_goal(model, free_at, stopped);
  return !proof.region.empty() || !proof.turn->beyond.empty();
}

/// Turns from the start that the bounds are to stay between [rad].
struct Turns {
  double before, next;
};

/// Those to the goal's angle next to what a way turns at most [rad].
Turns turns_around(const Model& model, double most) {
  constexpr double kWhole = 2.0 * kHalfTurn;
  const Goal& goal = *model.scene.goal;
  const double wanted = *goal.theta - model.scene.start.X_HO.theta;
  if (goal.theta_is == ThetaMeaning::kNumber) {
    return wanted > most ? Turns{-kAnyTurn, wanted} : Turns{wanted, kAnyTurn};
  }
  const double next = wanted + kWhole * std::ceil((most - wanted) / kWhole);
  return {next - kWhole, next};
}

double longest(const std::vector<Vec2>& ways) {
  double length = 0.0;
  for (const Vec2& way : ways) length = std::max(length, way.norm());
  return length;
}

/// Looks for bounds in both senses that the check accepts: what it finds to break them is
/// added to what they have to be above.
class BoundSearch {
 public:
  BoundSearch(const Model& model, const LocalLaw& law, double length,
              const Stopped& stopped)
      : model_(model),
        start_(finger_in_object(model.scene.start.X_HO)),
        stopped_(stopped),
        above_(length, stopped),
        below_(length, stopped),
        law_(law) {}

  /// Adds the greatest rates of turn in both senses, in directions all around a place.
  void look_around(const Vec2& place) {
    for (int i = 0; i < kDirections; ++i) {
      const Vec2 direction = towards(2.0 * kHalfTurn * i / kDirections);
      add_most(place, direction, 1.0, above_);
      add_most(place, direction, -1.0, below_);
    }
  }

  void add_way(const Vec2& way) {
    above_.add_way(way);
    below_.add_way(way);
  }

  /// What a way turns at most, by what was looked at [rad].
  std::optional<double> most() const {
    const auto most = above_.least_along_ways();
    return most ? std::optional(*most / model_.c) : std::nullopt;
  }

  /// Bounds between which the turns are, by `aside` [rad] more; false if there are none.
  bool complete(const Turns& turns, double aside, Proof& proof) {
    for (int round = 0; round < kMostRounds; ++round) {
      if (stopped_ && stopped_()) return false;
      const auto above = above_.surest(model_.c * (turns.next - aside));
      const auto below = below_.surest(-model_.c * (turns.before + aside));
      if (!above || !below) return false;
      proof.turn->most = *above;
      proof.turn->least = {-below->at_start, -below->bend};
      TurnBreaks breaks;
      if (verify_turn(model_, proof, nullptr, &breaks)) return true;
      const bool only_ends = breaks.pushes.empty();
      if (only_ends && (breaks.ends.empty() || round == kMostRoundsForEnds)) return false;
      learn(breaks);
    }
    return false;
  }

 private:
  void add_most(const Vec2& place, const Vec2& direction, double sense,
                TurnBounder& bounder) const {
    const std::array corners = {place};
    double most = -kInfinity;
    for (int k = 0; k < static_cast<int>(model_.contacts.size()); ++k) {
      most = std::max(most, law_.most_turn(k, corners, {direction, kHalfLooked}, sense));
    }
    if (most > -kInfinity) bounder.add({place - start_, direction, most});
  }

  void learn(const TurnBreaks& breaks) {
    for (const TurnBreaks::Push& push : breaks.pushes) {
      const Vec2 from_start = push.place - start_;
      for (const double side : {-1.0, 1.0}) {
        const Vec2 direction =
            rotated(side * push.directions.half_angle, push.directions.middle);
        above_.add({from_start, direction, push.most});
        below_.add({from_start, direction, -push.least});
      }
    }
    for (const Vec2& place : breaks.ends) add_way(place - start_);
  }

  const Model& model_;
  const Vec2 start_;
  const Stopped& stopped_;
  TurnBounder above_, below_;
  const LocalLaw& law_;
};

}  // namespace

bool find_turn(const Model& model, Proof& proof, const Stopped& stopped) {
  const Goal& goal = *model.scene.goal;
  if (!ipopt_is_built() || !goal.x || !goal.y || !goal.theta) return false;
  const bool clips = has_clipped_discs(model);
  const LocalLaw law = clips ? LocalLaw::of_whole_discs(model) : LocalLaw(model);
  if (!law.is_known() || (clips && !has_clipped_law(model))) return false;
  if (!enclose(model, proof, stopped) || (stopped && stopped())) return false;
  const std::vector<Vec2> ways = ways_to_goal(model, proof);
  const double length = longest(ways);
  if (length == 0.0) return false;
  BoundSearch bounds(model, law, length, stopped);
  for (const Vec2& place : places_between(model, proof)) bounds.look_around(place);
  for (const Vec2& way : ways) bounds.add_way(way);
  const auto most = bounds.most();
  if (!most) return false;
  const Turns turns = turns_around(model, *most);
  return std::ranges::any_of(kLeft, [&](double left) {
    return bounds.complete(turns, angle_tolerance(goal) + left, proof);
  });
}

}  // namespace prehensile
