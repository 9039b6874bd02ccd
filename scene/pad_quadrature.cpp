#include "scene/pad_quadrature.h"

#include <algorithm>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "scene/outline.h"

namespace prehensile {
namespace {

struct Rule {
  Eigen::VectorXd nodes;
  Eigen::VectorXd weights;  // sum 1
};

/// Gauss rule from the recurrence of its orthogonal polynomials (Golub and Welsch 1969).
Rule gauss(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& off_diagonal) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, off_diagonal);
  return {solver.eigenvalues(), solver.eigenvectors().row(0).array().square().matrix()};
}

/// On [-1, 1].
Rule gauss_legendre(int n) {
  Eigen::VectorXd off(n - 1);
  for (int k = 1; k < n; ++k) off[k - 1] = k / std::sqrt(4.0 * k * k - 1.0);
  return gauss(Eigen::VectorXd::Zero(n), off);
}

/// On [0, 1] with weight r: the radii of rings that integrate a polynomial over a disc.
Rule gauss_radial(int n) {
  Eigen::VectorXd diagonal(n);
  Eigen::VectorXd off(n - 1);
  for (int k = 0; k < n; ++k) diagonal[k] = 1.0 / ((2.0 * k + 1.0) * (2.0 * k + 3.0));
  for (int k = 1; k < n; ++k) off[k - 1] = std::sqrt(k * (k + 1.0)) / (2.0 * k + 1.0);
  Rule rule = gauss(diagonal, off);
  rule.nodes = 0.5 * (rule.nodes.array() + 1.0).matrix();
  return rule;
}

/// Two Gauss panels side by side on [-1, 1]: the kink of |r| at the axis falls between
/// them.
Rule two_panels(int n) {
  if (n == 1) return {Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)};
  const Rule half = gauss_legendre(n / 2);
  Rule rule{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int i = 0; i < n / 2; ++i) {
    rule.nodes[i] = 0.5 * (half.nodes[i] - 1.0);
    rule.nodes[n / 2 + i] = 0.5 * (half.nodes[i] + 1.0);
    rule.weights[i] = rule.weights[n / 2 + i] = 0.5 * half.weights[i];
  }
  return rule;
}

void add(ContactPoints& points, const Vec2& p, double weight) {
  points.x[points.count] = p.x();
  points.y[points.count] = p.y();
  points.weight[points.count] = weight;
  ++points.count;
}

ContactPoints disc_points(double radius, int points) {
  ContactPoints result;
  result.coverage = 1.0;
  const int rings = points >= 64 ? 4 : points >= 16 ? 2 : 1;
  const int spokes = points / rings;
  if (points == 1) {
    add(result, Vec2::Zero(), 1.0);
    return result;
  }
  const Rule rule = gauss_radial(rings);
  const double step = 2.0 * std::numbers::pi / spokes;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < spokes; ++j) {
      const double angle = (j + 0.5 * (i % 2)) * step;
      add(result, radius * rule.nodes[i] * Vec2(std::cos(angle), std::sin(angle)),
          rule.weights[i] / spokes);
    }
  }
  return result;
}

ContactPoints rectangle_points(const Vec2& size, int points) {
  ContactPoints result;
  result.coverage = 1.0;
  int long_side = 1;
  while (long_side * long_side < points) long_side *= 2;
  const int short_side = points / long_side;
  const bool x_is_longer = size.x() >= size.y();
  const Rule along_x = two_panels(x_is_longer ? long_side : short_side);
  const Rule along_y = two_panels(x_is_longer ? short_side : long_side);
  for (int i = 0; i < along_x.nodes.size(); ++i) {
    for (int j = 0; j < along_y.nodes.size(); ++j) {
      add(result, 0.5 * Vec2(size.x() * along_x.nodes[i], size.y() * along_y.nodes[j]),
          along_x.weights[i] * along_y.weights[j]);
    }
  }
  return result;
}

ContactPoints line_points(const LinePad& pad, int points) {
  ContactPoints result;
  result.coverage = 1.0;
  const Vec2 d(std::cos(pad.angle), std::sin(pad.angle));
  for (int i = 0; i < points; ++i) {
    add(result, pad.length * ((i + 0.5) / points - 0.5) * d, 1.0 / points);
  }
  return result;
}

/// Centres of compact parts, moved out from the finger axis by the little that gives them
/// the torque of the polygon.
ContactPoints polygon_points(const std::vector<Vec2>& outline, int points) {
  ContactPoints result;
  result.coverage = 1.0;
  constexpr std::size_t kFine = 4096;
  const std::vector<Triangle> pieces = pieces_of(outline, kFine);
  double area = 0.0;
  double lever = 0.0;
  for (const Triangle& piece : pieces) {
    area += area_of(piece);
    lever += area_of(piece) * centroid_of(piece).norm();
  }
  const std::vector<PolygonPart> parts = parts_of(pieces, points);
  double of_parts = 0.0;
  for (const PolygonPart& part : parts) of_parts += part.area * part.centroid.norm();
  const double stretch = of_parts > 0.0 ? lever / of_parts : 1.0;
  for (const PolygonPart& part : parts) {
    add(result, stretch * part.centroid, part.area / area);
  }
  return result;
}

