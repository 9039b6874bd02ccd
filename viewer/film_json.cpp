#include "viewer/film_json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

#include <nlohmann/json.hpp>

#include "viewer/surfaces.h"

namespace prehensile::viewer {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostOutcomes = 400;  // drawn; they are draws, so the first will do

/// Six digits.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

/// Lengths and angles: to 1e-7.
Json fine(double value) {
  if (!std::isfinite(value)) return nullptr;
  const double rounded = std::round(1e7 * value) / 1e7;
  return rounded == 0.0 ? 0.0 : rounded;
}

Json point(const Vec2& p) { return {fine(p.x()), fine(p.y())}; }
Json point(const Vec3& p) { return {fine(p.x()), fine(p.y()), fine(p.z())}; }
Json pose(const PlanarPose& X) { return {fine(X.x), fine(X.y), fine(X.theta)}; }
Json grasp(const Grasp& g) {
  return {fine(g.X_HO.x), fine(g.X_HO.y), fine(g.X_HO.theta), fine(g.psi)};
}

Json points(const std::vector<Vec2>& outline) {
  Json out = Json::array();
  for (const Vec2& p : outline) out.push_back(point(p));
  return out;
}

const char* axis_name(Axis axis) {
  return axis == Axis::kX ? "x" : axis == Axis::kY ? "y" : "z";
}

/// Vertices [um], each once, and three indices a triangle, one after the other.
Json surface_json(const Surface& surface) {
  Json vertices = Json::array(), triangles = Json::array();
  std::map<std::array<long, 3>, std::size_t> numbers;
  for (const auto& triangle : surface.triangles) {
    for (const Vec3& p : triangle) {
      const std::array<long, 3> um{std::lround(1e6 * p.x()), std::lround(1e6 * p.y()),
                                   std::lround(1e6 * p.z())};
      const auto [known, is_new] = numbers.emplace(um, numbers.size());
      if (is_new) {
        for (const long value : um) vertices.push_back(value);
      }
      triangles.push_back(known->second);
    }
  }
  return {{"vertices", vertices}, {"triangles", triangles}};
}

Json bodies_json(const std::vector<ConvexBody>& bodies, double extent) {
  Json out = Json::array();
  for (const ConvexBody& body : bodies) {
    out.push_back(
        {{"name", body.name}, {"surface", surface_json(surface_of(body, extent))}});
  }
  return out;
}

Json obstacles_json(const Model& model) {
  const auto& obstacles = model.scene.obstacles;
  if (!obstacles) return nullptr;
  const double extent = extent_of(model);
  return {{"fixture", bodies_json(obstacles->fixture, extent)},
          {"hand", bodies_json(obstacles->hand, extent)}};
}

/// Two ends each; null where there is none.
Json limits_json(const Model& model) {
  if (!model.scene.limits) return nullptr;
  const GraspLimits& limits = *model.scene.limits;
  const auto angle = [](const std::optional<double>& end) {
    return end ? fine(*end) : Json(nullptr);
  };
  const auto corner = [](const std::optional<Vec2>& end) {
    return end ? point(*end) : Json(nullptr);
  };
  return {{"theta", {angle(limits.theta_low), angle(limits.theta_high)}},
          {"finger", {corner(limits.finger_low), corner(limits.finger_high)}},
          {"hand", {corner(limits.hand_low), corner(limits.hand_high)}},
          {"hand_angle", {angle(limits.hand_angle_low), angle(limits.hand_angle_high)}}};
}

Json object_json(const Model& model, const std::optional<ObjectSurface>& mesh) {
  const ObjectBody body = object_body(model);
  Json out = {
      {"mass", number(model.mass)},
      {"p_OCom", {fine(model.p_OCom.x()), fine(model.p_OCom.y()), fine(model.z_OCom)}},
      {"outline", points(model.outline)},
      {"half_thickness", fine(model.half_thickness)},
      {"reach", fine(reach_of(model))},
      {"prisms", Json::array()},
      {"cylinders", Json::array()},
      {"sides", Json::array()}};
  for (const PrismBody& prism : body.prisms) {
    out["prisms"].push_back({{"outline", points(prism.outline)},
                             {"low", fine(prism.low)},
                             {"high", fine(prism.high)},
                             {"axis", axis_name(prism.axis)}});
  }
  for (const CylinderBody& cylinder : body.cylinders) {
    out["cylinders"].push_back({{"radius", fine(cylinder.radius)},
                                {"length", fine(cylinder.length)},
                                {"axis", axis_name(cylinder.axis)}});
  }
  for (const Face& side : body.sides) {
    out["sides"].push_back({{"a", point(side.a)},
                            {"b", point(side.b)},
                            {"low", fine(side.z_low)},
                            {"high", fine(side.z_high)}});
  }
  if (mesh) {
    out["mesh"] = surface_json(surface_of(*mesh));
    out["mesh"]["off"] = fine(mesh->off);
  }
  return out;
}

Json gripper_json(const Model& model) {
  const Gripper& gripper = model.scene.gripper;
  const PadBody pad = pad_body(model);
  return {{"name", gripper.name},
          {"pad", points(pad.outline)},
          {"is_round", pad.is_round},
          {"friction", {number(gripper.friction[0]), number(gripper.friction[1])}},
          {"grip_force", number(gripper.grip_force)}};
}

/// Where a pusher stands in the world [m, rad]: as the scene says; where nothing is
/// pushed, the object stands at O, and the pusher against the first face that it may
/// push.
struct Stand {
  Vec2 p;
  double angle;
};

Stand stand_of(const Model& model, const Film& film, int pusher) {
  const Scene& scene = model.scene;
  const auto contact =
      std::find_if(model.contacts.begin(), model.contacts.end(),
                   [pusher](const PushContact& c) { return c.pusher == pusher; });
  if (!film.pushes.empty() || contact == model.contacts.end()) {
    const Pusher& stated = scene.pushers[static_cast<std::size_t>(pusher)];
    return {stated.p_WP, stated.normal_angle};
  }
  return {0.5 * (contact->a + contact->b), std::atan2(contact->n.y(), contact->n.x())};
}

Json pushers_json(const Model& model, const Film& film) {
  Json out = Json::array();
  for (std::size_t i = 0; i < model.scene.pushers.size(); ++i) {
    const Pusher& pusher = model.scene.pushers[i];
    const PusherBody body = pusher_in(film, model, static_cast<int>(i));
    const Stand at = stand_of(model, film, static_cast<int>(i));
    out.push_back({{"name", pusher.name},
                   {"feature", std::string(name(body.kind))},
                   {"length", fine(body.length)},
                   {"width", fine(body.width)},
                   {"goes_on_along", body.goes_on_along},
                   {"goes_on_across", body.goes_on_across},
                   {"p_WP", {fine(at.p.x()), fine(at.p.y()), fine(pusher.z_WP)}},
                   {"normal_angle", fine(at.angle)},
                   {"friction", number(pusher.friction)}});
  }
  return out;
}

Json load_json(const PointLoad& load) {
  return {
      {"p", point(load.p)},
      {"n", {number(load.n.x()), number(load.n.y()), number(load.n.z())}},
      {"force", {number(load.force.x()), number(load.force.y()), number(load.force.z())}},
      {"slip", point(load.slip)},
      {"mu", number(load.mu)},
      {"mode", std::string(name(load.mode))}};
}

/// x, y [um] of the points of a pad, one after the other.
Json pad_places(const std::vector<PointLoad>& pad) {
  Json out = Json::array();
  for (const PointLoad& load : pad) {
    out.push_back(std::lround(1e6 * load.p.x()));
    out.push_back(std::lround(1e6 * load.p.y()));
  }
  return out;
}

/// Normal force, and friction along x and y of H, of the points of a pad [mN].
Json pad_forces(const std::vector<PointLoad>& pad) {
  Json out = Json::array();
  const auto mN = [](double force) { return std::lround(1e3 * force); };
  for (const PointLoad& load : pad) {
    out.push_back(mN(load.normal()));
    out.push_back(mN(load.force.x()));
    out.push_back(mN(load.force.y()));
  }
  return out;
}

Json pads_json(const ContactLoads& loads, std::array<Json, 2>& last_places) {
  Json out = Json::array();
  for (std::size_t jaw = 0; jaw < 2; ++jaw) {
    Json pad = Json::object();
    Json forces = pad_forces(loads.pad[jaw]);
    if (jaw == 0 || forces != out[0]["forces"]) pad["forces"] = std::move(forces);
    if (loads.pad[jaw].size() == 1) pad["load"] = load_json(loads.pad[jaw].front());
    const Json places = pad_places(loads.pad[jaw]);
    if (places != last_places[jaw]) pad["places"] = last_places[jaw] = places;
    out.push_back(pad);
  }
  return out;
}

Json frame_json(const FilmFrame& frame) {
  Json out = {{"s", number(frame.s)},
              {"X_HO", grasp(frame.grasp)},
              {"X_HP", pose(frame.X_HP)},
              {"jaw_z", {fine(frame.jaw_z[0]), fine(frame.jaw_z[1])}},
              {"push_force", number(frame.loads.push_force)},
              {"slack", number(frame.slack)},
              {"robust_slack", number(frame.robust_slack)},
              {"status", std::string(name(frame.sample.status))},
              {"certificate", number(frame.loads.certificate)},
              {"pusher", Json::array()}};
  if (frame.z_HO != 0.0) out["z_HO"] = fine(frame.z_HO);
  if (frame.z_HP != 0.0) out["z_HP"] = fine(frame.z_HP);
  for (const PointLoad& load : frame.loads.pusher)
    out["pusher"].push_back(load_json(load));
  if (std::isfinite(frame.direction)) {
    out["direction"] = number(frame.direction);
    out["cone"] = Json::array();
    for (const DirectionRange& range : frame.cone) {
      out["cone"].push_back({number(range.lo), number(range.hi)});
    }
  }
  return out;
}

Json events_json(const Transition& transition) {
  Json out = Json::array();
  for (int i = 0; i < transition.event_count; ++i) {
    const Event& event = transition.events[static_cast<std::size_t>(i)];
    out.push_back({{"s", number(event.s)}, {"kind", std::string(name(event.kind))}});
  }
  return out;
}

/// Of how many frames one has its pads written.
std::size_t pad_stride(const Film& film, int most) {
  std::size_t points = 0;
  for (const FilmPush& push : film.pushes) {
    for (const FilmFrame& frame : push.frames) {
      for (const auto& pad : frame.loads.pad) points += pad.size();
    }
  }
  return 1 + points / static_cast<std::size_t>(std::max(1, most));
}

Json push_json(const Model& model, const FilmPush& push, std::size_t stride) {
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  const auto face = static_cast<std::size_t>(contact.face);
  const Transition& done = push.transition;
  Json out = {{"kind", push.kind},
              {"pusher", contact.pusher},
              {"face", model.faces[face].name},
              {"p_PC", point(push.p_PC)},
              {"n_P", {number(contact.n.x()), number(contact.n.y())}},
              {"status", std::string(name(done.status))},
              {"completed", done.completed()},
              {"reason", std::string(done.reason)},
              {"why", push.why},
              {"done", number(done.done)},
              {"in_space", done.in_space},
              {"slipped", fine(done.slipped)},
              {"certificate", number(done.worst_certificate)},
              {"error_estimate", number(done.error_estimate)},
              {"events", events_json(done)},
              {"frames", Json::array()}};
  const double grip = grip_force_of(model, push.push);
  if (grip != model.scene.gripper.grip_force) out["grip_force"] = number(grip);
  std::array<Json, 2> last_places;
  for (std::size_t i = 0; i < push.frames.size(); ++i) {
    Json frame = frame_json(push.frames[i]);
    if (i % stride == 0) frame["pads"] = pads_json(push.frames[i].loads, last_places);
    out["frames"].push_back(std::move(frame));
  }
  return out;
}

Json phases_json(const Film& film) {
  Json out = Json::array();
  for (const FilmPhase& phase : film.phases) {
    out.push_back({{"kind", std::string(name(phase.kind))},
                   {"push", phase.push},
                   {"begin", number(phase.begin)},
                   {"end", number(phase.end)},
                   {"from", pose(phase.X_WH_from)},
                   {"to", pose(phase.X_WH_to)},
                   {"z", {fine(phase.z_from), fine(phase.z_to)}}});
  }
  return out;
}

Json verdict_json(const Plan& plan, const Film& film) {
  Json out = {{"status", std::string(name(plan.status))},
              {"message", plan.message},
              {"usable", plan.usable()},
              {"agrees", film.agrees},
              {"why", film.why},
              {"left_out", film.left_out},
              {"cost", number(plan.cost)},
              {"lower_bound", number(plan.lower_bound)},
              {"placements", number(plan.placements)},
              {"travel", number(plan.travel)},
              {"planner", plan.planner},
              {"promise", std::string(name(plan.promise))},
              {"proof", plan.proof.text},
              {"explanation", plan.explanation ? plan.explanation->text : ""},
              {"changes", Json::array()}};
  if (plan.explanation) {
    for (const ProposedChange& change : plan.explanation->changes) {
      const std::string& pusher = change.pusher;
      out["changes"].push_back(
          {{"what", change.what},
           {"option", pusher.empty() ? change.option : "pushers: - " + pusher}});
    }
  }
  return out;
}

Json goal_json(const Goal& goal) {
  const auto fixed = [](const std::optional<double>& value) {
    return value ? fine(*value) : Json(nullptr);
  };
  return {fixed(goal.x), fixed(goal.y), fixed(goal.theta), fixed(goal.psi)};
}

}  // namespace

