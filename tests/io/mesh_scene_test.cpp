/// Scenes whose object is a mesh file.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "io/scene_file.h"
#include "mechanics/model.h"
#include "problems/extruded_mesh.h"
#include "tests/io/files.h"
#include "tests/support/folder.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;

const fs::path kProblems = fs::path(PREHENSILE_SOURCE_DIR) / "problems";

/// A folder with a mesh and a scene around it.
class MeshScene : public ::testing::Test {
 protected:
  MeshScene() {
    fs::create_directories(folder_ / "scene");
    write(folder_.path("scene") / "part.obj", to_obj({bracket()}));
    write(folder_ / "outside.obj", to_obj({bracket()}));
  }

  static void write(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }

  /// Reads the scene with this mesh map; the message if it is refused.
  std::string read(const std::string& mesh, const std::string& mass = ", mass: 0.2",
                   const std::string& start = "") {
    const fs::path file = folder_.path("scene") / "scene.yaml";
    write(file, "version: 1\nobject: {mesh: {" + mesh + "}" + mass +
                    "}\ngripper: {pad: {disc: {radius: 0.006}}, friction: 0.5, "
                    "grip_force: 20}\n" +
                    start);
    try {
      scene_ = read_scene(file).scene;
      return "";
    } catch (const BadInput& bad) {
      return bad.what();
    }
  }

  const Folder folder_;
  Scene scene_;
};

TEST_F(MeshScene, BecomesASolidThatTravelsWithTheScene) {
  ASSERT_EQ(read("file: part.obj, unit: mm"), "");
  const auto* solid = std::get_if<SolidShape>(&scene_.object.shape);
  ASSERT_NE(solid, nullptr);
  EXPECT_NEAR(solid->thickness, 0.024, 1e-8);
  const std::string text = scene_to_yaml(scene_);
  const Scene again = parse_scene(text, "again").scene;
  EXPECT_EQ(scene_to_yaml(again), text);
  EXPECT_EQ(text.find("part.obj"), std::string::npos);
  EXPECT_NEAR(prepare(again).c, prepare(scene_).c, 1e-12);
}

TEST_F(MeshScene, FilesOutsideTheFolderAreRefused) {
  fs::create_symlink(folder_ / "outside.obj", folder_.path("scene") / "link.obj");
  for (const std::string& file :
       {std::string("../outside.obj"), (folder_ / "outside.obj").string(),
        std::string("x/../../outside.obj"), std::string("link.obj"), std::string(".")}) {
    const std::string message = read("file: " + file + ", unit: mm");
    EXPECT_NE(message.find("object.mesh.file"), std::string::npos) << file << message;
    EXPECT_NE(message.find(":2: "), std::string::npos) << message;
  }
  EXPECT_NE(read("file: ../outside.obj, unit: mm").find("in the folder of the scene"),
            std::string::npos);
}

TEST_F(MeshScene, PairsAreChosenByNameOrByDirection) {
  ASSERT_EQ(read("file: part.obj, unit: mm, pair: pair1"), "");
  const double by_name = std::get<SolidShape>(scene_.object.shape).thickness;
  EXPECT_GT(by_name, 0.025);
  ASSERT_EQ(read("file: part.obj, unit: mm, closing_direction: [0.1, 0, -1]"), "");
  EXPECT_NEAR(std::get<SolidShape>(scene_.object.shape).thickness, 0.024, 1e-8);
  ASSERT_EQ(read("file: part.obj, unit: mm, closing_direction: [0, 1, 0], "
                 "near: [0.01, 0.02, 0]",
                 ", mass: 0.2", "start: {x: 0.018}"),
            "");
  EXPECT_NEAR(std::get<SolidShape>(scene_.object.shape).thickness, 0.060, 1e-7);
  EXPECT_NE(read("file: part.obj, unit: mm, pair: pair77").find("expected one of pair0"),
            std::string::npos);
}

TEST_F(MeshScene, TheMassMayStandInADescriptionBesideIt) {
  EXPECT_NE(read("file: part.obj, unit: mm", "").find("object.mass: missing"),
            std::string::npos);
  write(folder_.path("scene") / "part.urdf",
        "<?xml version=\"0.0\" ?>\n<robot name=\"r\"><link name=\"l\"><inertial>"
        "<mass value=\".411\"/></inertial></link></robot>\n");
  ASSERT_EQ(read("file: part.obj, unit: mm", ""), "");
  EXPECT_DOUBLE_EQ(scene_.object.mass, 0.411);
  ASSERT_EQ(read("file: part.obj, unit: mm"), "");
  EXPECT_DOUBLE_EQ(scene_.object.mass, 0.2);
  write(folder_.path("scene") / "part.urdf", "<robot><link>");
  EXPECT_NE(read("file: part.obj, unit: mm", "").find("part.urdf"), std::string::npos);
}

TEST_F(MeshScene, RefusalsOfTheMeshNameTheField) {
  write(folder_.path("scene") / "part.obj", "v 0 0 0\n");
  EXPECT_NE(read("file: part.obj, unit: mm").find("object.mesh.file"), std::string::npos);
  EXPECT_NE(read("file: none.obj, unit: mm").find("cannot be read"), std::string::npos);
}

/// The mesh that the project ships is the one that it generates.
TEST(ShippedMesh, IsGenerated) {
  std::ifstream file(kProblems / "meshes" / "bracket.obj", std::ios::binary);
  const std::string shipped((std::istreambuf_iterator<char>(file)),
                            std::istreambuf_iterator<char>());
  EXPECT_EQ(shipped, to_obj({bracket()}));
  EXPECT_NO_THROW(prepare(read_scene(kProblems / "bracket.yaml").scene));
}

}  // namespace
}  // namespace prehensile::testing
