#include "planner/proofs/barrier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "planner/pads/local_law.h"
#include "planner/pads/place_slacks.h"
#include "planner/proofs/cheat_field.h"
#include "planner/proofs/free_places.h"
#include "planner/proofs/goal_cover.h"
#include "planner/proofs/half_planes.h"
#include "planner/proofs/traced_regions.h"
#include "scene/constants.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

/// Of the grids that are tried, over the longer side of the object. Over whole pads those
/// finer than kNodesOfAll only where the one before separates the goal.
constexpr std::array kNodesPerSide = {48, 96, 192, 384};
constexpr int kNodesOfAll = 96;
constexpr std::array kNodesPerSideWhereClipped = {96, 192};

/// Nodes that are looked at in all, in the order of their cost: more than were needed for
/// any barrier of the benchmark suite.
constexpr std::int64_t kMostNodes = 150'000;
constexpr std::int64_t kMostNodesWhereClipped = 600'000;

/// By so much more than what sticks the field lets a way turn for nothing: its
/// pieces have few directions, and what sticks changes from node to node. Tried in order.
constexpr std::array kFreely = {0.06, 0.02, 0.005, 0.0};  // [rad]
constexpr std::array kFreelyWhereClipped = {0.06, 0.0};

/// Where the face clips the discs: so much slack, over F, may be missing. Tried in order.
constexpr std::array kAllowed = {0.06, 0.03, 0.015, 0.008};

/// Levels of the field that are tried, as shares of its values at the goal and on the
/// border of what the tolerances leave around it.
constexpr std::array kLevels = {0.5, 0.25, 0.75};

/// Straight lines that are tried, and how close the places of the goal are that they keep
/// clear of [m].
constexpr int kMostLines = 4;
constexpr double kGoalSpacing = 2e-4;

/// Lines that follow what sticks, of those that are tried as borders. Where the face
/// clips the discs so much slack, over F, may be missing. Tried in order.
constexpr int kMostTraced = 60;
constexpr int kMostTracedWhereClipped = 20;
constexpr std::array kAllowedIfTraced = {0.04, 0.02, 0.01};

/// A field with less at the goal [spacings of the grid] shows no barrier.
constexpr double kLeastValue = 0.5;

/// Of some angles of the goal set, whose places are no closer than `spacing`.
GoalSample sample_of(const Goal& goal, double spacing) {
  constexpr int kPerSide = 6;
  const bool square = goal.test == GoalTest::kPerCoordinate;
  GoalSample sample;
  for_all_goal_angles(goal, [&](double theta, double) {
    const Vec2 middle = goal_place(goal, theta);
    if (!sample.middle.empty() && (middle - sample.middle.back()).norm() < spacing) {
      return true;
    }
    sample.middle.push_back(middle);
    for (int k = 0; k < 4 * kPerSide; ++k) {
      const double share = 2.0 * (k % kPerSide) / kPerSide - 1.0;
      const Vec2 off =
          square ? Vec2(1.0, share) : towards(0.25 * std::numbers::pi * share);
      const int side = k / kPerSide;
      const double turn = 0.5 * std::numbers::pi * side - theta;
      sample.border.push_back(middle + goal.position_tolerance * rotated(turn, off));
    }
    return true;
  });
  return sample;
}

/// The first region that is a barrier, or none.
Loops barrier_among(const Model& model, std::vector<Loops> regions) {
  std::optional<Vec2> weak;
  for (Loops& region : regions) {
    if (verify_barrier(model, region, nullptr, &weak)) return std::move(region);
  }
  return {};
}

/// Tries levels of a field.
class Levels {
 public:
  explicit Levels(const Model& model)
      : model_(model), start_(finger_in_object(model.scene.start.X_HO)) {}

  /// Whether the field separates the goal from the start, if only by what it allows.
  bool separate(CheatField& field, Judged judged, double freely) {
    const double spacing = field.grid().spacing;
    goal_ = sample_of(*model_.scene.goal, 0.25 * spacing);
    cost_ = field.costs(start_, goal_.middle, judged, freely, &of_goal_);
    separated_ = of_goal_ > kLeastValue * spacing && of_goal_ != kInfinity;
    return separated_;
  }

