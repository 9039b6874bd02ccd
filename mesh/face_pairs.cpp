#include "mesh/face_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/plane_regions.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

using internal::PlaneRegion;
using internal::simplified;

constexpr double kParallel = 0.99985;      // cosine of a degree
constexpr double kSamePlane = 1e-4;        // of the size of the body
constexpr std::size_t kMostOutline = 200;  // vertices, as `check` allows
constexpr std::size_t kMostPlanes = 400;

std::array<Vec3, 3> corners(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {mesh.vertices[static_cast<std::size_t>(t[0])],
          mesh.vertices[static_cast<std::size_t>(t[1])],
          mesh.vertices[static_cast<std::size_t>(t[2])]};
}

/// A plane in which triangles lie.
struct FlatFace {
  Vec3 normal;  // outwards
  double offset = 0.0;
  double area = 0.0;
  std::vector<std::size_t> triangles;
};

/// Planes of the body by area, largest first; smaller than `least` are left out.
std::vector<FlatFace> flat_faces(const TriangleMesh& mesh, double least) {
  struct Part {
    std::size_t triangle;
    Vec3 normal;
    double area;
    double offset;
  };
  std::vector<Part> parts;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = corners(mesh, i);
    const Vec3 cross = (b - a).cross(c - a);
    const double twice = cross.norm();
    if (!(twice > 0.0)) continue;
    const Vec3 n = cross / twice;
    parts.push_back({i, n, 0.5 * twice, n.dot((a + b + c) / 3.0)});
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.area > b.area; });
  const double same_plane = kSamePlane * extent(mesh.vertices).norm();
  std::vector<FlatFace> faces;
  for (const Part& part : parts) {
    const std::array<Vec3, 3> corner = corners(mesh, part.triangle);
    const auto contains_it = [&](const FlatFace& face) {
      return face.normal.dot(part.normal) >= kParallel &&
             std::all_of(corner.begin(), corner.end(), [&](const Vec3& p) {
               return std::abs(face.normal.dot(p) - face.offset) <= same_plane;
             });
    };
    auto face = std::find_if(faces.begin(), faces.end(), contains_it);
    if (face == faces.end()) {
      if (faces.size() == kMostPlanes) continue;
      face = faces.insert(faces.end(), {part.normal, part.offset, 0.0, {}});
    }
    face->area += part.area;
    face->triangles.push_back(part.triangle);
  }
  std::erase_if(faces, [&](const FlatFace& face) { return face.area < least; });
  std::stable_sort(faces.begin(), faces.end(),
                   [](const FlatFace& a, const FlatFace& b) { return a.area > b.area; });
  return faces;
}

/// Faces that look away from each other, farther apart than `least`; the largest ones
/// first, by the smaller of the two, and not more than anybody will look through.
std::vector<std::array<std::size_t, 2>> opposite_faces(const std::vector<FlatFace>& faces,
                                                       double least) {
  constexpr std::size_t kMostPairs = 32;
  std::vector<std::array<std::size_t, 2>> found;
  for (std::size_t j = 1; j < faces.size() && found.size() < kMostPairs; ++j) {
    for (std::size_t i = 0; i < j && found.size() < kMostPairs; ++i) {
      if (faces[i].normal.dot(faces[j].normal) > -kParallel) continue;
      if (faces[i].offset + faces[j].offset > least) found.push_back({i, j});
    }
  }
  return found;
}

/// Right-handed frame with z along the closing direction, in M; x and y are any.
struct Frame {
  Vec3 x, y, z;
  explicit Frame(const Vec3& closing) : z(closing) {
    const Vec3 seed = std::abs(z.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
    x = (seed - seed.dot(z) * z).normalized();
    y = z.cross(x);
  }
  Vec2 seen(const Vec3& p) const { return {x.dot(p), y.dot(p)}; }
};

template <typename Keep>
PlaneRegion projected(const TriangleMesh& mesh, const Frame& frame, const Keep& keep) {
  std::vector<std::vector<Vec2>> polygons;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = corners(mesh, i);
    if (!keep(a, b, c)) continue;
    polygons.push_back({frame.seen(a), frame.seen(b), frame.seen(c)});
  }
  return PlaneRegion::of(polygons);
}

