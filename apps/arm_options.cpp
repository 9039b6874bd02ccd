#include "apps/arm_options.h"

#include <cstdio>
#include <numbers>

#include <CLI/CLI.hpp>

#include "apps/option_checks.h"
#include "apps/table.h"
#include "planner/arm/arm_crossings.h"

namespace prehensile::apps {
namespace {

/// A plan is clear of obstacles for as long an approach as the scene says.
double clearance_of(const ArmOptions& options, const Scene& scene) {
  const double usual =
      scene.obstacles ? scene.obstacles->approach : options.limits.clearance;
  const double wanted = options.clearance_mm ? 1e-3 * *options.clearance_mm : usual;
  if (!scene.obstacles || wanted <= usual) return wanted;
  throw BadInput(
      text("--clearance-mm %g: expected at most %g, obstacles.approach of the "
           "scene: the plan is clear of obstacles no farther from its pushers",
           1e3 * wanted, 1e3 * usual));
}

ArmLimits limits_of(const ArmOptions& options, const Scene& scene) {
  ArmLimits limits = options.limits;
  limits.push_speed = 1e-3 * options.push_speed_mm;
  limits.approach_speed = 1e-3 * options.approach_speed_mm;
  limits.transit_speed = 1e-3 * options.transit_speed_mm;
  limits.clearance = clearance_of(options, scene);
  limits.turn_speed = options.turn_speed_deg * std::numbers::pi / 180.0;
  return limits;
}

[[noreturn]] void refuse_endless(double seconds, const ArmLimits& limits) {
  throw BadInput(text(
      "--arm: a motion of %.2g s at %g Hz: expected at most %lld samples; move faster "
      "or lower --arm-rate-hz",
      seconds, limits.rate, static_cast<long long>(limits.most_samples)));
}

/// The plan itself does not depend on where a scene puts its pushers, the arm does.
void warn_of_crossings(const Model& model, const Plan& plan, const ArmMotion& motion) {
  std::string found;
  for (const ArmCrossing& crossing : arm_crossings(model, plan, motion)) {
    const auto pusher = static_cast<std::size_t>(crossing.pusher);
    found += (found.empty() ? "" : ", ") + model.scene.pushers[pusher].name +
             text(" (at %.2f s, %s of push %d)", crossing.t,
                  std::string(name(crossing.phase)).c_str(), crossing.push + 1);
  }
  if (found.empty()) return;
  std::fprintf(
      stderr,
      "warning: the arm would carry the object through %s: seen at the samples "
      "of its motion, lines without a length as endless; pushers.N.position says "
      "where a pusher stands\n",
      found.c_str());
}

}  // namespace

void add_arm_options(CLI::App& command, ArmOptions& options) {
  const auto number = [&command](const char* flag, double& value, const char* doc,
                                 double most) {
    command.add_option(flag, value, doc)
        ->check(in_range(1e-3, most))
        ->capture_default_str();
  };
  command
      .add_option("--arm", options.files,
                  "write the motion of the arm: .csv (all), .tum or .txt (tool poses), "
                  ".yaml or .yml; may be given again")
      ->check(is_output());
  number("--push-speed-mm-s", options.push_speed_mm, "of the hand during a push", 1e4);
  number("--approach-speed-mm-s", options.approach_speed_mm, "before and after it", 1e4);
  number("--transit-speed-mm-s", options.transit_speed_mm, "between placements", 1e4);
  number("--turn-speed-deg-s", options.turn_speed_deg, "of the hand at most", 1e4);
  number("--acceleration", options.limits.acceleration, "of the hand at most, in m/s^2",
         1e3);
  number("--turn-acceleration", options.limits.turn_acceleration, "at most, in rad/s^2",
         1e4);
  command
      .add_option("--clearance-mm", options.clearance_mm,
                  "from a pusher before and after; default 30, or obstacles.approach of "
                  "the scene")
      ->check(in_range(1e-3, 1e3));
  number("--arm-rate-hz", options.limits.rate, "samples per second", 1e3);
  number("--guard-factor", options.limits.guard_factor,
         "guard force over the greatest force expected", 100.0);
}

void check_arm_options(const ArmOptions& options, const Scene& scene) {
  if (options.files.empty()) return;
  for (const std::string& file : options.files) arm_format(file);
  const ArmLimits limits = limits_of(options, scene);
  // Whatever the plan is, unless it has nothing to do: its first approach, last retreat.
  const double seconds = 2.0 * limits.clearance / limits.approach_speed;
  if (seconds * limits.rate > static_cast<double>(limits.most_samples)) {
    refuse_endless(seconds, limits);
  }
}

ArmTexts arm_texts(const ArmOptions& options, const Model& model, const PlanFile& plan) {
  ArmTexts texts;
  if (options.files.empty()) return texts;
  if (!plan.plan.usable()) {
    texts.report = "no plan, so no arm file is written\n";
    return texts;
  }
  const ArmLimits limits = limits_of(options, model.scene);
  const ArmMotion motion = arm_motion(model, plan.plan, limits);
  if (motion.is_too_long) refuse_endless(motion.seconds, limits);
  warn_of_crossings(model, plan.plan, motion);
  for (const int push : motion.blocked_transits) {
    texts.report += text(
        "the way to push %d is straight and not allowed: none was found that is clear of "
        "obstacles, within limits, and on which the grasp holds the object\n",
        push + 1);
  }
  for (const std::string& file : options.files) {
    texts.files.push_back({file, arm_to_text(plan, motion, limits, arm_format(file))});
    texts.report +=
        "arm file: " + file +
        text(" (%zu samples, %.2f s)\n", motion.samples.size(), motion.seconds);
  }
  return texts;
}

}  // namespace prehensile::apps
