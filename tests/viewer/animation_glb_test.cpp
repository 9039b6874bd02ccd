#include "viewer/animation_glb.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/command.h"
#include "tests/support/folder.h"
#include "tests/viewer/film_cases.h"
#include "viewer/film_state.h"
#include "viewer/surfaces.h"

namespace prehensile::viewer {
namespace {

using nlohmann::json;
using testing::film_cases;
using testing::FilmCase;

/// The two chunks of a GLB file, taken apart by hand.
struct Glb {
  json tree;
  std::string data;

  explicit Glb(const std::string& bytes) {
    const auto word = [&bytes](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, bytes.data() + at, 4);
      return value;
    };
    if (bytes.size() < 20 || word(0) != 0x46546C67U || word(4) != 2) return;
    EXPECT_EQ(word(8), bytes.size());
    const std::size_t length = word(12);
    tree = json::parse(bytes.substr(20, length));
    data = bytes.substr(20 + length + 8);
  }

  std::vector<float> values(int accessor) const {
    const json& a = tree.at("accessors").at(accessor);
    const json& view = tree.at("bufferViews").at(a.at("bufferView").get<std::size_t>());
    std::vector<float> out(view.at("byteLength").get<std::size_t>() / sizeof(float));
    std::memcpy(out.data(), data.data() + view.value("byteOffset", std::size_t{0}),
                out.size() * sizeof(float));
    return out;
  }

  /// Values of the animation of a node.
  std::vector<float> channel(const std::string& node, const std::string& path) const {
    const json& animation = tree.at("animations").at(0);
    for (const json& channel : animation.at("channels")) {
      const json& target = channel.at("target");
      const std::string name =
          tree.at("nodes").at(target.at("node").get<std::size_t>()).at("name");
      if (name != node || target.at("path") != path) continue;
      return values(animation.at("samplers")
                        .at(channel.at("sampler").get<std::size_t>())
                        .at("output"));
    }
    return {};
  }
};

TEST(FilmState, GoesThroughTheFramesWithoutJumps) {
  for (const FilmCase& one : film_cases()) {
    const double end = duration_of(one.film);
    ASSERT_GT(end, 0.0) << one.what;
    const FilmState last = state_at(one.film, end);
    const FilmFrame& frame = one.film.pushes.back().frames.back();
    EXPECT_NEAR(last.grasp.X_HO.x, frame.grasp.X_HO.x, 1e-12);
    EXPECT_NEAR(last.grasp.psi, frame.grasp.psi, 1e-12);
    FilmState before = state_at(one.film, 0.0);
    for (int i = 1; i <= 4000; ++i) {
      const FilmState now = state_at(one.film, end * i / 4000.0);
      const double step = end / 4000.0;
      EXPECT_LT(std::hypot(now.X_WH.x - before.X_WH.x, now.X_WH.y - before.X_WH.y),
                0.3 * step + 1e-4)
          << one.what << " at " << end * i / 4000.0;
      EXPECT_LT(std::abs(now.grasp.X_HO.theta - before.grasp.X_HO.theta),
                1.0 * step + 2e-3);
      before = now;
    }
  }
}

TEST(Surfaces, AreClosedAndLookOut) {
  for (const FilmCase& one : film_cases()) {
    const ObjectBody body = object_body(one.model);
    double expected = 0.0;
    for (const PrismBody& prism : body.prisms) {
      expected += properties_of(prism.outline).area * (prism.high - prism.low);
    }
    for (const CylinderBody& cylinder : body.cylinders) {
      expected += M_PI * cylinder.radius * cylinder.radius * cylinder.length;
    }
    if (!body.sides.empty()) continue;
    const double volume = volume_of(surface_of(body));
    EXPECT_NEAR(volume, expected, 2e-3 * expected) << one.what;
    for (const Pusher& pusher : one.model.scene.pushers) {
      EXPECT_GT(volume_of(surface_of(pusher_body(one.model, pusher), 0.01)), 0.0);
    }
  }
}

TEST(AnimationGlb, IsThereUnlessLeftOut) {
  EXPECT_EQ(has_glb(), bool{PREHENSILE_WITH_GLTF});
  if (has_glb()) return;
  const FilmCase one = film_cases().front();
  EXPECT_THROW((void)animation_glb(one.model, one.film), std::runtime_error);
}

#if PREHENSILE_WITH_GLTF

TEST(AnimationGlb, HoldsTheFilm) {
  for (const FilmCase& one : film_cases()) {
    const std::string bytes = animation_glb(one.model, one.film);
    EXPECT_LT(bytes.size(), 1'000'000U) << one.what;
    const Glb glb(bytes);
    ASSERT_EQ(glb.tree.at("asset").at("version"), "2.0");
    const std::vector<float> hand = glb.channel("hand", "translation");
    const std::vector<float> turn = glb.channel("hand", "rotation");
    const std::vector<float> object = glb.channel("object", "translation");
    const std::vector<float> roll = glb.channel("object", "rotation");
    const json& sampler = glb.tree.at("animations").at(0).at("samplers").at(0);
    const std::vector<float> times = glb.values(sampler.at("input"));
    ASSERT_EQ(hand.size(), 3 * times.size()) << one.what;
    ASSERT_EQ(roll.size(), 4 * times.size()) << one.what;
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (i > 0) {
        EXPECT_LT(times[i - 1], times[i]);
      }
      const FilmState state = state_at(one.film, static_cast<double>(times[i]));
      EXPECT_NEAR(hand[3 * i], state.X_WH.x, 2e-5);
      EXPECT_NEAR(object[3 * i + 1], state.grasp.X_HO.y, 2e-5);
      double norm = 0.0;
      for (std::size_t k = 0; k < 4; ++k) norm += roll[4 * i + k] * roll[4 * i + k];
      EXPECT_NEAR(norm, 1.0, 1e-5);
      // Quaternions are x, y, z, w.
      const double half = std::atan2(turn[4 * i + 2], turn[4 * i + 3]);
      EXPECT_NEAR(wrapped(2.0 * half - state.X_WH.theta), 0.0, 1e-3);
    }
  }
}