/// What both jaws reach: common to both faces, nothing of the body in front of it.
PlaneRegion region_of(const TriangleMesh& mesh, const Frame& frame, double low,
                      double high) {
  const double slack = kSamePlane * extent(mesh.vertices).norm();
  const auto lies_at = [&](double offset) {
    return [&frame, offset, slack](const Vec3& a, const Vec3& b, const Vec3& c) {
      return std::abs(frame.z.dot(a) - offset) <= 2.0 * slack &&
             std::abs(frame.z.dot(b) - offset) <= 2.0 * slack &&
             std::abs(frame.z.dot(c) - offset) <= 2.0 * slack;
    };
  };
  const auto in_front = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double top = std::max({frame.z.dot(a), frame.z.dot(b), frame.z.dot(c)});
    const double bottom = std::min({frame.z.dot(a), frame.z.dot(b), frame.z.dot(c)});
    // What looks towards the pad casts the whole shadow of what is in front of it.
    const double facing = (b - a).cross(c - a).dot(frame.z);
    return (facing > 0.0 && top > high + 4.0 * slack) ||
           (facing < 0.0 && bottom < low - 4.0 * slack);
  };
  return projected(mesh, frame, lies_at(low))
      .intersected(projected(mesh, frame, lies_at(high)))
      .without(projected(mesh, frame, in_front));
}

/// The sign by which the largest coordinate is positive: so the name of a direction does
/// not depend on the order of faces in the file.
double usual_sign(const Vec3& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  return v[largest] < 0.0 ? -1.0 : 1.0;
}

/// Direction of the longer side of the smallest rectangle around a polygon; one of its
/// edges lies along an edge of the convex hull, which is an edge between two vertices.
Vec2 long_direction(const std::vector<Vec2>& outline) {
  Vec2 best = Vec2::UnitX();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 edge = outline[(i + 1) % outline.size()] - outline[i];
    if (!(edge.norm() > 0.0)) continue;
    const Vec2 d = edge.normalized();
    double low_x = 0.0;
    double high_x = 0.0;
    double low_y = 0.0;
    double high_y = 0.0;
    for (const Vec2& v : outline) {
      const Vec2 r = v - outline[i];
      low_x = std::min(low_x, d.dot(r));
      high_x = std::max(high_x, d.dot(r));
      low_y = std::min(low_y, cross(d, r));
      high_y = std::max(high_y, cross(d, r));
    }
    const double area = (high_x - low_x) * (high_y - low_y);
    if (area >= least * (1.0 - 1e-9)) continue;
    least = area;
    best = high_x - low_x >= high_y - low_y ? d : perp(d);
  }
  return best;
}

std::vector<Vec2> few_vertices(const std::vector<Vec2>& ring, double size,
                               const char* what, std::vector<std::string>& notes) {
  if (ring.size() < 3) throw BadMesh(std::string(what) + ": no area");
  constexpr int kDoublings = 10;  // up to a hundredth of the size
  double tolerance = 1e-5 * size;
  for (int i = 0; i < kDoublings; ++i, tolerance *= 2.0) {
    std::vector<Vec2> few = simplified(ring, tolerance);
    if (few.size() < 3 || few.size() > kMostOutline || !is_simple(few)) continue;
    if (tolerance > 1e-4 * size) {
      notes.push_back(std::string(what) + " simplified to " + std::to_string(few.size()) +
                      " vertices");
    }
    return few;
  }
  throw BadMesh(std::string(what) +
                ": cannot be described by a simple polygon of at most " +
                std::to_string(kMostOutline) + " vertices");
}

/// Lowest and highest point of the surface above a place of the silhouette's border, by
/// the edges of its triangles that pass there, in O.
Vec2 heights_at(const TriangleMesh& mesh, const Eigen::Isometry3d& X_OM,
                const Vec2& place, double near) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corner = corners(mesh, i);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = X_OM * corner[k];
      const Vec3 edge = X_OM * corner[(k + 1) % 3] - p;
      const Vec2 flat = edge.head<2>();
      const double length_squared = flat.squaredNorm();
      const Vec2 r = place - p.head<2>();
      const bool is_upright = !(length_squared > near * near);
      const double s =
          is_upright ? 0.0 : std::clamp(r.dot(flat) / length_squared, 0.0, 1.0);
      if ((r - s * flat).norm() > near) continue;
      const double z = p.z() + s * edge.z();
      low = std::min({low, z, is_upright ? p.z() + edge.z() : z});
      high = std::max({high, z, is_upright ? p.z() + edge.z() : z});
    }
  }
  return low <= high ? Vec2(low, high) : Vec2(0.0, 0.0);
}

}  // namespace

