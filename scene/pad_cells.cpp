#include <algorithm>
#include <initializer_list>
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

/// Area, or length of a segment, and centroid.
struct Measured {
  double measure = 0.0;
  Vec2 centroid;
};

Measured measured(const CellShape& shape) {
  const auto& vertices = shape.vertices;
  if (shape.count == 2) {
    return {(vertices[1] - vertices[0]).norm(), 0.5 * (vertices[0] + vertices[1])};
  }
  double sum = 0.0;
  Vec2 moment = Vec2::Zero();
  const Vec2& o = vertices[0];
  for (int i = 1; i + 1 < shape.count; ++i) {
    const double area = 0.5 * cross(vertices[i] - o, vertices[i + 1] - o);
    sum += area;
    moment += area / 3.0 * (o + vertices[i] + vertices[i + 1]);
  }
  return {sum, moment / sum};
}

double reach_about(const Vec2& centre, const CellShape& shape) {
  double reach = 0.0;
  for (int i = 0; i < shape.count; ++i) {
    reach = std::max(reach, (shape.vertices[i] - centre).norm());
  }
  return reach;
}

PadCell cell_of(std::initializer_list<Vec2> vertices) {
  PadCell cell;
  for (const Vec2& vertex : vertices) cell.shape.add(vertex);
  const Measured whole = measured(cell.shape);
  cell.measure = whole.measure;
  cell.centroid = whole.centroid;
  cell.reach = reach_about(whole.centroid, cell.shape);
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
      cells.push_back(cell_of({inner * one, outer * one, outer * two, inner * two}));
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
      cells.push_back(cell_of(
          {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)}));
    }
  }
  return cells;
}

std::vector<PadCell> line_cells(const LinePad& pad, int per_side) {
  const int segments = 4 * per_side;
  const Vec2 d(std::cos(pad.angle), std::sin(pad.angle));
  std::vector<PadCell> cells;
  cells.reserve(static_cast<std::size_t>(segments));
  for (int i = 0; i < segments; ++i) {
    cells.push_back(cell_of({pad.length * (static_cast<double>(i) / segments - 0.5) * d,
                             pad.length * ((i + 1.0) / segments - 0.5) * d}));
  }
  return cells;
}

std::vector<PadCell> polygon_cells(const std::vector<Vec2>& outline, int per_side) {
  std::vector<PadCell> cells;
  const auto side = static_cast<std::size_t>(per_side);
  for (const Triangle& piece : pieces_of(outline, side * side)) {
    cells.push_back(cell_of({piece.vertices[0], piece.vertices[1], piece.vertices[2]}));
  }
  return cells;
}

/// The part of a shape in the half-plane left of a -> b (Sutherland and Hodgman 1974).
/// False: all of it is, and `part` is not set.
bool clip(const CellShape& shape, const Vec2& a, const Vec2& b, CellShape& part) {
  const Vec2 d = b - a;
  std::array<double, CellShape::kMaxVertices> left;
  bool all_left = true;
  for (int i = 0; i < shape.count; ++i) {
    left[i] = cross(d, shape.vertices[i] - a);
    all_left = all_left && left[i] >= 0.0;
  }
  if (all_left) return false;
  part.count = 0;
  for (int i = 0; i < shape.count; ++i) {
    const int next = i + 1 < shape.count ? i + 1 : 0;
    const Vec2& p = shape.vertices[i];
    const Vec2& q = shape.vertices[next];
    if (left[i] >= 0.0) part.add(p);
    const bool closes = shape.count > 2 || i == 0;
    if (closes && (left[i] >= 0.0) != (left[next] >= 0.0)) {
      part.add(p + left[i] / (left[i] - left[next]) * (q - p));
    }
  }
  return true;
}

bool is_cell(const CellShape& part, const CellShape& whole) {
  return part.count >= 3 || (part.count == 2 && whole.count == 2);
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
  CellShape whole;
  for (int i = 0; i < cell.shape.count; ++i) {
    whole.add(frame.in_object(cell.shape.vertices[i]));
  }
  const Vec2 centroid = measured(whole).centroid;
  const double reach = kWider * reach_about(centroid, whole);
  PressedCell pressed;
  Vec2 moment = Vec2::Zero();
  std::array<CellShape, 2> parts;
  for (const Triangle& triangle : face) {
    if (is_beside(triangle, centroid, reach)) continue;
    const CellShape* part = &whole;
    for (std::size_t i = 0; i < 3 && part->count > 0; ++i) {
      CellShape& next = part == &parts[0] ? parts[1] : parts[0];
      if (clip(*part, triangle.vertices[i], triangle.vertices[(i + 1) % 3], next)) {
        part = &next;
      }
    }
    if (!is_cell(*part, whole)) continue;
    const Measured in_triangle = measured(*part);
    if (!(in_triangle.measure > 0.0)) continue;
    pressed.measure += in_triangle.measure;
    moment += in_triangle.measure * in_triangle.centroid;
  }
  if (pressed.measure <= 0.0) return pressed;
  const Vec2 shift = moment / pressed.measure - centroid;
  pressed.centroid = cell.centroid + frame.turned_to_hand(shift);
  return pressed;
}

namespace {

/// A part that edges have left of a cell, both in H.
PressedCell pressed_part(const PadCell& cell, const CellShape& part) {
  if (!is_cell(part, cell.shape)) return {};
  const Measured pressed = measured(part);
  if (!(pressed.measure > kRounding * cell.measure)) return {};
  return {pressed.measure, cell.centroid + pressed.centroid - cell.middle};
}

}  // namespace

PressedCell press_at_edge(const PadCell& cell, const FaceEdge& edge,
                          const CellFrame& frame) noexcept {
  CellShape cut;
  const bool is_cut = clip(cell.shape, frame.in_hand(edge.a), frame.in_hand(edge.b), cut);
  return is_cut ? pressed_part(cell, cut) : PressedCell{cell.measure, cell.centroid};
}

PressedCell press_at_corner(const PadCell& cell, const FaceEdge& one, const FaceEdge& two,
                            const CellFrame& frame) noexcept {
  CellShape cut;
  if (!clip(cell.shape, frame.in_hand(one.a), frame.in_hand(one.b), cut)) {
    return press_at_edge(cell, two, frame);
  }
  CellShape cut_twice;
  const bool is_cut =
      cut.count > 0 && clip(cut, frame.in_hand(two.a), frame.in_hand(two.b), cut_twice);
  return pressed_part(cell, is_cut ? cut_twice : cut);
}

}  // namespace prehensile
