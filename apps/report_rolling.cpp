// Fig. 9 of the paper: where rolling begins, and rolling over edges.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/paper_report.h"
#include "apps/table.h"
#include "primitives/roll.h"

namespace prehensile::apps {
namespace {

plot::Chart roll_map(const PaperScenes& scenes, int& rolling, int& undecided) {
  plot::Chart chart;
  chart.title = "Where a cylinder rolls";
  chart.x = {.label = "grip force [N]"};
  chart.y = {.label = "friction of the table"};
  plot::HeatMap map{.label = "share of rolling",
                    .x = spaced(0.5, 12.0, 24),
                    .y = spaced(0.05, 1.2, 24),
                    .values = {},
                    .blank = "two motions"};
  SweepQuestion question;
  question.of = SweepOf::kRoll;
  for (const double mu : map.y) {
    for (const double grip : map.x) {
      const Model model = changed(scenes.roll, [&](Scene& scene) {
        scene.gripper.grip_force = grip;
        scene.pushers[0].friction = mu;
      });
      const SweepRow row = ask(model, question);
      rolling += row.answered && row.values[1] > 0.5;
      undecided += !row.answered;
      map.values.push_back(row.answered ? row.values[1] : kNan);
    }
  }
  plot::Line threshold{
      .label = "closed form", .points = {}, .colour = plot::Colour::kRed};
  const double weight = 9.81 * scenes.roll.mass;
  for (const double grip : spaced(0.5, 12.0, 60)) {
    CrossSectionModel section = *scenes.roll.cross_section;
    section.grip_force = grip;
    const double mu = rolling_threshold(section, 0.01, weight);
    if (mu <= 1.2) threshold.points.push_back({grip, mu});
  }
  chart.map = std::move(map);
  chart.series.emplace_back(std::move(threshold));
  return chart;
}

/// A regular section with as many sides, as wide between flat sides as the bar.
Model with_sides(const Model& bar, int sides) {
  return changed(bar, [&](Scene& scene) {
    auto& prism = std::get<PrismShape>(scene.object.shape);
    const double step = 2.0 * std::numbers::pi / sides;
    const double radius = 0.015 / std::cos(0.5 * step);
    prism.outline.clear();
    for (int i = 0; i < sides; ++i) {
      const double angle = (i + 0.5) * step - 0.5 * std::numbers::pi;
      prism.outline.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    if (sides > 4) scene.start.X_HO.y = 0.0;
  });
}

}  // namespace

void add_roll_figures(ReportPage& page, const PaperScenes& scenes) {
  page.heading("rolling", "Rolling (section VII-C, Fig. 9)");
  int rolling = 0;
  int undecided = 0;
  const std::string map = roll_map(scenes, rolling, undecided).svg();
  page.figure(
      "fig9", map,
      "Fig. 9 as a map: " + page.number("fig9.rolling", rolling, "%.0f") +
          " of 576 sections roll, in " +
          page.number("fig9.undecided", undecided, "%.0f") +
          " (hatched) “the support rolls it” and “the fingers carry it while the support "
          "slides past” are both motions; in the rest the object stands still. The red "
          "line is the threshold in closed form." +
          code("prehensile query sweep problems/paper/roll.yaml --of roll --over "
               "gripper.grip_force=0.5:12:24 --over pushers.0.friction=0.05:1.2:24 "
               "--show roll_share"));

  plot::Chart turn;
  turn.title = "Roll angle";
  turn.x = {.label = "travel of the support [mm]"};
  turn.y = {.label = "roll [deg]"};
  plot::Chart width = turn;
  width.title = "Opening of the jaws";
  width.y = {.label = "between the pads [mm]"};
  turn.width = width.width = 520.0;
  turn.height = width.height = 380.0;
  double widest = 0.0;
  double slowest = 0.0;
  double whole_turn = 0.0;
  for (const int sides : {4, 8, 16}) {
    const Model model = with_sides(scenes.prism, sides);
    std::vector<Sample> trace;
    const Transition out =
        apply(model, model.scene.start, Roll{0, 0.03}, {.max_step = 0.01}, &trace);
    plot::Line angle{.label = text("%d sides", sides), .points = {}};
    plot::Line opening{.label = text("%d sides", sides), .points = {}};
    for (const Sample& sample : trace) {
      angle.points.push_back({30.0 * sample.s, -to_deg(sample.grasp.psi)});
      opening.points.push_back({30.0 * sample.s, to_mm(sample.opening)});
      if (sides == 4) widest = std::max(widest, to_mm(sample.opening));
      if (sides == 4) slowest = std::max(slowest, sample.push_force);
    }
    if (sides == 4) whole_turn = -to_deg(out.end.psi);
    turn.series.emplace_back(std::move(angle));
    width.series.emplace_back(std::move(opening));
  }
  plot::Line round{.label = "cylinder",
                   .points = {{0.0, 0.0}, {30.0, to_deg(2.0)}},
                   .colour = plot::Colour::kGrey,
                   .dash = plot::Dash::kDashed};
  turn.series.emplace_back(std::move(round));
  page.figure(
      "fig9prism", plot::svg_of_sheet({turn, width}, 2),
      "Prisms roll over their edges: a square bar turns by " +
          page.number("prism.turn_deg", whole_turn, "%.2f") +
          "° while the support moves by one side of 30 mm, and opens the jaws from 30 "
          "to " +
          page.number("prism.widest_mm", widest, "%.2f") + " mm on the way, at up to " +
          page.number("prism.force", slowest, "%.2f") +
          " N. More sides come near the cylinder." +
          code("prehensile query push problems/paper/roll_prism.yaml --kind roll "
               "--travel-mm 30"));
}

}  // namespace prehensile::apps
