/// Options of all commands: numbers, seeds, and files to write.
#include <gtest/gtest.h>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

const std::string kScene = "problems/published/square_03.yaml";

struct Refused {
  std::string arguments, words;
};

void expect_refused(const Refused& refused) {
  const Outcome out = run_program(refused.arguments);
  EXPECT_EQ(out.exit_code, 2) << refused.arguments;
  EXPECT_EQ(out.out, "") << refused.arguments;
  EXPECT_NE(out.err.find(refused.words), std::string::npos)
      << refused.arguments << ": " << out.err;
}

TEST(OptionChecks, WhatIsNoNumberIsInNoRange) {
  const std::string number = "nan: expected a number";
  for (const char* arguments :
       {"plan SCENE --margin nan", "plan SCENE --time nan",
        "plan SCENE --guard-factor nan", "query instant SCENE --place-mm nan",
        "query sweep SCENE --place-mm nan", "query push SCENE --travel-mm nan",
        "query place SCENE --margin nan", "query spread SCENE --level nan",
        "query contact SCENE --level nan", "check SCENE --at-least nan",
        "calibrate SCENE x --level nan", "benchmark SCENE --progress-s nan"}) {
    std::string typed = arguments;
    typed.replace(typed.find("SCENE"), 5, kScene);
    expect_refused({typed, number});
  }
}

TEST(OptionChecks, SeedsAreWhatIsTyped) {
  for (const char* seed : {"-1", "18446744073709551616", "1.5", "0x10", "' '"}) {
    for (const char* command : {"plan ", "query spread ", "query cone ", "check "}) {
      expect_refused(
          {command + kScene + " --seed " + seed, "expected a whole number from 0"});
    }
  }
}

TEST(OptionChecks, OutputsAreFilesOfTheirOwnThatCanBeWritten) {
  const Folder folder;
  const auto at = [&](const char* file) { return folder.path(file).string(); };
  write_text(at("scene.yaml"),
             read_text(std::filesystem::path(PREHENSILE_SOURCE_DIR) / kScene));
  const std::string before = read_text(at("scene.yaml"));
  const std::string plan = "plan " + at("scene.yaml") + " -o ";
  expect_refused({plan + at("scene.yaml"), "SCENE does not name"});
  expect_refused(
      {plan + folder.path(".").string() + "/scene.yaml", "SCENE does not name"});
  expect_refused({plan + at("a.csv") + " --arm " + at("a.csv"), "does not name"});
  expect_refused({plan + at("a") + " --arm " + at("no/a.csv"), "cannot be written"});
  expect_refused({plan + at("no/a"), "cannot be written"});
  expect_refused({plan + at("scene.yaml/a"), "cannot be written"});
  expect_refused({plan + at(""), "a directory"});
  expect_refused({plan + "''", "name of a file"});
  expect_refused({"query sweep " + at("scene.yaml") + " --over place_mm=-1:1:3 --csv " +
                      at("scene.yaml"),
                  "SCENE does not name"});
  EXPECT_EQ(read_text(at("scene.yaml")), before);
  EXPECT_FALSE(std::filesystem::exists(at("a")));
  const Outcome done = run_program(plan + at("a"));
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(run_program("view " + at("a") + " -o " + at("a")).exit_code, 2);
}

}  // namespace
}  // namespace prehensile::testing
