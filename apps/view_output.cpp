#include "apps/view_output.h"

#include <filesystem>

#include <CLI/CLI.hpp>

#include "apps/mujoco_output.h"
#include "apps/option_checks.h"
#include "io/plan_file.h"
#include "viewer/animation_glb.h"
#include "viewer/film_json.h"
#include "viewer/key_frames.h"
#include "viewer/page.h"

namespace prehensile::apps {
namespace {

// Of all films of a page together.
constexpr int kFrames = 300;
constexpr int kPushes = 100;
constexpr int kPadPoints = 15'000;

void write_exports(const ViewFiles& files, const Shown& one) {
  if (files.frames.empty() && files.glb.empty()) return;
  viewer::Film film = viewer::film(one.model, one.plan, {.is_plan = one.is_plan});
  film.surface = one.surface;
  if (!files.frames.empty()) {
    write_atomically(files.frames, viewer::key_frames(one.model, film));
  }
  if (!files.glb.empty()) {
    write_atomically(files.glb, viewer::animation_glb(one.model, film));
  }
}

}  // namespace

void add_view_option(CLI::App& command, std::string& file) {
  command.add_option("--view", file, "also write a page to look at (HTML)")
      ->check(is_output());
}

void check_view_option(const std::string&) {}

void check_view_files(const ViewFiles& files) {
  if (files.glb.empty() || viewer::has_glb()) return;
  throw BadInput("--glb " + files.glb +
                 ": this build writes no GLB files: expected one with tinygltf");
}

bool write_view(const ViewFiles& files, const std::vector<Shown>& shown) {
  // First, for it may refuse.
  const Shown& first = shown.front();
  const std::string mjcf = mjcf_text(files.mjcf, first.model, first.plan.pushes);
  bool all_agree = true;
  std::vector<std::string> films;
  std::string title;
  const int parts = static_cast<int>(shown.size());  // share the size of the page
  for (const Shown& one : shown) {
    viewer::Film film = viewer::film(
        one.model, one.plan,
        {.frames = kFrames / parts, .pushes = kPushes / parts, .is_plan = one.is_plan});
    film.outcomes = one.outcomes;
    film.surface = one.surface;
    all_agree = all_agree && film.agrees;
    film.name = one.model.scene.name + (one.file.empty() ? "" : " (" + one.file + ')');
    title += (title.empty() ? "" : " | ") + film.name;
    films.push_back(viewer::to_json(one.model, one.plan, film, kPadPoints / parts));
  }
  write_exports(files, first);
  if (!mjcf.empty()) write_atomically(files.mjcf, mjcf);
  if (!files.page.empty()) write_atomically(files.page, viewer::page(title, films));
  return all_agree;
}

void write_refusal(const ViewFiles& files, const std::string& why) {
  if (files.page.empty() || std::filesystem::exists(files.page)) return;
  write_atomically(files.page, viewer::page_of_words("This cannot be shown", why));
}

}  // namespace prehensile::apps
