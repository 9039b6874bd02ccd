#include "apps/arm_options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <CLI/CLI.hpp>

#include "apps/option_checks.h"
#include "apps/table.h"
#include "planner/arm_crossings.h"

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

constexpr double kMostSamples = 1e6;

/// A file that nobody could read is refused before it fills the memory.
void refuse_endless(const Plan& plan, const ArmLimits& limits) {
  const double slowest =
      std::min({limits.push_speed, limits.approach_speed, limits.transit_speed});
  double seconds = 0.0;
  for (const PlannedPush& push : plan.pushes) {
    const LinearPush linear = as_linear(push.push);
    const double way = linear.travel + 4.0 * limits.clearance;
    const double turn = std::abs(linear.turn) + std::numbers::pi;
    seconds += 2.0 * (way / slowest + turn / limits.turn_speed) +
               4.0 * (std::sqrt(way / limits.acceleration) +
                      std::sqrt(turn / limits.turn_acceleration));
  }
  if (seconds * limits.rate <= kMostSamples) return;
  throw BadInput(
      text("--arm: a motion of about %.2g s at %g Hz: expected at most %.0e "
           "samples; move faster or lower --arm-rate-hz",
           seconds, limits.rate, kMostSamples));
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
                  "write the motion of the arm: .csv (all), .tum (tool poses) or "
                  ".yaml; may be given again")
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

void check_arm_files(const ArmOptions& options) {
  for (const std::string& file : options.files) arm_format(file);
}

std::string write_arm_files(const ArmOptions& options, const Model& model,
                            const PlanFile& plan) {
  if (options.files.empty()) return {};
  if (!plan.plan.usable()) return "no plan, so no arm file is written\n";
  const ArmLimits limits = limits_of(options, model.scene);
  refuse_endless(plan.plan, limits);
  const ArmMotion motion = arm_motion(model, plan.plan, limits);
  warn_of_crossings(model, plan.plan, motion);
  const double seconds = motion.samples.empty() ? 0.0 : motion.samples.back().t;
  std::string out;
  for (const int push : motion.blocked_transits) {
    out += text(
        "the way to push %d is straight and not allowed: none was found that is clear of "
        "obstacles, within limits, and on which the grasp holds the object\n",
        push + 1);
  }
  for (const std::string& file : options.files) {
    write_atomically(file, arm_to_text(plan, motion, limits, arm_format(file)));
    out += "arm file: " + file +
           text(" (%zu samples, %.2f s)\n", motion.samples.size(), seconds);
  }
  return out;
}

}  // namespace prehensile::apps
