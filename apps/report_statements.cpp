// Statements of the paper beside what is found.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "apps/paper_report.h"
#include "apps/table.h"
#include "mechanics/solvers.h"
#include "planner/planner.h"
#include "primitives/roll.h"

namespace prehensile::apps {
namespace {

constexpr const char* kConfirmed = "<span class=\"confirmed\">confirmed</span>";
constexpr const char* kLimits = "<span class=\"limits\">with limits</span>";
constexpr const char* kDiffers = "<span class=\"differs\">differs</span>";

using Rows = std::vector<std::vector<std::string>>;

void add(Rows& rows, const std::string& said, const std::string& where,
         const std::string& found, const std::string& command, const char* verdict,
         const std::string& why = "") {
  rows.push_back({html(said), "<span class=\"where\">" + where + "</span>",
                  found + code("prehensile " + command),
                  std::string(verdict) + (why.empty() ? "" : "<br/>" + html(why))});
}

/// Where `value` changes its sign, between two places where its signs differ.
double root(double low, double high, const std::function<double(double)>& value) {
  const bool rises = value(high) > 0.0;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    ((value(middle) > 0.0) == rises ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

SpatialTwist along(const Vec2& direction, double rate) {
  return in_space({rate * direction.x(), rate * direction.y(), 0.0});
}

InstantAnswer pushed(const Model& model, const SpatialTwist& V_HP,
                     const SolverOptions& how = {}, bool from_rest = false) {
  SpatialQuestionOptions options;
  options.from_rest = from_rest;
  return solve(
      question_at(model, model.contacts[0], 0.0, model.scene.start.X_HO, V_HP, options),
      how);
}

void add_sliding(ReportPage& page, const PaperScenes& scenes, Rows& rows) {
  const Model point = changed(
      scenes.slide, [](Scene& scene) { scene.pushers[0].feature = PointFeature{}; });
  const auto turning = [&](double place_mm) {
    SweepQuestion question;
    question.push.place_mm = place_mm;
    return answered(point, question).values[5];
  };
  const std::string point_command =
      std::string("query sweep problems/paper/slide.yaml --set '") + kPointPusher +
      "' --over place_mm=-15:15:31 --show omega";
  add(rows,
      "Under gravity a point contact hardly pushes the object straight; it turns while "
      "it slides.",
      "VII-A",
      "Pushed at the middle, the object turns at " +
          page.number("s.point.omega", to_deg(turning(0.0)), "%.3f") +
          " °/s while the pusher moves 10 mm/s.",
      point_command, kConfirmed);
  add(rows,
      "A straight slide by a point is possible only for one specific place below the "
      "centre of gravity.",
      "VII-A",
      "The turning vanishes at one place, " +
          page.number("s.point.place_mm", root(-15.0, 15.0, turning), "%.3f") +
          " mm from the level of the centre of gravity (up is positive).",
      point_command, kConfirmed);

  const PlanarInstant couple =
      std::get<PlanarInstant>(pushed(scenes.slide, along({1.0, 0.0}, 0.01)).detail);
  const auto tips = [&](double length) {
    const Model model = changed(scenes.slide, [&](Scene& scene) {
      scene.pushers[0].feature = LineFeature{length};
    });
    return std::abs(answered(model).values[5]) > 1e-9 ? -1.0 : 1.0;
  };
  const double shortest = root(1e-3, 0.03, tips);
  const auto lifts = [&](double grip) {
    const Model model =
        changed(scenes.slide, [&](Scene& scene) { scene.gripper.grip_force = grip; });
    return std::abs(answered(model).values[5]) > 1e-9 ? -1.0 : 1.0;
  };
  const double weight = 9.81 * scenes.slide.mass;
  add(rows, "Pushed by a line, the resulting motion is always straight.", "VII-A",
      "Straight here (turning " +
          page.number("s.line.omega", to_deg(answered(scenes.slide).values[5]), "%.1g") +
          " °/s). But a line shorter than " +
          page.number("s.line.shortest_mm", 1e3 * shortest, "%.3f") +
          " mm tips (closed form " +
          page.number("s.line.shortest_closed_mm", 1e3 * 2.0 * 0.05 * weight / 20.0,
                      "%.3f") +
          " mm: one end would have to pull), and so does this one with a grip below " +
          page.number("s.line.grip", root(2.5, 20.0, lifts), "%.3f") + " N.",
      "query sweep problems/paper/slide.yaml --over pushers.0.line.length=0.002:0.03:29 "
      "--show omega",
      kLimits, "not always: while both ends push");
  const double low =
      std::min(couple.pusher[0].normal_force, couple.pusher[1].normal_force);
  const double high =
      std::max(couple.pusher[0].normal_force, couple.pusher[1].normal_force);
  add(rows,
      "Two coupled forces of different magnitude at the ends of the line balance "
      "gravity and add up to the pushing force.",
      "VII-A, Fig. 5",
      page.number("s.couple.low", low, "%.4f") + " N and " +
          page.number("s.couple.high", high, "%.4f") + " N, together " +
          page.number("s.couple.sum", low + high, "%.4f") + " N = 2 μ N.",
      "query instant problems/paper/slide.yaml", kConfirmed);
  const Model plane = changed(scenes.slide, [](Scene& scene) {
    scene.pushers[0].feature = PlaneFeature{0.03, std::nullopt};
  });
  const SpatialTwist one = pushed(plane, along({1.0, 0.0}, 0.01)).V_HO;
  const SpatialTwist other = pushed(scenes.slide, along({1.0, 0.0}, 0.01)).V_HO;
  add(rows, "A planar contact has a similar effect.", "VII-A",
      "The same motion: largest difference of the twists " +
          page.number("s.plane.difference", (one - other).cwiseAbs().maxCoeff(), "%.1g") +
          ".",
      "query instant problems/paper/slide.yaml --set 'pushers=[{name: wall, plane: "
      "{length: 0.03}, friction: 0.5, position: [-0.05, 0], faces: [\"-x\"]}]'",
      kConfirmed);
  const auto force_at = [&](double grip) {
    return answered(changed(scenes.slide,
                            [&](Scene& scene) { scene.gripper.grip_force = grip; }))
        .values[1];
  };
  const double slope = (force_at(40.0) - force_at(4.0)) / 36.0;
  double bend = 0.0;
  for (const double grip : spaced(4.0, 40.0, 10)) {
    bend =
        std::max(bend, std::abs(force_at(grip) - force_at(4.0) - slope * (grip - 4.0)));
  }
  add(rows, "The pushing force that breaks the grasp is linear in the gripping force.",
      "VII-A, Fig. 6",
      "Slope " + page.number("s.linear.slope", slope, "%.6f") +
          " (2 μ); largest distance from the line " +
          page.number("s.linear.bend", bend, "%.1g") + " N.",
      "query sweep problems/paper/slide.yaml --over gripper.grip_force=4:40:10 --show "
      "normal_force",
      kConfirmed);
  const auto force_of = [&](double a) {
    return pushed(scenes.slide, along({1.0, 0.0}, a), {}, true).w_push[0];
  };
  add(rows,
      "The solution directly gives the minimum force required at the pusher to move the "
      "object.",
      "VI-B",
      "With a prescribed acceleration of 1 and 10 m/s² the normal force is " +
          page.number("s.acceleration.one", force_of(1.0), "%.4f") + " and " +
          page.number("s.acceleration.ten", force_of(10.0), "%.4f") +
          " N: 2 μ N + m a. The force that breaks the grasp is the limit " +
          page.number("s.acceleration.limit",
                      pushed(scenes.slide, along({1.0, 0.0}, 1.0)).w_push[0], "%.4f") +
          " N.",
      "query instant problems/paper/slide.yaml --acceleration 10", kDiffers,
      "it contains m a of the acceleration that was prescribed");
}

void add_cones(ReportPage& page, const PaperScenes& scenes, Rows& rows) {
  // Four points per pad: the pyramids of many points take seconds.
  const Model model = prepare(scenes.slide.scene, {.points_per_pad = 4});
  std::string found =
      "Largest error of the push force over 12 directions and 4 points per "
      "pad, exact cone against g generators: ";
  for (const int g : {4, 8, 16, 32}) {
    double worst = 0.0;
    for (const double degrees : spaced(-20.0, 24.0, 12)) {
      const SpatialTwist V =
          along(rotated(degrees * std::numbers::pi / 180.0, {1.0, 0.0}), 0.01);
      const InstantAnswer exact = pushed(model, V, {.solver = Solver::kSpatial});
      const InstantAnswer cone =
          pushed(model, V, {.solver = Solver::kSpatialPivoting, .generators = g});
      worst = std::max(worst, std::abs(cone.push_force / exact.push_force - 1.0));
    }
    found += text("g = %d: ", g) +
             page.number(text("s.cone.g%d", g), 100.0 * worst, "%.2f") + "\u00a0%" +
             (g < 32 ? ", " : ".");
  }
  add(rows, "The friction cone is replaced by a pyramid; more generators approximate it.",
      "IV-B, eq. (2)", found,
      "query instant problems/paper/slide.yaml --direction-deg 24 --compare --points 4",
      kLimits,
      "a pyramid also drives the motion along its edges; the exact cone is solved");
}

void add_pivoting(ReportPage& page, const PaperScenes& scenes, Rows& rows) {
  const Transition pivot = apply(scenes.pivot, scenes.pivot.scene.start,
                                 Pivot{.contact = 0, .turn = std::numbers::pi / 9.0});
  const Vec2 drift =
      finger_in_object(pivot.end.X_HO) - finger_in_object(scenes.pivot.scene.start.X_HO);
  add(rows, "A line pusher that turns about the fingers pivots the object.", "VII-B",
      "A pivot of 20° turns the object by " +
          page.number("s.pivot.turn", to_deg(pivot.end.X_HO.theta), "%.3f") +
          "°; the fingers drift by " +
          page.number("s.pivot.drift_mm", 1e3 * drift.norm(), "%.3f") + " mm.",
      "query push problems/paper/pivot.yaml --kind pivot --turn-deg 20", kConfirmed);
  const auto row_at = [&](double place_mm) {
    SweepQuestion question;
    question.push.place_mm = place_mm;
    question.speed_mm_s = 0.0;
    question.turn_deg_s = 40.0;
    return answered(scenes.pivot, question);
  };
  bool falls = true;
  double last = row_at(34.0).values[0];
  const double first = last;
  for (const double place : spaced(30.0, -30.0, 16)) {
    const double force = row_at(place).values[0];
    falls = falls && force < last;
    last = force;
  }
  add(rows, "The further the pusher from the pivoting axis, the smaller the force.",
      "VII-B, Fig. 8",
      std::string(falls ? "Falls at every step" : "Does not fall everywhere") +
          ", from " + page.number("s.pivot.first", first, "%.3f") + " to " +
          page.number("s.pivot.last", last, "%.3f") + " N.",
      "query sweep problems/paper/pivot.yaml --over place_mm=34:-30:17 --speed-mm-s 0 "
      "--turn-deg-s 40",
      falls ? kConfirmed : kDiffers);
  const auto drift_at = [&](double place) {
    const SweepRow row = row_at(place);
    return 1e3 * std::hypot(row.values[3], row.values[4]) / std::abs(row.values[5]);
  };
  add(rows, "… and the more dominant the pivoting over undesired slip.", "VII-B",
      "Distance of the centre of rotation from the finger axis: " +
          page.number("s.pivot.slip_near", drift_at(34.0), "%.3f") +
          " mm with the edge near, " +
          page.number("s.pivot.slip_far", drift_at(-30.0), "%.3f") + " mm with it far.",
      "query sweep problems/paper/pivot.yaml --over place_mm=34:-30:17 --speed-mm-s 0 "
      "--turn-deg-s 40 --show v_x,v_y,omega",
      kConfirmed);
}

void add_rolling(ReportPage& page, const PaperScenes& scenes, Rows& rows) {
  SweepQuestion question;
  question.of = SweepOf::kRoll;
  const auto light = [&](double grip, double mu) {
    return ask(changed(scenes.roll,
                       [&](Scene& scene) {
                         scene.gripper.grip_force = grip;
                         scene.pushers[0].friction = mu;
                       }),
               question);
  };
  constexpr double kLoose = 3.0;
  const double threshold = light(kLoose, 0.5).values[0];
  int rolls = 0;
  int slides = 0;
  int between = 0;
  for (const double mu : spaced(0.02, 1.2, 200)) {
    const double share = light(kLoose, mu).values[1];
    ++(share > 0.999 ? rolls : share < 0.001 ? slides : between);
  }
  add(rows,
      "At low friction of the external contact the object purely slides; with more the "
      "tendency to roll increases, up to pure rolling above a certain coefficient.",
      "VII-C",
      "Of 200 coefficients from 0.02 to 1.2 at 3 N, " +
          page.number("s.roll.slides", slides, "%.0f") + " slide, " +
          page.number("s.roll.rolls", rolls, "%.0f") + " roll, " +
          page.number("s.roll.between", between, "%.0f") +
          " do something in between. Threshold in closed form: " +
          page.number("s.roll.threshold", threshold, "%.5f") + ".",
      "query sweep problems/paper/roll.yaml --of roll --set gripper.grip_force=3 --over "
      "pushers.0.friction=0.02:1.2:200 --show roll_share",
      kLimits, "both ends confirmed, but it is a jump: a cylinder does not roll in part");
  const auto rolling = [&](double grip) {
    const SweepRow row = light(grip, 0.9);
    return row.values[1] > 0.5 ? 1.0 : -1.0;
  };
  const double weight = 9.81 * scenes.roll.mass;
  const auto alone = [&](double grip) { return light(grip, 0.9).answered ? 1.0 : -1.0; };
  add(rows,
      "The same is observed when the gripping force goes from high to low; grasped "
      "harder, the object slides.",
      "VII-C, Fig. 9",
      "At table friction 0.9 the object can roll below " +
          page.number("s.roll.grip", root(1.0, 12.0, rolling), "%.4f") + " N. Above " +
          page.number("s.roll.carried", root(1.0, 6.0, alone), "%.4f") +
          " N (closed form " +
          page.number("s.roll.carried_closed", weight / (2.0 * 0.3), "%.4f") +
          " N) the fingers can carry it, and rolling is one of two motions.",
      "query sweep problems/paper/roll.yaml --of roll --over gripper.grip_force=1:12:45 "
      "--show roll_share",
      kLimits, "between the two forces the answer depends on who carries the weight");
  const Transition bar = apply(scenes.prism, scenes.prism.scene.start, Roll{0, 0.03});
  const Model tall = changed(scenes.prism, [](Scene& scene) {
    scene.gripper.pad = RectanglePad{{0.03, 0.1}};
    scene.pushers[0].friction = 50.0;
  });
  const Transition upright = apply(tall, tall.scene.start, Roll{0, 0.03});
  add(rows,
      "The rolling primitive starts from a grasp on a prismatic or cylindrical object.",
      "VII-C",
      "A square bar held above its middle by low pads turns by " +
          page.number("s.prism.turn", -to_deg(bar.end.psi), "%.3f") +
          "° over its edge. Between jaws as tall as the bar it turns by " +
          page.number("s.prism.upright", std::abs(to_deg(upright.end.psi)), "%.1f") +
          "° even at a table friction of 50.",
      "query push problems/paper/roll_prism.yaml --kind roll --travel-mm 30", kLimits,
      "flat jaws hold a flat side upright unless they hold it by a low strip");
}

void add_future(ReportPage& page, const PaperScenes& scenes, Rows& rows) {
  const Plan plan = plan_regrasp(scenes.slide);
  add(rows,
      "Future work: continuous motions, and the location and motion of the pusher for a "
      "desired reorientation.",
      "VIII",
      "A plan for the slide: " +
          page.number("s.plan.pushes", static_cast<double>(plan.pushes.size()), "%.0f") +
          " push, cost " + page.number("s.plan.cost", plan.cost, "%.4f") +
          " against a lower bound of " +
          page.number("s.plan.bound", plan.lower_bound, "%.4f") + ".",
      "plan problems/paper/slide.yaml; prehensile query place problems/paper/slide.yaml "
      "--to 10,0,0",
      "<span class=\"done\">done</span>");
}

}  // namespace

const char* const kPointPusher =
    "pushers=[{name: pin, point: {}, friction: 0.5, position: [-0.05, 0], faces: "
    "[\"-x\"]}]";

void add_statements(ReportPage& page, const PaperScenes& scenes) {
  page.heading("statements", "What the paper says, and what is found");
  page.paragraph(
      "The paper’s statements in our words. <em>With limits</em>: true in the set-up "
      "shown, with a boundary that the paper does not name.");
  Rows rows = {{"statement", "where", "found", "verdict"}};
  add_sliding(page, scenes, rows);
  add_cones(page, scenes, rows);
  add_pivoting(page, scenes, rows);
  add_rolling(page, scenes, rows);
  add_future(page, scenes, rows);
  page.table(rows, "statements");
}

}  // namespace prehensile::apps
