// Figs. 5, 6 and 8 of the paper, recomputed.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "apps/paper_report.h"
#include "apps/table.h"
#include "mechanics/solvers.h"
#include "primitives/transition.h"
#include "scene/outline.h"

namespace prehensile::apps {
namespace {

constexpr double kTurnRate = 40.0;  // [deg/s] of the pivoting pusher

std::vector<plot::Point> outline_at(const Model& model, const PlanarPose& X_HO) {
  std::vector<plot::Point> points;
  for (const Vec2& v : model.outline) {
    const Vec2 p = 1e3 * transform(X_HO, v);
    points.push_back({p.x(), p.y()});
  }
  return points;
}

SweepQuestion pivot_at(double place_mm) {
  SweepQuestion question;
  question.push.place_mm = place_mm;
  question.speed_mm_s = 0.0;
  question.turn_deg_s = kTurnRate;
  return question;
}

/// The object in the hand before and after a push, as in Fig. 5.
plot::Chart before_and_after(const Model& model, const Grasp& end,
                             const std::string& title) {
  plot::Chart chart;
  chart.title = title;
  chart.x = {.label = "x in the hand [mm]", .low = -80.0, .high = 70.0};
  chart.y = {.label = "y in the hand [mm]", .low = -45.0, .high = 45.0};
  chart.equal_scales = true;
  chart.width = 520.0;
  chart.height = 380.0;
  const PlanarPose& start = model.scene.start.X_HO;
  chart.series.emplace_back(plot::Region{.label = "start",
                                         .points = outline_at(model, start),
                                         .colour = plot::Colour::kGrey,
                                         .filled = false});
  chart.series.emplace_back(plot::Region{.label = "end",
                                         .points = outline_at(model, end.X_HO),
                                         .colour = plot::Colour::kBlue});
  const double radius = 1e3 * std::get<DiscPad>(model.scene.gripper.pad).radius;
  chart.series.emplace_back(plot::Region{
      .label = "pads",
      .points = plot::sector({0.0, 0.0}, 0.0, radius, 0.0, 2.0 * std::numbers::pi),
      .colour = plot::Colour::kOrange});
  const Vec2 foot =
      1e3 * transform(start, 0.5 * (model.contacts[0].a + model.contacts[0].b));
  chart.series.emplace_back(plot::Arrow{.label = "pusher",
                                        .tail = {foot.x() - 12.0, foot.y()},
                                        .head = {foot.x(), foot.y()},
                                        .colour = plot::Colour::kRed});
  return chart;
}

}  // namespace

SweepRow answered(const Model& model, const SweepQuestion& question) {
  const SweepRow row = ask(model, question);
  if (row.answered) return row;
  throw std::runtime_error("report: " + model.scene.name + ": " + row.status + ": " +
                           row.reason);
}

std::vector<double> spaced(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(low + i * (high - low) / (count - 1.0));
  return values;
}

void add_slide_figures(ReportPage& page, const PaperScenes& scenes) {
  page.heading("sliding", "Straight sliding (section VII-A, Figs. 5 and 6)");
  const Slide slide{.contact = 0, .e = {1.0, 0.0}, .travel = 0.02};
  const LinearPush push{.contact = 0, .e = {1.0, 0.0}, .travel = 0.02};
  const Model point = changed(
      scenes.slide, [](Scene& scene) { scene.pushers[0].feature = PointFeature{}; });
  const Transition by_point = apply(point, point.scene.start, push);
  const Transition by_line = apply(scenes.slide, scenes.slide.scene.start, slide);
  page.figure(
      "fig5",
      plot::svg_of_sheet({before_and_after(point, by_point.end, "(a) point pusher"),
                          before_and_after(scenes.slide, by_line.end, "(b) line pusher")},
                         2),
      "Fig. 5 again: 20 mm by a point (a) and by a line (b), gravity along −y. The point "
      "turns the part by " +
          page.number("fig5.point.turn_deg", to_deg(by_point.end.X_HO.theta), "%.2f") +
          "°, the line by " +
          page.number("fig5.line.turn_deg", to_deg(by_line.end.X_HO.theta), "%.2f") +
          "°." + code("prehensile query push problems/paper/slide.yaml --travel-mm 20"));

  plot::Chart chart;
  chart.title = "Push force against grip force";
  chart.x = {.label = "grip force [N]", .from_zero = true};
  chart.y = {.label = "normal push force [N]", .from_zero = true};
  chart.height = 400.0;
  double worst = 0.0;
  for (const double mu : {0.3, 0.5, 0.7}) {
    plot::Scatter solved{.label = text("exact solver, finger friction %.1f", mu),
                         .points = {}};
    plot::Line closed{.label = "",
                      .points = {},
                      .colour = plot::Colour::kGrey,
                      .dash = plot::Dash::kDashed};
    for (const double grip : spaced(6.0, 40.0, 18)) {
      const Model model = changed(scenes.slide, [&](Scene& scene) {
        scene.gripper.friction = {mu, mu};
        scene.gripper.grip_force = grip;
      });
      const SweepRow row = answered(model);
      const double closed_form = 2.0 * mu * grip;
      worst = std::max(worst, std::abs(row.values[1] - closed_form) / closed_form);
      solved.points.push_back({grip, row.values[1]});
      closed.points.push_back({grip, closed_form});
    }
    chart.series.emplace_back(std::move(closed));
    chart.series.emplace_back(std::move(solved));
  }
  page.figure("fig6", chart.svg(),
              "Fig. 6 again: the force that breaks the grasp is linear in the grip "
              "force. Dashed: the closed form 2 μ N (with less grip the line no longer "
              "balances the weight, and the part tips). Largest relative difference: " +
                  page.number("fig6.worst", worst, "%.1e") + "." +
                  code("prehensile query sweep problems/paper/slide.yaml --over "
                       "gripper.grip_force=6:40:18 --show normal_force"));
}

void add_pivot_figure(ReportPage& page, const PaperScenes& scenes) {
  page.heading("pivoting", "Pivoting (section VII-B, Fig. 8)");
  const PushContact& contact = scenes.pivot.contacts[0];
  const double finger = contact.t.dot(finger_in_object(scenes.pivot.scene.start.X_HO) -
                                      0.5 * (contact.a + contact.b));
  const Model point = changed(
      scenes.pivot, [](Scene& scene) { scene.pushers[0].feature = PointFeature{}; });
  plot::Chart chart;
  chart.title = "Pivot force against the place of the pusher";
  chart.x = {.label = "distance of the pusher from the finger axis [mm]",
             .from_zero = true};
  chart.y = {.label = "push force [N]", .from_zero = true};
  chart.height = 400.0;
  std::vector<double> forces;
  for (const bool is_point : {false, true}) {
    plot::Line line{.label = is_point ? "point pusher" : "line pusher, 50 mm long",
                    .points = {},
                    .marks = true};
    for (const double place : spaced(34.0, -30.0, 17)) {
      const SweepRow row = answered(is_point ? point : scenes.pivot, pivot_at(place));
      line.points.push_back({1e3 * finger - place, row.values[0]});
      if (!is_point) forces.push_back(row.values[0]);
    }
    chart.series.emplace_back(std::move(line));
  }
  page.figure(
      "fig8", chart.svg(),
      "Fig. 8 again: the further out the edge pushes, the less force it takes, "
      "from " +
          page.number("fig8.near", forces.front(), "%.2f") + " N at " +
          page.number("fig8.near_mm", 1e3 * finger - 34.0, "%.0f") +
          " mm (centre of the edge) to " +
          page.number("fig8.far", forces.back(), "%.2f") + " N at " +
          page.number("fig8.far_mm", 1e3 * finger + 30.0, "%.0f") +
          " mm. What counts is the end of the edge that presses: a point where the near "
          "edge ends, at " +
          page.number("fig8.end_mm", 1e3 * finger - 9.0, "%.0f") + " mm, takes " +
          page.number("fig8.end", answered(point, pivot_at(9.0)).values[0], "%.2f") +
          " N." +
          code("prehensile query sweep problems/paper/pivot.yaml --over "
               "place_mm=34:-30:17 --speed-mm-s 0 --turn-deg-s 40"));
}

}  // namespace prehensile::apps
