#include "benchmarks/suite/problem_list.h"

#include <algorithm>
#include <fnmatch.h>
#include <stdexcept>

#include "benchmarks/suite/scene_of_mesh.h"
#include "problems/published_regrasps.h"

namespace prehensile::suite {
namespace {

namespace fs = std::filesystem;

template <typename... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <typename... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

/// Files below `folder` whose path relative to it matches, component by component.
void find_files(const fs::path& folder, fs::path::const_iterator part,
                fs::path::const_iterator end, std::vector<fs::path>& found) {
  const std::string pattern = part->string();
  const bool is_last = std::next(part) == end;
  std::error_code error;
  std::vector<fs::path> matches;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD) == 0) {
      matches.push_back(entry.path());
    }
  }
  std::sort(matches.begin(), matches.end());
  for (const fs::path& match : matches) {
    if (!is_last && fs::is_directory(match, error)) {
      find_files(match, std::next(part), end, found);
    } else if (is_last && fs::is_regular_file(match, error)) {
      found.push_back(match);
    }
  }
}

std::vector<fs::path> files_of(const SuiteFile& suite, const std::string& family,
                               const std::vector<std::string>& patterns) {
  const fs::path folder = suite.folder.empty() ? fs::path(".") : suite.folder;
  std::vector<fs::path> files;
  for (const std::string& pattern : patterns) {
    const fs::path parts = fs::path(pattern).lexically_normal();
    const std::size_t before = files.size();
    find_files(folder, parts.begin(), parts.end(), files);
    const auto refuse = [&](const std::string& what) {
      throw BadInput("family " + family + ": " + pattern + ": " + what);
    };
    if (files.size() == before) {
      refuse("no such file in " + folder.string() +
             ": expected files of the suite's folder, or --data FOLDER");
    }
    for (std::size_t i = before; i < files.size(); ++i) {
      if (!is_below(folder, files[i])) refuse("leads out of " + folder.string());
    }
  }
  return files;
}

Scene of_walls(const AmongWalls& source, std::uint64_t index) {
  const auto seed = static_cast<std::uint64_t>(source.seed);
  Scene scene =
      random_among_walls(source.square, source.range, source.gravity, seed, index);
  if (source.theta_window) scene = with_theta_window(scene, *source.theta_window);
  return source.posts > 0 ? with_obstacles(scene, source.posts, seed, index) : scene;
}

Scene of_constructed(const Constructed& source, std::uint64_t index) {
  const auto seed = static_cast<std::uint64_t>(source.seed);
  const Scene scene = random_regrasp(source.object, seed, index).scene;
  if (source.goals == GoalsFrom::kPushes) return scene;
  const auto problem = random_regrasp_of(scene, source.goals, seed, index);
  if (!problem) throw std::runtime_error("no random goal found for this object");
  return problem->scene;
}

Scene of_file(const Scene& scene, GoalsFrom goals, int seed, int number) {
  const auto problem = random_regrasp_of(scene, goals, static_cast<std::uint64_t>(seed),
                                         static_cast<std::uint64_t>(number));
  if (!problem) throw std::runtime_error("no regrasp found for this object");
  return problem->scene;
}

}  // namespace

bool is_below(const fs::path& folder, const fs::path& file) {
  const fs::path inner = fs::canonical(file);
  const fs::path outer = fs::canonical(folder);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first ==
         outer.end();
}

ProblemList::ProblemList(const SuiteFile& file, bool quick) {
  families_.reserve(file.suite.families.size());
  for (const Family& family : file.suite.families) {
    Entry& entry =
        families_.emplace_back(Entry{family.name, family.source, {}, 0, false});
    const auto from_pushes = [](GoalsFrom goals) { return goals == GoalsFrom::kPushes; };
    std::visit(Overloaded{[&](const PublishedPairs& s) { entry.count = s.count; },
                          [&](const AmongWalls& s) { entry.count = s.count; },
                          [&](const Constructed& s) {
                            entry.count = s.count;
                            entry.is_constructed = from_pushes(s.goals);
                          },
                          [&](const Fixtures& s) {
                            entry.count = s.count;
                            entry.is_constructed = from_pushes(s.range.goals);
                          },
                          [&](const SceneFiles& s) {
                            entry.files = files_of(file, family.name, s.files);
                            const int each = s.goals == FileGoals::kGiven ? 1 : s.count;
                            entry.count = each * static_cast<int>(entry.files.size());
                            entry.is_constructed = s.goals == FileGoals::kPushes;
                          },
                          [&](const MeshFiles& s) {
                            entry.files = files_of(file, family.name, s.files);
                            entry.count = s.count * static_cast<int>(entry.files.size());
                            entry.is_constructed = from_pushes(s.goals);
                          }},
               family.source);
    if (quick) entry.count = std::min(entry.count, file.suite.quick);
  }
}

int ProblemList::count() const {
  int all = 0;
  for (const Entry& entry : families_) all += entry.count;
  return all;
}

Scene ProblemList::scene(int family, int index) const {
  const Entry& entry = families_[static_cast<std::size_t>(family)];
  const auto number = static_cast<std::uint64_t>(index);
  // Files take turns, so that the first few problems show all of them.
  const int files = std::max<int>(1, static_cast<int>(entry.files.size()));
  const auto file = [&] { return entry.files[static_cast<std::size_t>(index % files)]; };
  Scene scene = std::visit(
      Overloaded{
          [&](const PublishedPairs& s) {
            return s.square ? published_square(index) : published_tee(index);
          },
          [&](const AmongWalls& s) { return of_walls(s, number); },
          [&](const Constructed& s) { return of_constructed(s, number); },
          [&](const Fixtures& s) {
            const auto problem =
                random_fixture(s.range, static_cast<std::uint64_t>(s.seed), number);
            if (!problem) throw std::runtime_error("no problem found in these ranges");
            return problem->scene;
          },
          [&](const SceneFiles& s) {
            const Scene given = read_scene(file()).scene;
            if (s.goals == FileGoals::kGiven) return given;
            const GoalsFrom goals =
                s.goals == FileGoals::kPushes ? GoalsFrom::kPushes : GoalsFrom::kRandom;
            return of_file(given, goals, s.seed, index / files);
          },
          [&](const MeshFiles& s) {
            return of_file(scene_of_mesh(s, file()), s.goals, s.seed, index / files);
          }},
      entry.source);
  if (!scene.goal) throw std::runtime_error("the scene has no goal");
  scene.name = problem_name(family, index);
  return scene;
}

std::string ProblemList::problem_name(int family, int index) const {
  return name(family) + '/' + std::to_string(index + 1);
}

}  // namespace prehensile::suite
