#include "mechanics/pad_friction.h"

#include <limits>

#include "mechanics/slide_equation.h"

namespace prehensile {

using pad_kernels::line_slope;
using pad_kernels::LineSlope;
using pad_kernels::resisting_wrench;

namespace {

constexpr int kLanes = PaddedColumns::kLanes;
constexpr int kLineSteps = 200;

/// Distance of a point from the centre of rotation, in units of the pads, below which the
/// point is the pivot: rounding of the twist could not tell.
constexpr double kMet = 1e-11;

constexpr double kNear = 1e-9;  ///< distance below which points may be merged

}  // namespace

PadFriction::Frame PadFriction::frame_of(const PlanarGrasp& grasp) noexcept {
  Frame frame;
  double sum = 0.0;
  double sum_x = 0.0;
  double sum_y = 0.0;
  bool sane = grasp.count > 0 && grasp.count <= PlanarGrasp::kCapacity;
  for (int j = 0; sane && j < grasp.count; ++j) {
    sane = grasp.bound[j] >= 0.0;
    sum += grasp.bound[j];
    sum_x += grasp.bound[j] * grasp.x[j];
    sum_y += grasp.bound[j] * grasp.y[j];
  }
  if (!sane || !(sum > 0.0) || !std::isfinite(sum_x + sum_y)) return frame;
  frame.centre = {sum_x / sum, sum_y / sum};
  double first = 0.0;
  double second = 0.0;
  for (int j = 0; j < grasp.count; ++j) {
    const Vec2 r = Vec2(grasp.x[j], grasp.y[j]) - frame.centre;
    first += grasp.bound[j] * r.norm();
    second += grasp.bound[j] * r.squaredNorm();
  }
  frame.length = std::sqrt(second / sum);
  frame.torque_radius = first / sum;
  frame.force = sum;
  return frame;
}

PadFriction::PadFriction(const PlanarGrasp& grasp, const Frame& frame,
                         bool is_point) noexcept
    : count_(grasp.count),
      padded_((grasp.count + kLanes - 1) / kLanes * kLanes),
      is_point_(is_point) {
  const double per_length = 1.0 / frame.length;
  const double per_force = 1.0 / frame.force;
  double lever = 0.0;
  double reach = 0.0;
  for (int j = 0; j < count_; ++j) {
    x_[j] = is_point ? 0.0 : (grasp.x[j] - frame.centre.x()) * per_length;
    y_[j] = is_point ? 0.0 : (grasp.y[j] - frame.centre.y()) * per_length;
    b_[j] = grasp.bound[j] * per_force;
    const double r2 = x_[j] * x_[j] + y_[j] * y_[j];
    lever += b_[j] * std::sqrt(r2);
    reach = std::max(reach, r2);
  }
  for (int j = count_; j < padded_; ++j) x_[j] = y_[j] = b_[j] = 0.0;
  torque_radius_ = is_point ? 1.0 : lever;
  reach_ = std::sqrt(reach);
}

bool PadFriction::merge_near_points() noexcept {
  bool merged = false;
  for (int j = 1; j < count_; ++j) {
    for (int i = 0; i < j; ++i) {
      const Vec2 apart = at(j) - at(i);
      if (apart.isZero(0.0) || apart.norm() > kNear) continue;
      x_[j] = x_[i];
      y_[j] = y_[i];
      merged = true;
      break;
    }
  }
  return merged;
}

double PadFriction::dissipation(const PlanarTwist& u) const noexcept {
  return resisting_wrench(points(), u).dot(u);
}

PlanarWrench PadFriction::resistance(const PlanarTwist& u,
                                     const PivotPoint& pivot) const noexcept {
  const PlanarWrench smooth = resisting_wrench(points(), u);
  if (pivot.index < 0) return smooth;
  return smooth + wrench_of(at(pivot.index), pivot.force);
}

PivotPoint PadFriction::pivot_at(const PlanarTwist& u) const noexcept {
  if (u[2] == 0.0) return {};
  const int j = nearest_to_centre(u);
  const double speed = point_velocity(u, at(j)).norm();
  if (speed > kMet * std::abs(u[2])) return {};
  return {j, Vec2::Zero()};
}

PlanarTwist PadFriction::rotation_about(int j, double omega) const {
  return {omega * y_[j], -(omega * x_[j]), omega};
}

PlanarTwist PadFriction::scaled_twist(const PlanarTwist& u, const PivotPoint& pivot,
                                      double scale) const noexcept {
  if (pivot.index < 0) return scale * u;
  return rotation_about(pivot.index, scale * u[2]);
}

int PadFriction::nearest_to_centre(const PlanarTwist& u) const noexcept {
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < count_; ++j) {
    const double cx = u[0] - u[2] * y_[j];
    const double cy = u[1] + u[2] * x_[j];
    const double square = cx * cx + cy * cy;
    if (square < least && b_[j] > 0.0) {
      least = square;
      nearest = j;
    }
  }
  return nearest;
}

double PadFriction::merged_bound(int j) const noexcept {
  double sum = 0.0;
  for (int i = 0; i < count_; ++i) {
    if (x_[i] == x_[j] && y_[i] == y_[j]) sum += b_[i];
  }
  return sum;
}

