#include "planner/catalogue.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "planner/search/frame.h"

namespace prehensile {
namespace {

using Options = std::vector<PlannerOption>;

PlannerOption goal_bias(double value) {
  return {"goal_bias", 0.0, 1.0, value, "share of samples that are goals"};
}

PlannerOption range(double value) {
  return {.name = "range",
          .least = 1e-3,
          .most = 20.0,
          .value = value,
          .about = "longest motion",
          .in_L = true};
}

PlannerOption yes_or_no(const char* name, bool value, const char* about) {
  return {name, 0.0, 1.0, value ? 1.0 : 0.0, about, true};
}

PlannerOption count(const char* name, double most, double value, const char* about) {
  return {name, 1.0, most, value, about, true};
}

PlannerOption rewire_factor(double value) {
  return {"rewire_factor", 0.5, 4.0, value, "factor on the size of neighbourhoods"};
}

PlannerOption tries(double value) {
  return count("tries", 100.0, value, "controls tried for each wanted state");
}

/// The tuned values of the grid and of the lead.
struct SyclopValues {
  double cells, samples, regions, extensions, abandon, add, shortest;
};

Options syclop(const SyclopValues& v) {
  return {
      count("cells", 64.0, v.cells, "of the decomposition, along each side"),
      count("free_volume_samples", 10'000.0, v.samples, "states drawn beforehand"),
      count("num_region_expansions", 1000.0, v.regions, "regions of a lead looked at"),
      count("num_tree_expansions", 100.0, v.extensions, "extensions in each region"),
      {"prob_abandon_lead_early", 0.0, 1.0, v.abandon, "chance to give up a lead"},
      {"prob_add_available_regions", 0.0, 1.0, v.add, "chance of one more region"},
      {"prob_shortest_path_lead", 0.0, 1.0, v.shortest, "chance of the shortest lead"}};
}

Options sst(double bias, double selection, double pruning) {
  return {goal_bias(bias),
          {"selection_radius", 1e-3, 1.0, selection, "of best nodes", false, true},
          {"pruning_radius", 1e-3, 1.0, pruning, "of witnesses", false, true}};
}

Options control_kpiece(double bias, double border, double good, double bad,
                       double close) {
  return {goal_bias(bias),
          {"border_fraction", 0.0, 1.0, border, "share of time for cells at the border"},
          {"good_score_factor", 0.01, 1.0, good, "on cells after progress"},
          {"bad_score_factor", 0.01, 1.0, bad, "on cells without"},
          count("max_close_samples", 300.0, close, "states kept that came close")};
}

std::vector<PlannerKind> own() {
  return {{"push",
           PlannerFamily::kOwn,
           "push",
           {{"fallback_share", 0.0, 0.9, 0.1,
             "of the budget, for a baseline where the exact stages find nothing"},
            {"fallback_share_obstacles", 0.0, 0.9, 0.9,
             "the same among obstacles, where looks for collisions cost most of it"}}},
          {"motion-cone-tree",
           PlannerFamily::kBaseline,
           "motion-cone-tree",
           {{"step", 1e-3, 2.0, 0.15, "length of a step", false, true},
            goal_bias(0.92),
            {"temperature", 1e-6, 10.0, 1.7e-4, "of the transition test, at first"},
            {"temperature_factor", 1.01, 10.0, 1.5, "on it, up and down"},
            count("most_failures", 1000.0, 10.0, "transitions refused before it rises"),
            {"radius", 0.0, 2.0, 1.5, "where parents are looked for", false, true},
            yes_or_no("rewire", true, "whether neighbours may change their parent")}},
          {"random-shooting",
           PlannerFamily::kBaseline,
           "random-shooting",
           {count("depth", 50.0, 23.0, "most pushes of a trial"),
            {"longest", 0.01, 5.0, 1.3, "push of a trial", false, true},
            count("redraws", 100.0, 5.0, "of a control that cannot stick")}},
          {"two-trees",
           PlannerFamily::kBaseline,
           "two-trees",
           {{"longest", 0.01, 5.0, 0.79, "push of a tree", false, true},
            count("draws", 100.0, 9.0, "of a push, of which the closest is tried"),
            count("links", 100'000.0, 374.0, "nodes that a new one is joined with")}}};
}

std::vector<std::pair<std::string, Options>> geometric() {
  return {
      {"RRT", {range(4.1), goal_bias(0.65)}},
      {"RRTConnect", {range(0.59)}},
      {"RRTstar",
       {range(0.67), goal_bias(0.61), rewire_factor(1.08),
        yes_or_no("delay_collision_checking", true, "sort neighbours by cost first")}},
      {"InformedRRTstar",
       {range(0.67), goal_bias(0.61), rewire_factor(1.08),
        yes_or_no("delay_collision_checking", true, "sort neighbours by cost first")}},
      {"LBTRRT",
       {range(1.2), goal_bias(0.17), {"epsilon", 0.0, 10.0, 0.05, "from the optimum"}}},
      {"BITstar",
       {count("samples_per_batch", 10'000.0, 100.0, "states drawn at a time"),
        rewire_factor(1.1), yes_or_no("use_k_nearest", true, "or all within a radius")}},
      {"ABITstar",
       {count("samples_per_batch", 10'000.0, 100.0, "states drawn at a time"),
        rewire_factor(1.1),
        yes_or_no("use_k_nearest", true, "or all within a radius"),
        {"initial_inflation_factor", 1.0, 1e6, 1e6, "on the heuristic, at first"}}},
      {"AITstar",
       {count("samples_per_batch", 10'000.0, 100.0, "states drawn at a time"),
        rewire_factor(1.0), yes_or_no("use_k_nearest", true, "or all within a radius")}},
      {"FMT",
       {count("num_samples", 100'000.0, 131.0, "states drawn at once"),
        // With 0.4 OMPL 1.5.2 runs into a node without neighbours and crashes.
        {"radius_multiplier", 0.8, 10.0, 3.8, "on the size of neighbourhoods"},
        yes_or_no("heuristics", true, "order by the cost to go as well"),
        yes_or_no("extended_fmt", true, "draw more where these do not suffice")}},
      {"EST", {range(0.33), goal_bias(0.65)}},
      {"KPIECE1",
       {range(1.1),
        goal_bias(0.72),
        {"border_fraction", 0.0, 1.0, 0.13, "share of time for cells at the border"},
        {"min_valid_path_fraction", 0.01, 1.0, 0.06, "of a motion cut short"}}}};
}

std::vector<std::pair<std::string, Options>> control() {
  return {{"RRT", {goal_bias(0.54)}},
          {"SST", sst(0.12, 0.11, 0.009)},
          {"EST", {range(0.33), goal_bias(0.65)}},
          {"KPIECE1", control_kpiece(0.13, 0.38, 0.14, 0.24, 64.0)},
          {"PDST", {goal_bias(0.9)}},
          {"SyclopRRT", syclop({5.0, 6502.0, 862.0, 2.0, 0.95, 0.35, 0.98})},
          {"SyclopEST", syclop({6.0, 4952.0, 316.0, 1.0, 0.73, 0.37, 0.69})}};
}

std::vector<std::pair<std::string, Options>> blind() {
  return {{"RRT", {goal_bias(0.38), tries(2.0)}},
          {"SST", sst(0.53, 0.0089, 0.0019)},
          {"EST", {range(0.15), goal_bias(0.29), tries(9.0)}},
          {"KPIECE1", control_kpiece(0.05, 0.8, 0.9, 0.45, 30.0)},
          {"PDST", {goal_bias(0.9), tries(3.0)}},
          {"SyclopRRT", syclop({30.0, 1124.0, 276.0, 1.0, 0.28, 0.41, 0.61})},
          {"SyclopEST", syclop({8.0, 109.0, 71.0, 2.0, 0.16, 0.22, 0.17})}};
}

bool improves(const std::string& algorithm) {
  constexpr std::array<const char*, 7> kImproving{
      "RRTstar", "InformedRRTstar", "LBTRRT", "BITstar", "ABITstar", "AITstar", "SST"};
  return std::ranges::find(kImproving, algorithm) != kImproving.end();
}

std::vector<PlannerKind> all_kinds() {
  std::vector<PlannerKind> kinds = own();
  const auto add = [&kinds](const char* prefix, PlannerFamily family,
                            const std::vector<std::pair<std::string, Options>>& all) {
    for (const auto& [algorithm, options] : all) {
      kinds.push_back(
          {prefix + algorithm, family, algorithm, options, improves(algorithm)});
    }
  };
  add("geometric::", PlannerFamily::kGeometric, geometric());
  add("control::", PlannerFamily::kControl, control());
  add("blind::", PlannerFamily::kBlind, blind());
  return kinds;
}

/// Of OMPL 1.5, geometric. Roadmaps and trees from both ends that check a motion one way
/// and use it the other; the roadmaps also look for solutions in a second thread.
constexpr std::array<const char*, 12> kReversing{
    "PRM",  "PRMstar", "LazyPRM", "LazyPRMstar", "SPARS",    "SPARStwo",
    "BFMT", "BiEST",   "SBL",     "pSBL",        "BKPIECE1", "LBKPIECE1"};

bool is_built(const PlannerKind& kind) { return !kind.needs_ompl() || frame_is_built(); }

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string name_fault(const std::string& planner) {
  const std::string algorithm = planner.substr(planner.rfind(':') + 1);
  const bool known = find_planner(planner) != nullptr;
  if (!known && std::ranges::find(kReversing, algorithm) != kReversing.end()) {
    return "planner " + planner +
           " is refused: it uses motions in the direction in which it did not check "
           "them, and a push cannot be undone by pushing back; expected one of " +
           joined(planner_names());
  }
  if (!known) {
    return "there is no planner " + planner + "; expected one of " +
           joined(planner_names());
  }
  if (!is_built(*find_planner(planner))) {
    return "planner " + planner + " needs OMPL, which is not built in; expected one of " +
           joined(planner_names());
  }
  return {};
}

std::string option_names(const PlannerKind& kind) {
  std::vector<std::string> names;
  names.reserve(kind.options.size());
  for (const PlannerOption& option : kind.options) names.emplace_back(option.name);
  return joined(names);
}

std::string setting_fault(const PlannerKind& kind, const std::string& name,
                          double value) {
  const auto option = std::ranges::find_if(
      kind.options, [&](const PlannerOption& o) { return name == o.name; });
  if (option == kind.options.end()) {
    return "planner " + kind.name + " has no option " + name + "; expected one of " +
           option_names(kind);
  }
  const bool inside = value >= option->least && value <= option->most;  // not NaN
  if (inside && !(option->whole && value != std::floor(value))) return {};
  return "option " + name + " of planner " + kind.name + " is " + number(value) +
         "; expected a " + (option->whole ? "whole " : "") + "number from " +
         number(option->least) + " to " + number(option->most);
}

}  // namespace

const std::vector<PlannerKind>& planner_catalogue() {
  static const std::vector<PlannerKind> kinds = all_kinds();
  return kinds;
}

const PlannerKind* find_planner(const std::string& name) {
  for (const PlannerKind& kind : planner_catalogue()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

std::vector<std::string> planner_names() {
  std::vector<std::string> names;
  for (const PlannerKind& kind : planner_catalogue()) {
    if (is_built(kind)) names.push_back(kind.name);
  }
  return names;
}

std::string planner_fault(const std::string& planner, const PlannerSettings& settings) {
  const std::string fault = name_fault(planner);
  if (!fault.empty()) return fault;
  for (const auto& [name, value] : settings) {
    const std::string wrong = setting_fault(*find_planner(planner), name, value);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

double setting(const PlannerKind& kind, const PlannerSettings& settings,
               const std::string& option) {
  const auto set = settings.find(option);
  if (set != settings.end()) return set->second;
  for (const PlannerOption& known : kind.options) {
    if (option == known.name) return known.value;
  }
  return kNan;
}

}  // namespace prehensile
