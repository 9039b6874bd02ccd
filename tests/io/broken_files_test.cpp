/// Hostile and broken input: one message per fault, with file, line, field, value and
/// what was expected; nothing is read that should not be.
#include <map>
#include <sstream>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "io/plan_file.h"
#include "tests/io/files.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;

const fs::path kBroken = kSourceTree / "tests/io/broken";

std::string message_for(const fs::path& file) {
  return message_of([&] {
    if (file.extension() == ".json") {
      read_plan(file);
    } else {
      read_scene(file);
    }
  });
}

/// The messages wanted for each file, from broken/messages.txt.
std::map<std::string, std::string> expected_messages() {
  std::map<std::string, std::string> messages;
  std::istringstream lines(text_of(kBroken / "messages.txt"));
  for (std::string line; std::getline(lines, line);) {
    std::string& all = messages[line.substr(0, line.find(':'))];
    all += (all.empty() ? "" : "\n") + line;
  }
  return messages;
}

std::string without(std::string text, const std::string& part) {
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos;) {
    text.erase(at, part.size());
  }
  return text;
}

TEST(BrokenFiles, EachHasItsMessage) {
  std::map<std::string, std::string> expected = expected_messages();
  for (const char* extension : {".yaml", ".json"}) {
    for (const fs::path& file : files_below("tests/io/broken", extension)) {
      const std::string name = fs::relative(file, kBroken).string();
      EXPECT_EQ(without(message_for(file), kBroken.string() + "/"), expected[name]);
      EXPECT_NE(expected[name].find("expected"), std::string::npos) << name;
      expected.erase(name);
    }
  }
  EXPECT_TRUE(expected.empty()) << expected.begin()->first << " is not there";
  EXPECT_GE(expected_messages().size(), 100u);
}

TEST(BrokenFiles, ScenesAndPlansAreToldApart) {
  EXPECT_EQ(
      message_of([] { parse_scene(R"({"version": 1, "scene_digest": "0"})", "p"); }),
      "p: a plan file: expected a scene file");
  for (const char* scene : {"version: 1\nobject: {}\n", "\n# a comment\nversion: 1\n"}) {
    EXPECT_EQ(message_of([&] { parse_plan(scene, "s"); }),
              "s: a scene file: expected a plan file, as `prehensile plan` writes it");
  }
}

TEST(BrokenFiles, AllFaultsOfAFileAreListedUpToTwenty) {
  std::string text = "version: 1\nobject: {box: {size: [1, 1, 1]}, mass: -1}\n";
  text += "gripper: {pad: {disc: {radius: 0.1}}, friction: -1, grip_force: -1}\n";
  const std::string three = message_of([&] { parse_scene(text, "three"); });
  EXPECT_EQ(std::count(three.begin(), three.end(), '\n'), 2) << three;

  for (int i = 0; i < 30; ++i) text += "key" + std::to_string(i) + ": 0\n";
  const std::string many = message_of([&] { parse_scene(text, "many"); });
  EXPECT_EQ(std::count(many.begin(), many.end(), '\n'), 20) << many;
  EXPECT_NE(many.find("many: and 13 more"), std::string::npos) << many;
}

TEST(BrokenFiles, FaultsOfValuesAreListedBesideThoseOfSyntax) {
  const std::string message = message_of([] {
    parse_scene(
        "version: 1\n"
        "object:\n"
        "  prism: {outline: [[0, 0], [1, 1], [1, 0], [0, 1]], thickness: 0.1}\n"
        "  mass: x\n"
        "gripper: {pad: {disc: {radius: 0.1}}, friction: 1, grip_force: 1}\n",
        "two");
  });
  EXPECT_NE(message.find("two:4: object.mass: x"), std::string::npos) << message;
  EXPECT_NE(message.find("two:3: object.prism.outline: edges"), std::string::npos)
      << message;
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
}

TEST(BrokenFiles, WhatIsNoFileIsRefused) {
  const Folder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::map<std::string, std::string> expected = {
      {kBroken.string(), "a directory: expected a file"},
      {"/dev/zero", "a device, pipe or socket: expected a file"},
      {pipe.string(), "a device, pipe or socket: expected a file"},
      {(folder / "absent.yaml").string(), "cannot be opened: No such file or directory"},
  };
  for (const auto& [file, what] : expected) {
    EXPECT_EQ(message_of([&, name = file] { read_scene(name); }), file + ": " + what);
    EXPECT_EQ(message_of([&, name = file] { read_plan(name); }), file + ": " + what);
  }
}

TEST(BrokenFiles, LargeFilesAreRefusedUnread) {
  const Folder folder;
  const fs::path file = folder / "large";
  std::ofstream(file) << "version: 1\n";
  fs::resize_file(file, 100'000'000);
  EXPECT_EQ(
      message_of([&] { read_scene(file); }),
      file.string() + ": 100000000 bytes: expected a file of at most 1000000 bytes");
  EXPECT_EQ(
      message_of([&] { read_plan(file); }),
      file.string() + ": 100000000 bytes: expected a file of at most 10000000 bytes");
}

