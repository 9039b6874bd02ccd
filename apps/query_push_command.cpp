#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/grip_report.h"
#include "apps/json_number.h"
#include "apps/mujoco_output.h"
#include "apps/option_checks.h"
#include "apps/plan_report.h"
#include "apps/push_options.h"
#include "apps/table.h"
#include "apps/view_output.h"
#include "io/object_surface.h"
#include "io/plan_file.h"
#include "io/scene_file.h"
#include "planner/plan.h"
#include "primitives/transition.h"

namespace prehensile::apps {
namespace {

struct Options {
  SceneOptions scene;
  PushOptions push;
  PathOptions path;
  bool grip_range = false;
  double grip_tolerance_mm = 1.0;
  int grip_places = GripRangeOptions{}.samples;
  std::string view;
  std::string mjcf;
};

/// What the pad plane does not have: forces of the jaws and how their pads press.
std::string describe_space(const std::vector<Sample>& trace, std::size_t stride) {
  Table table({"done %", "jaw 1 N", "jaw 2 N", "moment across N mm", "pressed %",
               "out of plane %"});
  for (std::size_t i = 0; i < trace.size(); i += stride) {
    const Sample& s = trace[i];
    table.add({text("%.1f", 100.0 * s.s), text("%.4f", s.jaw_force[0]),
               text("%.4f", s.jaw_force[1]), text("%.4f", to_mm(s.moment_across)),
               text("%.0f", 100.0 * s.pressed), text("%.1f", 100.0 * s.out_of_plane)});
  }
  return "followed in space, where the loads of the pads shift:\n" + table.str();
}

std::string describe(const Model& model, const Options& options,
                     const Transition& transition, const std::vector<Sample>& trace) {
  std::string out = options.path.kind + ": " + std::string(name(transition.status)) +
                    text(" after %.1f %% of the push", 100.0 * transition.done) + '\n';
  if (!transition.reason.empty()) out += std::string(transition.reason) + '\n';
  Table table({"done %", "x mm", "y mm", "theta deg", "roll deg", "force N", "normal N",
               "tangential N", "slip mm", "status"});
  const std::size_t stride = std::max<std::size_t>(1, trace.size() / 20);
  for (std::size_t i = 0; i < trace.size(); i += stride) {
    const Sample& s = trace[i];
    table.add({text("%.1f", 100.0 * s.s), text("%.3f", to_mm(s.grasp.X_HO.x)),
               text("%.3f", to_mm(s.grasp.X_HO.y)),
               text("%.3f", to_deg(s.grasp.X_HO.theta)),
               text("%.3f", to_deg(s.grasp.psi)), text("%.4f", s.push_force),
               text("%.4f", s.normal_force), text("%.4f", s.tangential_force),
               text("%.4f", to_mm(s.slip_rate)), std::string(name(s.status))});
  }
  out += table.str();
  if (transition.in_space) out += describe_space(trace, stride);
  for (int i = 0; i < transition.event_count; ++i) {
    out += text("event at %.3f %%: ", 100.0 * transition.events[i].s) +
           std::string(name(transition.events[i].kind)) + '\n';
  }
  if (transition.more_events > 0) {
    out += text("and %d events more in between\n", transition.more_events);
  }
  out += "end: " + pose_text(model, transition.end) + '\n';
  // A push that stops at once may have no instant to tell of.
  if (std::isfinite(transition.max_push_force)) {
    out += text("force %.4f to %.4f N, certificate %.0e, ", transition.min_push_force,
                transition.max_push_force, transition.worst_certificate);
  }
  if (std::isfinite(transition.error_estimate)) {
    out += text("estimated error %.2g um, ", 1e6 * transition.error_estimate);
  }
  return out + text("slipped %.3f mm, %d instants\n", to_mm(transition.slipped),
                    transition.instants);
}

nlohmann::ordered_json pose_json(const Grasp& grasp) {
  return {{"x", number(grasp.X_HO.x)},
          {"y", number(grasp.X_HO.y)},
          {"theta", number(grasp.X_HO.theta)},
          {"psi", number(grasp.psi)}};
}

nlohmann::ordered_json to_json(const Transition& transition,
                               const std::vector<Sample>& trace) {
  nlohmann::ordered_json out = {{"status", std::string(name(transition.status))},
                                {"reason", std::string(transition.reason)},
                                {"done", number(transition.done)},
                                {"end", pose_json(transition.end)},
                                {"min_push_force", number(transition.min_push_force)},
                                {"max_push_force", number(transition.max_push_force)},
                                {"slipped", number(transition.slipped)},
                                {"error_estimate", number(transition.error_estimate)},
                                {"certificate", number(transition.worst_certificate)},
                                {"instants", transition.instants},
                                {"in_space", transition.in_space},
                                {"events", nlohmann::ordered_json::array()},
                                {"more_events", transition.more_events},
                                {"samples", nlohmann::ordered_json::array()}};
  for (int i = 0; i < transition.event_count; ++i) {
    out["events"].push_back({{"done", number(transition.events[i].s)},
                             {"kind", std::string(name(transition.events[i].kind))}});
  }
  for (const Sample& s : trace) {
    nlohmann::ordered_json sample = {{"done", number(s.s)}};
    sample.update(pose_json(s.grasp));
    sample.update({{"push_force", number(s.push_force)},
                   {"normal_force", number(s.normal_force)},
                   {"tangential_force", number(s.tangential_force)},
                   {"slip", number(s.slip_rate)},
                   {"status", std::string(name(s.status))}});
    if (std::isfinite(s.opening)) sample["opening"] = s.opening;
    sample.update({{"certificate", number(s.certificate)}});
    if (transition.in_space) {
      sample.update({{"jaw_force", {number(s.jaw_force[0]), number(s.jaw_force[1])}},
                     {"moment_across", number(s.moment_across)},
                     {"pressed", number(s.pressed)},
                     {"out_of_plane", number(s.out_of_plane)}});
    }
    out["samples"].push_back(sample);
  }
  return out;
}

int run_grip_range(const Options& options, const Model& model, const Push& push) {
  GripRangeOptions wanted;
  wanted.tolerance = 1e-3 * options.grip_tolerance_mm;
  wanted.samples = options.grip_places;
  wanted.transition.tolerance =
      std::min(1e-6 * options.path.tolerance_um, 0.01 * wanted.tolerance);
  const GripRange range =
      grip_range(model, chosen_grasp(model, options.push), push, wanted);
  if (options.scene.json) {
    std::printf("%s\n", grip_json(range).dump(2).c_str());
  } else {
    std::fputs(grip_text(model, range).c_str(), stdout);
  }
  return range.found ? kDone : kNegative;
}

/// A plan of this push alone, which states nothing.
Plan plan_of(const Grasp& start, const Push& push) {
  Plan plan;
  plan.start = plan.goal = start;
  plan.margin = Margin::none();
  plan.pushes.push_back({.push = push, .start = start, .end = start});
  return plan;
}

int run(const Options& options) {
  check_view_option(options.view);
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  const Model model =
      prepare(file.scene, {.points_per_pad = options.path.points, .other_grips = false});
  const int contact = chosen_contact(model, options.push);
  const Push push = chosen_push(model, contact, options.push, options.path);
  if (options.grip_range) return run_grip_range(options, model, push);
  const Plan alone = plan_of(chosen_grasp(model, options.push), push);
  const std::string mjcf = mjcf_text(options.mjcf, model, alone.pushes);
  std::vector<Sample> trace;
  const Transition transition =
      apply(model, chosen_grasp(model, options.push), push,
            {.tolerance = 1e-6 * options.path.tolerance_um}, &trace);
  if (!options.view.empty()) {
    write_view({.page = options.view},
               {{model,
                 alone,
                 false,
                 {},
                 read_object_surface(options.scene.file, options.scene.overrides)}});
  }
  if (!mjcf.empty()) write_atomically(options.mjcf, mjcf);
  if (options.scene.json) {
    std::printf("%s\n", to_json(transition, trace).dump(2).c_str());
  } else {
    std::fputs(describe(model, options, transition, trace).c_str(), stdout);
    if (!options.view.empty()) std::printf("page: %s\n", options.view.c_str());
  }
  return transition.completed() ? kDone : kNegative;
}

}  // namespace

Command add_query_push(CLI::App& query) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *query.add_subcommand("push", "one push from pose to pose");
  add_scene_options(command, options->scene);
  add_push_options(command, options->push);
  add_path_options(command, options->path);
  command.add_flag("--grip-range", options->grip_range,
                   "instead: the grip forces with which this push ends where it should");
  command
      .add_option("--grip-tolerance-mm", options->grip_tolerance_mm,
                  "how far from there it may end (--grip-range)")
      ->check(in_range(1e-6, 1e3))
      ->capture_default_str();
  command
      .add_option("--grip-places", options->grip_places,
                  "steps between the places along the push whose needs are shown "
                  "(--grip-range)")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_view_option(command, options->view);
  add_mjcf_option(command, options->mjcf);
  command.footer(
      "Example:\n  prehensile query push problems/paper/slide.yaml --kind slide "
      "--travel-mm 15");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
