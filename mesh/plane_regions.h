/// Regions of a plane made of polygons: union, difference and their parts, by a polygon
/// clipping library. Internal to the mesh layer.
#pragma once

#include <memory>
#include <vector>

#include "scene/frames.h"

namespace prehensile::internal {

/// A set of the plane bounded by polygons, coordinates kept to a nanometre.
class PlaneRegion {
 public:
  PlaneRegion();
  PlaneRegion(const PlaneRegion& other);
  PlaneRegion(PlaneRegion&& other) noexcept;
  PlaneRegion& operator=(PlaneRegion other) noexcept;
  ~PlaneRegion();

  /// Union of polygons, of either orientation; gaps below two micrometres are closed.
  static PlaneRegion of(const std::vector<std::vector<Vec2>>& polygons);

  PlaneRegion intersected(const PlaneRegion& other) const;
  PlaneRegion without(const PlaneRegion& other) const;

  double area() const;  ///< [m^2], holes taken out

  /// The largest connected part as one polygon, counter-clockwise: holes are opened to
  /// the outside by slits of 20 micrometres along +x. Empty if the region is.
  std::vector<Vec2> largest_part() const;

  /// Outer border of the largest part, holes filled.
  std::vector<Vec2> largest_border() const;

 private:
  struct Paths;
  std::unique_ptr<Paths> paths_;
};

/// Fewest vertices whose polygon stays within `tolerance` [m] of the ring (Douglas and
/// Peucker 1973).
std::vector<Vec2> simplified(const std::vector<Vec2>& ring, double tolerance);

}  // namespace prehensile::internal