TEST(BrokenFiles, DeepNestingIsRefused) {
  constexpr int kDepth = 100'000;
  std::string yaml_maps;
  std::string yaml_block;
  std::string json_maps;
  for (int i = 0; i < kDepth; ++i) {
    yaml_maps += "{a: ";
    json_maps += "{\"a\": ";
  }
  for (int i = 0; i < 1000; ++i) yaml_block += std::string(i, ' ') + "a:\n";
  const std::string lists(kDepth, '[');
  const std::string dashes = [] {
    std::string text;
    for (int i = 0; i < kDepth; ++i) text += "- ";
    return text;
  }();
  for (const std::string& text :
       {yaml_maps, yaml_maps + "1" + std::string(kDepth, '}'), yaml_block, lists,
        lists + std::string(kDepth, ']'), dashes}) {
    EXPECT_NE(message_of([&] { parse_scene(text, "deep"); }), "") << text.substr(0, 20);
  }
  for (const std::string& text : {json_maps, lists}) {
    const std::string message = message_of([&] { parse_plan(text, "deep"); });
    EXPECT_NE(message.find("nested too deeply: expected at most 12 levels"),
              std::string::npos)
        << message;
  }
}

/// Every key is compared with all others of its map.
TEST(BrokenFiles, MapsOfTooManyKeysAreRefused) {
  for (const bool doubled : {false, true}) {
    std::string yaml = "version: 1\nobject:\n";
    std::string json = "{";
    for (int i = 0; i < 40'000; ++i) {
      const std::string key = "k" + std::to_string(doubled ? 0 : i);
      yaml += "  " + key + ": 0\n";
      json += "\"" + key + "\": 0,\n";
    }
    json += "\"version\": 1}";
    const std::string what = "a map of more keys: expected at most 1000";
    // Of doubled ones the first twenty are listed, and all counted.
    const std::string of_scene = doubled ? "s: and 980 more" : "s:1003: object: " + what;
    const std::string of_plan = doubled ? "p: and 980 more" : "p:1001: " + what;
    const std::string scene = message_of([&] { parse_scene(yaml, "s"); });
    EXPECT_NE(scene.find(of_scene), std::string::npos) << scene;
    const std::string plan = message_of([&] { parse_plan(json, "p"); });
    EXPECT_NE(plan.find(of_plan), std::string::npos) << plan;
  }
}

TEST(BrokenFiles, PlansMayNotBeEndless) {
  const fs::path plan = kBroken / "values/zero_rate_push.json";
  std::string text = text_of(plan);
  const std::size_t begin = text.find("\"pushes\": [") + 11;
  std::string many;
  for (int i = 0; i < 10'001; ++i) many += "{},";
  text.insert(begin, many);
  const std::string message = message_of([&] { parse_plan(text, "many"); });
  EXPECT_NE(message.find("pushes: a list of 10002: expected a list of 0 to 10000"),
            std::string::npos)
      << message;
}

TEST(BrokenFiles, MessagesStayOnOneLineAndShort) {
  const std::string scene = "version: 1\nname: \"" + std::string(10'000, 'x') +
                            "\\n\\n\\x01\"\nobject: \"a\\nb\"\ngripper: 0\n";
  const std::string message = message_of([&] { parse_scene(scene, "long"); });
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 2) << message;
  EXPECT_LT(message.size(), 500u) << message;
}

TEST(Overrides, AreCheckedLikeTheFileAndNamed) {
  const fs::path file = kSourceTree / "problems/paper/slide.yaml";
  const std::map<std::string, std::string> expected = {
      {"gripper.grip_force=-3",
       "--set gripper.grip_force=-3: gripper.grip_force: -3: expected a number from 0 to "
       "1000000 N"},
      {"gripper.grip=3", "did you mean grip_force?"},
      {"grip", "--set grip: expected path=value"},
      {"=3", "--set =3: expected path=value"},
      {"name.x=3", "--set name.x=3: name.x: straight slide: expected a path that ends"},
      {"pushers.9.friction=1",
       "pushers.9: no such member: expected an index from 0 to 0"},
      {"pushers.x.friction=1",
       "pushers.x: no such member: expected an index from 0 to 0"},
      {"start.x=9", "--set start.x=9: start: the finger axis is at"},
      {"goal.x=[1",
       "--set goal.x=[1: a list or a map as a key, or a bracket that is never"},
      {"goal.x=", "--set goal.x=: empty"},
      {"goal.x=.nan", "--set goal.x=.nan: goal.x: .nan: expected a number"},
      {"goal={x: 1, x: 2}", "--set goal={x: 1, x: 2}: x: given twice"},
  };
  for (const auto& [option, what] : expected) {
    const std::string message =
        message_of([&, set = option] { read_scene(file, {set}); });
    EXPECT_NE(message.find(what), std::string::npos) << option << " says " << message;
  }
}

}  // namespace
}  // namespace prehensile::testing
