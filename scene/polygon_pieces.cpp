#include "scene/polygon_pieces.h"

#include <algorithm>

#include "scene/outline.h"

namespace prehensile {

double area_of(const Triangle& t) {
  return 0.5 * cross(t.vertices[1] - t.vertices[0], t.vertices[2] - t.vertices[0]);
}

Vec2 centroid_of(const Triangle& t) {
  return (t.vertices[0] + t.vertices[1] + t.vertices[2]) / 3.0;
}

std::vector<Triangle> triangulate(const std::vector<Vec2>& outline) {
  std::vector<Vec2> rest = outline;
  std::vector<Triangle> triangles;
  const auto is_ear = [&rest](std::size_t i) {
    const std::size_t n = rest.size();
    const Vec2& a = rest[(i + n - 1) % n];
    const Vec2& b = rest[i];
    const Vec2& c = rest[(i + 1) % n];
    if (cross(b - a, c - b) <= 0.0) return false;
    return std::none_of(rest.begin(), rest.end(), [&](const Vec2& p) {
      if (p == a || p == b || p == c) return false;
      return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 &&
             cross(a - c, p - c) >= 0.0;
    });
  };
  while (rest.size() > 2) {
    std::size_t ear = 0;
    while (ear < rest.size() && !is_ear(ear)) ++ear;
    if (ear == rest.size()) {  // what remains is flat at some vertex: drop the flattest
      const auto turn = [&rest](std::size_t i) {
        const std::size_t n = rest.size();
        return std::abs(
            cross(rest[i] - rest[(i + n - 1) % n], rest[(i + 1) % n] - rest[i]));
      };
      ear = 0;
      for (std::size_t i = 1; i < rest.size(); ++i) {
        if (turn(i) < turn(ear)) ear = i;
      }
    } else {
      const std::size_t n = rest.size();
      triangles.push_back({{rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]}});
    }
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

namespace {

double longest_side(const Triangle& t) {
  return std::max({(t.vertices[1] - t.vertices[0]).norm(),
                   (t.vertices[2] - t.vertices[1]).norm(),
                   (t.vertices[0] - t.vertices[2]).norm()});
}

/// Triangles of a polygon: around its centroid where that sees every edge from inside.
std::vector<Triangle> compact_triangles(const std::vector<Vec2>& outline) {
  const Vec2 centre = properties_of(outline).centroid;
  std::vector<Triangle> fan;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    fan.push_back({{centre, outline[i], outline[(i + 1) % outline.size()]}});
    if (!(area_of(fan.back()) > 0.0)) return triangulate(outline);
  }
  return fan;
}

}  // namespace

std::vector<Triangle> pieces_of(const std::vector<Vec2>& outline, std::size_t count) {
  struct Piece {
    Triangle triangle;
    double longest;
  };
  const auto piece = [](const Triangle& t) { return Piece{t, longest_side(t)}; };
  const auto shorter = [](const Piece& a, const Piece& b) {
    return a.longest < b.longest;
  };
  std::vector<Piece> pieces;
  pieces.reserve(count);
  for (const Triangle& t : compact_triangles(outline)) pieces.push_back(piece(t));
  std::make_heap(pieces.begin(), pieces.end(), shorter);
  while (pieces.size() < count) {
    std::pop_heap(pieces.begin(), pieces.end(), shorter);
    auto [whole, longest] = pieces.back();
    while ((whole.vertices[1] - whole.vertices[0]).norm() < longest) {
      std::rotate(whole.vertices.begin(), whole.vertices.begin() + 1,
                  whole.vertices.end());
    }
    const auto& [a, b, c] = whole.vertices;
    const Vec2 middle = 0.5 * (a + b);
    pieces.back() = piece({{a, middle, c}});
    std::push_heap(pieces.begin(), pieces.end(), shorter);
    pieces.push_back(piece({{middle, b, c}}));
    std::push_heap(pieces.begin(), pieces.end(), shorter);
  }
  std::vector<Triangle> triangles;
  triangles.reserve(pieces.size());
  for (const Piece& each : pieces) triangles.push_back(each.triangle);
  return triangles;
}

namespace {

struct Fragment {
  Vec2 centre;
  double area;
};
using Fragments = std::vector<Fragment>::iterator;

/// Parts of like area: halves of halves, each cut across its longer extent; their centres
/// become points.
void add_parts(Fragments first, Fragments last, int parts,
               std::vector<PolygonPart>& found) {
  double area = 0.0;
  Vec2 moment = Vec2::Zero();
  Vec2 low = Vec2::Constant(1e9);
  Vec2 high = Vec2::Constant(-1e9);
  for (Fragments piece = first; piece != last; ++piece) {
    area += piece->area;
    moment += piece->area * piece->centre;
    low = low.cwiseMin(piece->centre);
    high = high.cwiseMax(piece->centre);
  }
  if (parts == 1) {
    if (area > 0.0) found.push_back({moment / area, area});
    return;
  }
  const int axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
  std::sort(first, last, [axis](const Fragment& a, const Fragment& b) {
    return a.centre[axis] < b.centre[axis];
  });
  Fragments middle = first;
  for (double half = 0.0; middle != last && half < 0.5 * area; ++middle) {
    half += middle->area;
  }
  add_parts(first, middle, parts / 2, found);
  add_parts(middle, last, parts / 2, found);
}

}  // namespace

std::vector<PolygonPart> parts_of(const std::vector<Triangle>& pieces, int count) {
  std::vector<Fragment> fragments;
  fragments.reserve(pieces.size());
  for (const Triangle& piece : pieces) {
    fragments.push_back({centroid_of(piece), area_of(piece)});
  }
  std::vector<PolygonPart> parts;
  add_parts(fragments.begin(), fragments.end(), count, parts);
  return parts;
}

}  // namespace prehensile
