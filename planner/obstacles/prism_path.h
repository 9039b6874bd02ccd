/// The way of a prism that rolls over its edges on a support, as geometry alone: it tips
/// about one edge after the other, and none of them slides. Internal to the planner.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "mechanics/model.h"

namespace prehensile {

class PrismPath {
 public:
  /// Of Model::prism, which lies with a side on the support of `contact` and looks as at
  /// psi = 0, by dpsi [rad].
  PrismPath(const Model& model, const PushContact& contact, double dpsi);

  /// Pose of O in the frame that O has at the start, after the share s in [0, 1] of the
  /// angle.
  Eigen::Isometry3d at(double s) const;

  /// No point of the prism travels farther [m].
  double length() const { return length_; }

 private:
  /// Tips about one edge: up to this angle, about this point of the section.
  struct Tip {
    double until = 0.0;           // [rad] >= 0
    Vec3 edge_O = Vec3::Zero();   // in O
    Vec3 edge_O0 = Vec3::Zero();  // where it rests, in O of the start
  };

  Eigen::Matrix3d rotation(double angle) const;
  int lowest(const Vec3& up) const;
  double next_flat(int pivot, double angle, const Vec3& up, int& next) const;

  Vec3 axis_ = Vec3::UnitX();  // turns by angles > 0 about it
  double angle_ = 0.0;         // [rad] of the whole way, >= 0
  double length_ = 0.0;
  std::vector<Vec3> section_;  // in O
  std::vector<Tip> tips_;
};

}  // namespace prehensile
