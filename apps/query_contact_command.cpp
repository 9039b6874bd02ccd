#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/contact_report.h"
#include "apps/option_checks.h"
#include "apps/parallel.h"
#include "apps/plan_report.h"
#include "apps/push_options.h"
#include "apps/table.h"
#include "apps/uncertainty_options.h"
#include "io/plan_file.h"

namespace prehensile::apps {
namespace {

struct Options {
  SceneOptions scene;
  PushOptions push;
  PathOptions path;
  std::vector<std::string> vary;
  std::vector<double> lines_mm = {10.0, 20.0, 40.0};
  int samples = 300;
  std::uint64_t seed = 1;
  int jobs = 0;
  double level = 0.9;
  std::string csv;
  std::string plot;
};

/// Friction, pressure and place; not the pose in the hand, which no contact can mend
/// while it is flush from the start.
UncertaintyBox usual_box() {
  UncertaintyBox box;
  box[Unknown::kFriction] = 0.25;
  box[Unknown::kFingerFriction] = 0.2;
  box[Unknown::kTorqueRadius] = 0.25;
  box[Unknown::kPlace] = 2e-3;
  box[Unknown::kCentreOfMassX] = box[Unknown::kCentreOfMassY] = 2e-3;
  return box;
}

struct NamePad {
  std::string operator()(const DiscPad& pad) const {
    return text("disc of radius %.4g mm", to_mm(pad.radius));
  }
  std::string operator()(const RectanglePad& pad) const {
    return text("rectangle %.4g x %.4g mm", to_mm(pad.size.x()), to_mm(pad.size.y()));
  }
  std::string operator()(const LinePad& pad) const {
    return text("line %.4g mm at %.4g deg", to_mm(pad.length), to_deg(pad.angle));
  }
  std::string operator()(const PointPad& pad) const {
    return pad.spin_radius
               ? text("soft point, spin radius %.4g mm", to_mm(*pad.spin_radius))
               : "point";
  }
  std::string operator()(const PolygonPad& pad) const {
    return text("polygon of %zu vertices", pad.outline.size());
  }
};

/// Radius of a disc of the same size, by which other pads are made.
struct ReachOfPad {
  double operator()(const DiscPad& pad) const { return pad.radius; }
  double operator()(const RectanglePad& pad) const {
    return std::sqrt(pad.size.x() * pad.size.y() / std::numbers::pi);
  }
  double operator()(const LinePad& pad) const { return 0.5 * pad.length; }
  double operator()(const PointPad&) const { return 0.005; }
  double operator()(const PolygonPad& pad) const {
    return std::sqrt(properties_of(pad.outline).area / std::numbers::pi);
  }
};

std::string name_of(const PusherFeature& feature) {
  if (std::holds_alternative<UprightFeature>(feature)) return "upright edge";
  const std::optional<double> length = length_in_plane(feature);
  if (!length) return "point";
  const char* kind = std::holds_alternative<PlaneFeature>(feature) ? "plane" : "line";
  return std::isfinite(*length) ? text("%s %.4g mm", kind, to_mm(*length)) : "wall";
}

struct Geometry {
  PusherFeature pusher;
  Pad pad;
};

/// The scene's own pusher and pads, then other pushers with these pads, then other pads
/// with this pusher.
std::vector<Geometry> geometries(const Options& options, const Scene& scene,
                                 const PusherFeature& own) {
  const Pad& pad = scene.gripper.pad;
  std::vector<Geometry> out = {{own, pad}};
  std::vector<PusherFeature> pushers = {PointFeature{}};
  for (const double mm : options.lines_mm) pushers.push_back(LineFeature{1e-3 * mm});
  pushers.push_back(LineFeature{});
  for (const PusherFeature& pusher : pushers) {
    if (name_of(pusher) != name_of(own)) out.push_back({pusher, pad});
  }
  const double r = std::visit(ReachOfPad{}, pad);
  const double side = r * std::sqrt(std::numbers::pi);
  const std::vector<Pad> pads = {DiscPad{r},
                                 DiscPad{2.0 * r},
                                 RectanglePad{{side, side}},
                                 RectanglePad{{2.0 * side, 0.5 * side}},
                                 RectanglePad{{0.5 * side, 2.0 * side}},
                                 LinePad{2.0 * r, 0.0},
                                 LinePad{2.0 * r, 0.5 * std::numbers::pi},
                                 PointPad{}};
  for (const Pad& other : pads) {
    if (std::visit(NamePad{}, other) != std::visit(NamePad{}, pad)) {
      out.push_back({own, other});
    }
  }
  return out;
}

ContactVariant ask(const Options& options, const Scene& scene, const Geometry& geometry,
                   int contact, int pusher, const Grasp& grasp, const Push& push,
                   const UncertaintyBox& box) {
  ContactVariant variant;
  variant.pusher = name_of(geometry.pusher);
  variant.pad = std::visit(NamePad{}, geometry.pad);
  Scene changed = scene;
  changed.pushers[static_cast<std::size_t>(pusher)].feature = geometry.pusher;
  changed.gripper.pad = geometry.pad;
  for (const Fault& fault : check(changed)) {
    variant.refusal += variant.refusal.empty() ? "" : "; ";
    variant.refusal += fault.field + ": " + fault.what;
  }
  if (!variant.refusal.empty()) return variant;
  const Model model =
      prepare(changed, {.points_per_pad = options.path.points, .other_grips = false});
  variant.torque_radius = model.c;
  if (contact >= static_cast<int>(model.contacts.size())) {
    variant.refusal = "this contact does not exist with that geometry";
    return variant;
  }
  if (!pads_on_object(model, grasp.X_HO)) {
    variant.refusal = "the pads are not on the object";
    return variant;
  }
  variant.ensemble = run_ensemble(model, grasp, push,
                                  {.box = box,
                                   .samples = options.samples,
                                   .seed = options.seed,
                                   .jobs = number_of_jobs(options.jobs),
                                   .tolerance = 1e-6 * options.path.tolerance_um});
  return variant;
}

int run(const Options& options) {
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  const Model model =
      prepare(file.scene, {.points_per_pad = options.path.points, .other_grips = false});
  const int contact = chosen_contact(model, options.push);
  const Grasp grasp = chosen_grasp(model, options.push);
  const Push push = chosen_push(model, contact, options.push, options.path);
  const int pusher = model.contacts[contact].pusher;
  ContactReport report;
  report.question =
      options.path.kind + " at " + contact_text(model, contact) +
      text(", place %.2f mm, %.4g mm, turning %.4g deg", options.push.place_mm,
           options.path.kind == "pivot" ? 0.0 : options.path.travel_mm,
           options.path.turn_deg);
  report.box = parse_box(options.vary, usual_box());
  report.level = options.level;
  report.reach = 0.5 * model.L;
  const std::vector<Geometry> all =
      geometries(options, file.scene, file.scene.pushers[pusher].feature);
  for (const Geometry& geometry : all) {
    report.variants.push_back(
        ask(options, file.scene, geometry, contact, pusher, grasp, push, report.box));
  }
  report.variants.front().is_scenes_own = true;
  if (!options.csv.empty()) write_atomically(options.csv, to_csv(report));
  if (!options.plot.empty()) write_atomically(options.plot, to_svg(report));
  const std::string out =
      options.scene.json ? to_json(report).dump(2) + '\n' : describe(report);
  std::fputs(out.c_str(), stdout);
  const bool any = std::any_of(
      report.variants.begin(), report.variants.end(),
      [](const ContactVariant& variant) { return variant.ensemble.completed() > 0; });
  return any ? kDone : kNegative;
}

}  // namespace

Command add_query_contact(CLI::App& query) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *query.add_subcommand(
      "contact", "which pusher and pads make one push most predictable");
  add_scene_options(command, options->scene);
  add_push_options(command, options->push);
  add_path_options(command, options->path);
  add_vary_option(command, options->vary);
  command
      .add_option("--lines-mm", options->lines_mm,
                  "lengths of the line pushers that are compared")
      ->delimiter(',')
      ->check(in_range(1e-2, 1e4))
      ->capture_default_str();
  command.add_option("--samples", options->samples, "pushes drawn for each contact")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command.add_option("--seed", options->seed, "of the drawn pushes")
      ->check(is_seed())
      ->capture_default_str();
  command.add_option("--jobs", options->jobs, "threads; default: one per core")
      ->check(CLI::Range(0, 1024));
  command.add_option("--level", options->level, "of the half widths")
      ->check(in_range(0.01, 0.999))
      ->capture_default_str();
  command.add_option("--csv", options->csv, "write the comparison to this file")
      ->check(is_output());
  command.add_option("--plot", options->plot, "write a picture (SVG) to this file")
      ->check(is_output());
  command.footer(
      "Example:\n  prehensile query contact problems/paper/slide.yaml --travel-mm 20");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
