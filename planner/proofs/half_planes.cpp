#include "planner/proofs/half_planes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr int kNodesPerSide = 32;

/// Between start and goal there has to be this much [m].
constexpr double kLeastGap = 2e-4;

/// Lines that are looked at for each direction, at most.
constexpr int kMostLines = 24;

/// By so much free directions may lead across a line that is tried [rad]: they are known
/// at some places only.
constexpr double kAcross = 0.02;

struct Place {
  Vec2 p_OF;
  FreeDirections free;
};

/// A line across `u`, and how far from leading across it the free directions are there.
struct Line {
  Vec2 u;
  double at = 0.0;      // [m] u.p
  double margin = 0.0;  // [rad]
};

std::vector<Place> places_on(const PlaceGrid& grid, const Model& model,
                             const FreeAt& free_at) {
  std::vector<Place> places;
  for (int node = 0; node < grid.count(); ++node) {
    const Vec2 p_OF = grid.place(node);
    if (depth_inside(model.pad_face, p_OF) < 0.0) continue;
    places.push_back({p_OF, free_at(p_OF)});
  }
  return places;
}

double margin_of(const Line& line, double angle, const std::vector<Place>& places,
                 double near) {
  double margin = 0.5 * std::numbers::pi;
  for (const Place& place : places) {
    if (std::abs(line.u.dot(place.p_OF) - line.at) > near) continue;
    margin = std::min(margin, place.free.distance(angle) - 0.5 * std::numbers::pi);
    if (margin < -kAcross) break;
  }
  return margin;
}

/// The best line across a direction.
std::optional<Line> line_across(double angle, const Vec2& start,
                                const std::vector<Vec2>& goals,
                                const std::vector<Place>& places, double spacing) {
  Line line{.u = towards(angle)};
  const double low = line.u.dot(start);
  double high = INFINITY;
  for (const Vec2& goal : goals) high = std::min(high, line.u.dot(goal));
  const double gap = high - low;
  if (gap < kLeastGap) return std::nullopt;
  const int count = std::clamp(static_cast<int>(gap / spacing), 1, kMostLines);
  std::optional<Line> best;
  for (int i = 0; i < count; ++i) {
    line.at = low + gap * (i + 0.5) / count;
    line.margin = margin_of(line, angle, places, spacing);
    if (line.margin >= -kAcross && (!best || line.margin > best->margin)) best = line;
  }
  return best;
}

/// What is behind the line, far beyond the object.
Loops region_behind(const Line& line, double size) {
  const Vec2 middle = line.at * line.u;
  const Vec2 along = size * perp(line.u), back = 2.0 * size * line.u;
  return {{middle - along, middle + along, middle + along - back, middle - along - back}};
}

}  // namespace

std::vector<Loops> half_planes(const Model& model, const std::vector<Vec2>& goals,
                               const FreeAt& free_at, int count) {
  const PlaceGrid grid = PlaceGrid::over(model.pad_face, kNodesPerSide);
  const std::vector<Place> places = places_on(grid, model, free_at);
  const Vec2 start = finger_in_object(model.scene.start.X_HO);
  std::vector<Line> lines;
  for (int k = 0; k < FreeDirections::kLookedAt; ++k) {
    const double angle = FreeDirections::direction(k);
    const auto line = line_across(angle, start, goals, places, grid.spacing);
    if (line) lines.push_back(*line);
  }
  std::ranges::stable_sort(lines, std::ranges::greater(), &Line::margin);
  std::vector<Loops> regions;
  const double size = grid.spacing * std::max(grid.nx, grid.ny) + start.norm();
  for (const Line& line : lines) {
    if (static_cast<int>(regions.size()) == count) break;
    regions.push_back(region_behind(line, size));
  }
  return regions;
}

}  // namespace prehensile
