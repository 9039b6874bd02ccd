#include "planner/proofs/traced_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

/// Of the grid between whose nodes what sticks is taken as linear while lines are tried.
constexpr int kNodesPerSide = 96;

/// Steps of a line across the longer side of the object, and in all.
constexpr int kStepsAcross = 120;
constexpr int kMostSteps = 600;

/// Lines end so many steps beside the object.
constexpr int kStepsBeside = 4;

/// By so much free directions may lie in more than half a turn [rad]: they are known
/// about.
constexpr double kLenient = 0.03;

/// A straight line turns before it comes closer to what is free than this share of the
/// headings that are left.
constexpr double kAside = 0.1;

/// Lines that need to follow what is free no longer keep away from it by this share.
constexpr double kAsideThen = 0.25;

/// Directions in which a line may be led through a place: from `low` counter-clockwise;
/// any where nothing sticks.
struct Headings {
  bool any = true;
  double low = 0.0, width = 0.0;  // [rad]
  double middle() const { return low + 0.5 * width; }
};

/// Those that both leave.
Headings common(const Headings& one, const Headings& other) {
  if (one.any) return other;
  if (other.any) return one;
  const double off = std::remainder(other.low - one.low, 2.0 * kHalfTurn);
  const double low = std::max(0.0, off);
  const double high = std::min(one.width, off + other.width);
  return {false, one.low + low, high - low};
}

Headings headings_beside(const FreeDirections& free) {
  if (free.are_none()) return {};
  const auto gap = free.widest_gap();
  return {false, gap.from, gap.width - kHalfTurn};
}

/// The headings at a place, of which those at the nodes of a grid are kept.
class HeadingGrid {
 public:
  HeadingGrid(const Model& model, const FreeAt& free_at)
      : free_at_(free_at),
        grid_(PlaceGrid::over(model.pad_face, kNodesPerSide)),
        known_(static_cast<std::size_t>(grid_.count())) {}

  Headings at(const Vec2& p) {
    Headings sum;
    double weight = 0.0;
    double first = 0.0;
    double turned = 0.0;
    double width = 0.0;
    for (const auto& [node, share] : grid_.around(p)) {
      if (share == 0.0) continue;
      const Headings& there = at_node(node);
      if (there.any) continue;
      if (weight == 0.0) first = there.middle();
      weight += share;
      turned += share * std::remainder(there.middle() - first, 2.0 * kHalfTurn);
      width += share * there.width;
    }
    if (weight == 0.0) return sum;
    width /= weight;
    return {false, first + turned / weight - 0.5 * width, width};
  }

 private:
  const Headings& at_node(int node) {
    auto& known = known_[static_cast<std::size_t>(node)];
    if (!known) known = headings_beside(free_at_(grid_.place(node)));
    return *known;
  }

  const FreeAt& free_at_;
  PlaceGrid grid_;
  std::vector<std::optional<Headings>> known_;
};

/// How a line is led on, and back from where it begins: straight on as far as the
/// headings admit, or at a share of them.
struct Steer {
  bool straight = true;
  double first = 0.5;            // share of the headings where it begins
  double on = 0.5, back = 0.5;   // otherwise
  double closely = kEverywhere;  // [m] to how far along; from there on less
};

/// `closely` [m]: how far lines around what the start reaches, or what leads to the goal,
/// have to follow it.
std::vector<Steer> all_steers(double closely) {
  constexpr std::array kFirst = {0.5, 0.2, 0.8, 0.05, 0.95};
  constexpr std::array kShares = {0.15, 0.85, 0.03, 0.97, 0.006, 0.994};
  constexpr std::array kCloseShares = {0.03, 0.006, 0.0015};
  std::vector<Steer> steers;
  steers.reserve(kFirst.size() + 2 * kCloseShares.size() +
                 kShares.size() * kShares.size());
  for (const double first : kFirst) steers.push_back({.first = first});
  for (const double share : kCloseShares) {
    for (const double on : {share, 1.0 - share}) {
      steers.push_back(
          {.straight = false, .on = on, .back = 1.0 - on, .closely = closely});
    }
  }
  for (const double on : kShares) {
    for (const double back : kShares) {
      steers.push_back({.straight = false, .on = on, .back = back});
    }
  }
  return steers;
}

