#include "mesh/triangle_mesh.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "problems/extruded_mesh.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

const std::vector<Vec2> kSquare = {{0, 0}, {4, 0}, {4, 2}, {0, 2}};

std::string refusal(const std::string& bytes, const std::string& name) {
  try {
    mesh_from_bytes(bytes, name, 1.0);
  } catch (const BadMesh& bad) {
    return bad.what();
  }
  return "accepted";
}

/// The same body, whatever the format says it with.
TEST(TriangleMesh, FormatsAgree) {
  const ExtrudedMesh box = extruded(kSquare, 1.0, 4.0);
  const std::string texts[] = {to_obj({box}), to_text_stl({box}), to_binary_stl({box})};
  const char* const names[] = {"a.obj", "a.stl", "a.STL"};
  for (int i = 0; i < 3; ++i) {
    const TriangleMesh mesh = mesh_from_bytes(texts[i], names[i], 0.01);
    EXPECT_EQ(mesh.vertices.size(), 8u) << names[i];
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_TRUE(mesh.repairs.empty());
    const MeshProperties properties = properties_of(mesh);
    EXPECT_NEAR(properties.volume, 24e-6, 1e-11);
    EXPECT_LT((properties.centroid - Vec3(0.02, 0.01, 0.025)).norm(), 1e-8);
    EXPECT_NEAR(properties.spread(0, 0), 1e-4 * 16.0 / 12.0, 1e-9);
    EXPECT_NEAR(properties.spread(1, 1), 1e-4 * 4.0 / 12.0, 1e-9);
    EXPECT_NEAR(properties.spread(2, 2), 1e-4 * 9.0 / 12.0, 1e-9);
    EXPECT_NEAR(properties.spread(0, 1), 0.0, 1e-12);
  }
}

TEST(TriangleMesh, FacesThatLookInwardsAreTurned) {
  ExtrudedMesh box = extruded(kSquare, 0.0, 3.0);
  const double volume =
      properties_of(mesh_from_bytes(to_obj({box}), "a.obj", 1.0)).volume;
  for (std::size_t i = 0; i < box.triangles.size(); i += 2) {
    std::swap(box.triangles[i][0], box.triangles[i][1]);
  }
  const TriangleMesh mixed = mesh_from_bytes(to_obj({box}), "a.obj", 1.0);
  EXPECT_EQ(mixed.repairs.size(), 1u);
  EXPECT_NEAR(properties_of(mixed).volume, volume, 1e-12);
}

/// A shell inside another that looks inwards is a cavity; beside it, a mistake.
TEST(TriangleMesh, CavitiesStayAndMistakesGo) {
  const ExtrudedMesh outer = extruded(kSquare, 0.0, 3.0);
  ExtrudedMesh inner = extruded({{1, 0.5}, {2, 0.5}, {2, 1.5}, {1, 1.5}}, 1.0, 2.0);
  for (auto& t : inner.triangles) std::swap(t[0], t[1]);
  ExtrudedMesh beside = inner;
  for (Vec3& v : beside.vertices) v.x() += 10.0;
  const auto volume = [](const std::vector<ExtrudedMesh>& parts) {
    return properties_of(mesh_from_bytes(to_obj(parts), "a.obj", 1.0)).volume;
  };
  EXPECT_NEAR(volume({outer, inner}), 24.0 - 1.0, 1e-5);
  EXPECT_NEAR(volume({outer, beside}), 24.0 + 1.0, 1e-5);
}

TEST(TriangleMesh, DegenerateFacesAreDropped) {
  ExtrudedMesh box = extruded(kSquare, 0.0, 3.0);
  box.triangles.push_back({0, 1, 1});
  box.vertices.push_back(box.vertices[0] + Vec3(1e-9, 0.0, 0.0));
  box.triangles.push_back({0, 8, 1});
  const TriangleMesh mesh = mesh_from_bytes(to_text_stl({box}), "a.stl", 1.0);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.repairs.size(), 1u);
}

