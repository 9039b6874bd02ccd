#include "apps/plan_report.h"

#include <cmath>

#include "apps/table.h"

namespace prehensile::apps {
namespace {

/// Bound of plans to the goal itself over that of all others, from which it is printed.
constexpr double kWorthSaying = 1.1;

/// Direction of a push measured from the pusher's normal, positive towards t.
double direction_from_normal(const PushContact& contact, const Vec2& e) {
  return std::atan2(e.dot(contact.t), e.dot(contact.n));
}

std::vector<std::string> push_row(const Model& model, const PlannedPush& planned,
                                  int number) {
  const bool rolls = std::holds_alternative<Roll>(planned.push);
  const PushContact& contact = model.contacts[contact_of(planned.push)];
  std::vector<std::string> row = {text("%d", number)};
  double travel = 0.0;
  if (rolls) {
    travel = std::get<Roll>(planned.push).travel;
    row.insert(row.end(), {"roll", contact_text(model, contact_of(planned.push)), "-",
                           "-", text("%.1f", to_mm(travel)),
                           text("%.1f", to_deg(planned.end.psi - planned.start.psi))});
  } else {
    const LinearPush push = as_linear(planned.push);
    const bool moves = push.travel > 1e-9;
    row.insert(
        row.end(),
        {kind_name(push.travel, push.turn, 0.0), contact_text(model, push.contact),
         text("%.1f", to_mm(push.place)),
         moves ? text("%.1f", to_deg(direction_from_normal(contact, push.e))) : "-",
         text("%.1f", to_mm(push.travel)), text("%.1f", to_deg(push.turn))});
  }
  const PlanarPose& pose = planned.end.X_HO;
  row.insert(row.end(), {text("%.2f", to_mm(pose.x)), text("%.2f", to_mm(pose.y)),
                         text("%.2f", to_deg(pose.theta))});
  if (model.cross_section) row.push_back(text("%.2f", to_deg(planned.end.psi)));
  row.insert(row.end(), {text("%.1f", planned.push_force), text("%.3f", planned.slack),
                         text("%.0e", planned.certificate)});
  return row;
}

std::string push_table(const Model& model, const Plan& plan) {
  std::vector<std::string> header = {"#",       "kind",      "pusher",   "place mm",
                                     "dir deg", "travel mm", "turn deg", "x mm",
                                     "y mm",    "theta deg"};
  if (model.cross_section) header.emplace_back("roll deg");
  header.insert(header.end(), {"force N", "margin", "certificate"});
  Table table(header);
  int number = 0;
  for (const PlannedPush& push : plan.pushes) table.add(push_row(model, push, ++number));
  return table.str();
}

std::string effort(const Plan& plan) {
  std::string work = text("%lld stick tests", static_cast<long long>(plan.stick_tests));
  if (plan.propagations > 0) {
    work += text(", %lld propagations", static_cast<long long>(plan.propagations));
  }
  return text("planner %s, seed %llu: %s, %lld exact instants, %.1f ms\n",
              plan.planner.c_str(), static_cast<unsigned long long>(plan.seed),
              work.c_str(), static_cast<long long>(plan.instants), 1e3 * plan.seconds);
}

std::string promise_text(const Plan& plan) {
  const Margin& margin = plan.margin;
  if (plan.promise == Promise::kNominalOnly) return "NOMINAL ONLY: no margin\n";
  if (margin.is_none()) return "nominal: no margin\n";
  std::string promise = text(
      "planned for (%s): friction -%.0f %%, weight over grip +-%.0f %%, torque radius "
      "+-%.0f %%, pusher place +-%.1f mm and tilt +-%.2f deg, centre of mass +-%.1f mm, "
      "start in the hand +-%.1f mm\n",
      std::string(name(plan.promise)).c_str(), 100.0 * margin.friction,
      100.0 * margin.force, 100.0 * margin.torque_radius, to_mm(margin.place),
      to_deg(margin.tilt), to_mm(margin.centre_of_mass), to_mm(margin.grasp));
  if (margin.weightless) promise.insert(promise.size() - 1, "; no push needs gravity");
  return promise;
}

std::string explanation_text(const Explanation& explanation) {
  std::string out = explanation.text + '\n';
  for (const ProposedChange& change : explanation.changes) {
    out += text("  J = %.3f with ", change.cost) + change.what;
    if (!change.option.empty()) out += ": " + change.option;
    if (!change.pusher.empty()) out += ": pushers: - " + change.pusher;
    out += '\n';
  }
  return out;
}

std::string price_text(const CostWeights& price, const Plan& plan) {
  return text(
      "prices: travel %g, work %g per J, grip change %g; the pads take %.4g J, the grip "
      "changes %g times\n",
      price.travel, price.work, price.grip_change, plan.work, plan.grip_changes);
}

}  // namespace

std::string contact_text(const Model& model, int contact) {
  const PushContact& c = model.contacts[contact];
  std::string out = model.scene.pushers[c.pusher].name;
  out += " on " + model.faces[c.face].name;
  if (c.grip_share != 1.0) {
    out += text(", grip %.1f N", c.grip_share * model.scene.gripper.grip_force);
  }
  return out;
}

std::string pose_text(const Model& model, const Grasp& grasp) {
  std::string out = text("x %.2f mm, y %.2f mm, theta %.2f deg", to_mm(grasp.X_HO.x),
                         to_mm(grasp.X_HO.y), to_deg(grasp.X_HO.theta));
  if (model.cross_section || model.prism) {
    out += text(", roll %.2f deg", to_deg(grasp.psi));
  }
  return out;
}

std::string describe(const Model& model, const Plan& plan) {
  std::string out = model.scene.name + ": " + std::string(name(plan.status)) + '\n';
  const bool is_said_below = plan.message == plan.proof.text;
  if (!plan.message.empty() && !is_said_below) out += plan.message + '\n';
  out += "start: " + pose_text(model, plan.start) + '\n';
  if (plan.proof.kind != Proof::Kind::kNone) {
    out +=
        "proof (" + std::string(name(plan.proof.kind)) + "): " + plan.proof.text + '\n';
  }
  if (plan.usable()) {
    out += "goal:  " + pose_text(model, plan.goal) + '\n';
    if (!plan.pushes.empty()) out += push_table(model, plan);
    out += text(
        "cost J = %.3f (%g placements, travel %.1f mm); lower bound %.3f, gap %.1f %%",
        plan.cost, plan.placements, to_mm(plan.travel), plan.lower_bound,
        100.0 * plan.gap());
    if (plan.bound_at_goal && *plan.bound_at_goal >= kWorthSaying * plan.lower_bound) {
      out += text("; to the goal itself %.3f, gap %.1f %%", *plan.bound_at_goal,
                  100.0 * plan.gap_to(*plan.bound_at_goal));
    }
    out += text("; published cost %.1f\n", plan.published_cost);
    if (model.scene.cost) out += price_text(*model.scene.cost, plan);
    out += promise_text(plan);
  }
  if (plan.explanation) out += explanation_text(*plan.explanation);
  return out + effort(plan);
}

std::string describe(const Model& model, const Plan& plan, const Replay& replay) {
  Table table({"#", "pusher", "outcome", "position um", "angle mrad", "force %", "margin",
               "certificate", "agrees"});
  for (std::size_t i = 0; i < replay.pushes.size(); ++i) {
    const ReplayedPush& push = replay.pushes[i];
    table.add(
        {text("%zu", i + 1), contact_text(model, contact_of(plan.pushes[i].push)),
         std::string(name(push.transition.status)),
         text("%.3f", 1e6 * push.position_error), text("%.4f", 1e3 * push.angle_error),
         text("%.3f", 100.0 * push.force_error), text("%.3f", push.slack),
         text("%.0e", push.transition.worst_certificate), push.agrees ? "yes" : "NO"});
  }
  std::string out =
      model.scene.name + ": " + (replay.agrees ? "the plan holds" : "FAILED") + '\n';
  if (!replay.pushes.empty()) out += table.str();
  if (!replay.why.empty()) out += replay.why + '\n';
  for (std::size_t i = 0; i < replay.pushes.size(); ++i) {
    if (replay.pushes[i].why.empty()) continue;
    const std::string why = text("push %zu: ", i + 1) + replay.pushes[i].why;
    if (why != replay.why) out += why + '\n';
  }
  return out + "end:   " + pose_text(model, replay.end) +
         text("; %lld exact instants\n", static_cast<long long>(replay.instants));
}

}  // namespace prehensile::apps
