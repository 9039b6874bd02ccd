/// Pages in a real browser, where there is one: no error, and something is drawn.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/folder.h"
#include "tests/viewer/film_cases.h"
#include "viewer/film_json.h"
#include "viewer/page.h"

namespace prehensile::viewer {
namespace {

namespace fs = std::filesystem;
using testing::Ended;
using testing::film_cases;
using testing::FilmCase;
using testing::Folder;
using testing::run;

std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    const std::string found = run(std::string("command -v ") + name + " 2>/dev/null").out;
    if (!found.empty()) return found.substr(0, found.find('\n'));
  }
  return {};
}

/// What a browser makes of a page: the document after its scripts ran, and its console.
std::string opened(const std::string& program, const Folder& folder,
                   const std::string& text, const std::string& moment) {
  const fs::path file = folder / "page.html";
  std::ofstream(file) << text;
  const Ended ended =
      run("timeout 120 '" + program + "' --headless --no-sandbox --no-first-run " +
          "--disable-background-networking --enable-unsafe-swiftshader " +
          "--use-angle=swiftshader --virtual-time-budget=60000 --enable-logging=stderr " +
          "--user-data-dir='" + (folder / "profile").string() + "' --dump-dom 'file://" +
          file.string() + moment + "' 2>&1");
  EXPECT_EQ(ended.status, 0) << ended.out.substr(0, 500);
  return ended.out;
}

/// Opens a page at a moment and looks for anything that went wrong. Returns the
/// milliseconds until the first frame.
double expect_drawn(const std::string& program, const Folder& folder,
                    const std::string& what, const std::string& text,
                    const std::string& moment) {
  const std::string out = opened(program, folder, text, moment);
  EXPECT_EQ(out.find("data-error="), std::string::npos) << what;
  EXPECT_EQ(out.find("CONSOLE"), std::string::npos)
      << what << ": " << out.substr(out.find("CONSOLE"), 300);
  EXPECT_EQ(out.find("class=\"failure\""), std::string::npos) << what << ": no WebGL";
  std::smatch found;
  const std::regex first("data-first-frame-ms=\"([0-9]+)\"");
  EXPECT_TRUE(std::regex_search(out, found, first)) << what << ": nothing drawn";
  return found.empty() ? kNan : std::stod(found[1]);
}

TEST(BrowserFull, OpensEveryKindOfPage) {
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "no chromium on this machine";
  const Folder folder;
  const auto json = [](const FilmCase& one) {
    return to_json(one.model, one.plan, one.film);
  };
  double fastest = 1e9;
  for (const FilmCase& one : film_cases()) {
    for (const char* moment :
         {"#push=1&share=0.5", "#push=1&share=1&frame=world&theme=dark&view=front"}) {
      fastest = std::min(fastest, expect_drawn(program, folder, one.what,
                                               page(one.what, {json(one)}), moment));
    }
  }
  // Recorded, not judged: software rendering on a busy machine says little.
  RecordProperty("first_frame_ms", static_cast<int>(fastest));
  std::printf("first frame after %.0f ms at best\n", fastest);

  const FilmCase& tee = film_cases()[7];
  FilmCase sampled = tee;
  sampled.film.outcomes.assign(300, tee.film.pushes.back().frames.back().grasp);
  expect_drawn(program, folder, "two", page("two", {json(tee), json(sampled)}), "#t=2");

  Plan refused;
  refused.status = PlanStatus::kInfeasible;
  refused.proof = {.kind = Proof::Kind::kNoPusher, .text = "nothing can touch it"};
  refused.start = refused.goal = tee.model.scene.start;
  const std::string text =
      page("refused", {to_json(tee.model, refused, film(tee.model, refused))});
  expect_drawn(program, folder, "refused", text, "");
  EXPECT_NE(opened(program, folder, text, "").find("No plan: "), std::string::npos);
}

/// Scene files below problems/, from there.
std::vector<std::string> shipped_scenes() {
  const fs::path root = testing::kSourceTree / "problems";
  std::vector<std::string> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".yaml") continue;
    scenes.push_back(fs::relative(entry.path(), root).string());
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// Every shipped scene, an eighth at a time: its plan, or the scene where there is none.
class ShippedScenesFull : public ::testing::TestWithParam<int> {};

TEST_P(ShippedScenesFull, OpenWithoutAnError) {
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "no chromium on this machine";
  const Folder folder;
  const std::vector<std::string> scenes = shipped_scenes();
  ASSERT_GE(scenes.size(), 110U);
  for (std::size_t i = static_cast<std::size_t>(GetParam()); i < scenes.size(); i += 8) {
    const FilmCase one = testing::planned(scenes[i]);
    const std::string text = page(one.what, {to_json(one.model, one.plan, one.film)});
    EXPECT_LT(text.size(), 1'000'000U) << one.what;
    const double first = expect_drawn(program, folder, one.what, text, "#share=0.5");
    std::printf("%s: %zu kB, first frame after %.0f ms\n", one.what.c_str(),
                text.size() / 1000, first);
  }
}
INSTANTIATE_TEST_SUITE_P(Eighths, ShippedScenesFull, ::testing::Range(0, 8));

/// Keys do what the page says they do.
TEST(BrowserFull, ObeysKeys) {
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "no chromium on this machine";
  const Folder folder;
  const FilmCase& one = film_cases()[7];
  std::string text = page("keys", {to_json(one.model, one.plan, one.film)});
  const std::string pressing = R"(<script>
    const press = (key) => window.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
    const clock = () => document.querySelector('.clock').textContent;
    const seen = [clock()];
    press(']'); seen.push(clock());
    press(']'); seen.push(document.querySelector('.pushes [aria-current]').textContent);
    press('End'); seen.push(clock());
    press('f'); seen.push(document.querySelector('.tools select').value);
    press('d'); seen.push(document.documentElement.dataset.theme);
    press('Home'); seen.push(clock() === seen[0]);
    press(' '); seen.push(document.querySelector('.play').getAttribute('aria-label'));
    document.documentElement.dataset.seen = seen.join('; ');
  </script></body>)";
  text.replace(text.rfind("</body>"), 7, pressing);
  const std::string out = opened(program, folder, text, "");
  const double begin = one.film.phases[1].begin, end = one.film.phases.back().end;
  char expected[200];
  std::snprintf(expected, sizeof expected,
                "data-seen=\"0.00 / %.2f s; %.2f / %.2f s; 2. push by floor on -y; "
                "%.2f / %.2f s; world; dark; true; Pause\"",
                end, begin, end, end, end);
  const std::size_t seen = out.find("data-seen=");
  ASSERT_NE(seen, std::string::npos);
  EXPECT_EQ(out.substr(seen, std::string(expected).size()), expected);
}

/// Nothing in a scene's words runs.
TEST(BrowserFull, HostileWordsDoNotRun) {
  const std::string program = browser();
  if (program.empty()) GTEST_SKIP() << "no chromium on this machine";
  const Folder folder;
  FilmCase one = film_cases()[7];
  const std::string words =
      "</script><img src=x onerror=\"document.documentElement.dataset.error='ran'\">";
  one.film.name = one.model.scene.name = one.model.scene.pushers[0].name = words;
  expect_drawn(program, folder, "hostile",
               page(words, {to_json(one.model, one.plan, one.film)}), "#t=1");
}

}  // namespace
}  // namespace prehensile::viewer