TEST(TriangleMesh, RefusalsSayWhy) {
  const ExtrudedMesh box = extruded(kSquare, 0.0, 3.0);
  ExtrudedMesh open = box;
  open.triangles.pop_back();
  EXPECT_NE(refusal(to_obj({open}), "a.obj").find("closed surface"), std::string::npos);
  EXPECT_NE(refusal(to_obj({box, box}), "a.obj").find("doubled"), std::string::npos);
  EXPECT_NE(refusal(to_obj({box}), "a.ply").find(".stl or .obj"), std::string::npos);
  EXPECT_NE(refusal("", "a.obj"), "accepted");
  EXPECT_NE(refusal("", "a.stl"), "accepted");
  EXPECT_NE(refusal("v 0 0 0\nf 1 2 3\n", "a.obj").find("vertex 2"), std::string::npos);
  EXPECT_NE(refusal("v 0 0 nan\n", "a.obj").find("numbers"), std::string::npos);
  EXPECT_NE(refusal("solid x\nvertex 1 2 inf\n", "a.stl").find("numbers"),
            std::string::npos);
  ExtrudedMesh large = box;
  for (Vec3& v : large.vertices) v *= 1e4;
  EXPECT_NE(refusal(to_obj({large}), "a.obj").find("unit"), std::string::npos);
  ExtrudedMesh flat = box;
  for (Vec3& v : flat.vertices) v.z() = 0.0;
  EXPECT_NE(refusal(to_obj({flat}), "a.obj"), "accepted");
  std::string cut = to_binary_stl({box});
  cut.resize(cut.size() - 7);
  EXPECT_NE(refusal(cut, "a.stl"), "accepted");
}

/// The import library makes another body of numbers that it cannot read.
TEST(TriangleMesh, NumbersAreReadAsWrittenOrRefusedWithTheirLine) {
  const std::string box = to_obj({extruded(kSquare, 0.0, 3.0)});
  for (const char* bad :
       {"v 0 0", "v 0.0.5 0 0", "v 0.05- 0 0", "v 0-1 0 0", "v 1e400 0 0", "v 0 0 0 0 0",
        "v 100000000000000000000 0 0", "f 1 2 3x", "f 1 2 3/4/5/6", "f 1/x 2 3"}) {
    const std::string why = refusal(box + bad + "\n", "a.obj");
    const auto lines = std::ranges::count(box, '\n') + 1;
    EXPECT_EQ(why.find("a.obj:" + std::to_string(lines) + ": " + bad), 0u) << why;
  }
  const std::string same = refusal("v\t0 0 0\n" + box, "a.obj");
  EXPECT_EQ(same, "accepted");
  std::string long_face = "f";
  for (int i = 0; i < 5000; ++i) long_face += " 1";
  EXPECT_NE(refusal(box + long_face, "a.obj").find("corners"), std::string::npos);
  EXPECT_NE(refusal("solid x\nvertex 1 2 3 4 5\n", "a.stl").find("a.stl:2: "),
            std::string::npos);
}

/// What a file names besides its faces is not opened.
TEST(TriangleMesh, OtherFilesAreNotOpened) {
  const std::string text = "mtllib /dev/zero\nusemtl x\nvt 0 0\nvn 0 0 1\n" +
                           to_obj({extruded(kSquare, 0.0, 3.0)});
  EXPECT_EQ(mesh_from_bytes(text, "a.obj", 1.0).triangles.size(), 12u);
}

/// A file with bytes changed, dropped or doubled is read or refused, and never more.
int broken_files(int count, std::uint64_t seed) {
  const ExtrudedMesh box = extruded(kSquare, 0.0, 3.0);
  const std::string sound[] = {to_obj({box}), to_text_stl({box}), to_binary_stl({box})};
  const char* const names[] = {"a.obj", "a.stl", "a.stl"};
  Random random(seed);
  int read = 0;
  for (int i = 0; i < count; ++i) {
    const int kind = random.below(3);
    std::string text = sound[kind];
    const int changes = 1 + random.below(4);
    for (int c = 0; c < changes; ++c) {
      const auto at =
          static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
      switch (random.below(4)) {
        case 0:
          text[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          text.erase(at, static_cast<std::size_t>(random.below(40)));
          break;
        case 2:
          text.insert(at, text.substr(at, static_cast<std::size_t>(random.below(60))));
          break;
        default:
          text.resize(std::max<std::size_t>(at, 1));
      }
      if (text.empty()) text += ' ';
    }
    try {
      const TriangleMesh mesh = mesh_from_bytes(text, names[kind], 1.0);
      EXPECT_GT(properties_of(mesh).volume, 0.0);
      ++read;
    } catch (const BadMesh&) {
    }
  }
  return read;
}

TEST(TriangleMesh, BrokenFilesAreReadOrRefused) { EXPECT_GT(broken_files(3000, 1), 30); }

TEST(TriangleMeshFull, BrokenFilesAreReadOrRefused) {
  EXPECT_GT(broken_files(300000, 2), 3000);
}

TEST(TriangleMesh, FilesThatCannotBeReadAreNamed) {
  EXPECT_THROW(read_mesh("/nonexistent/a.stl", 1.0), BadMesh);
  EXPECT_THROW(read_mesh("/tmp", 1.0), BadMesh);
}

}  // namespace
}  // namespace prehensile
