#include "planner/ompl/stock_planners.h"

#include <cstdio>
#include <memory>

#include <ompl/control/SimpleDirectedControlSampler.h>

namespace prehensile {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

std::string text_of(const PlannerOption& option, double value) {
  char text[32];
  std::snprintf(text, sizeof text, option.whole ? "%.0f" : "%.17g", value);
  return text;
}

bool has_option(const PlannerKind& kind, const std::string& name) {
  for (const PlannerOption& option : kind.options) {
    if (name == option.name) return true;
  }
  return false;
}

int whole_setting(const PlannerKind& kind, const PlannerSettings& settings,
                  const char* name) {
  return has_option(kind, name) ? static_cast<int>(setting(kind, settings, name)) : 1;
}

void set_options(const PlannerKind& kind, const PlannerSettings& settings, double L,
                 ob::Planner& planner) {
  // Pruning rebuilds the graph for every state that it drops, which takes longer than it
  // saves here.
  if (planner.params().hasParam("use_graph_pruning")) {
    planner.params().setParam("use_graph_pruning", "0");
  }
  for (const PlannerOption& option : kind.options) {
    if (!planner.params().hasParam(option.name)) continue;  // one of ours
    const double value = setting(kind, settings, option.name) * (option.in_L ? L : 1.0);
    planner.params().setParam(option.name, text_of(option, value));
  }
}

/// Blind controls are directed as OMPL does it: the best of some.
void set_tries(const PushProblem& problem, unsigned tries) {
  problem.space_information()->setDirectedControlSamplerAllocator(
      [tries](const oc::SpaceInformation* si) {
        return std::make_shared<oc::SimpleDirectedControlSampler>(si, tries);
      });
}

}  // namespace

ControlMeaning meaning_for(PlannerFamily family) {
  return family == PlannerFamily::kBlind ? ControlMeaning::kBlind
                                         : ControlMeaning::kSteered;
}

ob::PlannerPtr make_stock_planner(const PlannerKind& kind,
                                  const PlannerSettings& settings,
                                  const PushProblem& problem) {
  const int cells = whole_setting(kind, settings, "cells");
  ob::PlannerPtr planner = kind.family == PlannerFamily::kGeometric
                               ? make_geometric(kind.algorithm, problem)
                               : make_control(kind.algorithm, problem, cells);
  if (!planner) return nullptr;
  if (kind.family == PlannerFamily::kBlind) {
    set_tries(problem, static_cast<unsigned>(whole_setting(kind, settings, "tries")));
  }
  set_options(kind, settings, problem.steps()->model().L, *planner);
  planner->setProblemDefinition(problem.definition());
  planner->setup();
  return planner;
}

}  // namespace prehensile
