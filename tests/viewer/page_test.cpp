#include "viewer/page.h"

#include <cmath>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "planner/proofs/refuse.h"
#include "problems/published_regrasps.h"
#include "tests/viewer/film_cases.h"
#include "viewer/film_json.h"
#include "viewer/key_frames.h"

namespace prehensile::viewer {
namespace {

using nlohmann::json;
using testing::film_cases;
using testing::FilmCase;

constexpr std::size_t kLargestPage = 1'000'000;  // bytes

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t times = 0;
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + what.size())) {
    ++times;
  }
  return times;
}

/// What a browser would read as the data of a page.
json data_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin) + begin.size();
  return json::parse(page.substr(at, page.find("</script", at) - at));
}

TEST(Page, IsSmallAndHoldsItsData) {
  for (const FilmCase& one : film_cases()) {
    const std::string text = page(one.what, {to_json(one.model, one.plan, one.film)});
    EXPECT_LT(text.size(), kLargestPage) << one.what;
    const json data = data_of(text);
    ASSERT_EQ(data.size(), 1U);
    EXPECT_EQ(data[0].at("name"), one.model.scene.name);
    EXPECT_EQ(data[0].at("pushes").size(), one.film.pushes.size());
  }
}

/// A plan with a great many pushes.
TEST(Page, StaysSmall) {
  FilmCase one = film_cases()[0];
  const PlannedPush push = one.plan.pushes[0];
  Slide back = std::get<Slide>(push.push);
  back.travel = 1e-6;
  one.plan.pushes.assign(5000, {.push = back, .start = push.start, .end = push.start});
  const Film many = film(one.model, one.plan);
  EXPECT_GT(many.left_out, 0);
  EXPECT_EQ(static_cast<int>(many.pushes.size()) + many.left_out, 5000);
  const std::string data = to_json(one.model, one.plan, many);
  EXPECT_LT(page("many", {data}).size(), kLargestPage);
  // Two of them share the room.
  const Film fewer = film(one.model, one.plan, {.frames = 150, .pushes = 50});
  const std::string half = to_json(one.model, one.plan, fewer, 7500);
  EXPECT_LT(page("two", {half, half}).size(), kLargestPage);
}

/// Pads of many points, whose places change all the time.
TEST(Page, StaysSmallWithManyPoints) {
  Scene scene = testing::model_of("paper/pivot.yaml").scene;
  scene.start.X_HO.x = 0.055;  // near the end: part of each pad overhangs
  scene.gripper.pad = RectanglePad{{0.028, 0.04}};
  FilmCase one{"clipped", prepare(scene, {.points_per_pad = 64}), {}, {}};
  one.plan.start = one.plan.goal = scene.start;
  one.plan.pushes.push_back(
      {.push = Pivot{.place = -0.02, .turn = 0.4, .guard_distance = 1.0},
       .start = scene.start,
       .end = scene.start});
  one.film = film(one.model, one.plan, {.is_plan = false});
  ASSERT_GE(one.film.pushes[0].frames.size(), 30U)
      << one.film.pushes[0].transition.reason;
  EXPECT_GE(one.film.pushes[0].frames[0].loads.pad[0].size(), 30U);
  const std::string data = to_json(one.model, one.plan, one.film);
  EXPECT_LT(page("clipped", {data, data}).size(), kLargestPage);
}

/// A mesh of as many triangles as are ever drawn, on a page that is large without it.
TEST(Page, StaysSmallWithAMesh) {
  FilmCase one = testing::film_case("confined/tee_90.yaml");
  ObjectSurface& mesh = one.film.surface.emplace();
  constexpr int kAround = 40;
  for (int i = 0; i < 26; ++i) {
    for (int j = 0; j < kAround; ++j) {
      mesh.vertices.emplace_back(-0.0512345 * std::cos(0.157 * j),
                                 -0.0512345 * std::sin(0.157 * j), 0.0112345 - 1e-3 * i);
    }
  }
  for (int i = 0; i < 1000; ++i) {
    mesh.triangles.push_back({i, i + 1, i + kAround});
    mesh.triangles.push_back({i + 1, i + kAround - 1, i + kAround});
  }
  const std::string data = to_json(one.model, one.plan, one.film);
  const json read = json::parse(data);
  EXPECT_EQ(read.at("object").at("mesh").at("triangles").size(), 6000U);
  EXPECT_LT(page("mesh", {data}).size(), kLargestPage);
}

/// Bodies, limits and meshes are in the data where the scene has them.
TEST(Page, HoldsObstaclesLimitsAndMeshes) {
  const auto data = [](const FilmCase& one) {
    return json::parse(to_json(one.model, one.plan, one.film));
  };
  const json plain = data(film_cases()[0]);
  EXPECT_TRUE(plain.at("obstacles").is_null());
  EXPECT_TRUE(plain.at("limits").is_null());
  EXPECT_FALSE(plain.at("object").contains("mesh"));
  const json limits = data(testing::film_case("confined/tee_90.yaml")).at("limits");
  EXPECT_NEAR(limits.at("theta")[0].get<double>(), -M_PI / 2.0, 1e-6);
  EXPECT_TRUE(limits.at("finger")[0].is_null());
  const FilmCase& bracket = testing::film_case("bracket.yaml");
  const json mesh = data(bracket).at("object").at("mesh");
  EXPECT_EQ(mesh.at("triangles").size(), 3 * bracket.film.surface->triangles.size());
  if (!collisions_are_built()) GTEST_SKIP() << "built without FCL";
  const json bodies = data(testing::film_case("confined/post_in_the_way.yaml"));
  EXPECT_EQ(bodies.at("obstacles").at("fixture").size(), 4U);
  const json& finger = bodies.at("obstacles").at("hand")[0];
  EXPECT_EQ(finger.at("name"), "finger 1");
  EXPECT_EQ(finger.at("surface").at("vertices").size(), 24U);  // 8 corners [um]
}

