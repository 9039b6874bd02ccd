#include "scene/constants.h"
#include "scene/scene.h"

namespace prehensile {

bool can_roll(const Object& object) {
  const auto* cylinder = std::get_if<CylinderShape>(&object.shape);
  return cylinder && cylinder->axis != Axis::kZ;
}

std::optional<double> length_in_plane(const PusherFeature& feature) {
  if (const auto* line = std::get_if<LineFeature>(&feature)) {
    return line->length.value_or(kInfinity);
  }
  if (const auto* plane = std::get_if<PlaneFeature>(&feature)) {
    return plane->length.value_or(kInfinity);
  }
  return std::nullopt;
}

double width_across_plane(const PusherFeature& feature) {
  if (const auto* upright = std::get_if<UprightFeature>(&feature)) {
    return upright->length.value_or(kInfinity);
  }
  if (const auto* plane = std::get_if<PlaneFeature>(&feature)) {
    return plane->width.value_or(kInfinity);
  }
  return 0.0;
}

}  // namespace prehensile
