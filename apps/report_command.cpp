#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/option_checks.h"
#include "apps/paper_report.h"
#include "apps/paper_scenes.h"
#include "apps/table.h"
#include "apps/version.h"
#include "io/plan_file.h"
#include "io/scene_file.h"

namespace prehensile::apps {
namespace {

Model model_of(const char* yaml, const char* label) {
  return prepare(parse_scene(yaml, label).scene);
}

}  // namespace

PaperScenes paper_scenes() {
  return {model_of(paper::kSlide, "slide.yaml"), model_of(paper::kPivot, "pivot.yaml"),
          model_of(paper::kRoll, "roll.yaml"),
          model_of(paper::kRollPrism, "roll_prism.yaml")};
}

void add_scene_table(ReportPage& page, const PaperScenes& scenes) {
  page.heading("objects", "The objects");
  page.paragraph(
      "The paper prints no size, mass, friction or force. These are ours, of the order "
      "of "
      "its photographs; all are files in <code>problems/paper</code>.");
  std::vector<std::vector<std::string>> rows = {{"file", "object", "mass", "pads",
                                                 "finger friction", "grip force",
                                                 "pusher", "its friction"}};
  const auto add = [&](const char* file, const Model& model, const char* object,
                       const char* pads, const char* pusher) {
    const std::string id = std::string("scene.") + file;
    const Gripper& gripper = model.scene.gripper;
    rows.push_back(
        {code(file), object, page.number(id + ".mass_g", 1e3 * model.mass, "%.0f") + " g",
         pads, page.number(id + ".friction", gripper.friction[0], "%.2f"),
         page.number(id + ".grip", gripper.grip_force, "%.1f") + " N", pusher,
         page.number(id + ".pusher", model.scene.pushers[0].friction, "%.2f")});
  };
  add("slide", scenes.slide, "box 100 × 40 × 25 mm", "discs, 10 mm radius",
      "edge, 30 mm");
  add("pivot", scenes.pivot, "box 120 × 30 × 25 mm", "discs, 8 mm radius", "edge, 50 mm");
  add("roll", scenes.roll, "cylinder, 20 mm radius", "squares, 20 mm", "table");
  add("roll_prism", scenes.prism, "square bar, 30 mm", "strips 30 × 2 mm",
      "rubber sheet");
  page.table(rows, "objects");
}

std::string paper_report() {
  const PaperScenes scenes = paper_scenes();
  ReportPage page;
  add_scene_table(page, scenes);
  add_slide_figures(page, scenes);
  add_pivot_figure(page, scenes);
  add_roll_figures(page, scenes);
  add_statements(page, scenes);
  add_traps(page, scenes);
  std::string lead =
      "<p>“Prehensile Pushing: In-hand Manipulation with Push-Primitives” ";
  lead += "(IROS 2015), computed again: its figures for stated objects, its statements ";
  lead +=
      "beside what the software finds, and what its equations get wrong. Every number ";
  lead += "on this page was computed when the page was written, by prehensile ";
  lead += version();
  lead += "; every exact answer has passed its certificate.</p>\n";
  return page.str("Prehensile pushing, recomputed", lead);
}

Command add_report(CLI::App& app) {
  auto file = std::make_shared<std::string>();
  CLI::App& command = *app.add_subcommand(
      "report", "the paper's figures and statements, recomputed, as one HTML page");
  command.add_option("-o,--output", *file, "HTML file to write")
      ->check(is_output())
      ->required();
  command.footer("Example:\n  prehensile report -o report.html");
  return [file] {
    const std::string page = paper_report();
    write_atomically(*file, page);
    std::printf("wrote %s, %.0f kB\n", file->c_str(),
                1e-3 * static_cast<double>(page.size()));
    return static_cast<int>(kDone);
  };
}

}  // namespace prehensile::apps
