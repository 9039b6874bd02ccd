/// `prehensile report`: one page, every figure, and numbers that the library gives too.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "io/scene_file.h"
#include "mechanics/model.h"
#include "mechanics/planar_instant.h"
#include "primitives/transition.h"
#include "tests/apps/program.h"
#include "tests/plot/svg_text.h"
#include "tests/support/folder.h"

namespace prehensile::testing {
namespace {

namespace fs = std::filesystem;

/// The page, written once.
const std::string& page() {
  static const std::string kPage = [] {
    const Folder folder;
    const fs::path file = folder / "report.html";
    const Outcome out = run_program("report -o " + file.string());
    EXPECT_EQ(out.exit_code, 0) << out.err;
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }();
  return kPage;
}

/// Values of all <data> elements by their ids.
const std::map<std::string, double>& numbers() {
  static const std::map<std::string, double> kNumbers = [] {
    std::map<std::string, double> found;
    const std::string& text = page();
    const std::string mark = "<data id=\"";
    for (std::size_t at = text.find(mark); at != std::string::npos;
         at = text.find(mark, at + 1)) {
      const std::size_t from = at + mark.size();
      const std::size_t end = text.find('"', from);
      const std::size_t value = text.find("value=\"", end) + 7;
      found[text.substr(from, end - from)] = std::stod(text.substr(value));
    }
    return found;
  }();
  return kNumbers;
}

double number(const std::string& id) {
  const auto found = numbers().find(id);
  EXPECT_NE(found, numbers().end()) << id;
  return found == numbers().end() ? NAN : found->second;
}

Model model_of(const std::string& name) {
  const fs::path root = PREHENSILE_SOURCE_DIR;
  return prepare(read_scene(root / "problems/paper" / (name + ".yaml")).scene);
}

TEST(Report, IsOneWellFormedPageWithoutTheNetwork) {
  const std::string& text = page();
  ASSERT_TRUE(text.starts_with("<!DOCTYPE html>\n"));
  EXPECT_EQ(plot::testing::fault_of_svg(text.substr(text.find('\n') + 1)), "");
  EXPECT_LT(text.size(), 1000000U);
  for (const char* outside : {"src=", "@import", "<link", "<script", "url(http"}) {
    EXPECT_EQ(text.find(outside), std::string::npos) << outside;
  }
  EXPECT_NE(text.find("prefers-color-scheme: dark"), std::string::npos);
}

TEST(Report, HasEveryFigureAndNoNumberThatIsNone) {
  const std::string& text = page();
  for (const char* id : {"fig5", "fig6", "fig8", "fig9", "fig9prism"}) {
    const std::size_t at = text.find(std::string("<figure id=\"") + id + "\">");
    ASSERT_NE(at, std::string::npos) << id;
    EXPECT_NE(text.find("<svg", at), std::string::npos) << id;
  }
  for (const char* none : {">nan", "\"nan", ">inf", "\"inf", " nan"}) {
    EXPECT_EQ(text.find(none), std::string::npos) << none;
  }
  EXPECT_GT(numbers().size(), 60U);
  for (const auto& [id, value] : numbers()) EXPECT_TRUE(std::isfinite(value)) << id;
}

/// Names inside the charts are unique on the page, or one chart would clip another.
TEST(Report, NoTwoPartsShareAName) {
  std::map<std::string, int> seen;
  const std::string& text = page();
  for (std::size_t at = text.find(" id=\""); at != std::string::npos;
       at = text.find(" id=\"", at + 1)) {
    ++seen[text.substr(at + 5, text.find('"', at + 5) - at - 5)];
  }
  for (const auto& [id, count] : seen) EXPECT_EQ(count, 1) << id;
}

TEST(Report, NumbersAreThoseOfTheLibrary) {
  const Model slide = model_of("slide");
  const PushContact& contact = slide.contacts[0];
  const PlanarPose& X_HO = slide.scene.start.X_HO;
  const PlanarInstant now = solve_planar(grasp_at(slide, X_HO, contact.g_O),
                                         drive_at(contact, 0.0, X_HO, {0.01, 0.0, 0.0}));
  EXPECT_NEAR(number("s.couple.sum"),
              now.pusher[0].normal_force + now.pusher[1].normal_force, 1e-9);
  EXPECT_NEAR(number("s.couple.low"),
              std::min(now.pusher[0].normal_force, now.pusher[1].normal_force), 1e-9);
  // Closed forms: 2 mu N, and 2 mu N + m a.
  EXPECT_NEAR(number("s.couple.sum"), 20.0, 1e-9);
  EXPECT_NEAR(number("s.acceleration.ten"), 21.0, 1e-4);
  EXPECT_NEAR(number("s.line.shortest_mm"), number("s.line.shortest_closed_mm"), 1e-6);
  EXPECT_NEAR(number("s.line.grip"), 0.05 * 9.81 * 0.1 / 0.015, 1e-6);
  EXPECT_NEAR(number("s.linear.slope"), 1.0, 1e-9);
  EXPECT_NEAR(number("s.roll.carried"), number("s.roll.carried_closed"), 1e-6);
  EXPECT_NEAR(number("t.jaws.two") - number("t.jaws.one"), number("t.jaws.traction"),
              1e-9);

  const Model point = [&] {
    Scene scene = slide.scene;
    scene.pushers[0].feature = PointFeature{};
    return prepare(scene);
  }();
  const Transition turned =
      apply(point, point.scene.start,
            LinearPush{.contact = 0, .e = {1.0, 0.0}, .travel = 0.02});
  EXPECT_NEAR(number("fig5.point.turn_deg"), turned.end.X_HO.theta * 180.0 / M_PI, 1e-9);
  const Model bar = model_of("roll_prism");
  const Transition rolled = apply(bar, bar.scene.start, Roll{0, 0.03});
  EXPECT_NEAR(number("s.prism.turn"), -rolled.end.psi * 180.0 / M_PI, 1e-9);
  EXPECT_NEAR(number("s.prism.turn"), 90.0, 1e-6);

  const CrossSectionModel section = [&] {
    CrossSectionModel loose = *model_of("roll").cross_section;
    loose.grip_force = 3.0;
    return loose;
  }();
  EXPECT_NEAR(number("s.roll.threshold"), rolling_threshold(section, 0.01, 0.3 * 9.81),
              1e-9);
  EXPECT_EQ(number("s.roll.between"), 0.0);
}

TEST(Report, ThePageIsTheSameEveryTime) {
  const Folder folder;
  const fs::path file = folder / "report.html";
  ASSERT_EQ(run_program("report -o " + file.string()).exit_code, 0);
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_EQ(text.str(), page());
  EXPECT_EQ(run_program("report -o /nowhere/report.html").exit_code, 2);
  EXPECT_EQ(run_program("report").exit_code, 2);
}

}  // namespace
}  // namespace prehensile::testing
