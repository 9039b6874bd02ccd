#include "mesh/plane_regions.h"

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>

#include "scene/segment_distance.h"

namespace prehensile::internal {
namespace {

constexpr double kPerMetre = 1e9;
constexpr double kSlit = 2e-5;  // [m]
constexpr double kSeam = 1e-6;  // [m]

ClipperLib::IntPoint to_grid(const Vec2& p) {
  return {std::llround(p.x() * kPerMetre), std::llround(p.y() * kPerMetre)};
}

Vec2 from_grid(const ClipperLib::IntPoint& p) {
  return {static_cast<double>(p.X) / kPerMetre, static_cast<double>(p.Y) / kPerMetre};
}

ClipperLib::Paths clipped(ClipperLib::ClipType how, const ClipperLib::Paths& a,
                          const ClipperLib::Paths& b) {
  ClipperLib::Clipper clipper;
  clipper.StrictlySimple(true);
  clipper.AddPaths(a, ClipperLib::ptSubject, true);
  clipper.AddPaths(b, ClipperLib::ptClip, true);
  ClipperLib::Paths result;
  clipper.Execute(how, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return result;
}

/// Grown by a distance, or shrunk.
ClipperLib::Paths grown(const ClipperLib::Paths& paths, double distance) {
  ClipperLib::ClipperOffset offset;
  offset.AddPaths(paths, ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
  ClipperLib::Paths result;
  offset.Execute(result, distance * kPerMetre);
  return result;
}

const ClipperLib::Path* largest_outer(const ClipperLib::Paths& paths) {
  const ClipperLib::Path* largest = nullptr;
  double most = 0.0;
  for (const ClipperLib::Path& path : paths) {
    const double area = ClipperLib::Area(path);
    if (area <= most) continue;
    most = area;
    largest = &path;
  }
  return largest;
}

std::vector<Vec2> ring_of(const ClipperLib::Path* path) {
  std::vector<Vec2> ring;
  if (!path) return ring;
  ring.reserve(path->size());
  for (const ClipperLib::IntPoint& p : *path) ring.push_back(from_grid(p));
  return ring;
}

/// A slit from the rightmost vertex of a hole to beyond everything.
ClipperLib::Path slit_from(const ClipperLib::Path& hole, ClipperLib::cInt end) {
  const auto start = *std::max_element(
      hole.begin(), hole.end(), [](const auto& a, const auto& b) { return a.X < b.X; });
  const auto half = static_cast<ClipperLib::cInt>(0.5 * kSlit * kPerMetre);
  const ClipperLib::cInt back = start.X - half;
  return {{back, start.Y - half},
          {end, start.Y - half},
          {end, start.Y + half},
          {back, start.Y + half}};
}

}  // namespace

struct PlaneRegion::Paths {
  ClipperLib::Paths rings;
};

PlaneRegion::PlaneRegion() : paths_(std::make_unique<Paths>()) {}
PlaneRegion::PlaneRegion(const PlaneRegion& other)
    : paths_(std::make_unique<Paths>(*other.paths_)) {}
PlaneRegion::PlaneRegion(PlaneRegion&& other) noexcept = default;
PlaneRegion& PlaneRegion::operator=(PlaneRegion other) noexcept {
  paths_.swap(other.paths_);
  return *this;
}
PlaneRegion::~PlaneRegion() = default;

PlaneRegion PlaneRegion::of(const std::vector<std::vector<Vec2>>& polygons) {
  ClipperLib::Paths paths;
  for (const std::vector<Vec2>& polygon : polygons) {
    ClipperLib::Path path;
    path.reserve(polygon.size());
    for (const Vec2& p : polygon) path.push_back(to_grid(p));
    const double area = ClipperLib::Area(path);
    if (area == 0.0) continue;
    if (area < 0.0) std::reverse(path.begin(), path.end());
    paths.push_back(std::move(path));
  }
  PlaneRegion region;
  // Neighbours meet to a nanometre only; growing and shrinking closes their seams.
  region.paths_->rings =
      grown(grown(clipped(ClipperLib::ctUnion, paths, {}), kSeam), -kSeam);
  return region;
}

PlaneRegion PlaneRegion::intersected(const PlaneRegion& other) const {
  PlaneRegion region;
  region.paths_->rings =
      clipped(ClipperLib::ctIntersection, paths_->rings, other.paths_->rings);
  return region;
}

PlaneRegion PlaneRegion::without(const PlaneRegion& other) const {
  PlaneRegion region;
  region.paths_->rings =
      clipped(ClipperLib::ctDifference, paths_->rings, other.paths_->rings);
  return region;
}

double PlaneRegion::area() const {
  double sum = 0.0;
  for (const ClipperLib::Path& ring : paths_->rings) sum += ClipperLib::Area(ring);
  return sum / (kPerMetre * kPerMetre);
}

std::vector<Vec2> PlaneRegion::largest_part() const {
  ClipperLib::Paths rings = paths_->rings;
  ClipperLib::cInt end = 0;
  for (const ClipperLib::Path& ring : rings) {
    for (const ClipperLib::IntPoint& p : ring) end = std::max(end, p.X);
  }
  end += static_cast<ClipperLib::cInt>(kSlit * kPerMetre);
  constexpr int kMostHoles = 200;
  for (int i = 0; i < kMostHoles; ++i) {
    const auto hole = std::find_if(rings.begin(), rings.end(), [](const auto& ring) {
      return !ClipperLib::Orientation(ring);
    });
    if (hole == rings.end()) break;
    rings = clipped(ClipperLib::ctDifference, rings, {slit_from(*hole, end)});
  }
  return ring_of(largest_outer(rings));
}

std::vector<Vec2> PlaneRegion::largest_border() const {
  return ring_of(largest_outer(paths_->rings));
}

namespace {

/// Marks the vertices between `first` and `last` that have to stay.
void keep_between(const std::vector<Vec2>& ring, std::size_t first, std::size_t last,
                  double tolerance, std::vector<bool>& keep) {
  std::vector<std::array<std::size_t, 2>> work = {{first, last}};
  const std::size_t n = ring.size();
  while (!work.empty()) {
    const auto [from, to] = work.back();
    work.pop_back();
    double most = tolerance;
    std::size_t farthest = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double distance = std::sqrt(
          squared_distance_to_segment(ring[i % n], ring[from % n], ring[to % n]));
      if (distance <= most) continue;
      most = distance;
      farthest = i;
    }
    if (farthest == from) continue;
    keep[farthest % n] = true;
    work.push_back({from, farthest});
    work.push_back({farthest, to});
  }
}

}  // namespace

std::vector<Vec2> simplified(const std::vector<Vec2>& ring, double tolerance) {
  if (ring.size() < 4) return ring;
  // Two vertices that stay: the lowest, and the one farthest from it.
  std::size_t one = 0;
  std::size_t two = 0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const bool lower = ring[i].x() < ring[one].x() ||
                       (ring[i].x() == ring[one].x() && ring[i].y() < ring[one].y());
    if (lower) one = i;
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if ((ring[i] - ring[one]).norm() > (ring[two] - ring[one]).norm()) two = i;
  }
  std::vector<bool> keep(ring.size(), false);
  keep[one] = keep[two] = true;
  const std::size_t n = ring.size();
  keep_between(ring, one, two > one ? two : two + n, tolerance, keep);
  keep_between(ring, two, one > two ? one : one + n, tolerance, keep);
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < n; ++i) {
    if (keep[i]) kept.push_back(ring[i]);
  }
  return kept;
}

}  // namespace prehensile::internal
