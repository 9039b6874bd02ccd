#include "benchmarks/suite/suite_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "benchmarks/suite/suite_fields.h"
#include "io/document.h"
#include "io/field_reader.h"
#include "io/field_schema.h"
#include "planner/catalogue.h"

namespace prehensile::suite {
namespace {

using internal::Faults;
using internal::Value;

constexpr auto kVisit = [](auto& fields, Suite& suite) { visit_suite(fields, suite); };

bool has_only(const std::string& text, std::size_t longest, std::string_view marks) {
  return !text.empty() && text.size() <= longest &&
         std::all_of(text.begin(), text.end(), [marks](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                  (c >= '0' && c <= '9') || marks.find(c) != std::string_view::npos;
         });
}

/// Relative, and not out of its folder by its words.
bool stays_inside(const std::filesystem::path& file) {
  return !file.empty() && file.is_relative() &&
         std::none_of(file.begin(), file.end(), [](const auto& p) { return p == ".."; });
}

/// Faults of values, each at its field's line.
class Judge {
 public:
  Judge(const Value& root, Faults& faults) : root_(root), faults_(faults) {}

  void require(bool sound, const std::string& field, const std::string& what) {
    if (sound || faults_.concerns(field)) return;
    const Value& value = internal::deepest(root_, field);
    const bool is_single =
        value.kind == Value::Kind::kPlain || value.kind == Value::Kind::kText;
    faults_.add(internal::place_of(root_, field), field,
                (is_single ? internal::shown(value) + ": " : "") + "expected " + what);
  }

  void word(const std::string& word, const std::string& field) {
    require(is_word(word), field,
            "one word of letters, digits, _ - and ., at most 60 of them");
  }

  void unique(std::set<std::string>& names, const std::string& name,
              const std::string& field) {
    require(names.insert(name).second, field, "a name that no other entry has");
  }

  void range(const Range& range, const std::string& field) {
    require(range[0] <= range[1], field, "the lower end first");
  }

