/// `view`, and --view of the commands that make plans and pushes.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/apps/program.h"

namespace prehensile::testing {
namespace {

bool holds(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

class ViewTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const Outcome planned = run_program("plan problems/published/tee_21.yaml -o " +
                                        plan_ + " --view " + page_);
    ASSERT_EQ(planned.exit_code, 0) << planned.err;
  }

  Folder folder_;
  std::string plan_ = folder_.path("plan.json").string();
  std::string page_ = folder_.path("page.html").string();
};

TEST_F(ViewTest, WritesPagesAndPictures) {
  EXPECT_TRUE(holds(read_text(page_), "<title>tee 21</title>"));
  const std::string picture = folder_.path("plan.svg").string();
  const std::string other = folder_.path("other.html").string();
  const std::string copy = folder_.path("copy.json").string();
  std::filesystem::copy_file(plan_, copy);
  const Outcome both = run_program("view " + plan_ + ' ' + copy + " --samples 20 -o " +
                                   other + " --frames " + picture);
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_TRUE(
      holds(read_text(other), "<title>tee 21 (plan.json) | tee 21 (copy.json)</title>"));
  EXPECT_TRUE(holds(read_text(picture), "2. push by floor"));
  // The picture alone, and the same picture again.
  const std::string again = folder_.path("again.svg").string();
  EXPECT_EQ(run_program("view " + plan_ + " --frames " + again).exit_code, 0);
  EXPECT_EQ(read_text(again), read_text(picture));
}

TEST_F(ViewTest, ShowsScenesAndPushes) {
  EXPECT_EQ(run_program("view problems/paper/roll.yaml -o " + page_).exit_code, 0);
  EXPECT_TRUE(holds(read_text(page_), "\"name\":\"roll\""));
  const Outcome push = run_program(
      "query push problems/paper/slide.yaml --kind slide --travel-mm 15 --json --view " +
      page_);
  EXPECT_EQ(push.exit_code, 0) << push.err;
  EXPECT_EQ(push.out.front(), '{');
  EXPECT_TRUE(holds(read_text(page_), "\"kind\":\"slide\""));
  // The same motion asked for as a push is not guarded, and no slide.
  const Outcome general = run_program(
      "query push problems/paper/slide.yaml --kind push --travel-mm 15 --view " + page_);
  EXPECT_EQ(general.exit_code, 0) << general.err;
  EXPECT_TRUE(holds(read_text(page_), "\"kind\":\"push\""));
}

TEST_F(ViewTest, AnswersInJsonAndTakesOverridesOfScenes) {
  const Outcome shown = run_program(
      "view problems/paper/roll.yaml --set 'name=\"<b>\"' --json -o " + page_);
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_TRUE(holds(shown.out, "\"agrees\": true"));
  EXPECT_EQ(shown.out.front(), '{');
  EXPECT_TRUE(holds(read_text(page_), "<title>&lt;b&gt;</title>"));
  EXPECT_EQ(run_program("view " + plan_ + " --set object.mass=1 -o " + page_).exit_code,
            2);
}

/// A plan file has no triangles: the scene has, if it is the plan's.
TEST_F(ViewTest, TakesTheTrianglesOfAMeshFromTheScene) {
  if (!PREHENSILE_WITH_MESHES) GTEST_SKIP() << "built without meshes";
  const std::string bracket = folder_.path("bracket.json").string();
  ASSERT_EQ(run_program("plan problems/bracket.yaml --no-advice -o " + bracket).exit_code,
            0);
  EXPECT_EQ(run_program("view " + bracket + " -o " + page_).exit_code, 0);
  EXPECT_FALSE(holds(read_text(page_), "\"mesh\":{"));
  const std::string scene = " --scene problems/bracket.yaml -o ";
  const Outcome shown = run_program("view " + bracket + scene + page_);
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_TRUE(holds(read_text(page_), "\"mesh\":{"));
  EXPECT_EQ(run_program("view problems/bracket.yaml -o " + page_).exit_code, 0);
  EXPECT_TRUE(holds(read_text(page_), "\"mesh\":{"));
  const Outcome other = run_program("view " + plan_ + scene + page_);
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(holds(other.err, "--scene problems/bracket.yaml: expected a scene whose"))
      << other.err;
}

TEST_F(ViewTest, SaysWhenAPlanDoesNotHold) {
  std::string text = read_text(plan_);
  const std::string key = "\"push_force\": ";
  const std::size_t at = text.find(key);
  ASSERT_NE(at, std::string::npos);
  text.insert(at + key.size(), "1");  // a force of another order
  write_text(plan_, text);
  const Outcome shown = run_program("view " + plan_ + " -o " + page_);
  EXPECT_EQ(shown.exit_code, 1) << shown.out << shown.err;
  EXPECT_TRUE(holds(read_text(page_), "the push force differs"));
}

TEST_F(ViewTest, ShowsARefusal) {
  const Outcome planned = run_program(
      "plan problems/published/tee_21.yaml --set goal.x=0.5 --no-advice -o " + plan_);
  ASSERT_EQ(planned.exit_code, 1) << planned.out << planned.err;
  EXPECT_EQ(run_program("view " + plan_ + " -o " + page_).exit_code, 0);
  EXPECT_TRUE(holds(read_text(page_), "\"usable\":false"));
}

TEST_F(ViewTest, BrokenFilesGiveAPageThatSaysSo) {
  std::filesystem::remove(page_);
  write_text(plan_, "{\"version\": 1<script>");
  const Outcome broken = run_program("view " + plan_ + " -o " + page_);
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_TRUE(holds(broken.err, "plan.json:1:")) << broken.err;
  const std::string page = read_text(page_);
  EXPECT_TRUE(holds(page, "This cannot be shown"));
  EXPECT_TRUE(holds(page, "plan.json:1:"));
  EXPECT_FALSE(holds(page, "<script"));
  // What is there stays.
  write_text(page_, "a page that somebody needs");
  EXPECT_EQ(run_program("view missing.json -o " + page_).exit_code, 2);
  EXPECT_EQ(run_program("view missing.yaml -o " + page_).exit_code, 2);
  EXPECT_EQ(run_program("view -o " + page_).exit_code, 2);
  EXPECT_EQ(read_text(page_), "a page that somebody needs");
}

}  // namespace
}  // namespace prehensile::testing
