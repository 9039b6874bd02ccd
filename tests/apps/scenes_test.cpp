/// Every query on every shipped scene: no crash, no number that is none, and a reason for
/// each refusal.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
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

/// What is asked for by samples takes how many of them.
struct Samples {
  const char* grip;
  const char* cone;
  const char* spread;
  const char* contact;
};
constexpr Samples kShipped{"", "--samples 8 --check 100", "12", "4"};
/// Of random scenes some take minutes per query under the sanitizers.
constexpr Samples kRandom{"--grip-places 2",
                          "--samples 2 --slices 13 --check 10 --points 4", "4", "2"};

/// SCENE stands for the scene's file.
std::vector<std::string> queries(const Samples& samples) {
  return {"instant SCENE",
          "push SCENE --travel-mm 3",
          std::string("push SCENE --travel-mm 3 --grip-range --points 4 ") + samples.grip,
          "sweep SCENE --over gripper.grip_force=1:50:5",
          "sweep SCENE --of push --over travel_mm=1,40 --over pushers.0.friction=0.1,0.9",
          "sweep SCENE --of roll --over pushers.0.friction=0.1,0.9",
          std::string("cone SCENE ") + samples.cone,
          std::string("spread SCENE --travel-mm 3 --samples ") + samples.spread,
          std::string("contact SCENE --travel-mm 3 --samples ") + samples.contact,
          "place SCENE --twist 3,2,5 --grip-force 5,60"};
}

/// How often a query ended with each exit code.
using Tally = std::map<std::string, std::array<int, 3>>;

void print(const Tally& tally) {
  for (const auto& [query, codes] : tally) {
    std::printf("%-80s %4d done, %4d negative, %4d bad input\n", query.c_str(), codes[0],
                codes[1], codes[2]);
  }
}

/// Whether an object says why numbers in it may be none.
bool says_why(const json& object) {
  for (const char* key : {"reason", "refused", "nominal_reason"}) {
    if (object.contains(key) && object.at(key) != json("")) return true;
  }
  for (const char* key : {"answered", "possible", "found"}) {
    if (object.contains(key) && object.at(key) == false) return true;
  }
  return object.contains("completed") && object.at("completed") == 0;
}

/// Numbers of answers that may be none without a word: docs/queries.md.
bool may_be_none(const std::string& key) {
  static const std::set<std::string> kKeys = {
      "nominal",        "robust",                     // open ends of a cone's slice
      "stick_low",      "stick_high",                 // what "sticks" says
      "force_interval", "evidence",   "other_twist",  // of other motions and forces
      "nearest",        "grip_force", "proof",        // of places that are possible
      "force_bounds",
  };
  return kKeys.contains(key);
}

/// A status that is no success comes with words, and so does a number that is none.
void expect_reasons(const json& value, const std::string& key, bool explained,
                    const std::string& query) {
  if (value.is_null()) {
    EXPECT_TRUE(explained || may_be_none(key)) << query << ": " << key;
  }
  if (value.is_object()) {
    if (value.contains("answered") && value.at("answered") == false) {
      EXPECT_NE(value.at("reason"), "") << query << value.dump();
      EXPECT_NE(value.at("status"), "") << query << value.dump();
    }
    const bool here = explained || says_why(value);
    for (const auto& [name, item] : value.items()) {
      expect_reasons(item, name, here, query);
    }
  } else if (value.is_array()) {
    for (const json& item : value) expect_reasons(item, key, explained, query);
  }
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

/// What sanitizers say, they say on stderr.
void expect_sane(const Outcome& out, const std::string& query) {
  for (const char* word : {"Sanitizer", "runtime error", "internal fault"}) {
    EXPECT_EQ(out.err.find(word), std::string::npos) << query << '\n' << out.err;
  }
}

/// One query, judged; the exit code.
int ask(const std::string& query, int most) {
  const Outcome out = run_program("query " + query + " --json");
  EXPECT_GE(out.exit_code, 0) << query << out.err;
  EXPECT_LE(out.exit_code, most) << query << out.err;
  expect_sane(out, query);
  if (out.exit_code == 2) {
    EXPECT_NE(out.err, "") << query;
    EXPECT_EQ(out.err.find("nan"), std::string::npos) << query << out.err;
  } else if (!json::accept(out.out)) {  // NaN and infinity are no JSON
    ADD_FAILURE() << query << '\n' << out.out;
  } else {
    const json answer = json::parse(out.out);
    expect_reasons(answer, "", out.exit_code == 1, query);
    if (out.exit_code == 1) {
      EXPECT_TRUE(has_reason(answer)) << query << '\n' << out.out;
    }
  }
  return out.exit_code;
}

void count(int code, const std::string& query, Tally& tally) {
  if (code >= 0 && code < 3) ++tally[query][static_cast<std::size_t>(code)];
}

void ask_all(const std::vector<std::string>& scenes) {
  Tally tally;
  for (const std::string& scene : scenes) {
    for (const std::string& query : queries(kShipped)) {
      std::string asked = query;
      asked.replace(asked.find("SCENE"), 5, scene);
      const int code = ask(asked, 1);
      count(code, query, tally);
      const Outcome told = run_program("query " + asked);
      EXPECT_EQ(told.exit_code, code) << asked;
      EXPECT_EQ(told.out.find("nan"), std::string::npos) << asked << '\n' << told.out;
      expect_sane(told, asked);
    }
  }
  print(tally);
}

/// Random scenes: some ask for what makes no sense there, which is bad input with words.
void ask_all_random(std::uint64_t seed, int scenes) {
  const Folder folder;
  const std::string file = folder.path("scene.yaml").string();
  Tally tally;
  for (int i = 0; i < scenes; ++i) {
    SCOPED_TRACE("scene " + std::to_string(seed + static_cast<std::uint64_t>(i)));
    Random random(seed + static_cast<std::uint64_t>(i));
    write_text(file, scene_to_yaml(random_scene(random)));
    for (const std::string& query : queries(kRandom)) {
      std::string asked = query;
      asked.replace(asked.find("SCENE"), 5, file);
      count(ask(asked, 2), query, tally);
    }
  }
  print(tally);
  int answered = 0;
  for (const auto& [query, codes] : tally) answered += codes[0];
  EXPECT_GT(answered, scenes);
}

TEST(Scenes, ARandomFewAnswerEveryQueryOrSayWhyNot) { ask_all_random(1, 6); }

/// 500 of them, ten at a time.
class ScenesFull : public ::testing::TestWithParam<int> {};

TEST_P(ScenesFull, RandomOnesAnswerEveryQueryOrSayWhyNot) {
  ask_all_random(1000 + 10U * static_cast<std::uint64_t>(GetParam()), 10);
}
INSTANTIATE_TEST_SUITE_P(Tens, ScenesFull, ::testing::Range(0, 50));

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
