#include "planner/obstacles/prism_path.h"

#include <algorithm>
#include <cmath>

#include "scene/constants.h"

namespace prehensile {
namespace {

constexpr double kSameAngle = 1e-9;  // [rad]

/// Over the length of the way: vertices that differ by less lie on the support together.
constexpr double kSameHeight = 1e-9;

Vec3 in_space(const Vec2& in_plane, double z) { return {in_plane.x(), in_plane.y(), z}; }

}  // namespace

PrismPath::PrismPath(const Model& model, const PushContact& contact, double dpsi)
    : angle_(std::abs(dpsi)) {
  const LyingPrism& prism = *model.prism;
  axis_ = std::copysign(1.0, dpsi) * in_space(prism.axis, 0.0);
  for (const Vec2& p : prism.section) {
    section_.push_back(in_space(p.x() * prism.lateral, p.y()));
  }
  double width = 0.0;
  for (const Vec3& p : section_) {
    for (const Vec3& q : section_) width = std::max(width, (p - q).norm());
  }
  length_ = angle_ * width;

  const Vec3 up = in_space(contact.n, 0.0);
  int pivot = lowest(up);
  Vec3 rests = section_[static_cast<std::size_t>(pivot)];
  double angle = 0.0;
  while (angle < angle_) {
    int next = pivot;
    const Vec3& edge = section_[static_cast<std::size_t>(pivot)];
    angle = next_flat(pivot, angle, up, next);
    tips_.push_back({angle, edge, rests});
    rests += rotation(angle) * (section_[static_cast<std::size_t>(next)] - edge);
    pivot = next;
  }
}

Eigen::Isometry3d PrismPath::at(double s) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (tips_.empty()) return pose;
  const double angle = s * angle_;
  auto tip = std::ranges::find_if(tips_, [&](const Tip& t) { return angle <= t.until; });
  if (tip == tips_.end()) --tip;
  pose.linear() = rotation(angle);
  pose.translation() = tip->edge_O0 - pose.linear() * tip->edge_O;
  return pose;
}

Eigen::Matrix3d PrismPath::rotation(double angle) const {
  return Eigen::AngleAxisd(angle, axis_).toRotationMatrix();
}

/// Of the vertices on the support the one that stays there.
int PrismPath::lowest(const Vec3& up) const {
  int best = 0;
  const double same = kSameHeight * length_;
  for (int i = 1; i < static_cast<int>(section_.size()); ++i) {
    const Vec3 d =
        section_[static_cast<std::size_t>(i)] - section_[static_cast<std::size_t>(best)];
    const double higher = up.dot(d);
    const double rises = up.dot(axis_.cross(d));
    if (higher < -same || (higher <= same && rises < 0.0)) best = i;
  }
  return best;
}

/// The angle beyond `angle` at which another vertex comes down to the support.
double PrismPath::next_flat(int pivot, double angle, const Vec3& up, int& next) const {
  double least = kInfinity;
  for (int i = 0; i < static_cast<int>(section_.size()); ++i) {
    if (i == pivot) continue;
    const Vec3 d =
        section_[static_cast<std::size_t>(i)] - section_[static_cast<std::size_t>(pivot)];
    // Its height over the pivot: up.dot(d) cos(angle) + up.dot(axis x d) sin(angle).
    const double zero = std::atan2(up.dot(d), -up.dot(axis_.cross(d)));
    double ahead = std::fmod(zero - angle, kPi);
    if (ahead < kSameAngle) ahead += kPi;
    if (ahead < kSameAngle) ahead += kPi;
    if (angle + ahead < least) {
      least = angle + ahead;
      next = i;
    }
  }
  return least;
}

}  // namespace prehensile