std::string to_json(const Model& model, const Plan& plan, const Film& film,
                    int pad_points) {
  const Scene& scene = model.scene;
  Json out = {{"format", 1},
              {"name", film.name},
              {"origin", scene.origin},
              {"is_plan", plan.status != PlanStatus::kNotRun},
              {"verdict", verdict_json(plan, film)},
              {"g_W", {number(scene.g_W.x()), number(scene.g_W.y()), number(scene.g_Wz)}},
              {"object", object_json(model, film.surface)},
              {"gripper", gripper_json(model)},
              {"pushers", pushers_json(model, film)},
              {"obstacles", obstacles_json(model)},
              {"limits", limits_json(model)},
              {"start", grasp(scene.start)},
              {"goal", scene.goal ? goal_json(*scene.goal) : Json(nullptr)},
              {"pushes", Json::array()},
              {"phases", phases_json(film)},
              {"outcomes", Json::array()}};
  const std::size_t stride = pad_stride(film, pad_points);
  for (const FilmPush& push : film.pushes) {
    out["pushes"].push_back(push_json(model, push, stride));
  }
  const std::size_t shown = std::min(film.outcomes.size(), kMostOutcomes);
  for (std::size_t i = 0; i < shown; ++i)
    out["outcomes"].push_back(grasp(film.outcomes[i]));
  return out.dump();
}

}  // namespace prehensile::viewer
