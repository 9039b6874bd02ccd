#include "problems/pushed_plate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/LU>

#include "mechanics/limit_surface.h"
#include "mechanics/planar_instant.h"
#include "scene/outline.h"
#include "scene/pad_quadrature.h"

namespace prehensile {
namespace {

constexpr int kMostPoints = 90;
constexpr int kFinePoints = 4000;  ///< of the grid that measures a torque radius

/// A square cell of a grid.
PadCell square_cell(const Vec2& centre, double side) {
  PadCell cell;
  const double h = 0.5 * side;
  for (const Vec2& corner : {Vec2(-h, -h), Vec2(h, -h), Vec2(h, h), Vec2(-h, h)}) {
    cell.shape.add(centre + corner);
  }
  cell.measure = side * side;
  cell.centroid = centre;
  cell.reach = h * std::sqrt(2.0);
  return cell;
}

/// Cells of this side that overlap the outline, each by its part inside.
Plate over_grid(const std::vector<Vec2>& outline, double side) {
  Vec2 low = outline[0];
  Vec2 high = outline[0];
  for (const Vec2& vertex : outline) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const std::vector<Triangle> pieces = triangulate(outline);
  const Vec2 cells = ((high - low) / side).array().ceil();
  const Vec2 corner = 0.5 * (low + high - side * cells);
  Plate plate;
  for (int i = 0; i < static_cast<int>(cells.x()); ++i) {
    for (int j = 0; j < static_cast<int>(cells.y()); ++j) {
      const PressedCell part =
          press(square_cell(corner + side * Vec2(i + 0.5, j + 0.5), side), pieces,
                CellFrame(PlanarPose{}));
      if (part.measure <= 1e-3 * side * side) continue;
      plate.support.push_back(part.centroid);
      plate.shares.push_back(part.measure);
    }
  }
  const double sum = std::accumulate(plate.shares.begin(), plate.shares.end(), 0.0);
  for (double& share : plate.shares) share /= sum;
  plate.outline = outline;
  return plate;
}

/// How the plate moves in one step, twist about its pressure centre; zero if unsolved.
struct Step {
  PlanarTwist V = PlanarTwist::Zero();
  bool solved = false;
  bool slips = false;
};

class Simulation {
 public:
  Simulation(const Plate& plate, SupportModel model, const Tips& tips,
             const PlanarPose& X_WO)
      : plate_(plate),
        model_(model),
        tips_(tips),
        centre_(plate.centre()),
        surface_{1.0, plate.torque_radius()} {
    result_.X_WO = X_WO;
  }

  void advance(const TipPlaces& from, const TipPlaces& to) {
    touches_ = 0;
    const PlanarPose X_OW = inverse(result_.X_WO);
    for (int i = 0; i < tips_.count; ++i) {
      const TipGap contact = tip_gap(plate_, transform(X_OW, to[i]), tips_.radius);
      if (contact.gap < 0.0) add({contact, to[i] - from[i]});
    }
    if (touches_ == 0) {
      result_.kept_contact = result_.kept_contact && !result_.touched;
      return;
    }
    result_.touched = true;
    const Step step = solve();
    result_.failures += !step.solved;
    result_.slipped = result_.slipped || step.slips;
    move(step.V);
  }

  const PushedPlate& result() const { return result_; }

 private:
  struct Touch {
    TipGap contact;
    Vec2 motion;  // of the tip in this step, in W
  };

  void add(const Touch& touch) {
    if (touches_ == 1 && touch.contact.n_O.dot(touch_[0].contact.n_O) < 0.999) {
      if (touch.contact.gap < touch_[0].contact.gap) touch_[0] = touch;
      return;
    }
    touch_[touches_++] = touch;
  }

  /// The pusher moves so that every touching point leaves its tip along the normal.
  PlanarDrive drive_of_touches() const {
    const double theta = result_.X_WO.theta;
    PlanarDrive drive;
    drive.count = touches_;
    drive.mu = tips_.mu;
    drive.n_H = rotated(theta, touch_[0].contact.n_O);
    const Vec2 t = drive.t_H();
    for (int i = 0; i < touches_; ++i) {
      drive.p_HC[i] = rotated(theta, touch_[i].contact.p_OC - centre_);
    }
    const double out = -touch_[0].contact.gap;
    double turn = 0.0;
    double along = touch_[0].motion.dot(t);
    if (touches_ == 2) {
      const double apart = (drive.p_HC[1] - drive.p_HC[0]).dot(t);
      turn = (touch_[0].contact.gap - touch_[1].contact.gap) / -apart;
      along = 0.5 * (along + touch_[1].motion.dot(t));
    }
    const Vec2 rate = out * drive.n_H + along * t;
    drive.V_HP << rate - turn * perp(drive.p_HC[0]), turn;
    return drive;
  }

  Step solve() {
    const PlanarDrive drive = drive_of_touches();
    const PlanarInstant answer =
        model_ == SupportModel::kPoints
            ? solve_points(result_.X_WO.theta, drive)
            : solve_limit_surface(surface_, PlanarWrench::Zero(), drive);
    if (!usable(answer.status)) return {};
    Step step{answer.V_HO, true, false};
    for (int i = 0; i < answer.pusher_count; ++i) {
      step.slips = step.slips || answer.pusher[i].mode != ContactMode::kStick;
    }
    return step;
  }

