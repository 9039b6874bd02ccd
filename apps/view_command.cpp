#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/commands.h"
#include "apps/mujoco_output.h"
#include "apps/option_checks.h"
#include "apps/parallel.h"
#include "apps/plan_samples.h"
#include "apps/uncertainty_options.h"
#include "apps/view_output.h"
#include "io/object_surface.h"
#include "io/plan_file.h"

namespace prehensile::apps {
namespace {

struct Options {
  std::vector<std::string> files;
  std::vector<std::string> overrides;
  std::string scene;
  bool json = false;
  ViewFiles out;
  int samples = 0;
  std::vector<std::string> vary;
  std::uint64_t seed = 1;
  int jobs = 0;
};

bool is_plan_file(const std::string& file) {
  return std::filesystem::path(file).extension() == ".json";
}

/// Where the plan leaves the object in members of its uncertainty.
std::vector<Grasp> sampled_ends(const Options& options, const Shown& shown) {
  const auto& stated = shown.model.scene.uncertainty;
  SampleOptions sampling;
  sampling.box =
      parse_box(options.vary, stated ? stated_box(shown.model.scene) : usual_box());
  if (stated && options.vary.empty()) sampling.spread = stated->spread;
  sampling.samples = options.samples;
  sampling.seed = options.seed;
  sampling.jobs = number_of_jobs(options.jobs);
  std::vector<Grasp> ends;
  for (const PlanTrial& trial : sample_plan(shown.model, shown.plan, sampling).trials) {
    if (trial.is_scene) ends.push_back(trial.end);
  }
  return ends;
}

bool is_same(const SolidShape& one, const SolidShape& other) {
  constexpr double kSame = 1e-9;  // [m]
  return one.outline.size() == other.outline.size() &&
         std::abs(one.thickness - other.thickness) < kSame &&
         std::equal(one.outline.begin(), one.outline.end(), other.outline.begin(),
                    [](const Vec2& p, const Vec2& q) { return (p - q).norm() < kSame; });
}

/// The triangles of the plan's object, from the scene that it was planned for.
std::optional<ObjectSurface> surface_from(const std::string& scene,
                                          const Scene& planned) {
  if (scene.empty()) return std::nullopt;
  std::optional<ObjectSurface> surface = read_object_surface(scene);
  const Scene shown = read_scene(scene).scene;
  const auto* solid = std::get_if<SolidShape>(&planned.object.shape);
  const auto* read = std::get_if<SolidShape>(&shown.object.shape);
  if (!surface || !solid || !is_same(*read, *solid)) {
    throw BadInput("--scene " + scene +
                   ": expected a scene whose object is the mesh that was planned for");
  }
  return surface;
}

Shown read(const Options& options, const std::string& file) {
  if (!is_plan_file(file)) {
    if (!options.scene.empty()) {
      throw BadInput("--scene " + options.scene + ": " + file +
                     " is a scene: expected a plan file");
    }
    const Scene scene = read_scene(file, options.overrides).scene;
    Plan plan;
    plan.start = plan.goal = scene.start;
    return {
        prepare(scene), plan, false, {}, read_object_surface(file, options.overrides)};
  }
  if (!options.overrides.empty()) {
    throw BadInput("--set " + options.overrides.front() + ": " + file +
                   " is a plan, made for the scene in it: expected a scene file");
  }
  const PlanFile read = read_plan(file);
  Shown shown{
      prepare(read.scene), read.plan, true, {}, surface_from(options.scene, read.scene)};
  const bool has_pushes = shown.plan.usable() && !shown.plan.pushes.empty();
  if (options.samples > 0 && has_pushes) shown.outcomes = sampled_ends(options, shown);
  return shown;
}

/// Two plans of one scene are told apart by their files.
void tell_apart(const std::vector<std::string>& files, std::vector<Shown>& shown) {
  if (shown.size() < 2) return;
  if (shown[0].model.scene.name != shown[1].model.scene.name) return;
  const auto last_part = [&files](std::size_t i) {
    return std::filesystem::path(files[i]).filename().string();
  };
  const bool by_folder = last_part(0) == last_part(1);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    shown[i].file = by_folder ? files[i] : last_part(i);
  }
}

std::string describe(const ViewFiles& out, bool agrees) {
  std::string words;
  if (!out.page.empty()) words += "page: " + out.page + '\n';
  if (!out.frames.empty()) words += "key frames: " + out.frames + '\n';
  if (!out.glb.empty()) words += "animation: " + out.glb + '\n';
  if (!out.mjcf.empty()) words += "MJCF: " + out.mjcf + '\n';
  if (!agrees) words += "a replay does not agree with the plan: the page says why\n";
  return words;
}

int run(const Options& options) {
  check_view_files(options.out);
  std::vector<Shown> shown;
  try {
    for (const std::string& file : options.files) shown.push_back(read(options, file));
  } catch (const BadInput& bad) {
    write_refusal(options.out, bad.what());
    throw;
  }
  tell_apart(options.files, shown);
  ViewFiles out = options.out;
  if (out.page.empty() && out.frames.empty() && out.glb.empty() && out.mjcf.empty()) {
    out.page = "view.html";
  }
  const bool agrees = write_view(out, shown);
  if (options.json) {
    const nlohmann::ordered_json written = {{"page", out.page},
                                            {"frames", out.frames},
                                            {"glb", out.glb},
                                            {"mjcf", out.mjcf},
                                            {"agrees", agrees}};
    std::printf("%s\n", written.dump(2).c_str());
  } else {
    std::fputs(describe(out, agrees).c_str(), stdout);
  }
  return agrees ? kDone : kNegative;
}

}  // namespace

Command add_view(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand(
      "view", "write a page that shows a plan, two plans, or a scene");
  command
      .add_option("FILE", options->files,
                  "plan file (.json) or scene file; two: side by side")
      ->required()
      ->expected(1, 2);
  command
      .add_option("--set", options->overrides,
                  "override a field of the scene file: start.x=0.01 (repeatable)")
      ->allow_extra_args(false);
  command.add_option(
      "--scene", options->scene,
      "of a plan whose object is a mesh: its scene file, for the triangles");
  command.add_flag("--json", options->json,
                   "print one JSON object on stdout, nothing else");
  command
      .add_option("-o,--output", options->out.page,
                  "page to write (HTML); view.html if nothing else is asked for")
      ->check(is_output());
  command
      .add_option("--frames", options->out.frames,
                  "also, or only: one picture per push of the first plan (SVG)")
      ->check(is_output());
  command
      .add_option("--glb", options->out.glb,
                  "also, or only: the first plan as an animation (GLB)")
      ->check(is_output());
  command
      .add_option("--mjcf", options->out.mjcf,
                  "also, or only: scene and first plan for MuJoCo (MJCF, XML)")
      ->check(is_output());
  command
      .add_option("--samples", options->samples,
                  "show where so many members of the uncertainty end")
      ->check(CLI::Range(1, 10'000));
  add_vary_option(command, options->vary);
  command.add_option("--seed", options->seed, "of the samples")
      ->check(is_seed())
      ->capture_default_str();
  command.add_option("--jobs", options->jobs, "threads for the samples; 0: one per core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.footer(
      "The page needs no network and no other file. Exit code 1: a replay does not agree "
      "with the plan.\n"
      "Example:\n  prehensile view plan.json -o plan.html --samples 200\n"
      "  prehensile view a.json b.json -o compare.html\n"
      "  prehensile view plan.json --frames plan.svg --glb plan.glb --mjcf plan.xml");
  return [options] { return run(*options); };
}

}  // namespace prehensile::apps
