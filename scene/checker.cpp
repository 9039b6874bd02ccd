#include "scene/checker.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "scene/outline.h"

namespace prehensile {

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.10g", value);
  return buffer;
}

std::string text(const Vec2& p) {
  return std::string("[").append(text(p.x())).append(", ").append(text(p.y())) + ']';
}

void Checker::in_range(const std::string& field, double value, double low, double high,
                       const char* unit) {
  if (value >= low && value <= high) return;
  std::string what = text(value) + ": expected a number from " + text(low);
  const bool open = high == std::numeric_limits<double>::infinity();
  what += open ? " up" : " to " + text(high);
  fault(field, what + (*unit ? std::string(" ") + unit : std::string()));
}

void Checker::unit_quaternion(const std::string& field, const std::array<double, 4>& q) {
  double norm = 0.0;
  for (const double component : q) norm += component * component;
  if (std::abs(norm - 1.0) < 1e-3) return;
  fault(field,
        "norm " + text(std::sqrt(norm)) + ": expected a unit quaternion x, y, z, w");
}

void check_outline(Checker& checker, const std::string& field,
                   const std::vector<Vec2>& outline, std::size_t most) {
  if (outline.size() < 3 || outline.size() > most) {
    checker.fault(field, std::to_string(outline.size()) + " vertices: expected 3 to " +
                             std::to_string(most));
    return;
  }
  for (const Vec2& v : outline) checker.place(field, v);
  if (!checker.clean()) return;
  if (!is_simple(outline)) {
    checker.fault(field,
                  "edges cross, touch or have no length: expected a simple polygon");
    return;
  }
  const double area = properties_of(outline).area;
  if (!(area > kSmallest * kSmallest)) {
    checker.fault(field,
                  "area " + text(area) +
                      " m^2: expected vertices in counter-clockwise order around a "
                      "positive area");
  }
}

}  // namespace prehensile
