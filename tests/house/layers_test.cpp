/// The architecture as a test: includes point to the left only, and third parties stay in
/// their rooms.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace prehensile {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = PREHENSILE_SOURCE_DIR;

/// What each folder may include.
const std::map<std::string, std::set<std::string>> kLeftOf = {
    {"scene", {"scene"}},
    {"optimisation", {"optimisation"}},
    {"mechanics", {"scene", "optimisation", "mechanics"}},
    {"primitives", {"scene", "optimisation", "mechanics", "primitives"}},
    {"planner", {"scene", "optimisation", "mechanics", "primitives", "planner"}},
    {"problems",
     {"scene", "optimisation", "mechanics", "primitives", "planner", "problems"}},
    {"mesh", {"scene", "mesh"}},
    {"io", {"scene", "optimisation", "mechanics", "primitives", "planner", "mesh", "io"}},
    {"plot", {"plot"}},
    {"viewer",
     {"scene", "optimisation", "mechanics", "primitives", "planner", "plot", "viewer"}},
    {"mjcf", {"scene", "optimisation", "mechanics", "primitives", "planner", "mjcf"}},
    {"apps",
     {"scene", "optimisation", "mechanics", "primitives", "planner", "mesh", "io", "plot",
      "viewer", "mjcf", "apps"}},
};

/// The folders of the planner, each of which may include those before it, and the values
/// at the top of the planner that all of it speaks of; the sources at the top may include
/// all.
const std::vector<std::string> kFoldersOfPlanner = {
    "geometry", "obstacles", "pads",   "steering",  "bounds", "checks",
    "chains",   "walks",     "finish", "baselines", "search", "proofs",
    "arm",      "fcl",       "ompl",   "absent"};

/// Where a third party, or a part of the standard library, may be named.
struct Room {
  std::regex include;
  std::regex allowed;  // of the path relative to the root
};

std::vector<Room> rooms() {
  const std::string rim = "|^(benchmarks|tests|examples)/.*";
  const auto room = [&rim](const char* include, const std::string& allowed) {
    return Room{std::regex(include), std::regex(allowed + rim)};
  };
  return {
      room("^ompl/", "^planner/ompl/.*|^planner/ompl_interface\\.h$"),
      room("^fcl/", "^planner/fcl/.*"),
      room("^nlopt", "^optimisation/nlopt_backend\\.cpp$"),
      room("^Ip.*\\.hpp$|^coin", "^optimisation/ipopt_backend\\.cpp$"),
      room("^yaml-cpp/", "^io/.*"),
      room("^nlohmann/", "^(io|apps|viewer)/.*"),
      room("^CLI/", "^apps/.*"),
      room("^assimp/", "^mesh/import\\.cpp$"),
      room("^polyclipping/", "^mesh/plane_regions\\.cpp$"),
      room("^tinyxml2\\.h$", "^mesh/urdf\\.cpp$|^mjcf/elements\\.h$"),
      room("^mujoco/", "^mjcf/mujoco_replay\\.cpp$"),
      room("^tiny_gltf\\.h$", "^viewer/animation_glb\\.cpp$"),
      room("^sqlite3\\.h$", "^$"),
      room("^zlib\\.h$", "^io/gzip\\.cpp$"),
      room("^(iostream|fstream)$", "^(mesh|io|apps)/.*"),
      room("^random$", "^$"),
      room("^chrono$", "^(planner|apps)/.*"),
      room("^thread$", "^apps/.*"),
  };
}

struct Include {
  std::string file;
  int line;
  std::string what;
};

std::vector<Include> all_includes() {
  const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  for (const auto& [folder, left] : kLeftOf) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      std::ifstream in(entry.path());
      std::string text;
      for (int line = 1; std::getline(in, text); ++line) {
        std::smatch match;
        if (!std::regex_search(text, match, pattern)) continue;
        includes.push_back({fs::relative(entry.path(), kRoot).string(), line, match[1]});
      }
    }
  }
  return includes;
}

TEST(Layers, IncludesPointToTheLeft) {
  int checked = 0;
  for (const Include& include : all_includes()) {
    const std::string target = include.what.substr(0, include.what.find('/'));
    if (!kLeftOf.contains(target)) continue;
    const std::string folder = include.file.substr(0, include.file.find('/'));
    EXPECT_TRUE(kLeftOf.at(folder).contains(target))
        << include.file << ':' << include.line << " includes " << include.what;
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

/// How far down a file of the planner is in the list; -1 at the top.
int folder_of_planner(const std::string& path) {
  const std::string inner = path.substr(std::string("planner/").size());
  const std::size_t slash = inner.find('/');
  if (slash == std::string::npos) return -1;
  const auto place = std::ranges::find(kFoldersOfPlanner, inner.substr(0, slash));
  return static_cast<int>(place - kFoldersOfPlanner.begin());
}

TEST(Layers, FoldersOfThePlannerPointToTheLeft) {
  const int unknown = static_cast<int>(kFoldersOfPlanner.size());
  int checked = 0;
  for (const Include& include : all_includes()) {
    if (!include.file.starts_with("planner/") || !include.what.starts_with("planner/")) {
      continue;
    }
    const int from = folder_of_planner(include.file);
    const int to = folder_of_planner(include.what);
    const bool is_public = include.file == "planner/ompl_interface.h";
    const bool is_source = include.file.ends_with(".cpp");
    EXPECT_LT(from, unknown) << include.file << " lies in a folder without a place";
    EXPECT_TRUE(from < 0 ? to < 0 || is_source || is_public : to <= from)
        << include.file << ':' << include.line << " includes " << include.what;
    ++checked;
  }
  EXPECT_GT(checked, 300);
}

TEST(Layers, ThirdPartiesStayInTheirRooms) {
  const std::vector<Room> all = rooms();
  for (const Include& include : all_includes()) {
    for (const Room& room : all) {
      if (!std::regex_search(include.what, room.include)) continue;
      EXPECT_TRUE(std::regex_match(include.file, room.allowed))
          << include.file << ':' << include.line << " includes " << include.what;
    }
  }
}

TEST(Layers, SuitesNameTheirDatabaseInOneFile) {
  int found = 0;
  for (const auto& entry : fs::directory_iterator(kRoot / "benchmarks" / "suite")) {
    std::ifstream in(entry.path());
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    if (text.find("#include <sqlite3.h>") == std::string::npos) continue;
    EXPECT_EQ(entry.path().filename(), "database.cpp");
    ++found;
  }
  EXPECT_EQ(found, 1);
}

TEST(Layers, HeadersHaveOneGuardAndNoUsingNamespace) {
  for (const auto& [folder, left] : kLeftOf) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.path().extension() != ".h") continue;
      std::ifstream in(entry.path());
      const std::string text((std::istreambuf_iterator<char>(in)), {});
      EXPECT_NE(text.find("#pragma once"), std::string::npos) << entry.path();
      EXPECT_EQ(text.find("using namespace"), std::string::npos) << entry.path();
      EXPECT_TRUE(text.starts_with("///"))
          << entry.path() << " starts without a description";
    }
  }
}

}  // namespace
}  // namespace prehensile