 private:
  const Value& root_;
  Faults& faults_;
};

void judge_fixtures(const FixtureRange& range, const std::string& path, Judge& judge) {
  judge.range(range.size, path + ".size");
  judge.range(range.mass, path + ".mass");
  judge.range(range.pad_size, path + ".pad_size");
  judge.range(range.pad_aspect, path + ".pad_aspect");
  judge.range(range.finger_friction, path + ".finger_friction");
  judge.range(range.pusher_friction, path + ".pusher_friction");
  judge.range(range.strength, path + ".strength");
  judge.range(range.count, path + ".pusher_count");
  judge.require(range.count[0] == std::floor(range.count[0]) &&
                    range.count[1] == std::floor(range.count[1]),
                path + ".pusher_count", "whole numbers");
}

void judge_files(const std::vector<std::string>& files, const std::string& path,
                 Judge& judge) {
  judge.require(!files.empty(), path, "at least one file");
  for (std::size_t i = 0; i < files.size(); ++i) {
    judge.require(stays_inside(files[i]), path + '.' + std::to_string(i),
                  "a path in the suite's folder or below");
  }
}

void judge_source(const Family& family, const std::string& path, Judge& judge) {
  if (const auto* fixtures = std::get_if<Fixtures>(&family.source)) {
    judge_fixtures(fixtures->range, path + ".fixtures", judge);
  } else if (const auto* scenes = std::get_if<SceneFiles>(&family.source)) {
    judge_files(scenes->files, path + ".scenes.files", judge);
  } else if (const auto* meshes = std::get_if<MeshFiles>(&family.source)) {
    judge_files(meshes->files, path + ".meshes.files", judge);
  }
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

void judge_study(const Study& study, const std::string& path, Judge& judge) {
  judge.word(study.name, path + ".name");
  for (std::size_t i = 0; i < study.arguments.size(); ++i) {
    const std::string& argument = study.arguments[i];
    const std::string field = path + ".arguments." + std::to_string(i);
    judge.require(has_only(argument, 100, "_-.,:=*"), field,
                  "letters, digits and _ - . , : = * alone, at most 100 of them");
    judge.require(!is_set_by_the_command(argument), field,
                  "no option that the command sets itself");
  }
  const bool wants_data = program_of(study).takes_data;
  judge.require(wants_data || study.data.empty(), path + ".data",
                "none: this program reads no data");
  judge.require(!wants_data || stays_inside(study.data), path + ".data",
                "a folder in the suite's folder or below");
}

void judge_settings(const PlannerEntry& entry, const std::string& path, Judge& judge) {
  if (entry.settings.empty()) return;
  if (!find_planner(entry.planner)) {
    judge.require(false, path,
                  "none: nothing is known of the options of " + entry.planner);
    return;
  }
  for (const auto& [name, value] : entry.settings) {
    const std::string fault = planner_fault(entry.planner, {{name, value}});
    judge.require(fault.empty(), path + '.' + name,
                  "an option of the planner (" + fault + ")");
  }
}

void judge_suite(const Suite& suite, const std::vector<std::string>& planners,
                 Judge& judge) {
  judge.word(suite.name, "name");
  std::set<std::string> names;
  for (std::size_t i = 0; i < suite.families.size(); ++i) {
    const std::string path = "families." + std::to_string(i);
    judge.word(suite.families[i].name, path + ".name");
    judge.unique(names, suite.families[i].name, path + ".name");
    judge_source(suite.families[i], path, judge);
  }
  judge.require(!suite.families.empty() || !suite.studies.empty(), "families",
                "families and planners, or studies");
  judge.require(suite.families.empty() || !suite.planners.empty(), "planners",
                "planners for the families");
  judge.require(suite.planners.empty() || !suite.families.empty(), "families",
                "families for the planners");
  names.clear();
  for (std::size_t i = 0; i < suite.studies.size(); ++i) {
    const std::string path = "studies." + std::to_string(i);
    judge_study(suite.studies[i], path, judge);
    judge.unique(names, suite.studies[i].name, path + ".name");
  }
  names.clear();
  for (std::size_t i = 0; i < suite.planners.size(); ++i) {
    const PlannerEntry& entry = suite.planners[i];
    const std::string path = "planners." + std::to_string(i);
    judge.require(
        std::find(planners.begin(), planners.end(), entry.planner) != planners.end(),
        path + ".planner", "one of " + listed(planners));
    judge_settings(entry, path + ".options", judge);
    judge.require(entry.budget == std::floor(entry.budget), path + ".budget",
                  "a whole number");
    judge.require(!entry.name.empty() || is_word(entry.planner), path + ".name",
                  "a name, because " + entry.planner + " is not one word");
    judge.word(entry.label(), path + ".name");
    judge.unique(names, entry.label(), path + ".name");
  }
}

}  // namespace

bool is_word(const std::string& text) { return has_only(text, 60, "_-."); }

SuiteFile parse_suite(const std::string& text, const std::string& label,
                      const std::vector<std::string>& planners,
                      const std::filesystem::path& folder) {
  Faults faults(label);
  const Value root = internal::parse_yaml(text, faults);
  SuiteFile file{.suite = {}, .text = text, .folder = folder};
  internal::FieldReader::read(root, "", faults, file.suite, kVisit);
  Judge judge(root, faults);
  judge_suite(file.suite, planners, judge);
  faults.raise();
  return file;
}

SuiteFile read_suite(const std::filesystem::path& file,
                     const std::vector<std::string>& planners,
                     const std::filesystem::path& folder) {
  const std::string text = internal::read_text(file, internal::kLargestScene);
  return parse_suite(text, file.string(), planners,
                     folder.empty() ? file.parent_path() : folder);
}

std::string suite_schema() {
  Suite defaults;
  return internal::FieldSchema::document(
      "Benchmark suite of prehensile",
      "Which problems, which planners, how often, within which limits. SI units unless "
      "the key says otherwise.",
      defaults, kVisit);
}

}  // namespace prehensile::suite
