/// Sums over the finger points, the only loops of the exact solver. Internal to the
/// mechanics layer.
///
/// With c = (v_x - w y, v_y + w x) the velocity of a point, each point adds b c/|c| to
/// the resisting force. Four points go side by side in a fixed order, so the sums are the
/// same on every processor. A point at rest adds nothing (its force is the pivot's
/// business).
#pragma once

#include <Eigen/Core>

#include "mechanics/planar_problem.h"

namespace prehensile {

/// Columns padded with bound 0 to whole lanes, aligned to 32 bytes.
struct PaddedColumns {
  static constexpr int kLanes = 4;
  const double* x;
  const double* y;
  const double* b;
  int padded;
  int* sums;  ///< counts the sums over all points
};

namespace pad_kernels {

using Lanes = Eigen::Array<double, PaddedColumns::kLanes, 1>;
using Column = Eigen::Map<const Lanes, Eigen::Aligned32>;

/// Keeps 0/0 away from points at rest; smaller than the square of any rate that counts.
inline constexpr double kTiny = 1e-200;

struct PointLanes {
  Lanes x, y, b, cx, cy, square;
  PointLanes(const PaddedColumns& pads, int j, const PlanarTwist& u)
      : x(Column(pads.x + j)), y(Column(pads.y + j)), b(Column(pads.b + j)) {
    cx = u[0] - u[2] * y;
    cy = u[1] + u[2] * x;
    square = (cx * cx + cy * cy).max(kTiny);
  }
};

/// Gradient of D at u.
inline PlanarWrench resisting_wrench(const PaddedColumns& pads, const PlanarTwist& u) {
  ++*pads.sums;
  Lanes fx = Lanes::Zero();
  Lanes fy = Lanes::Zero();
  Lanes m = Lanes::Zero();
  for (int j = 0; j < pads.padded; j += PaddedColumns::kLanes) {
    const PointLanes at(pads, j, u);
    const Lanes per_rate = at.b / at.square.sqrt();
    const Lanes gx = per_rate * at.cx;
    const Lanes gy = per_rate * at.cy;
    fx += gx;
    fy += gy;
    m += at.x * gy - at.y * gx;
  }
  return {fx.sum(), fy.sum(), m.sum()};
}

/// Force along m of the gradient of D at u.
inline double resisting_force(const PaddedColumns& pads, const PlanarTwist& u,
                              const Vec2& m) {
  ++*pads.sums;
  Lanes sum = Lanes::Zero();
  for (int j = 0; j < pads.padded; j += PaddedColumns::kLanes) {
    const PointLanes at(pads, j, u);
    sum += at.b * (m.x() * at.cx + m.y() * at.cy) / at.square.sqrt();
  }
  return sum.sum();
}

/// First and second derivative of D along d.
struct LineSlope {
  double first;
  double second;
};

inline LineSlope line_slope(const PaddedColumns& pads, const PlanarTwist& u,
                            const PlanarTwist& d) {
  ++*pads.sums;
  Lanes first = Lanes::Zero();
  Lanes second = Lanes::Zero();
  for (int j = 0; j < pads.padded; j += PaddedColumns::kLanes) {
    const PointLanes at(pads, j, u);
    const Lanes dx = d[0] - d[2] * at.y;
    const Lanes dy = d[1] + d[2] * at.x;
    const Lanes per_rate = at.b / at.square.sqrt();
    const Lanes across = dx * at.cy - dy * at.cx;
    first += per_rate * (dx * at.cx + dy * at.cy);
    second += per_rate * across * across / at.square;
  }
  return {first.sum(), second.sum()};
}

/// Gradient and second derivative of D; the latter is sum b/|c|^3 h h', with h the wrench
/// of a quarter turn of c at the point.
struct Curvature {
  PlanarWrench gradient;
  Eigen::Matrix3d hessian;
};

inline Curvature curvature(const PaddedColumns& pads, const PlanarTwist& u) {
  ++*pads.sums;
  Lanes fx = Lanes::Zero();
  Lanes fy = Lanes::Zero();
  Lanes m = Lanes::Zero();
  Lanes xx = Lanes::Zero();
  Lanes xy = Lanes::Zero();
  Lanes yy = Lanes::Zero();
  Lanes xm = Lanes::Zero();
  Lanes ym = Lanes::Zero();
  Lanes mm = Lanes::Zero();
  for (int j = 0; j < pads.padded; j += PaddedColumns::kLanes) {
    const PointLanes at(pads, j, u);
    const Lanes per_rate = at.b / at.square.sqrt();
    const Lanes gx = per_rate * at.cx;
    const Lanes gy = per_rate * at.cy;
    fx += gx;
    fy += gy;
    m += at.x * gy - at.y * gx;
    const Lanes scale = per_rate / at.square;
    const Lanes hm = at.x * at.cx + at.y * at.cy;
    const Lanes sx = scale * at.cx;
    const Lanes sy = scale * at.cy;
    xx += sy * at.cy;
    xy -= sy * at.cx;
    yy += sx * at.cx;
    xm -= sy * hm;
    ym += sx * hm;
    mm += scale * hm * hm;
  }
  Curvature result;
  result.gradient = {fx.sum(), fy.sum(), m.sum()};
  const double hxy = xy.sum();
  const double hxm = xm.sum();
  const double hym = ym.sum();
  result.hessian << xx.sum(), hxy, hxm, hxy, yy.sum(), hym, hxm, hym, mm.sum();
  return result;
}

}  // namespace pad_kernels
}  // namespace prehensile
