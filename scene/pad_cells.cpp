#include <algorithm>
#include <numbers>

#include "scene/outline.h"
#include "scene/pad_quadrature.h"

namespace prehensile {
namespace {

/// Beyond rounding: a circle about a cell that surely holds it.
constexpr double kWider = 1.0 + 1e-9;

/// Parts of a cell that are smaller than this share of it are none: where they lie is
/// rounding.
constexpr double kRounding = 1e-12;

void find_measure(PadCell& cell) {
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
}

void finish(PadCell& cell) {
  find_measure(cell);
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
  const Vec2 d = b - a;
  std::array<double, PadCell::kMaxVertices> left;
  bool all_left = true;
  for (int i = 0; i < polygon.count; ++i) {
    left[i] = cross(d, polygon.vertices[i] - a);
    all_left = all_left && left[i] >= 0.0;
  }
  if (all_left) return;
  PadCell result;
  for (int i = 0; i < polygon.count; ++i) {
    const int next = (i + 1) % polygon.count;
    const Vec2& p = polygon.vertices[i];
    const Vec2& q = polygon.vertices[next];
    if (left[i] >= 0.0) result.vertices[result.count++] = p;
    const bool closes = polygon.count > 2 || i == 0;
    if (closes && (left[i] >= 0.0) != (left[next] >= 0.0)) {
      result.vertices[result.count++] = p + left[i] / (left[i] - left[next]) * (q - p);
    }
  }
  polygon = result;
}

/// Whether a circle about p lies right of one of the sides.
bool is_beside(const Triangle& triangle, const Vec2& p, double radius) {
  for (int i = 0; i < 3; ++i) {
    const Vec2 d = triangle.vertices[(i + 1) % 3] - triangle.vertices[i];
    const double left = cross(d, p - triangle.vertices[i]);
    if (left < 0.0 && left * left > radius * radius * d.squaredNorm()) return true;
  }
  return false;
}

struct CellsOf {
  int per_side;

  std::vector<PadCell> operator()(const DiscPad& disc) const {
    return disc_cells(disc.radius, per_side);
  }
  std::vector<PadCell> operator()(const RectanglePad& rectangle) const {
    return rectangle_cells(rectangle.size, per_side);
  }
  std::vector<PadCell> operator()(const LinePad& line) const {
    return line_cells(line, per_side);
  }
  std::vector<PadCell> operator()(const PolygonPad& polygon) const {
    return polygon_cells(polygon.outline, per_side);
  }
  std::vector<PadCell> operator()(const PointPad&) const { return {}; }
};

}  // namespace

std::vector<PadCell> pad_cells(const Pad& pad, const PadPressure& pressure,
                               int per_side) {
  std::vector<PadCell> cells = std::visit(CellsOf{per_side}, pad);
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
    cell.middle = cell.centroid;
    cell.centroid *= wanted * load / torque;
    cell.within = kWider * (cell.centroid.norm() + cell.reach);
  }
  return cells;
}

PressedCell press(const PadCell& cell, const std::vector<Triangle>& face,
                  const CellFrame& frame) noexcept {
  PadCell whole;
  whole.count = cell.count;
  for (int i = 0; i < cell.count; ++i)
    whole.vertices[i] = frame.in_object(cell.vertices[i]);
  finish(whole);
  PressedCell pressed;
  Vec2 moment = Vec2::Zero();
  for (const Triangle& triangle : face) {
    if (is_beside(triangle, whole.centroid, kWider * whole.reach)) continue;
    PadCell part;
    part.count = whole.count;
    part.vertices = whole.vertices;
    for (int i = 0; i < 3 && part.count > 0; ++i) {
      clip(part, triangle.vertices[i], triangle.vertices[(i + 1) % 3]);
    }
    if (part.count < 2 || (cell.count > 2 && part.count < 3)) continue;
    find_measure(part);
    if (!(part.measure > 0.0)) continue;
    pressed.measure += part.measure;
    moment += part.measure * part.centroid;
  }
  if (pressed.measure <= 0.0) return pressed;
  const Vec2 shift = moment / pressed.measure - whole.centroid;
  pressed.centroid = cell.centroid + frame.turned_to_hand(shift);
  return pressed;
}

PressedCell press_at_edge(const PadCell& cell, const Vec2& a, const Vec2& b,
                          const CellFrame& frame) noexcept {
  PadCell part;
  part.count = cell.count;
  part.vertices = cell.vertices;
  clip(part, frame.in_hand(a), frame.in_hand(b));
  if (part.count < 2 || (cell.count > 2 && part.count < 3)) return {};
  find_measure(part);
  if (!(part.measure > kRounding * cell.measure)) return {};
  return {part.measure, cell.centroid + part.centroid - cell.middle};
}

}  // namespace prehensile