std::vector<FacePair> find_face_pairs(const TriangleMesh& mesh, double least_area) {
  const std::vector<FlatFace> faces = flat_faces(mesh, 0.5 * least_area);
  const double size = extent(mesh.vertices).norm();
  std::vector<FacePair> pairs;
  for (const auto& [i, j] : opposite_faces(faces, 1e-3 * size)) {
    FacePair pair;
    pair.closing = (faces[i].normal - faces[j].normal).normalized();
    pair.offset = {-faces[j].offset, faces[i].offset};
    if (usual_sign(pair.closing) < 0.0) {
      pair.closing = -pair.closing;
      pair.offset = {-faces[i].offset, faces[j].offset};
    }
    const auto [low, high] = pair.offset;
    pair.thickness = high - low;
    const Frame frame(pair.closing);
    const std::vector<Vec2> part = region_of(mesh, frame, low, high).largest_part();
    if (part.size() < 3) continue;
    const OutlineProperties properties = properties_of(part);
    if (!(properties.area >= least_area)) continue;
    pair.area = properties.area;
    pair.centre = properties.centroid.x() * frame.x + properties.centroid.y() * frame.y +
                  0.5 * (low + high) * frame.z;
    pairs.push_back(pair);
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const FacePair& a, const FacePair& b) { return a.area > b.area; });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].name = "pair" + std::to_string(i);
  }
  return pairs;
}

HeldBody body_between(const TriangleMesh& mesh, const FacePair& pair) {
  HeldBody body;
  const double size = extent(mesh.vertices).norm();
  const Frame seen(pair.closing);
  const MeshProperties properties = properties_of(mesh);

  // Half of the surface, the one that looks along z, casts the whole shadow.
  const PlaneRegion shadow =
      projected(mesh, seen, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        return (b - a).cross(c - a).dot(seen.z) > 0.0;
      });
  std::vector<Vec2> outline =
      few_vertices(shadow.largest_border(), size, "silhouette", body.notes);

  const Vec2 along = long_direction(outline);
  Vec3 x = along.x() * seen.x + along.y() * seen.y;
  x *= usual_sign(x);
  const double middle = 0.5 * (pair.offset[0] + pair.offset[1]);
  const Vec3 origin =
      properties.centroid + (middle - seen.z.dot(properties.centroid)) * seen.z;
  body.X_MO.linear() << x, seen.z.cross(x), seen.z;
  body.X_MO.translation() = origin;
  const Eigen::Isometry3d X_OM = body.X_MO.inverse();
  const auto in_object = [&](const Vec2& p) {
    const Vec3 p_O = X_OM * (p.x() * seen.x + p.y() * seen.y);
    return Vec2(p_O.x(), p_O.y());
  };

  SolidShape& shape = body.shape;
  shape.thickness = pair.thickness;
  for (const Vec2& p : outline) shape.outline.push_back(in_object(p));
  const PlaneRegion region = region_of(mesh, seen, pair.offset[0], pair.offset[1]);
  for (const Vec2& p :
       few_vertices(region.largest_part(), size, "face for the pads", body.notes)) {
    shape.pad_face.push_back(in_object(p));
  }
  shape.centroid = X_OM * properties.centroid;
  shape.spread = X_OM.linear() * properties.spread * X_OM.linear().transpose();

  for (std::size_t i = 0; i < shape.outline.size(); ++i) {
    const Vec2& a = shape.outline[i];
    const Vec2& b = shape.outline[(i + 1) % shape.outline.size()];
    shape.heights.push_back(heights_at(mesh, X_OM, 0.5 * (a + b), 5e-4 * size));
  }
  return body;
}

}  // namespace prehensile
