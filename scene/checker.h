/// Collects what is wrong with the values of a scene. Internal to the scene layer.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace prehensile {

inline constexpr double kLongest = 10.0;   // [m]
inline constexpr double kSmallest = 1e-6;  // [m]
inline constexpr std::size_t kMostVertices = 200;

std::string text(double value);
std::string text(const Vec2& p);

/// A later group of checks runs only if the earlier ones passed.
class Checker {
 public:
  void fault(const std::string& field, const std::string& what) {
    faults_.push_back({field, what});
  }
  /// NaN is never in range.
  void in_range(const std::string& field, double value, double low, double high,
                const char* unit);
  void length(const std::string& field, double value) {
    in_range(field, value, kSmallest, kLongest, "m");
  }
  void place(const std::string& field, const Vec2& p) {
    in_range(field, p.x(), -kLongest, kLongest, "m");
    in_range(field, p.y(), -kLongest, kLongest, "m");
  }
  void angle(const std::string& field, double value) {
    in_range(field, value, -100.0, 100.0, "rad");
  }
  void unit_quaternion(const std::string& field, const std::array<double, 4>& q);
  bool clean() const { return faults_.empty(); }
  std::vector<Fault> take() { return std::move(faults_); }

 private:
  std::vector<Fault> faults_;
};

void check_outline(Checker& checker, const std::string& field,
                   const std::vector<Vec2>& outline, std::size_t most = kMostVertices);

/// Of a scene with limits: their ranges, and that the start is within them.
void check_limits(Checker& checker, const Scene& scene);

void check_obstacles(Checker& checker, const Obstacles& obstacles);

}  // namespace prehensile
