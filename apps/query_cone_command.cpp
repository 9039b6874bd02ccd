#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/commands.h"
#include "apps/cone_report.h"
#include "apps/option_checks.h"
#include "apps/plan_report.h"
#include "apps/push_options.h"
#include "apps/table.h"
#include "apps/uncertainty_options.h"
#include "io/plan_file.h"
#include "primitives/space_cone.h"
#include "scene/split_mix.h"

namespace prehensile::apps {
namespace {

/// Corners of a box with more unknowns than this are drawn instead of listed.
constexpr int kMostCorners = 512;

struct Options {
  SceneOptions scene;
  PushOptions push;
  std::vector<std::string> vary;
  int samples = 128;
  std::uint64_t seed = 1;
  int check = 2000;
  int points = 16;
  int slices = 181;
  std::string csv;
  std::string plot;
};

UncertaintyBox usual_box() {
  UncertaintyBox box;
  box[Unknown::kFriction] = box[Unknown::kGripForce] = box[Unknown::kTorqueRadius] = 0.1;
  box[Unknown::kPlace] = 1e-3;
  box[Unknown::kCentreOfMassX] = box[Unknown::kCentreOfMassY] = 1e-3;
  return box;
}

/// Corners and inner points of the box.
std::vector<BoxPoint> points_of(const Options& options, const UncertaintyBox& box) {
  std::vector<BoxPoint> points;
  const std::size_t unknowns = box.active().size();
  if (unknowns == 0) return points;
  const bool all = unknowns <= 9;
  for (std::uint64_t i = 0; i < (all ? 1U << unknowns : kMostCorners); ++i) {
    // Odd multiples of the golden section spread over the corners of a large box.
    points.push_back(corner(box, all ? i : (i * kSplitMixStride) >> 32));
  }
  for (int i = 0; i < options.samples; ++i) {
    points.push_back(random_point(options.seed, static_cast<std::uint64_t>(i)));
  }
  return points;
}

/// The cone of the pad plane, and its check.
void answer_in_plane(const std::vector<BoxPoint>& points, const ConeQuestion& question,
                     const ConeMember& nominal, int slices, ConeReport& report) {
  std::vector<ConeMember> members;
  for (const BoxPoint& at : points) {
    const CompiledMember member =
        cone_member(question.model.scene, question.grasp, question.contact,
                    question.place, question.box, at);
    if (member.usable) members.push_back(member.member);
  }
  report.unusable = static_cast<int>(points.size() - members.size());
  report.cone = motion_cone(nominal, members, slices);
  report.check = check_cone(question, nominal, members);
}

void answer_in_space(const std::vector<BoxPoint>& points, const ConeQuestion& question,
                     const ConeMember& nominal, int slices, ConeReport& report) {
  std::vector<SpaceMember> members;
  for (const BoxPoint& at : points) {
    std::optional<SpaceMember> member =
        space_member(question.model, question.grasp, question.contact, question.place,
                     question.box, at);
    if (member) members.push_back(std::move(*member));
  }
  report.unusable = static_cast<int>(points.size() - members.size());
  report.cone = cone_in_space(question.model, question.grasp, question.contact,
                              question.place, motion_cone(nominal, {}, slices), members);
  report.check = check_cone_in_space(question, report.cone);
}

int run(const Options& options) {
  const SceneFile file = read_scene(options.scene.file, options.scene.overrides);
  const Model model =
      prepare(file.scene, {.points_per_pad = options.points, .other_grips = false});
  const int contact = chosen_contact(model, options.push);
  const Grasp grasp = chosen_grasp(model, options.push);
  if (!(model.F > 0.0)) {
    throw BadInput("gripper: a grasp without friction has no motion cone");
  }
  if (!(model.c > 0.0)) {
    throw BadInput(
        "gripper.pad: a point: expected pads with some extent: a point resists no turn, "
        "and every motion cone over it is the one of the point's own friction");
  }
  ConeReport report{.model = model, .grasp = grasp, .contact = contact};
  report.place = 1e-3 * options.push.place_mm;
  report.question = contact_text(model, contact) +
                    text(" at place %.2f mm; object at ", options.push.place_mm) +
                    pose_text(model, grasp);
  report.box = parse_box(options.vary, usual_box());
  report.in_space = model.push_needs_space(model.contacts[contact]);
  const ConeMember nominal = cone_member(model, contact, report.place, grasp.X_HO);
  const ConeQuestion question{.model = model,
                              .grasp = grasp,
                              .contact = contact,
                              .place = report.place,
                              .box = report.box,
                              .seed = options.seed,
                              .count = options.check};
  const std::vector<BoxPoint> points = points_of(options, report.box);
  if (report.in_space) {
    answer_in_space(points, question, nominal, options.slices, report);
  } else {
    answer_in_plane(points, question, nominal, options.slices, report);
  }
  if (!options.csv.empty()) write_atomically(options.csv, to_csv(report));
  if (!options.plot.empty()) write_atomically(options.plot, to_svg(report));
  const std::string out =
      options.scene.json ? to_json(report).dump(2) + '\n' : describe(report);
  std::fputs(out.c_str(), stdout);
  return is_empty(report.cone) ? kNegative : kDone;
}

}  // namespace

Command add_query_cone(CLI::App& query) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *query.add_subcommand(
      "cone", "the motions of a pusher that the object follows, and how robustly");
  add_scene_options(command, options->scene);
  add_push_options(command, options->push);
  add_vary_option(command, options->vary);
  command
      .add_option("--samples", options->samples,
                  "points drawn inside the box, besides its corners")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command.add_option("--seed", options->seed, "of the drawn points")
      ->check(is_seed())
      ->capture_default_str();
  command
      .add_option("--check", options->check,
                  "motions that are asked as instants, to judge the cone")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  command
      .add_option("--slices", options->slices,
                  "directions over the whole turn in which a line's rates of turn are "
                  "sought; in space each takes its time")
      ->check(CLI::Range(2, 3601))
      ->capture_default_str();
  command.add_option("--points", options->points, "contact points per pad")
      ->check(CLI::IsMember({1, 4, 8, 16, 32, 64}))
      ->capture_default_str();
  command.add_option("--csv", options->csv, "write the edges to this file")
      ->check(is_output());
  command.add_option("--plot", options->plot, "write a picture (SVG) to this file")
      ->check(is_output());
  command.footer(
      "Example:\n  prehensile query cone problems/paper/slide.yaml --pusher edge --vary "
      "friction=0.2,place_mm=1");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