class Tracer {
 public:
  explicit Tracer(const Model& model) : outline_(model.pad_face) {
    low_ = high_ = outline_.front();
    for (const Vec2& vertex : outline_) {
      low_ = low_.cwiseMin(vertex);
      high_ = high_.cwiseMax(vertex);
    }
    step_ = (high_ - low_).maxCoeff() / kStepsAcross;
  }

  /// The region on the right of the line through a place; none if it ends on the object.
  template <class HeadingsAt>
  Loops region(const Vec2& place, const Steer& steer, const HeadingsAt& at) const {
    Steer begin = steer;
    begin.straight = false;
    begin.on = steer.first;
    const auto angle = heading(headings_at(place, at), begin, 1.0, 0.0, 0.0);
    if (!angle) return {};
    const auto on = way(place, steer, 1.0, *angle, at);
    const auto back = on ? way(place, steer, -1.0, *angle, at) : std::nullopt;
    if (!back) return {};
    std::vector<Vec2> loop(back->rbegin(), back->rend());
    loop.push_back(place);
    loop.insert(loop.end(), on->begin(), on->end());
    close_on_right(loop);
    return {loop};
  }

 private:
  std::optional<double> heading(const Headings& headings, const Steer& steer,
                                double sense, double last, double gone) const {
    if (headings.any) return last;
    if (headings.width < -kLenient) return std::nullopt;
    const double middle = headings.middle();
    if (headings.width <= 0.0) return middle;
    double share = sense > 0.0 ? steer.on : steer.back;
    if (gone > steer.closely) share = std::clamp(share, kAsideThen, 1.0 - kAsideThen);
    if (!steer.straight) return headings.low + share * headings.width;
    const double most = (0.5 - kAside) * headings.width;
    const double off = std::remainder(last - middle, 2.0 * kHalfTurn);
    return middle + std::clamp(off, -most, most);
  }

  template <class HeadingsAt>
  Headings headings_at(const Vec2& p, const HeadingsAt& at) const {
    return depth_inside(outline_, p) < 0.0 ? Headings() : at(p);
  }

  /// From a place on, or back, to beside the object: each step along a heading that is
  /// left where it begins, half way, and where it ends.
  template <class HeadingsAt>
  std::optional<std::vector<Vec2>> way(Vec2 p, const Steer& steer, double sense,
                                       double last, const HeadingsAt& at) const {
    std::vector<Vec2> way;
    for (int k = 0; k < kMostSteps; ++k) {
      const Headings begin = headings_at(p, at);
      auto angle = heading(begin, steer, sense, last, k * step_);
      for (int i = 0; angle && i < 2; ++i) {
        const Vec2 step = sense * step_ * towards(*angle);
        const Headings all = common(
            begin, common(headings_at(p + 0.5 * step, at), headings_at(p + step, at)));
        angle = heading(all, steer, sense, last, k * step_);
      }
      if (!angle) return std::nullopt;
      last = *angle;
      p += sense * step_ * towards(last);
      way.push_back(p);
      if (is_beside(p)) return way;
    }
    return std::nullopt;
  }

  bool is_beside(const Vec2& p) const {
    const double around = kStepsBeside * step_;
    return ((p - low_).array() < -around).any() || ((p - high_).array() > around).any();
  }

