/// Damaged files end in BadInput or are valid; nothing else, and never a crash. With the
/// meshes of tests/mesh/triangle_mesh_test.cpp the full runs read more than a million.
#include <gtest/gtest.h>

#include "io/plan_file.h"
#include "tests/io/files.h"
#include "tests/support/random.h"

namespace prehensile::testing {
namespace {

const std::vector<std::string> kPieces = {
    "{",    "}",      "[",       "]",    ":",
    ": ",   ",",      "- ",      "\n",   "\n  ",
    "\t",   "\"",     "'",       "#",    "&a ",
    "*a ",  "!!str ", "? ",      "| ",   "> ",
    "---",  "...",    "%YAML ",  "nan",  ".nan",
    ".inf", "1e999",  "-1e-9",   "1e-5", "0",
    "-",    "null",   "true",    "~",    "\\u0000",
    "\\",   "<<: ",   "\xff",    "\r",   "\xc3",
    "1e5",  "-0",     "@",       "`",    "\xef\xbb\xbf",
    "{}",   "[]",     "\"a\": ", "x: ",  std::string(1, '\0')};

std::string damaged(std::string text, Random& random) {
  const int times = 1 + random.below(4);
  for (int i = 0; i < times && !text.empty(); ++i) {
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(text.size())));
    const auto length = static_cast<std::size_t>(random.below(30));
    switch (random.below(6)) {
      case 0:
        text[at] = static_cast<char>(random.bits());
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.insert(at, kPieces[random.below(static_cast<int>(kPieces.size()))]);
        break;
      case 4:
        text.replace(at, 1, kPieces[random.below(static_cast<int>(kPieces.size()))]);
        break;
      default:
        if (random.chance(0.2)) text.resize(at);
        break;
    }
  }
  return text;
}

struct Outcome {
  int valid = 0;
  int refused = 0;
};

Outcome damage(const std::vector<std::filesystem::path>& files, int times,
               std::uint64_t seed) {
  Random random(seed);
  Outcome outcome;
  for (int i = 0; i < times; ++i) {
    const auto& file = files[random.below(static_cast<int>(files.size()))];
    const std::string text = damaged(text_of(file), random);
    const std::string message = message_of([&] {
      if (file.extension() == ".json") {
        parse_plan(text, "damaged");
      } else {
        parse_scene(text, "damaged");
      }
    });
    if (message.empty()) {
      ++outcome.valid;
    } else {
      ++outcome.refused;
      EXPECT_TRUE(message.starts_with("damaged:")) << message;
    }
  }
  return outcome;
}

void expect_sound(int times, std::uint64_t seed) {
  auto scenes = files_below("problems", ".yaml");
  const Outcome of_scenes = damage(scenes, times, seed);
  EXPECT_GT(of_scenes.valid, times / 100);
  EXPECT_GT(of_scenes.refused, times / 2);
  // Plans whose fault lies in one number or word are whole in every other respect.
  const Outcome of_plans =
      damage(files_below("tests/io/broken/values", ".json"), times, seed + 1);
  EXPECT_GT(of_plans.refused, times / 2);
}

TEST(Mutations, DamagedFilesNeverCrash) { expect_sound(2000, 6); }

TEST(Mutations, DamagedFilesNeverCrashFull) { expect_sound(360'000, 7); }

}  // namespace
}  // namespace prehensile::testing