/// Along the line, power falls to the left and rises to the right of a pivot if the
/// pivot's own bound covers the slope of all other points there.
bool PadFriction::rests_on_pivot(const PlanarTwist& u0, const PlanarTwist& d,
                                 const PlanarWrench& w,
                                 LowestOnLine& lowest) const noexcept {
  for (int j = 0; j < count_; ++j) {
    const Vec2 a = point_velocity(u0, at(j));
    const Vec2 b = point_velocity(d, at(j));
    const double length = b.norm();
    if (length == 0.0 || std::abs(cross(a, b)) > kMet * length * std::abs(u0[2] + d[2])) {
      continue;
    }
    const double s = -a.dot(b) / (length * length);
    const PlanarTwist u = rotation_about(j, u0[2] + s * d[2]);
    const double slope = (resisting_wrench(points(), u) - w).dot(d);
    if (std::abs(slope) > merged_bound(j) * length) continue;
    lowest = {true, u, {j, Vec2::Zero()}, 0};
    return true;
  }
  return false;
}

LowestOnLine PadFriction::lowest(const PlanarTwist& u0, const PlanarTwist& d,
                                 const PlanarWrench& w,
                                 const PlanarTwist* guess) const noexcept {
  const double pull = w.dot(d);
  const double steepest = dissipation(d);
  if (!(std::abs(pull) < steepest * (1.0 - 1e-14))) return {};

  // Start at the answer of the ellipsoid with the same torque radius.
  const PlanarTwist metric(1.0, 1.0, torque_radius_ * torque_radius_);
  const double dd = d.dot(metric.cwiseProduct(d));
  const double middle = -d.dot(metric.cwiseProduct(u0)) / dd;
  const PlanarTwist across = u0 + middle * d;
  const double width = std::sqrt(across.dot(metric.cwiseProduct(across)) / dd);
  const double k = std::clamp(pull / std::sqrt(dd), -0.99, 0.99);
  double s = middle + width * k / std::sqrt(1.0 - k * k);
  if (guess != nullptr) s = d.dot(metric.cwiseProduct(*guess - u0)) / dd;

  const double enough = 4e-16 * (steepest + std::abs(pull));
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  double stride = std::max(width, 1e-6 * std::abs(middle) + 1e-100);
  LowestOnLine lowest;
  int step = 0;
  for (; step < kLineSteps; ++step) {
    const LineSlope slope = line_slope(points(), u0 + s * d, d);
    const double excess = slope.first - pull;
    if (std::abs(excess) <= enough) break;
    (excess > 0.0 ? high : low) = s;
    if (step == 8 && rests_on_pivot(u0, d, w, lowest)) return lowest;
    double next = s - excess / slope.second;
    if (!(next > low && next < high)) {
      const bool closed = std::isfinite(low) && std::isfinite(high);
      next = closed ? 0.5 * (low + high) : s + (excess > 0.0 ? -stride : stride);
      stride *= 4.0;
    } else if (std::abs(next - s) > 8.0 * stride) {
      next = s + std::copysign(8.0 * stride, next - s);
      stride *= 4.0;
    }
    if (next == s || next == low || next == high) break;
    s = next;
  }
  lowest = {true, u0 + s * d, {}, step};
  lowest.pivot = pivot_at(lowest.u);
  if (lowest.pivot.index >= 0) {
    lowest.u = rotation_about(lowest.pivot.index, lowest.u[2]);
  }
  return lowest;
}

int PadFriction::slides(const SlideQuestion& question, int capacity,
                        double* roots) const noexcept {
  SlideQuestion stretched = question;
  stretched.V[2] *= torque_radius_;
  double guess[2];
  const int guesses = slides_on_sphere(stretched, guess);
  if (question.V[2] == 0.0) {
    const int count = std::min(capacity, guesses);
    std::copy_n(guess, count, roots);
    return count;
  }
  const SlideEquation equation{points(), question};
  if (capacity <= 2) {
    int count = 0;
    for (int i = 0; i < guesses; ++i) {
      if (equation.polish(guess[i]) && question.slips(guess[i]))
        roots[count++] = guess[i];
    }
    if (count > 0) return count;
  }
  return equation.scan(stretched.V.norm(), capacity, roots);
}

bool PadFriction::nearest_slide(const SlideQuestion& question,
                                double& root) const noexcept {
  const SlideEquation equation{points(), question};
  if (question.V[2] != 0.0 && equation.polish(root)) return true;
  SlideQuestion stretched = question;
  stretched.V[2] *= torque_radius_;
  stretched.start = -question.slip * std::numeric_limits<double>::infinity();
  double guess[2];
  const int guesses = slides_on_sphere(stretched, guess);
  bool found = false;
  double nearest = 0.0;
  for (int i = 0; i < guesses; ++i) {
    if (question.V[2] != 0.0 && !equation.polish(guess[i])) continue;
    if (!found || std::abs(guess[i] - root) < std::abs(nearest - root))
      nearest = guess[i];
    found = true;
  }
  root = nearest;
  return found;
}

}  // namespace prehensile
