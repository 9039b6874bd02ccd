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

void finish(PadCell& cell) {
  if (cell.count == 2) {
    cell.measure = (cell.vertices[1] - cell.vertices[0]).norm();
    cell.centroid = 0.5 * (cell.vertices[0] + cell.vertices[1]);
  } else {
    Vec2 moment = Vec2::Zero();
    for (int i = 1; i + 1 < cell.count; ++i) {
      const Vec2& o = cell.vertices[0];
      const double area = 0.5 * cross(cell.vertices[i] - o, cell.vertices[i + 1] - o);
      cell.measure += area;
      moment += area / 3.0 * (o + cell.vertices[i] + cell.vertices[i + 1]);
    }
    cell.centroid = moment / cell.measure;
  }
  for (int i = 0; i < cell.count; ++i) {
    cell.reach = std::max(cell.reach, (cell.vertices[i] - cell.centroid).norm());
  }
}

PadCell quadrilateral(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  PadCell cell;
  cell.count = 4;
  cell.vertices[0] = a;
  cell.vertices[1] = b;
  cell.vertices[2] = c;
  cell.vertices[3] = d;
  finish(cell);
  return cell;
}

/// Rings of equal area, cut by spokes; the radii make the polygon as large as the disc.
std::vector<PadCell> disc_cells(double radius, int per_side) {
  const int rings = per_side / 2;
  const int spokes = 2 * per_side;
  const double step = 2.0 * std::numbers::pi / spokes;
  const double rim = radius * std::sqrt(step / std::sin(step));
  std::vector<PadCell> cells;
  for (int i = 0; i < rings; ++i) {
    const double inner = rim * std::sqrt(static_cast<double>(i) / rings);
    const double outer = rim * std::sqrt((i + 1.0) / rings);
    for (int j = 0; j < spokes; ++j) {
      const Vec2 one(std::cos(j * step), std::sin(j * step));
      const Vec2 two(std::cos((j + 1) * step), std::sin((j + 1) * step));
      cells.push_back(quadrilateral(inner * one, outer * one, outer * two, inner * two));
    }
  }
  return cells;
}

std::vector<PadCell> rectangle_cells(const Vec2& size, int per_side) {
  std::vector<PadCell> cells;
  for (int i = 0; i < per_side; ++i) {
    for (int j = 0; j < per_side; ++j) {
      const auto corner = [&](int a, int b) {
        return Vec2(size.x() * (static_cast<double>(a) / per_side - 0.5),
                    size.y() * (static_cast<double>(b) / per_side - 0.5));
      };
      cells.push_back(quadrilateral(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1),
                                    corner(i, j + 1)));
    }
  }
  return cells;
}

std::vector<PadCell> line_cells(const LinePad& pad, int per_side) {
  const int segments = 4 * per_side;
  const Vec2 d(std::cos(pad.angle), std::sin(pad.angle));
  std::vector<PadCell> cells;
  for (int i = 0; i < segments; ++i) {
    PadCell cell;
    cell.count = 2;
    cell.vertices[0] = pad.length * (static_cast<double>(i) / segments - 0.5) * d;
    cell.vertices[1] = pad.length * ((i + 1.0) / segments - 0.5) * d;
    finish(cell);
    cells.push_back(cell);
  }
  return cells;
}

std::vector<PadCell> polygon_cells(const std::vector<Vec2>& outline, int per_side) {
  std::vector<PadCell> cells;
  const auto side = static_cast<std::size_t>(per_side);
  for (const Triangle& piece : pieces_of(outline, side * side)) {
    PadCell& cell = cells.emplace_back();
    cell.count = 3;
    std::copy(piece.vertices.begin(), piece.vertices.end(), cell.vertices.begin());
    finish(cell);
  }
  return cells;
}

/// Cuts the polygon by the half-plane left of a -> b (Sutherland and Hodgman 1974).
void clip(PadCell& polygon, const Vec2& a, const Vec2& b) {
  PadCell result;
  const Vec2 d = b - a;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec2& p = polygon.vertices[i];
    const Vec2& q = polygon.vertices[(i + 1) % polygon.count];
    const double at_p = cross(d, p - a);
    const double at_q = cross(d, q - a);
    if (at_p >= 0.0) result.vertices[result.count++] = p;
    const bool closes = polygon.count > 2 || i == 0;
    if (closes && (at_p >= 0.0) != (at_q >= 0.0)) {
      result.vertices[result.count++] = p + at_p / (at_p - at_q) * (q - p);
    }
  }
  polygon = result;
}

}  // namespace