TEST(AnimationGlb, ASceneAloneStandsStill) {
  const Model model = testing::model_of("ycb/box_franka.yaml");
  const Glb glb(animation_glb(model, {}));
  EXPECT_FALSE(glb.tree.contains("animations"));
  EXPECT_EQ(glb.tree.at("meshes").size(), model.scene.pushers.size() + 3);
}

/// The judge is Khronos' own: an npm package, in viewer/node_modules where it is there.
TEST(AnimationGlbFull, PassesTheKhronosValidator) {
  const std::filesystem::path room = testing::kSourceTree / "viewer";
  if (testing::run("command -v node").status != 0 ||
      !std::filesystem::exists(room / "node_modules/gltf-validator")) {
    GTEST_SKIP() << "no gltf-validator: cd viewer && npm ci";
  }
  const testing::Folder folder;
  const auto validated = [&](const std::string& name, const std::string& bytes) {
    const std::filesystem::path file = folder / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return testing::run("node '" + (room / "validate.mjs").string() + "' '" +
                        file.string() + "' 2>&1");
  };
  int number = 0;
  for (const FilmCase& one : film_cases()) {
    const std::string name = std::to_string(number++) + ".glb";
    const testing::Ended ended = validated(name, animation_glb(one.model, one.film));
    EXPECT_EQ(ended.status, 0) << one.what << ": " << ended.out;
    EXPECT_NE(ended.out.find(": 0 errors, 0 warnings"), std::string::npos) << one.what;
  }
  // It does find faults: accessors of an unknown type, of the same length.
  std::string wrong = animation_glb(film_cases()[0].model, film_cases()[0].film);
  const std::size_t type = wrong.find("\"VEC3\"");
  ASSERT_NE(type, std::string::npos);
  wrong.replace(type, 6, "\"VEC5\"");
  EXPECT_NE(validated("wrong.glb", wrong).status, 0);
}

#endif

}  // namespace
}  // namespace prehensile::viewer
