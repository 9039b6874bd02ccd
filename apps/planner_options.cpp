#include "apps/planner_options.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <CLI/CLI.hpp>

#include "apps/table.h"
#include "io/scene_file.h"
#include "planner/catalogue.h"

namespace prehensile::apps {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string unit_of(const PlannerOption& option) {
  return option.in_L ? " L" : option.whole ? " (whole)" : "";
}

/// All planners of this build with their options.
void print_planners() {
  Table table({"planner", "option", "default", "from", "to", "what it is"});
  for (const std::string& name : planner_names()) {
    std::string planner = name;
    const PlannerKind& kind = *find_planner(name);
    if (kind.options.empty()) table.add({planner, "", "", "", "", ""});
    for (const PlannerOption& option : kind.options) {
      table.add({planner, option.name, number(option.value), number(option.least),
                 number(option.most) + unit_of(option), option.about});
      planner.clear();
    }
  }
  std::fputs(table.str().c_str(), stdout);
  std::fputs(
      "L: longer side of the object. geometric: OMPL's planners over places, joined by\n"
      "exact pushes; control: its control planners with samplers that steer; blind: the\n"
      "same with uniform random controls.\n",
      stdout);
}

std::pair<std::string, double> parsed(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
  char* end = nullptr;
  const double found = std::strtod(value.c_str(), &end);
  if (equals == 0 || value.empty() || *end != '\0' || !std::isfinite(found)) {
    throw BadInput("--planner-option " + text +
                   ": expected name=number, as in goal_bias=0.2");
  }
  return {text.substr(0, equals), found};
}

}  // namespace

void add_planner_options(CLI::App& command, PlannerChoice& choice) {
  command
      .add_option("--planner", choice.planner,
                  "which planner searches; --list-planners shows all")
      ->capture_default_str();
  command
      .add_option("--planner-option", choice.settings,
                  "option of the planner: name=number (repeatable)")
      ->allow_extra_args(false);
  command.add_flag_callback(
      "--list-planners",
      [] {
        print_planners();
        throw CLI::Success();
      },
      "print all planners with their options, and end");
}

void set_planner(const PlannerChoice& choice, PlanOptions& options) {
  options.planner = choice.planner;
  for (const std::string& text : choice.settings) {
    const auto [name, value] = parsed(text);
    if (!options.settings.emplace(name, value).second) {
      throw BadInput("--planner-option " + text + ": " + name + " is set twice");
    }
  }
  const std::string fault = planner_fault(options.planner, options.settings);
  if (!fault.empty()) throw BadInput("--planner: " + fault);
}

}  // namespace prehensile::apps
