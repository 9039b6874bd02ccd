#include "planner/catalogue.h"

#include <algorithm>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "planner/search/frame.h"
#include "tests/planner/planner_cases.h"

namespace prehensile {
namespace {

TEST(Catalogue, OwnIsFirstAndNamesAreUnique) {
  const auto& kinds = planner_catalogue();
  EXPECT_EQ(kinds.front().name, "push");
  std::set<std::string> names;
  for (const PlannerKind& kind : kinds) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_EQ(find_planner(kind.name), &kind);
  }
  EXPECT_EQ(planner_names().front(), "push");
  EXPECT_EQ(planner_names().size(), frame_is_built() ? kinds.size() : 3U);
}

TEST(Catalogue, DefaultsAreAllowedValues) {
  for (const PlannerKind& kind : planner_catalogue()) {
    if (kind.needs_ompl() && !frame_is_built()) continue;
    PlannerSettings defaults;
    for (const PlannerOption& option : kind.options) {
      EXPECT_TRUE(defaults.emplace(option.name, option.value).second);
      EXPECT_EQ(setting(kind, {}, option.name), option.value);
      EXPECT_EQ(setting(kind, {{option.name, option.most}}, option.name), option.most);
      for (const double wrong :
           {std::numeric_limits<double>::quiet_NaN(), option.most * 1.5 + 1.0,
            std::numeric_limits<double>::infinity(), option.least - 1.0}) {
        const std::string fault = planner_fault(kind.name, {{option.name, wrong}});
        EXPECT_NE(fault.find(option.name), std::string::npos) << kind.name;
      }
      if (option.whole) {
        EXPECT_FALSE(
            planner_fault(kind.name, {{option.name, option.least + 0.5}}).empty());
      }
    }
    EXPECT_EQ(planner_fault(kind.name, defaults), "");
  }
}

TEST(Catalogue, UnknownNamesAreRefusedWithTheList) {
  const std::string planner = planner_fault("geometric::Magic", {});
  const std::string option = planner_fault("motion-cone-tree", {{"magic", 1.0}});
  EXPECT_NE(planner.find("motion-cone-tree, random-shooting, two-trees"),
            std::string::npos);
  EXPECT_NE(option.find("step, goal_bias"), std::string::npos) << option;
}

TEST(Catalogue, PlannersThatReverseMotionsAreRefusedForThat) {
  for (const std::string name :
       {"PRM", "PRMstar", "LazyPRM", "BFMT", "BiEST", "BKPIECE1", "SBL"}) {
    const std::string fault = planner_fault("geometric::" + name, {});
    EXPECT_NE(fault.find("cannot be undone"), std::string::npos) << name;
  }
}

TEST(Catalogue, OmplThatIsNotBuiltInIsSaidToBeAbsent) {
  const std::string fault = planner_fault("geometric::RRT", {});
  EXPECT_EQ(fault.empty(), frame_is_built()) << fault;
  if (!frame_is_built()) {
    EXPECT_NE(fault.find("not built in"), std::string::npos);
  }
}

TEST(Catalogue, PlansWithWrongSettingsAreRefused) {
  Scene scene = testing::walled_square();
  const Model model = prepare(scene);
  const Plan plan = plan_regrasp(model, {.settings = {{"speed", 3.0}}});
  EXPECT_EQ(plan.status, PlanStatus::kUnsupported);
  EXPECT_NE(plan.message.find("fallback_share"), std::string::npos) << plan.message;
}

}  // namespace
}  // namespace prehensile
