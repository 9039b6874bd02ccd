#include "problems/extruded_mesh.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include <Eigen/Geometry>

#include "scene/polygon_pieces.h"

namespace prehensile {
namespace {

std::string line(const char* head, const Vec3& v) {
  char text[96];
  std::snprintf(text, sizeof text, "%s %.9g %.9g %.9g\n", head, v.x(), v.y(), v.z());
  return text;
}

template <typename Take>
void for_each_triangle(const std::vector<ExtrudedMesh>& parts, const Take& take) {
  for (const ExtrudedMesh& part : parts) {
    for (const auto& t : part.triangles) {
      take(part.vertices[static_cast<std::size_t>(t[0])],
           part.vertices[static_cast<std::size_t>(t[1])],
           part.vertices[static_cast<std::size_t>(t[2])]);
    }
  }
}

template <typename Number>
void append(std::string& out, Number number) {
  char bytes[sizeof number];
  std::memcpy(bytes, &number, sizeof number);
  out.append(bytes, sizeof number);
}

void append(std::string& out, const Vec3& v) {
  for (int i = 0; i < 3; ++i) append(out, static_cast<float>(v[i]));
}

Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a).normalized();
}

}  // namespace

ExtrudedMesh extruded(const std::vector<Vec2>& outline, double low, double high) {
  ExtrudedMesh mesh;
  const int n = static_cast<int>(outline.size());
  for (const double z : {low, high}) {
    for (const Vec2& v : outline) mesh.vertices.emplace_back(v.x(), v.y(), z);
  }
  const auto index = [&outline](const Vec2& v) {
    return static_cast<int>(std::find(outline.begin(), outline.end(), v) -
                            outline.begin());
  };
  for (const Triangle& triangle : triangulate(outline)) {
    const int a = index(triangle.vertices[0]);
    const int b = index(triangle.vertices[1]);
    const int c = index(triangle.vertices[2]);
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({n + a, n + b, n + c});
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangles.push_back({i, j, n + j});
    mesh.triangles.push_back({i, n + j, n + i});
  }
  return mesh;
}

std::string to_obj(const std::vector<ExtrudedMesh>& parts) {
  std::string out;
  int first = 1;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    out += "o part" + std::to_string(i) + '\n';
    for (const Vec3& v : parts[i].vertices) out += line("v", v);
    for (const auto& t : parts[i].triangles) {
      char text[64];
      std::snprintf(text, sizeof text, "f %d %d %d\n", first + t[0], first + t[1],
                    first + t[2]);
      out += text;
    }
    first += static_cast<int>(parts[i].vertices.size());
  }
  return out;
}

std::string to_text_stl(const std::vector<ExtrudedMesh>& parts) {
  std::string out = "solid body\n";
  for_each_triangle(parts, [&out](const Vec3& a, const Vec3& b, const Vec3& c) {
    out += line("facet normal", normal_of(a, b, c)) + "outer loop\n";
    for (const Vec3& v : {a, b, c}) out += line("vertex", v);
    out += "endloop\nendfacet\n";
  });
  return out + "endsolid body\n";
}

std::string to_binary_stl(const std::vector<ExtrudedMesh>& parts) {
  std::string out(80, ' ');
  std::uint32_t count = 0;
  for (const ExtrudedMesh& part : parts) {
    count += static_cast<std::uint32_t>(part.triangles.size());
  }
  append(out, count);
  for_each_triangle(parts, [&out](const Vec3& a, const Vec3& b, const Vec3& c) {
    append(out, normal_of(a, b, c));
    for (const Vec3& v : {a, b, c}) append(out, v);
    append(out, std::uint16_t{0});
  });
  return out;
}

ExtrudedMesh bracket() {
  return extruded({{0, 0}, {80, 0}, {80, 30}, {30, 30}, {30, 60}, {0, 60}}, 0.0, 24.0);
}

}  // namespace prehensile
