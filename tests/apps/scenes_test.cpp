/// Every query on every shipped scene: no crash, no number that is none, and a reason for
/// each refusal.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/scene_file.h"
#include "tests/apps/program.h"
#include "tests/io/random_scenes.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<std::string> shipped_scenes() {
  const fs::path root = PREHENSILE_SOURCE_DIR;
  std::vector<std::string> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(root / "problems")) {
    if (entry.path().extension() != ".yaml") continue;
    scenes.push_back(fs::relative(entry.path(), root).string());
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// SCENE stands for the scene's file.
const std::vector<std::string>& queries() {
  static const std::vector<std::string> kQueries = {
      "instant SCENE",
      "push SCENE --travel-mm 3",
      "push SCENE --travel-mm 3 --grip-range",
      "sweep SCENE --over gripper.grip_force=1:50:5",
      "sweep SCENE --of push --over travel_mm=1,40 --over pushers.0.friction=0.1,0.9",
      "sweep SCENE --of roll --over pushers.0.friction=0.1,0.9",
      "cone SCENE --samples 8 --check 100",
      "spread SCENE --travel-mm 3 --samples 12",
      "contact SCENE --travel-mm 3 --samples 4",
      "place SCENE --twist 3,2,5 --grip-force 5,60"};
  return kQueries;
}

/// A status that is no success comes with words.
void expect_reasons(const json& value, const std::string& query) {
  if (value.is_object() && value.contains("answered") &&
      !value.at("answered").get<bool>()) {
    EXPECT_NE(value.at("reason"), "") << query << value.dump();
    EXPECT_NE(value.at("status"), "") << query << value.dump();
  }
  if (!value.is_structured()) return;
  for (const json& item : value) expect_reasons(item, query);
}

/// The reason of a negative answer, wherever the query keeps it.
bool has_reason(const json& answer) {
  const auto says = [](const json& words) { return !words.get<std::string>().empty(); };
  for (const char* key : {"reason", "meaning"}) {
    if (answer.contains(key) && says(answer.at(key))) return true;
  }
  if (answer.contains("nominal")) return says(answer.at("nominal").at("reason"));
  // Rows and contacts say why themselves; an empty cone is its own reason.
  return answer.contains("rows") || answer.contains("contacts") ||
         answer.contains("slices");
}

void ask_all(const std::vector<std::string>& scenes) {
  for (const std::string& scene : scenes) {
    for (std::string query : queries()) {
      query.replace(query.find("SCENE"), 5, scene);
      const Outcome out = run_program("query " + query + " --json");
      ASSERT_GE(out.exit_code, 0) << query << out.err;
      ASSERT_LE(out.exit_code, 1) << query << out.err;
      ASSERT_TRUE(json::accept(out.out)) << query << '\n' << out.out;
      const json answer = json::parse(out.out);
      expect_reasons(answer, query);
      if (out.exit_code == 1) {
        EXPECT_TRUE(has_reason(answer)) << query << '\n' << out.out;
      }
      const Outcome told = run_program("query " + query);
      EXPECT_EQ(told.exit_code, out.exit_code) << query;
      EXPECT_EQ(told.out.find("nan"), std::string::npos) << query << '\n' << told.out;
    }
  }
}

/// Random scenes: some ask for what makes no sense there, which is bad input with words.
void ask_all_random(std::uint64_t seed, int count) {
  const Folder folder;
  const std::string file = folder.path("scene.yaml").string();
  int answered = 0;
  for (int i = 0; i < count; ++i) {
    Random random(seed + static_cast<std::uint64_t>(i));
    write_text(file, scene_to_yaml(random_scene(random)));
    for (std::string query : queries()) {
      query.replace(query.find("SCENE"), 5, file);
      const Outcome out = run_program("query " + query + " --json");
      ASSERT_GE(out.exit_code, 0) << i << ' ' << query << out.err;
      ASSERT_LE(out.exit_code, 2) << i << ' ' << query << out.err;
      if (out.exit_code == 2) {
        EXPECT_NE(out.err, "") << i << ' ' << query;
        EXPECT_EQ(out.err.find("nan"), std::string::npos) << i << query << out.err;
        continue;
      }
      ASSERT_TRUE(json::accept(out.out)) << i << ' ' << query << '\n' << out.out;
      const json answer = json::parse(out.out);
      expect_reasons(answer, query);
      if (out.exit_code == 1) {
        EXPECT_TRUE(has_reason(answer)) << i << ' ' << query << '\n' << out.out;
      }
      answered += out.exit_code == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(answered, count);
}

TEST(Scenes, ARandomFewAnswerEveryQueryOrSayWhyNot) { ask_all_random(1, 6); }

TEST(Scenes, FullRandomSetAnswersEveryQueryOrSaysWhyNot) { ask_all_random(1000, 500); }

TEST(Scenes, AFewAnswerEveryQuery) {
  std::vector<std::string> some;
  const std::vector<std::string> all = shipped_scenes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool family = all[i].find("published") != std::string::npos;
    if (!family || i % 50 == 0) some.push_back(all[i]);
  }
  ASSERT_GE(some.size(), 10U);
  ask_all(some);
}

TEST(Scenes, FullSetAnswersEveryQuery) {
  const std::vector<std::string> all = shipped_scenes();
  ASSERT_GE(all.size(), 110U);
  ask_all(all);
}

}  // namespace
}  // namespace prehensile::testing
