#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/commands.h"
#include "apps/json_number.h"
#include "apps/plan_report.h"
#include "apps/table.h"
#include "io/scene_file.h"
#include "mechanics/model.h"
#include "mechanics/size_of_problem.h"

namespace prehensile::apps {
namespace {

double grip_force_of(const Model& model, const PushContact& contact) {
  return model.scene.gripper.grip_force * contact.grip_share;
}

nlohmann::ordered_json to_json(const Model& model) {
  nlohmann::ordered_json contacts = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const PushContact& contact = model.contacts[i];
    const ProblemSize size = size_of_problem(model, static_cast<int>(i));
    contacts.push_back(
        {{"pusher", model.scene.pushers[contact.pusher].name},
         {"face", model.faces[contact.face].name},
         {"points", size.pusher_points},
         {"unknowns", size.unknowns},
         {"generators", size.generators},
         {"reference_unknowns", size.reference_unknowns},
         {"reference_constraints", size.reference_constraints},
         {"spatial_unknowns", size.spatial_unknowns},
         {"spatial_points", size.spatial_points},
         {"grip_force", number(grip_force_of(model, contact))},
         {"gravity_in_object", numbers(contact.grip_share * contact.g_O)}});
  }
  nlohmann::ordered_json decisions = nlohmann::ordered_json::array();
  for (const Decision& decision : model.decisions) {
    decisions.push_back({{"left_out", decision.what}, {"why", decision.why}});
  }
  return {{"name", model.scene.name},
          {"state_dimensions", model.state_dimensions()},
          {"finger_points", grasp_at(model, model.scene.start.X_HO, Vec2::Zero()).count},
          {"friction_capacity", number(model.F)},
          {"torque_radius", number(model.c)},
          {"length", number(model.L)},
          {"mass", number(model.mass)},
          {"centre_of_mass", numbers(model.p_OCom)},
          {"contacts", contacts},
          {"left_out", decisions}};
}

void print(const Model& model) {
  const int points = grasp_at(model, model.scene.start.X_HO, Vec2::Zero()).count;
  std::printf("%s\n", model.scene.name.c_str());
  if (!model.scene.origin.empty()) std::printf("  %s\n", model.scene.origin.c_str());
  std::printf("state: %s (%d dimensions)\n",
              model.cross_section ? "x, y, theta, roll" : "x, y, theta",
              model.state_dimensions());
  std::printf(
      "grasp: %d finger points, friction up to F = %.2f N, torque radius c = %.2f mm\n",
      points, model.F, to_mm(model.c));
  std::printf("object: %.3f kg, centre of mass at (%.1f, %.1f) mm, L = %.1f mm\n",
              model.mass, to_mm(model.p_OCom.x()), to_mm(model.p_OCom.y()),
              to_mm(model.L));
  if (!model.contacts.empty()) {
    Table table({"contact", "points", "exact: unknowns", "reference (g=8): generators",
                 "unknowns", "rows", "spatial: unknowns", "points",
                 "gravity in O m/s^2"});
    for (std::size_t i = 0; i < model.contacts.size(); ++i) {
      const int index = static_cast<int>(i);
      const ProblemSize size = size_of_problem(model, index);
      const Vec2 g = model.contacts[i].grip_share * model.contacts[i].g_O;
      table.add({contact_text(model, index), text("%d", size.pusher_points),
                 text("%d", size.unknowns), text("%d", size.generators),
                 text("%d", size.reference_unknowns),
                 text("%d", size.reference_constraints),
                 text("%d", size.spatial_unknowns), text("%d", size.spatial_points),
                 text("(%.2f, %.2f)", g.x(), g.y())});
    }
    std::fputs(table.str().c_str(), stdout);
  }
  std::printf("left out, and why:\n");
  for (const Decision& decision : model.decisions) {
    std::printf("  %s: %s\n", decision.what.c_str(), decision.why.c_str());
  }
}

int run(const SceneOptions& options) {
  const SceneFile file = read_scene(options.file, options.overrides);
  const Model model = prepare(file.scene);
  if (options.json) {
    std::printf("%s\n", to_json(model).dump(2).c_str());
  } else {
    print(model);
  }
  return kDone;
}

}  // namespace

Command add_inspect(CLI::App& app) {
  auto options = std::make_shared<SceneOptions>();
  CLI::App& command = *app.add_subcommand(
      "inspect", "what the compiled model contains, what was left out and why");
  add_scene_options(command, *options);
  command.footer("Example:\n  prehensile inspect problems/paper/slide.yaml");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