/// What a profile of pressure has to know of a shape.
struct PadSize {
  Vec2 half = Vec2::Zero();    // [m] half sides or radius; 0 along a side that it lacks
  double mean_square = 0.0;    // [m^2] of the distance to the finger axis, by the profile
  Vec2 along = Vec2::UnitX();  // of its first side
};

struct SizeOf {
  bool hertz;

  PadSize operator()(const DiscPad& disc) const {
    return {Vec2::Constant(disc.radius), disc.radius * disc.radius * (hertz ? 0.4 : 0.5)};
  }
  PadSize operator()(const RectanglePad& rectangle) const {
    return with_sides(0.5 * rectangle.size);
  }
  PadSize operator()(const LinePad& line) const {
    PadSize size = with_sides({0.5 * line.length, 0.0});
    size.along = {std::cos(line.angle), std::sin(line.angle)};
    return size;
  }
  PadSize operator()(const PolygonPad& polygon) const {
    const OutlineProperties whole = properties_of(polygon.outline);
    return {Vec2::Zero(),
            whole.second.trace() / whole.area + whole.centroid.squaredNorm()};
  }
  PadSize operator()(const PointPad&) const { return {}; }

 private:
  PadSize with_sides(const Vec2& half) const {
    return {half, half.squaredNorm() * (hertz ? 1.0 / 4.0 : 1.0 / 3.0)};
  }
};

struct PointsOf {
  int points;

  ContactPoints operator()(const DiscPad& disc) const {
    return disc_points(disc.radius, points);
  }
  ContactPoints operator()(const RectanglePad& rectangle) const {
    return rectangle_points(rectangle.size, points);
  }
  ContactPoints operator()(const LinePad& line) const {
    return line_points(line, points);
  }
  ContactPoints operator()(const PolygonPad& polygon) const {
    return polygon_points(polygon.outline, points);
  }
  ContactPoints operator()(const PointPad&) const {
    ContactPoints one;
    one.coverage = 1.0;
    add(one, Vec2::Zero(), 1.0);
    return one;
  }
};

struct ReachOf {
  double operator()(const DiscPad& disc) const { return disc.radius; }
  double operator()(const RectanglePad& rectangle) const {
    return 0.5 * rectangle.size.norm();
  }
  double operator()(const LinePad& line) const { return 0.5 * line.length; }
  double operator()(const PolygonPad& polygon) const {
    double reach = 0.0;
    for (const Vec2& v : polygon.outline) reach = std::max(reach, v.norm());
    return reach;
  }
  double operator()(const PointPad&) const { return 0.0; }
};

}  // namespace

PadDensity::PadDensity(const Pad& pad, const PadPressure& pressure)
    : along_(Vec2::UnitX()),
      half_(Vec2::Zero()),
      round_(std::holds_alternative<DiscPad>(pad)),
      hertz_(pressure.profile == PressureProfile::kHertz),
      edge_load_(pressure.edge_load) {
  const PadSize size = std::visit(SizeOf{hertz_}, pad);
  along_ = size.along;
  half_ = size.half;
  mean_square_ = size.mean_square;
}

double PadDensity::operator()(const Vec2& p) const {
  double density = 1.0;
  if (hertz_ && round_) {
    density = std::sqrt(std::max(0.0, 1.0 - p.squaredNorm() / (half_.x() * half_.x())));
  } else if (hertz_) {
    const Vec2 place(along_.dot(p), cross(along_, p));
    for (int i = 0; i < 2; ++i) {
      if (half_[i] == 0.0) continue;
      const double share = place[i] / half_[i];
      density *= std::sqrt(std::max(0.0, 1.0 - share * share));
    }
  }
  if (edge_load_ != 0.0 && mean_square_ > 0.0) {
    constexpr double kLeast = 0.02;
    density *=
        std::max(kLeast, 1.0 + edge_load_ * (p.squaredNorm() / mean_square_ - 1.0));
  }
  return density;
}

Pad in_plane_equivalent(const Pad& pad) {
  const auto* point = std::get_if<PointPad>(&pad);
  if (!point || !point->spin_radius) return pad;
  return DiscPad{.radius = 1.5 * *point->spin_radius};
}

ContactPoints pad_points(const Pad& pad, const PadPressure& pressure, int points) {
  ContactPoints result = std::visit(PointsOf{points}, pad);
  const PadDensity density(pad, pressure);
  if (density.is_uniform() || result.count == 1) return result;
  double sum = 0.0;
  for (int j = 0; j < result.count; ++j) {
    result.weight[j] *= density({result.x[j], result.y[j]});
    sum += result.weight[j];
  }
  for (int j = 0; j < result.count; ++j) result.weight[j] /= sum;
  return result;
}

double pad_reach(const Pad& pad) { return std::visit(ReachOf{}, pad); }

}  // namespace prehensile