TEST(Page, LoadsNothing) {
  const FilmCase& one = film_cases()[0];
  const std::string text = page("x", {to_json(one.model, one.plan, one.film)});
  const std::regex address(R"((https?|wss?|ftp)://[^\s"'`)\\<]*)");
  for (auto match = std::sregex_iterator(text.begin(), text.end(), address);
       match != std::sregex_iterator(); ++match) {
    const std::string found = match->str();
    EXPECT_TRUE(found == "http://www.w3.org/1999/xhtml" ||
                found == "http://www.w3.org/2000/svg")
        << found;
  }
  EXPECT_NE(text.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(text.find("<link"), std::string::npos);
  EXPECT_EQ(text.find(" src="), std::string::npos);
  EXPECT_NE(text.find("Copyright \xc2\xa9 2010-2026 three.js authors"),
            std::string::npos);
}

/// Words of a scene file are words, whatever they spell.
TEST(Page, HostileWordsStayWords) {
  const std::vector<std::string> hostile = {"</script><script>alert(1)</script>",
                                            "</SCRIPT ><img src=x onerror=alert(1)>",
                                            "<!--<script>",
                                            "<!--data--><!--script--><!--title-->",
                                            "\"; alert(1); //",
                                            "\xe2\x80\xa8 \xe2\x80\xa9 & ' \\ \\u003c",
                                            "</title><svg onload=alert(1)>"};
  const FilmCase& plain = film_cases()[7];
  const std::string harmless = page("x", {to_json(plain.model, plain.plan, plain.film)});
  for (const std::string& words : hostile) {
    FilmCase one = plain;
    one.film.name = one.model.scene.name = one.model.scene.origin = words;
    one.model.scene.gripper.name = words;
    one.model.scene.pushers[0].name = words;
    one.plan.message = one.plan.proof.text = one.film.why = words;
    one.plan.explanation = Explanation{words, {{.what = words, .option = words}}};
    const std::string text = page(words, {to_json(one.model, one.plan, one.film)});
    for (const char* markup :
         {"<script", "</script", "<!--", "<img", "<svg", "</title"}) {
      EXPECT_EQ(count(text, markup), count(harmless, markup)) << words << ": " << markup;
    }
    const json data = data_of(text);
    EXPECT_EQ(data[0].at("name"), words);
    EXPECT_EQ(data[0].at("pushers")[0].at("name"), words);
    EXPECT_EQ(data[0].at("verdict").at("explanation"), words);
    const std::string picture = key_frames(one.model, one.film);
    for (const char* markup : {"<script", "<img", "onload=alert(1)>", "<!--"}) {
      EXPECT_EQ(count(picture, markup), 0U) << words << ": " << markup;
    }
  }
}

TEST(Page, ARefusalSaysWhy) {
  const Model model = testing::model_of("paper/slide.yaml");
  Plan plan;
  plan.status = PlanStatus::kInfeasible;
  plan.proof = {.kind = Proof::Kind::kNoPusher, .text = "nothing can touch it"};
  const json data = data_of(page("x", {to_json(model, plan, film(model, plan))}));
  EXPECT_EQ(data[0].at("verdict").at("usable"), false);
  EXPECT_EQ(data[0].at("verdict").at("proof"), "nothing can touch it");
  EXPECT_TRUE(data[0].at("pushes").empty());
  // The object stands at O, each pusher at a face of it.
  const json& pushers = data[0].at("pushers");
  ASSERT_EQ(pushers.size(), model.scene.pushers.size());
  for (const PushContact& contact : model.contacts) {
    const json& pusher = pushers[static_cast<std::size_t>(contact.pusher)];
    const Vec2 p(pusher.at("p_WP")[0].get<double>(), pusher.at("p_WP")[1].get<double>());
    EXPECT_NEAR((p - contact.a).dot(contact.n), 0.0, 1e-6);
    EXPECT_GT((-p).dot(contact.n), 0.0);
  }
}

/// A refusal by a barrier shows the region on the object, and where the goal is.
TEST(KeyFrames, ShowTheRegionOfABarrier) {
  Scene scene = published_square(0);
  scene.pushers.resize(1);
  scene.start.X_HO = pose_from_finger({0.02, 0.0}, 0.0);
  const PlanarPose goal = pose_from_finger({-0.01, -0.0252}, 0.3);
  scene.goal->x = goal.x;
  scene.goal->y = goal.y;
  scene.goal->theta = goal.theta;
  scene.goal->position_tolerance = 1e-4;
  const Model model = prepare(scene);
  Plan plan;
  plan.start = plan.goal = scene.start;
  plan.proof = find_barrier_proof(model);
  ASSERT_EQ(plan.proof.kind, Proof::Kind::kBarrier);
  const std::string picture = key_frames(model, film(model, plan));
  EXPECT_EQ(count(picture, "clip-path=\"url(#within)\""), 1);
  EXPECT_EQ(count(picture, "where the goal needs it"), 1);
  Plan without = plan;
  without.proof = {};
  EXPECT_EQ(count(key_frames(model, film(model, without)), "#within"), 0);
}

TEST(KeyFrames, OnePicturePerPush) {
  for (const FilmCase& one : film_cases()) {
    const std::string picture = key_frames(one.model, one.film);
    EXPECT_EQ(count(picture, "<clipPath"), one.film.pushes.size()) << one.what;
    EXPECT_EQ(count(picture, "<g "), count(picture, "</g>"));
    EXPECT_EQ(picture.find("nan"), std::string::npos) << one.what;
    EXPECT_LT(picture.size(), 400'000U);
  }
}

}  // namespace
}  // namespace prehensile::viewer