  PlanarInstant solve_points(double theta, const PlanarDrive& drive) {
    PlanarGrasp grasp;
    grasp.count = static_cast<int>(plate_.support.size());
    for (int j = 0; j < grasp.count; ++j) {
      const Vec2 p = rotated(theta, plate_.support[j] - centre_);
      grasp.x[j] = p.x();
      grasp.y[j] = p.y();
      grasp.bound[j] = plate_.shares[j];
    }
    return solve_planar(grasp, drive);
  }

  /// The centre moves at the attitude in the middle of the step.
  void move(const PlanarTwist& V) {
    const Vec2 p = transform(result_.X_WO, centre_) + rotated(0.5 * V[2], V.head<2>());
    result_.X_WO.theta += V[2];
    const Vec2 origin = p - rotated(result_.X_WO.theta, centre_);
    result_.X_WO.x = origin.x();
    result_.X_WO.y = origin.y();
  }

  const Plate& plate_;
  SupportModel model_;
  Tips tips_;
  Vec2 centre_;
  LimitSurface surface_;
  std::array<Touch, 2> touch_;
  int touches_ = 0;
  PushedPlate result_;
};

}  // namespace

Vec2 Plate::centre() const {
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < support.size(); ++i) sum += shares[i] * support[i];
  return sum;
}

double Plate::torque_radius() const {
  const Vec2 c = centre();
  double sum = 0.0;
  for (std::size_t i = 0; i < support.size(); ++i) {
    sum += shares[i] * (support[i] - c).norm();
  }
  return sum;
}

Plate uniform_plate(const std::vector<Vec2>& outline, int points) {
  const double area = properties_of(outline).area;
  double side = std::sqrt(area / points);
  Plate plate = over_grid(outline, side);
  while (plate.support.size() > kMostPoints) {
    side *= 1.05;
    plate = over_grid(outline, side);
  }
  // The load of a cell is farther from the centre than its centroid, on the average.
  const Plate fine = over_grid(outline, std::sqrt(area / kFinePoints));
  const double spread = fine.torque_radius() / plate.torque_radius();
  const Vec2 centre = plate.centre();
  for (Vec2& p : plate.support) p = centre + spread * (p - centre);
  return plate;
}

Plate loaded_plate(const Plate& plate, double edge_load) {
  constexpr double kLeast = 0.02;
  const Vec2 centre = plate.centre();
  const std::size_t n = plate.support.size();
  double mean_square = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    mean_square += plate.shares[i] * (plate.support[i] - centre).squaredNorm();
  }
  Plate out = plate;
  Vec2 moment = Vec2::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 r = plate.support[i] - centre;
    out.shares[i] *=
        std::max(kLeast, 1.0 + edge_load * (r.squaredNorm() / mean_square - 1.0));
    moment += out.shares[i] * r;
    spread += out.shares[i] * r * r.transpose();
  }
  const Vec2 tilt = -spread.inverse() * moment;
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    out.shares[i] *= std::max(kLeast, 1.0 + tilt.dot(plate.support[i] - centre));
    sum += out.shares[i];
  }
  for (double& share : out.shares) share /= sum;
  return out;
}

TipGap tip_gap(const Plate& plate, const Vec2& p_OTip, double radius) {
  TipGap best;
  double least = std::numeric_limits<double>::infinity();
  const std::size_t n = plate.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& a = plate.outline[i];
    const Vec2 edge = plate.outline[(i + 1) % n] - a;
    const double s = std::clamp((p_OTip - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const Vec2 nearest = a + s * edge;
    const double distance = (p_OTip - nearest).norm();
    if (distance >= least) continue;
    least = distance;
    best.p_OC = nearest;
    best.n_O = perp(edge.normalized());  // inward: the outline is counter-clockwise
  }
  const bool inside = contains(plate.outline, p_OTip);
  if (least > 1e-9) best.n_O = (inside ? 1.0 : -1.0) / least * (p_OTip - best.p_OC);
  best.gap = (inside ? -least : least) - radius;
  return best;
}

PushedPlate push_plate(const Plate& plate, SupportModel model, const Tips& tips,
                       const PlanarPose& X_WO, std::span<const TipPlaces> path,
                       double step) {
  Simulation simulation(plate, model, tips, X_WO);
  for (std::size_t i = 1; i < path.size(); ++i) {
    double length = 0.0;
    for (int k = 0; k < tips.count; ++k) {
      length = std::max(length, (path[i][k] - path[i - 1][k]).norm());
    }
    const int steps = std::max(1, static_cast<int>(std::ceil(length / step)));
    const auto at = [&](int done) {
      const double s = static_cast<double>(done) / steps;
      TipPlaces places = path[i - 1];
      for (int k = 0; k < tips.count; ++k) places[k] += s * (path[i][k] - places[k]);
      return places;
    };
    for (int k = 0; k < steps; ++k) simulation.advance(at(k), at(k + 1));
  }
  return simulation.result();
}

}  // namespace prehensile