  /// Whether the field that was looked at last did.
  bool separated() const { return separated_; }

  /// A level that is a barrier, or none.
  Loops barrier_of(CheatField& field, Judged judged, double freely) {
    if (!separate(field, judged, freely)) return {};
    double of_border = of_goal_;
    for (const Vec2& place : goal_.border) {
      of_border = std::min(of_border, field.grid().interpolated(cost_, place));
    }
    for (const double value : {of_goal_, of_border}) {
      for (const double share : kLevels) {
        Loops region =
            loops_below(field.grid(), cost_, share * value, 0.1 * field.grid().spacing);
        if (verify_barrier(model_, region, nullptr, &weak_)) return region;
      }
    }
    return {};
  }

 private:
  const Model& model_;
  Vec2 start_;
  GoalSample goal_;
  std::vector<double> cost_;
  double of_goal_ = 0.0;
  bool separated_ = false;
  std::optional<Vec2> weak_;  // where the last region that was tried may be crossed
};

Loops barrier_of_whole_pads(const Model& model, const FreeAt& free_at,
                            const CheatField::Stopped& stopped) {
  const GoalSample goal = sample_of(*model.scene.goal, kGoalSpacing);
  Loops straight =
      barrier_among(model, half_planes(model, goal.border, free_at, kMostLines));
  if (!straight.empty()) return straight;
  Loops traced =
      barrier_among(model, traced_regions(model, goal, free_at, kMostTraced, stopped));
  if (!traced.empty()) return traced;
  Levels levels(model);
  for (const int nodes : kNodesPerSide) {
    CheatField field(model, nodes, free_at, stopped);
    for (const double freely : kFreely) {
      Loops barrier = levels.barrier_of(field, Judged::kWhereItBegins, freely);
      if (!barrier.empty()) return barrier;
    }
    if (nodes >= kNodesOfAll && !levels.separated()) break;
  }
  return {};
}

Loops barrier_of_clipped_discs(const Model& model, const CheatField::Stopped& stopped) {
  PlaceSlacks slacks(model);
  const auto free_if = [&](double allowed) {
    return free_over_clipped_discs(model, slacks, allowed);
  };
  const GoalSample goal = sample_of(*model.scene.goal, kGoalSpacing);
  for (const double allowed : kAllowedIfTraced) {
    const FreeAt free_at = free_closely_over_clipped_discs(model, slacks, allowed);
    Loops traced = barrier_among(
        model, traced_regions(model, goal, free_at, kMostTracedWhereClipped, stopped));
    if (!traced.empty()) return traced;
  }
  Levels levels(model);
  constexpr std::array kWays = {Judged::kAtBothEnds, Judged::kAllAlong};
  for (const int nodes : kNodesPerSideWhereClipped) {
    std::vector<CheatField> fields;  // the last is the strictest
    fields.reserve(kAllowed.size());
    for (const double allowed : kAllowed) {
      fields.emplace_back(model, nodes, free_if(allowed), stopped);
    }
    // What the strictest does not separate the others would not either.
    if (std::ranges::none_of(kWays, [&](Judged judged) {
          return levels.separate(fields.back(), judged, kFreelyWhereClipped.back());
        })) {
      return {};
    }
    for (CheatField& field : fields) {
      for (const Judged judged : kWays) {
        for (const double freely : kFreelyWhereClipped) {
          Loops barrier = levels.barrier_of(field, judged, freely);
          if (!barrier.empty()) return barrier;
        }
      }
    }
  }
  return {};
}

}  // namespace

Loops find_barrier(const Model& model, const std::function<bool()>& stopped) {
  const Goal& goal = *model.scene.goal;
  if (!goal.x || !goal.y) return {};
  const bool clips = has_clipped_discs(model);
  std::int64_t left = clips ? kMostNodesWhereClipped : kMostNodes;
  const CheatField::Stopped or_spent = [&] {
    return left-- <= 0 || (stopped && stopped());
  };
  if (clips) {
    return has_clipped_law(model) ? barrier_of_clipped_discs(model, or_spent) : Loops{};
  }
  if (!LocalLaw(model).is_known()) return {};
  return barrier_of_whole_pads(model, free_over_whole_pads(model), or_spent);
}

}  // namespace prehensile
