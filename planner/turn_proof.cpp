#include "planner/turn_proof.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "optimisation/nonlinear_program.h"
#include "planner/barrier.h"
#include "planner/clipped_law.h"
#include "planner/free_places.h"
#include "planner/goal_cover.h"
#include "planner/local_law.h"
#include "planner/traced_regions.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHalfTurn = std::numbers::pi;

/// Where the face clips the discs: so much slack, over F, may be missing on the lines
/// around a region.
constexpr double kAllowed = 0.01;

/// Shares of the headings that are left by which such a line turns aside. Tried in order.
constexpr std::array kAside = {0.03, 0.15};

/// How far behind the start the region ahead of it begins [m], and how far beyond the
/// goal, in its tolerances, the one from which it is reached ends. Tried in order.
constexpr std::array kBehindStart = {5e-5, 3e-4, 1e-3};
constexpr std::array kBeyondGoal = {1.2, 2.0, 4.0, 8.0};

/// Places where the turn is looked at, at most, of a grid over the longer side.
constexpr int kNodesPerSide = 200;
constexpr std::size_t kMostPlaces = 60;

/// Ranges of directions that are looked at.
constexpr int kRanges = 240;

/// Of a first bound: by so much of 1 + |kappa| it is above what was seen.
constexpr double kLittle = 0.01;

/// What the bounds leave of the way to the angles of the goal [rad], for the check. Tried
/// in order.
constexpr std::array kLeft = {0.1, 0.03};

/// A turn that no bound needs to keep below [rad].
constexpr double kAnyTurn = 1e3;

/// Bounds are no steeper.
constexpr double kSteepest = 40.0;

/// Of what bounds are asked to be above, only every so many are looked at at first; then
/// those that are broken by more than a little, so many at once, so often.
constexpr std::size_t kStride = 16;
constexpr double kBroken = 1e-5;
constexpr std::size_t kMostAdded = 200;
constexpr int kMostRounds = 12;

/// The middle of what is free at a place, as long as it is less than half a turn.
std::optional<Vec2> middle_way(const FreeDirections& free) {
  if (free.are_none()) return std::nullopt;
  const auto gap = free.widest_gap();
  if (gap.width <= kHalfTurn) return std::nullopt;
  return towards(gap.from + 0.5 * gap.width + kHalfTurn);
}

using Stopped = std::function<bool()>;

