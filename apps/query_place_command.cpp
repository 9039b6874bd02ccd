#include <cstdio>
#include <memory>
#include <numbers>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/option_checks.h"
#include "apps/place_report.h"
#include "apps/plan_report.h"
#include "apps/push_options.h"
#include "apps/table.h"
#include "io/plan_file.h"

namespace prehensile::apps {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

struct Options {
  SceneOptions scene;
  std::string pusher;
  std::string face;
  std::vector<double> at;
  std::vector<double> twist;
  std::vector<double> to;
  std::vector<double> grip;
  bool least_force = false;
  double margin = 1.0;
  int points = 16;
  std::string csv;
  std::string plot;
};

WantedMotion wanted_motion(const Options& options, const Model& model,
                           const Grasp& grasp) {
  if (options.twist.empty() == options.to.empty()) {
    throw BadInput("query place: expected one of --twist and --to");
  }
  if (!options.twist.empty()) {
    const PlanarTwist V_HO(1e-3 * options.twist[0], 1e-3 * options.twist[1],
                           kRadPerDeg * options.twist[2]);
    if (V_HO.isZero(0.0)) throw BadInput("--twist 0,0,0: expected a motion");
    return motion_of_twist(grasp.X_HO, V_HO);
  }
  const PlanarPose to{1e-3 * options.to[0], 1e-3 * options.to[1],
                      kRadPerDeg * options.to[2]};
  if (to == grasp.X_HO) throw BadInput("--to: expected another pose than the start");
  if (!pads_on_object(model, to)) {
    throw BadInput("--to " +
                   text("%g,%g,%g", options.to[0], options.to[1], options.to[2]) +
                   ": expected a pose with the pads on the object");
  }
  return motion_between(grasp.X_HO, to);
}

/// All contacts, or those of the pusher and face that were named.
std::vector<int> allowed_contacts(const Options& options, const Model& model) {
  std::vector<int> out;
  for (int i = 0; i < static_cast<int>(model.contacts.size()); ++i) {
    const PushContact& contact = model.contacts[i];
    const bool named =
        (options.pusher.empty() ||
         model.scene.pushers[contact.pusher].name == options.pusher) &&
        (options.face.empty() || model.faces[contact.face].name == options.face);
    if (named) out.push_back(i);
  }
  if (out.empty()) {
    // Says what exists.
    chosen_contact(model, {.pusher = options.pusher, .face = options.face});
  }
  return out;
}

int run(const Options& options) {
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  const Model model =
      prepare(file.scene, {.points_per_pad = options.points, .other_grips = false});
  note_pad_plane(model,
                 "pushes are sought and made in space; what no contact can do is not "
                 "proved");
  const Grasp grasp = chosen_grasp(model, {.at = options.at});
  PlaceReport report{.model = model};
  report.scene = options.scene.file;
  report.wanted = wanted_motion(options, model, grasp);
  report.options.margin = Margin{}.scaled(options.margin);
  report.options.least_force = options.least_force;
  report.options.contacts = allowed_contacts(options, model);
  if (!options.grip.empty()) {
    report.options.grip_low = options.grip[0];
    report.options.grip_high = options.grip[1];
    if (!(options.grip[0] <= options.grip[1])) {
      throw BadInput("--grip-force: expected the lower one first");
    }
  }
  report.question =
      report.wanted.is_path
          ? text("from %s to %g mm, %g mm, %g deg", pose_text(model, grasp).c_str(),
                 options.to[0], options.to[1], options.to[2])
          : text("object twist %g mm/s, %g mm/s, %g deg/s at ", options.twist[0],
                 options.twist[1], options.twist[2]) +
                pose_text(model, grasp);
  report.answer = find_place(model, report.wanted, report.options);
  if (report.answer.status == PlaceAnswer::Status::kBadInput) {
    throw BadInput("query place: " + std::string(report.answer.reason));
  }
  const bool found = report.answer.status == PlaceAnswer::Status::kFound;
  if (!found) {
    WantedMotion instant = report.wanted;
    instant.is_path = false;
    report.nearest = nearest_motion(model, instant, report.options);
  }
  if (!options.csv.empty() || !options.plot.empty()) {
    const std::vector<PlaceCurve> curves = curves_of(report);
    if (!options.csv.empty()) write_atomically(options.csv, to_csv(curves));
    if (!options.plot.empty()) write_atomically(options.plot, to_svg(report, curves));
  }
  const std::string out =
      options.scene.json ? to_json(report).dump(2) + '\n' : describe(report);
  std::fputs(out.c_str(), stdout);
  return found ? kDone : kNegative;
}

}  // namespace

Command add_query_place(CLI::App& query) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *query.add_subcommand(
      "place", "where and how to push so that the object moves as wanted");
  add_scene_options(command, options->scene);
  const auto three = [&](const char* name, std::vector<double>& values,
                         const char* what) {
    command.add_option(name, values, what)
        ->delimiter(',')
        ->expected(3)
        ->check(in_range(-1e6, 1e6));
  };
  three("--twist", options->twist,
        "wanted twist of the object in the hand, about the finger axis: "
        "vx_mm_s,vy_mm_s,omega_deg_s");
  three("--to", options->to, "wanted pose in the hand: x_mm,y_mm,theta_deg");
  three("--at", options->at,
        "pose in the hand before: x_mm,y_mm,theta_deg; default: the scene's start");
  command.add_option("--pusher", options->pusher, "only this pusher");
  command.add_option("--face", options->face, "only this face");
  command
      .add_option("--grip-force", options->grip,
                  "[N] low,high: grip forces to choose from; default: that of the scene")
      ->delimiter(',')
      ->expected(2)
      ->check(in_range(1e-9, 1e6));
  command.add_flag("--least-force", options->least_force,
                   "least push force that keeps the margin, instead of most margin");
  command
      .add_option(
          "--margin", options->margin,
          "factor on the box of uncertainty: 10 % of frictions, forces and torque "
          "radius, 1 mm of place and centre of mass")
      ->check(in_range(0.0, 5.0))
      ->capture_default_str();
  command.add_option("--points", options->points, "contact points per pad")
      ->check(CLI::IsMember({1, 4, 8, 16, 32, 64}))
      ->capture_default_str();
  command.add_option("--csv", options->csv, "write margins against place to this file")
      ->check(is_output());
  command.add_option("--plot", options->plot, "write a picture (SVG) to this file")
      ->check(is_output());
  command.footer(
      "Example:\n  prehensile query place problems/paper/slide.yaml --to 10,0,0\n"
      "  prehensile query place problems/paper/pivot.yaml --twist 0,0,30 --grip-force "
      "5,40 --least-force");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
