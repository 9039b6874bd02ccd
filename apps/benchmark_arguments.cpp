/// What users type behind the options of `prehensile benchmark`.
#include <charconv>
#include <vector>

#include "apps/benchmark_commands.h"
#include "io/scene_file.h"

namespace prehensile::apps {
namespace {

bool to_whole(const std::string& text, int& into) {
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, into);
  return error == std::errc() && last == end;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const std::vector<std::string> parts = split(text, '/');
  Shard shard;
  const bool sound = parts.size() == 2 && to_whole(parts[0], shard.index) &&
                     to_whole(parts[1], shard.count) && shard.index >= 1 &&
                     shard.index <= shard.count;
  if (!sound) throw BadInput("--shard " + text + ": expected I/N with 1 <= I <= N");
  return shard;
}

suite::RunKey parse_run(const std::string& text, const suite::Suite& suite,
                        const suite::ProblemList& problems) {
  const auto refuse = [&](const std::string& what) {
    throw BadInput("--only " + text + ": " + what);
  };
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 3) refuse("expected PROBLEM,PLANNER,SEED, or a study's name");
  suite::RunKey key{.family = -1, .problem = -1, .planner = -1};
  const std::vector<std::string> problem = split(parts[0], '/');
  std::string families, planners;
  for (int i = 0; i < problems.families(); ++i) {
    families += (i > 0 ? ", " : "") + problems.name(i);
    if (problems.name(i) == problem[0]) key.family = i;
  }
  if (key.family < 0) refuse(problem[0] + ": expected one of " + families);
  const int count = problems.count(key.family);
  int number = 0;
  if (problem.size() != 2 || !to_whole(problem[1], number) || number < 1 ||
      number > count) {
    refuse("expected a problem from " + problem[0] + "/1 to " + problem[0] + '/' +
           std::to_string(count));
  }
  key.problem = number - 1;
  for (std::size_t i = 0; i < suite.planners.size(); ++i) {
    const std::string& label = suite.planners[i].label();
    planners += (i > 0 ? ", " : "") + label;
    if (label == parts[1]) key.planner = static_cast<int>(i);
  }
  if (key.planner < 0) refuse(parts[1] + ": expected one of " + planners);
  if (!to_whole(parts[2], key.seed) || key.seed < 1) {
    refuse(parts[2] + ": expected a seed from 1");
  }
  return key;
}

}  // namespace prehensile::apps