/// A region that is never left and holds the start, or none.
Loops region_of_start(const Model& model, const FreeAt& free_at, const Stopped& stopped) {
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  const auto way = middle_way(free_at(start));
  if (!way) return {};
  for (const double aside : kAside) {
    for (const double behind : kBehindStart) {
      if (stopped && stopped()) return {};
      Loops region = region_ahead(model, start - behind * *way, free_at, aside);
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
  for (const double aside : kAside) {
    for (const double tolerances : kBeyondGoal) {
      if (stopped && stopped()) return {};
      const Vec2 apex = place + tolerances * goal.position_tolerance * *way;
      Loops region = region_not_behind(model, apex, free_at, aside);
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

/// A rate of turn that some contact makes, in one sense.
struct Seen {
  Vec2 from_start;  // [m]
  Vec2 direction;   // of dp_OF
  double kappa;     // sense c dtheta / |dp_OF|
};

/// The greatest at each of the places, at both ends of each range of directions.
std::vector<Seen> seen_turns(const Model& model, const LocalLaw& law,
                             const std::vector<Vec2>& places, double sense) {
  constexpr double kHalf = kHalfTurn / kRanges;
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  std::vector<Seen> seen;
  for (const Vec2& place : places) {
    const std::array corners = {place};
    for (int i = 0; i < kRanges; ++i) {
      const double angle = 2.0 * kHalf * i;
      double most = -kInfinity;
      for (int k = 0; k < static_cast<int>(model.contacts.size()); ++k) {
        most = std::max(most, law.most_turn(k, corners, {towards(angle), kHalf}, sense));
      }
      if (most == -kInfinity) continue;
      for (const double end : {angle - kHalf, angle + kHalf}) {
        seen.push_back({place - start, towards(end), most});
      }
    }
  }
  return seen;
}

/// Bounds in one sense on what was seen, as linear programmes, for Ipopt. Their variables
/// are the rate at the start, its change over `length`, and one more, which they
/// minimise.
class Bounds {
 public:
  Bounds(const std::vector<Seen>& seen, const std::vector<Vec2>& ways, double length,
         const Stopped& stopped)
      : seen_(seen), ways_(ways), length_(length), stopped_(stopped) {}

  /// The least over the ways to the goal [m].
  std::optional<double> least_along_ways() const {
    Rows rows;
    for (const Seen& one : seen_) {
      rows.add(one.direction, one.from_start / length_, 0.0,
               one.kappa + kLittle * (1.0 + std::abs(one.kappa)));
    }
    for (const Vec2& way : ways_) rows.add(-way / length_, 0.5 * way / length_, 1.0, 0.0);
    const auto x = solve(rows, kSteepest);
    return x ? std::optional(x->back() * length_) : std::nullopt;
  }

  /// That which is above what was seen by the greatest share of 1 + |kappa|, and over the
  /// ways at most `most` [m].
  std::optional<TurnRate> surest(double most) const {
    Rows rows;
    for (const Seen& one : seen_) {
      rows.add(one.direction, one.from_start / length_, 1.0 + std::abs(one.kappa),
               one.kappa);
    }
    for (const Vec2& way : ways_) {
      rows.add(-way / length_, 0.5 * way / length_, 0.0, -most / length_);
    }
    const auto x = solve(rows, 0.0);
    if (!x) return std::nullopt;
    return TurnRate{{(*x)[0], (*x)[1]}, Vec3((*x)[2], (*x)[3], (*x)[4]) / length_};
  }

 private:
  static constexpr int kVariables = 6;
  using Point = std::array<double, kVariables>;

  struct Rows {
    std::vector<Point> factors;
    std::vector<double> least;

    double value(std::size_t i, std::span<const double> x) const {
      return std::inner_product(x.begin(), x.end(), factors[i].begin(), 0.0);
    }

    /// The rate at a place, along `e`, and `of_last` times the last variable are
    /// `at_least`.
    void add(const Vec2& e, const Vec2& place, double of_last, double at_least) {
      factors.push_back({e.x(), e.y(), e.x() * place.x(),
                         e.x() * place.y() + e.y() * place.x(), e.y() * place.y(),
                         of_last});
      least.push_back(at_least);
    }
  };

  /// With a few rows at first, to which those that the solution breaks are added.
  std::optional<Point> solve(const Rows& rows, double most_of_last) const {
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < rows.least.size(); i += kStride) some.push_back(i);
    for (int round = 0; round < kMostRounds; ++round) {
      const auto x = solve(rows, some, most_of_last);
      if (!x) return std::nullopt;
      const auto broken = broken_by(*x, rows);
      if (broken.empty()) return x;
      some.insert(some.end(), broken.begin(), broken.end());
    }
    return std::nullopt;
  }

  /// Those that are broken most.
  static std::vector<std::size_t> broken_by(const Point& x, const Rows& rows) {
    std::vector<std::pair<double, std::size_t>> broken;
    for (std::size_t i = 0; i < rows.least.size(); ++i) {
      const double left = rows.value(i, x) - rows.least[i];
      if (left < -kBroken) broken.emplace_back(left, i);
    }
    std::ranges::sort(broken);
    broken.resize(std::min(broken.size(), kMostAdded));
    std::vector<std::size_t> most(broken.size());
    std::ranges::transform(broken, most.begin(),
                           [](const auto& one) { return one.second; });
    return most;
  }

  std::optional<Point> solve(const Rows& rows, const std::vector<std::size_t>& some,
                             double most_of_last) const {
    NonlinearProgram program;
    program.start.assign(kVariables, 0.0);
    program.lower.assign(kVariables, -kSteepest);
    program.upper.assign(kVariables, kSteepest);
    program.upper.back() = most_of_last;
    program.objective = [](std::span<const double> x, std::span<double> gradient) {
      if (!gradient.empty()) {
        std::ranges::fill(gradient, 0.0);
        gradient.back() = 1.0;
      }
      return x.back();
    };
    program.constraint_lower.resize(some.size());
    std::ranges::transform(some, program.constraint_lower.begin(),
                           [&](std::size_t i) { return rows.least[i]; });
    program.constraint_upper.assign(some.size(), kUnbounded);
    program.constraints = [&](std::span<const double> x, std::span<double> g) {
      for (std::size_t k = 0; k < some.size(); ++k) g[k] = rows.value(some[k], x);
    };
    for (int k = 0; k < static_cast<int>(some.size()); ++k) {
      for (int j = 0; j < kVariables; ++j) {
        program.jacobian_rows.push_back(k);
        program.jacobian_columns.push_back(j);
      }
    }
    program.jacobian = [&](std::span<const double>, std::span<double> values) {
      auto value = values.begin();
      for (const std::size_t i : some) {
        value = std::ranges::copy(rows.factors[i], value).out;
      }
    };
    program.hessian = [](std::span<const double>, double, std::span<const double>,
                         std::span<double>) {};
    program.stop = stopped_;
    const NlpResult result =
        minimise_ipopt(program, {.tolerance = 1e-6, .max_evaluations = 200});
    if (result.status != NlpStatus::kConverged) return std::nullopt;
    Point x;
    std::ranges::copy(result.x, x.begin());
    return x;
  }

  const std::vector<Seen>& seen_;
  const std::vector<Vec2>& ways_;
  double length_;
  const Stopped& stopped_;
};

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
  const FreeAt free_at = clips ? free_over_clipped_discs(model, *slacks, kAllowed)
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

}  // namespace

bool find_turn(const Model& model, Proof& proof, const Stopped& stopped) {
  const Goal& goal = *model.scene.goal;
  if (!ipopt_is_built() || !goal.x || !goal.y || !goal.theta) return false;
  const bool clips = has_clipped_discs(model);
  const LocalLaw law = clips ? LocalLaw::of_whole_discs(model) : LocalLaw(model);
  if (!law.is_known() || (clips && !has_clipped_law(model))) return false;
  if (!enclose(model, proof, stopped) || (stopped && stopped())) return false;
  const std::vector<Vec2> places = places_between(model, proof);
  const std::vector<Vec2> ways = ways_to_goal(model, proof);
  const double length = longest(ways);
  if (length == 0.0) return false;
  const std::vector<Seen> most = seen_turns(model, law, places, 1.0);
  const std::vector<Seen> least = seen_turns(model, law, places, -1.0);
  const Bounds bounds_above(most, ways, length, stopped);
  const Bounds bounds_below(least, ways, length, stopped);
  const auto high = bounds_above.least_along_ways();
  if (!high) return false;
  const Turns turns = turns_around(model, *high / model.c);
  for (const double left : kLeft) {
    const double aside = angle_tolerance(goal) + left;
    const auto above = bounds_above.surest(model.c * (turns.next - aside));
    const auto below = bounds_below.surest(-model.c * (turns.before + aside));
    if (!above || !below) continue;
    proof.turn->most = *above;
    proof.turn->least = {-below->at_start, -below->bend};
    if (verify_turn(model, proof, nullptr)) return true;
  }
  return false;
}

}  // namespace prehensile
