#include "viewer/key_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/obstacles/obstacle_bodies.h"
#include "scene/outline.h"
#include "viewer/panel.h"
#include "viewer/surfaces.h"

namespace prehensile::viewer {
namespace {

using plot::Drawing;
using plot::px;

constexpr double kTitle = 26.0;  // [px] above it
constexpr double kGap = 14.0;
constexpr double kCaption = 44.0;
constexpr int kColumns = 4;
constexpr double kSeen = 1.25;  // half of the picture over the reach of the object

const char* const kInk = "#222222";
const char* const kFaint = "#8a8f98";
const char* const kBefore = "#b9bec6";
const char* const kEdge = "#1f4e8c";
const char* const kFill = "#cfe0f5";
const char* const kRed = "#b3261e";
const char* const kGreen = "#14803f";
const char* const kPad = "#2b2f36";
const char* const kBody = "#c9ccd1";
const char* const kReached = "#e3a008";

std::vector<Vec2> moved(const PlanarPose& X, std::vector<Vec2> points) {
  for (Vec2& p : points) p = transform(X, p);
  return points;
}

std::vector<Vec2> circle(const Vec2& centre, double radius) {
  std::vector<Vec2> points;
  points.reserve(64);
  for (int i = 0; i < 64; ++i) {
    points.push_back(centre +
                     rotated(2.0 * std::numbers::pi * i / 64, Vec2(radius, 0.0)));
  }
  return points;
}

/// Both ends of what the pusher is in the pad plane, in P; a point: the same twice.
std::array<Vec2, 2> ends_of(const Model& model, const FilmPush& push) {
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  const Pusher& pusher = model.scene.pushers[static_cast<std::size_t>(contact.pusher)];
  const Vec2 half = 0.5 * pusher_body(model, pusher).length * contact.t;
  return {push.p_PC - half, push.p_PC + half};
}

void draw_pusher(Panel& panel, const Model& model, const FilmPush& push,
                 const PlanarPose& X_HP, const Drawing::Stroke& stroke) {
  const std::array<Vec2, 2> ends = ends_of(model, push);
  const Vec2 a = transform(X_HP, ends[0]);
  const Vec2 b = transform(X_HP, ends[1]);
  if (a == b) {
    const double radius = 4.0 / panel.scale();
    panel.polygon(circle(a, radius), stroke.colour, 1.0, {stroke.colour, 1.0, ""});
  } else {
    panel.line(a, b, stroke);
  }
}

/// Forces and friction cones of the pusher's points.
void draw_loads(Panel& panel, const FilmFrame& frame, double most_force) {
  for (const PointLoad& load : frame.loads.pusher) {
    if (load.mode == ContactMode::kOpen) continue;
    const Vec2 p = load.p.head<2>();
    const Vec2 n = load.n.head<2>();
    const double half = std::atan(load.mu);
    const double side = 42.0 / panel.scale() / std::cos(half);
    panel.polygon({p, p + side * rotated(-half, n), p + side * rotated(half, n)}, kRed,
                  0.14, {});
    panel.arrow(p, 85.0 / most_force * load.force.head<2>(), kRed, 2.4);
  }
}

/// The frame at or after a share of what was done.
const FilmFrame& frame_near(const FilmPush& push, double share) {
  const double s = share * push.frames.back().s;
  for (const FilmFrame& frame : push.frames) {
    if (frame.s >= s - 1e-12) return frame;
  }
  return push.frames.back();
}

/// Bodies of fixture and hand; a half space above or below covers everything.
void draw_obstacles(Panel& panel, const Model& model, const PlanarPose& X_HW) {
  const auto& obstacles = model.scene.obstacles;
  if (!obstacles) return;
  const double extent = extent_of(model);
  const auto draw = [&](const ConvexBody& body, const PlanarPose& X, const char* dash) {
    const auto* half_space = std::get_if<HalfSpaceShape>(&body.shape);
    if (half_space && std::abs((pose_of(body).linear() * half_space->normal).z()) > 0.9) {
      return;
    }
    panel.polygon(moved(X, shadow_of(surface_of(body, extent))), kBody, 0.35,
                  {kFaint, 0.8, dash});
  };
  for (const ConvexBody& body : obstacles->fixture) draw(body, X_HW, "");
  for (const ConvexBody& body : obstacles->hand) draw(body, {}, "2 2");
}

void draw_push(Panel& panel, const Model& model, const FilmPush& push,
               double most_force) {
  const FilmFrame& first = push.frames.front();
  const FilmFrame& last = push.frames.back();
  const std::vector<Vec2>& outline = model.outline;
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  const PlanarPose X_WP = pusher_in_world(model, contact, as_linear(push.push).place);
  draw_obstacles(panel, model, compose(last.X_HP, inverse(X_WP)));
  for (const double share : {1.0 / 3.0, 2.0 / 3.0}) {
    const PlanarPose& X_HO = frame_near(push, share).grasp.X_HO;
    panel.polygon(moved(X_HO, outline), "none", 1.0, {kBefore, 0.7, ""});
  }
  panel.polygon(moved(first.grasp.X_HO, outline), "none", 1.0, {kFaint, 1.2, "4 3"});
  panel.polygon(moved(last.grasp.X_HO, outline), kFill, 0.8, {kEdge, 1.7, ""});
  draw_pusher(panel, model, push, first.X_HP, {kFaint, 2.0, "4 3"});
  draw_pusher(panel, model, push, last.X_HP, {kRed, 3.6, ""});
  panel.polygon(pad_body(model).outline, kPad, 0.55, {kPad, 1.0, ""});
  // The path that the pads rub on the object, as it lies at the end.
  for (std::size_t i = 1; i < push.frames.size(); ++i) {
    const PlanarPose& X_HO = last.grasp.X_HO;
    panel.line(transform(X_HO, finger_in_object(push.frames[i - 1].grasp.X_HO)),
               transform(X_HO, finger_in_object(push.frames[i].grasp.X_HO)),
               {"#5b2a86", 1.6, ""});
  }
  draw_loads(panel, frame_near(push, 0.99), most_force);
}

/// The section across the object's axis: z to the right, away from the support up.
std::vector<Vec2> section_of(const Model& model, const FilmPush& push, double psi) {
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  std::vector<Vec2> points;
  if (!model.prism) return circle(Vec2::Zero(), model.half_thickness);
  const double side = contact.n.dot(model.prism->lateral);
  const double turn = contact.t.dot(model.prism->axis) > 0.0 ? psi : -psi;
  for (const Vec2& p : model.prism->section) {
    points.push_back(rotated(turn, Vec2(p.y(), side * p.x())));
  }
  return points;
}

/// Half of the pads' extent along the support's normal.
double half_pad_along(const Model& model, const Vec2& n_H) {
  double most = 0.0;
  for (const Vec2& p : pad_body(model).outline) most = std::max(most, n_H.dot(p));
  return most;
}

void draw_roll(Panel& panel, const Model& model, const FilmPush& push,
               double most_force) {
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  const FilmFrame& first = push.frames.front();
  const FilmFrame& last = push.frames.back();
  const auto place = [&](const FilmFrame& frame) {
    const Vec2 n_H = rotated(frame.grasp.X_HO.theta, contact.n);
    return Vec2(frame.z_HO, n_H.dot(translation(frame.grasp.X_HO)));
  };
  const auto section = [&](const FilmFrame& frame) {
    std::vector<Vec2> points = section_of(model, push, frame.grasp.psi);
    for (Vec2& p : points) p += place(frame);
    return points;
  };
  const auto mark = [&](const FilmFrame& frame, const char* colour) {
    const double psi =
        contact.t.x() + contact.t.y() > 0.0 ? frame.grasp.psi : -frame.grasp.psi;
    const Vec2 end = place(frame) + rotated(psi, Vec2(0.0, 0.8 * model.half_thickness));
    panel.line(place(frame), end, {colour, 1.4, ""});
  };
  panel.polygon(section(first), "none", 1.0, {kFaint, 1.2, "4 3"});
  mark(first, kFaint);
  panel.polygon(section(last), kFill, 0.8, {kEdge, 1.7, ""});
  mark(last, kEdge);
  const Vec2 n_H = rotated(last.grasp.X_HO.theta, contact.n);
  const double half = half_pad_along(model, n_H);
  const double thick = 0.15 * model.half_thickness;
  for (std::size_t jaw = 0; jaw < 2; ++jaw) {
    const double z = last.jaw_z[jaw];
    const double outer = z + (jaw == 0 ? -thick : thick);
    panel.polygon({{z, -half}, {outer, -half}, {outer, half}, {z, half}}, kPad, 0.55,
                  {kPad, 1.0, ""});
  }
  const double support = n_H.dot(transform(first.X_HP, push.p_PC));
  const double wide = 3.0 * model.half_thickness;
  panel.line({-wide, support}, {wide, support}, {kRed, 3.6, ""});
  panel.arrow({0.0, support - 0.35 * model.half_thickness},
              {panel.scale() * last.z_HP, 0.0}, kFaint, 2.0);
  const auto draw_load = [&](const PointLoad& load) {
    const Vec2 p(load.p.z(), n_H.dot(load.p.head<2>()));
    const Vec2 f(load.force.z(), n_H.dot(load.force.head<2>()));
    panel.arrow(p, 60.0 / most_force * f, kRed, 2.4);
  };
  for (const PointLoad& load : last.loads.pusher) draw_load(load);
  for (const auto& pad : last.loads.pad) {
    for (const PointLoad& load : pad) draw_load(load);
  }
}

double most_force_of(const FilmPush& push, bool with_pads) {
  double most = 1e-9;
  for (const FilmFrame& frame : push.frames) {
    for (const PointLoad& load : frame.loads.pusher) {
      most = std::max(most, load.force.norm());
    }
    if (!with_pads) continue;
    for (const auto& pad : frame.loads.pad) {
      for (const PointLoad& load : pad) most = std::max(most, load.force.norm());
    }
  }
  return most;
}

/// Gravity as it points in the hand when the push ends.
void draw_gravity(Panel& panel, const Model& model, const FilmPush& push,
                  const Vec2& corner) {
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  const Vec2 g_H = rotated(push.frames.back().X_HP.theta, contact.g_O);
  if (!(g_H.norm() > 0.0)) return;
  panel.arrow(corner, 26.0 * g_H / g_H.norm(), kInk, 1.8);
}

std::string title_of(const Model& model, const FilmPush& push, std::size_t index) {
  const PushContact& contact = model.contacts[static_cast<std::size_t>(push.contact)];
  const Pusher& pusher = model.scene.pushers[static_cast<std::size_t>(contact.pusher)];
  std::string out = std::to_string(index + 1) + ". " + push.kind + " by " + pusher.name;
  if (!push.transition.completed()) {
    out += ": " + std::string(name(push.transition.status));
  }
  return out;
}

/// A length of 1, 2 or 5 times a power of ten that is a good fifth of the picture.
double bar_length(double half_width) {
  const double raw = 0.5 * half_width;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double lead = raw / power;
  return power * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0);
}

void draw_bar(Panel& panel, const Vec2& middle, double half_width) {
  const double length = bar_length(half_width);
  const Vec2 a = middle + Vec2(-0.93 * half_width, -0.93 * half_width);
  panel.line(a, a + Vec2(length, 0.0), {kInk, 2.0, ""});
  panel.words(0.035 * kPanel, 0.945 * kPanel, plot::shortest(1e3 * length) + " mm",
              {.size = 11.0, .colour = kInk});
}

/// The middle of everything that the object's outline visits during a push.
Vec2 middle_of(const Model& model, const FilmPush& push, double& half_width) {
  Vec2 low = Vec2::Constant(1e9), high = Vec2::Constant(-1e9);
  for (const FilmFrame* frame : {&push.frames.front(), &push.frames.back()}) {
    for (const Vec2& p : moved(frame->grasp.X_HO, model.outline)) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  half_width = std::max(half_width, 0.56 * (high - low).maxCoeff());
  return 0.5 * (low + high);
}

/// Clips what is drawn to one picture.
std::string clip(std::size_t index, double left, double top) {
  const std::string id = "panel" + std::to_string(index);
  return std::string("<clipPath id=\"") + id + "\"><rect x=\"" + px(left) + "\" y=\"" +
         px(top) + "\" width=\"" + px(kPanel) + "\" height=\"" + px(kPanel) +
         "\"/></clipPath><g clip-path=\"url(#" + id + ")\">";
}

/// The part of the object that the finger axis cannot leave. The borders run round what
/// is between them, so that one after the other they are one polygon.
void draw_region(Panel& panel, const Model& model, const Loops& region) {
  const PlanarPose& X_HO = model.scene.start.X_HO;
  std::vector<Vec2> border;
  for (const auto& loop : region) {
    border.insert(border.end(), loop.begin(), loop.end());
    border.push_back(loop.front());
  }
  for (std::size_t i = region.size(); i-- > 1;) border.push_back(region[i - 1].front());
  panel.clip_to(moved(X_HO, model.pad_face));
  panel.polygon(moved(X_HO, border), kReached, 0.45, {kReached, 1.2, ""});
  panel.end_clip();
  if (const auto& goal = model.scene.goal; goal->x && goal->y && goal->theta) {
    const Vec2 p_OF = finger_in_object({*goal->x, *goal->y, *goal->theta});
    const double radius = 5.0 / panel.scale();
    panel.polygon(circle(transform(X_HO, p_OF), radius), kGreen, 1.0, {kGreen, 1.0, ""});
  }
}

void draw_still(Panel& panel, const Model& model, const Film& film) {
  const Grasp& start = model.scene.start;
  draw_obstacles(panel, model, start.X_HO);  // O is W at the start
  panel.polygon(moved(start.X_HO, model.outline), kFill, 0.8, {kEdge, 1.7, ""});
  if (!film.region.empty()) {
    draw_region(panel, model, film.region);
  } else if (const auto& goal = model.scene.goal) {
    const PlanarPose X{goal->x.value_or(start.X_HO.x), goal->y.value_or(start.X_HO.y),
                       goal->theta.value_or(start.X_HO.theta)};
    panel.polygon(moved(X, model.outline), "none", 1.0, {kGreen, 1.5, "4 3"});
  }
  panel.polygon(pad_body(model).outline, kPad, 0.55, {kPad, 1.0, ""});
}

}  // namespace

std::string key_frames(const Model& model, const Film& film, int most) {
  const std::size_t shown =
      std::min(film.pushes.size(), static_cast<std::size_t>(std::max(1, most)));
  const std::size_t panels = std::max<std::size_t>(1, shown);
  const auto columns = std::min<std::size_t>(kColumns, panels);
  const std::size_t rows = (panels + columns - 1) / columns;
  const double width = static_cast<double>(columns) * (kPanel + kGap) + kGap;
  const double height = static_cast<double>(rows) * (kPanel + kTitle) + kCaption;
  double half_width = kSeen * 0.5 * model.L;
  std::vector<Vec2> middles(panels, Vec2::Zero());
  for (std::size_t i = 0; i < shown; ++i) {
    middles[i] = middle_of(model, film.pushes[i], half_width);
  }
  if (!film.region.empty()) {
    middles[0] = transform(model.scene.start.X_HO, properties_of(model.outline).centroid);
  }
  Drawing drawing;
  drawing.rectangle(0.0, 0.0, width, height, "#ffffff", {});
  for (std::size_t i = 0; i < panels; ++i) {
    const std::size_t row = i / columns;
    const double left = kGap + static_cast<double>(i % columns) * (kPanel + kGap);
    const double top = kTitle + static_cast<double>(row) * (kPanel + kTitle);
    const bool rolls = i < shown && film.pushes[i].kind == "roll";
    const Vec2 middle = rolls ? Vec2::Zero() : middles[i];
    const double half = rolls ? 3.0 * model.half_thickness : half_width;
    Panel panel(drawing, left, top, middle, half);
    drawing.raw(clip(i, left, top));
    if (i >= shown) {
      draw_still(panel, model, film);
    } else if (rolls) {
      draw_roll(panel, model, film.pushes[i], most_force_of(film.pushes[i], true));
    } else {
      draw_push(panel, model, film.pushes[i], most_force_of(film.pushes[i], false));
      draw_gravity(panel, model, film.pushes[i], middle + Vec2(0.86, 0.9) * half);
    }
    draw_bar(panel, middle, half);
    drawing.raw("</g>");
    drawing.rectangle(left, top, kPanel, kPanel, "none", {"#d9dcd6", 1.0, ""});
    if (i < shown) {
      drawing.text(left + 0.5 * kPanel, top - 8.0, title_of(model, film.pushes[i], i),
                   {.size = 13.0, .colour = kInk, .anchor = Drawing::Anchor::kMiddle});
    }
  }
  std::string caption =
      "dark: the pads, which stand still; red: the pusher, its force and friction cone; "
      "dashed: before";
  if (!film.region.empty()) {
    caption =
        "yellow: no push takes the pads' middle out of it; green: where the goal needs "
        "it";
  }
  if (shown < film.pushes.size()) {
    caption +=
        std::string("; ") + std::to_string(film.pushes.size() - shown) + " more pushes";
  }
  drawing.text(0.5 * width, height - 16.0, caption,
               {.size = columns == 1 ? 7.0 : 12.0,
                .colour = "#444444",
                .anchor = Drawing::Anchor::kMiddle});
  return std::string("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"") + px(width) +
         "\" height=\"" + px(height) + "\" viewBox=\"0 0 " + px(width) + ' ' +
         px(height) + "\" font-family=\"sans-serif\">\n<title>" +
         plot::escaped(model.scene.name) + "</title>\n" + drawing.str() + "</svg>\n";
}

}  // namespace prehensile::viewer