PadDensity::PadDensity(const Pad& pad, const PadPressure& pressure)
    : along_(Vec2::UnitX()),
      half_(Vec2::Zero()),
      round_(std::holds_alternative<DiscPad>(pad)),
      hertz_(pressure.profile == PressureProfile::kHertz),
      edge_load_(pressure.edge_load) {
  if (const auto* disc = std::get_if<DiscPad>(&pad)) {
    half_.setConstant(disc->radius);
    mean_square_ = disc->radius * disc->radius * (hertz_ ? 0.4 : 0.5);
    return;
  }
  if (const auto* polygon = std::get_if<PolygonPad>(&pad)) {
    const OutlineProperties whole = properties_of(polygon->outline);
    mean_square_ = whole.second.trace() / whole.area + whole.centroid.squaredNorm();
    return;
  }
  if (const auto* rectangle = std::get_if<RectanglePad>(&pad)) {
    half_ = 0.5 * rectangle->size;
  } else if (const auto* line = std::get_if<LinePad>(&pad)) {
    half_.x() = 0.5 * line->length;
    along_ = {std::cos(line->angle), std::sin(line->angle)};
  }
  mean_square_ = half_.squaredNorm() * (hertz_ ? 1.0 / 4.0 : 1.0 / 3.0);
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
  ContactPoints result;
  if (const auto* disc = std::get_if<DiscPad>(&pad)) {
    result = disc_points(disc->radius, points);
  } else if (const auto* rectangle = std::get_if<RectanglePad>(&pad)) {
    result = rectangle_points(rectangle->size, points);
  } else if (const auto* line = std::get_if<LinePad>(&pad)) {
    result = line_points(*line, points);
  } else if (const auto* polygon = std::get_if<PolygonPad>(&pad)) {
    result = polygon_points(polygon->outline, points);
  } else {
    result.coverage = 1.0;
    add(result, Vec2::Zero(), 1.0);
  }
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

double pad_reach(const Pad& pad) {
  if (const auto* disc = std::get_if<DiscPad>(&pad)) return disc->radius;
  if (const auto* rectangle = std::get_if<RectanglePad>(&pad)) {
    return 0.5 * rectangle->size.norm();
  }
  if (const auto* line = std::get_if<LinePad>(&pad)) return 0.5 * line->length;
  double reach = 0.0;
  if (const auto* polygon = std::get_if<PolygonPad>(&pad)) {
    for (const Vec2& v : polygon->outline) reach = std::max(reach, v.norm());
  }
  return reach;
}

std::vector<PadCell> pad_cells(const Pad& pad, const PadPressure& pressure,
                               int per_side) {
  std::vector<PadCell> cells;
  if (const auto* disc = std::get_if<DiscPad>(&pad))
    cells = disc_cells(disc->radius, per_side);
  if (const auto* rectangle = std::get_if<RectanglePad>(&pad)) {
    cells = rectangle_cells(rectangle->size, per_side);
  }
  if (const auto* line = std::get_if<LinePad>(&pad)) cells = line_cells(*line, per_side);
  if (const auto* polygon = std::get_if<PolygonPad>(&pad)) {
    cells = polygon_cells(polygon->outline, per_side);
  }
  const PadDensity density(pad, pressure);
  double load = 0.0;
  double torque = 0.0;
  for (const PadCell& cell : cells) {
    const double share = cell.measure * density(cell.centroid);
    load += share;
    torque += share * cell.centroid.norm();
  }
  const ContactPoints fine = pad_points(pad, pressure, 64);
  double wanted = 0.0;
  for (int j = 0; j < fine.count; ++j) {
    wanted += fine.weight[j] * std::hypot(fine.x[j], fine.y[j]);
  }
  for (PadCell& cell : cells) {
    cell.pressure = density(cell.centroid);
    cell.centroid *= wanted * load / torque;
  }
  return cells;
}

PressedCell press(const PadCell& cell, const std::vector<Triangle>& face,
                  const PlanarPose& X_OH) noexcept {
  PadCell whole;
  whole.count = cell.count;
  for (int i = 0; i < cell.count; ++i)
    whole.vertices[i] = transform(X_OH, cell.vertices[i]);
  PadCell unscaled = whole;
  finish(unscaled);
  PressedCell pressed;
  Vec2 moment = Vec2::Zero();
  for (const Triangle& triangle : face) {
    PadCell part = whole;
    for (int i = 0; i < 3 && part.count > 0; ++i) {
      clip(part, triangle.vertices[i], triangle.vertices[(i + 1) % 3]);
    }
    if (part.count < 2 || (cell.count > 2 && part.count < 3)) continue;
    finish(part);
    if (!(part.measure > 0.0)) continue;
    pressed.measure += part.measure;
    moment += part.measure * part.centroid;
  }
  if (pressed.measure <= 0.0) return pressed;
  const Vec2 shift = moment / pressed.measure - unscaled.centroid;
  pressed.centroid = cell.centroid + rotated(-X_OH.theta, shift);
  return pressed;
}

}  // namespace prehensile