  /// Clockwise around the object, from the end of the line to where it begins.
  void close_on_right(std::vector<Vec2>& loop) const {
    constexpr double kCorner = 0.4;  // [rad]
    const Vec2 centre = 0.5 * (low_ + high_);
    const double radius = 2.0 * (high_ - low_).norm();
    const double from = angle_of(loop.back() - centre);
    double turn = std::remainder(angle_of(loop.front() - centre) - from, 2.0 * kHalfTurn);
    if (turn > 0.0) turn -= 2.0 * kHalfTurn;
    const int corners = std::max(2, static_cast<int>(-turn / kCorner));
    for (int k = 0; k <= corners; ++k) {
      loop.push_back(centre + radius * towards(from + turn * k / corners));
    }
  }

  const std::vector<Vec2>& outline_;
  Vec2 low_, high_;
  double step_ = 0.0;
};

/// Where lines begin: around the start, around the goal, and between them.
std::vector<Vec2> places_to_begin(const Vec2& start, const GoalSample& goal) {
  constexpr std::array kFromStart = {2e-5, 2e-4, 1e-3, 3e-3};  // [m]
  constexpr std::array kFromGoal = {2e-4, 2e-3};               // [m]
  constexpr int kAround = 8;
  constexpr int kBetween = 6;
  constexpr std::size_t kOfGoal = 12;
  std::vector<Vec2> places;
  for (const double distance : kFromStart) {
    for (int k = 0; k < kAround; ++k) {
      places.push_back(start + distance * towards(2.0 * kHalfTurn * k / kAround));
    }
  }
  const Vec2& middle = goal.middle.front();
  const std::size_t stride = (goal.border.size() + kOfGoal - 1) / kOfGoal;
  for (std::size_t k = 0; k < goal.border.size(); k += stride) {
    const Vec2 out = (goal.border[k] - middle).normalized();
    for (const double distance : kFromGoal) {
      places.push_back(goal.border[k] + distance * out);
    }
  }
  for (int k = 1; k < kBetween; ++k) {
    places.push_back(start + (middle - start) * k / kBetween);
  }
  return places;
}

Loops region_beside(const Model& model, const Vec2& place, const FreeAt& free_at,
                    const Steer& steer) {
  return Tracer(model).region(place, steer,
                              [&](const Vec2& p) { return headings_beside(free_at(p)); });
}

}  // namespace

std::vector<Loops> traced_regions(const Model& model, const GoalSample& goal,
                                  const FreeAt& free_at, int count,
                                  const std::function<bool()>& stopped) {
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  const Tracer tracer(model);
  HeadingGrid grid(model, free_at);
  const auto about = [&](const Vec2& p) { return grid.at(p); };
  const auto closely = [&](const Vec2& p) { return headings_beside(free_at(p)); };
  const auto separates = [&](const Loops& region) {
    const auto is_in = [&](const Vec2& place) { return is_between(region, place); };
    return !region.empty() && is_in(start) && std::ranges::none_of(goal.middle, is_in) &&
           std::ranges::none_of(goal.border, is_in);
  };
  const std::vector<Vec2> places = places_to_begin(start, goal);
  std::vector<Loops> regions;
  for (const Steer& steer : all_steers((goal.middle.front() - start).norm())) {
    for (const Vec2& place : places) {
      if (static_cast<int>(regions.size()) == count) return regions;
      if (stopped && stopped()) return regions;
      if (!separates(tracer.region(place, steer, about))) continue;
      Loops region = tracer.region(place, steer, closely);
      if (separates(region)) regions.push_back(std::move(region));
    }
  }
  return regions;
}

Loops region_ahead(const Model& model, const Vec2& apex, const FreeAt& free_at,
                   double aside, double closely) {
  return region_beside(
      model, apex, free_at,
      {.straight = false, .on = aside, .back = 1.0 - aside, .closely = closely});
}

Loops region_not_behind(const Model& model, const Vec2& apex, const FreeAt& free_at,
                        double aside, double closely) {
  return region_beside(
      model, apex, free_at,
      {.straight = false, .on = 1.0 - aside, .back = aside, .closely = closely});
}

}  // namespace prehensile
