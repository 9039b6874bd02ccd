/// What is shown is what happens: geometry, forces and time of films.
#include "viewer/film.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "tests/viewer/film_cases.h"
#include "viewer/bodies.h"

namespace prehensile::viewer {
namespace {

using testing::film_cases;
using testing::FilmCase;

constexpr double kTouch = 2e-6;  // [m] by which bodies may overlap or stand apart

// [m] by which a point of a clipped pad, the middle of what is left of a cell, may be off
// a face with a notch.
constexpr double kClip = 1e-4;

using Look = std::function<void(const FilmCase&, const FilmPush&, const FilmFrame&)>;

/// Calls `look` with every frame of every case; says how many there were.
int for_each_frame(const Look& look) {
  int frames = 0;
  for (const FilmCase& one : film_cases()) {
    for (const FilmPush& push : one.film.pushes) {
      SCOPED_TRACE(one.what + ", " + push.kind);
      for (const FilmFrame& frame : push.frames) {
        look(one, push, frame);
        ++frames;
      }
    }
  }
  return frames;
}

const PushContact& contact_of_push(const FilmCase& one, const FilmPush& push) {
  return one.model.contacts[static_cast<std::size_t>(push.contact)];
}

/// The vertices of the object in H at a frame, with its roll.
std::vector<Vec3> vertices_of(const Model& model, const FilmFrame& frame) {
  std::vector<Vec3> vertices;
  const auto add = [&](const Vec2& in_plane, double z) {
    const Vec2 p = transform(frame.grasp.X_HO, in_plane);
    vertices.emplace_back(p.x(), p.y(), z + frame.z_HO);
  };
  if (model.prism) {
    const LyingPrism& prism = *model.prism;
    // By the right hand about the axis: the section turns the other way where the axis is
    // y.
    const bool is_x = prism.axis.x() > 0.5;
    const double turn = is_x ? frame.grasp.psi : -frame.grasp.psi;
    for (const Vec2& corner : prism.section) {
      const Vec2 p = rotated(turn, corner);
      for (const double end : {-0.5, 0.5}) {
        add(p.x() * prism.lateral + end * prism.length * prism.axis, p.y());
      }
    }
    return vertices;
  }
  for (const Vec2& p : model.outline) {
    for (const double side : {-1.0, 1.0}) add(p, side * model.half_thickness);
  }
  return vertices;
}

TEST(Film, EveryCaseHasFrames) {
  for (const FilmCase& one : film_cases()) {
    EXPECT_FALSE(one.film.pushes.empty()) << one.what;
    EXPECT_TRUE(one.film.agrees) << one.what << ": " << one.film.why;
    for (const FilmPush& push : one.film.pushes) {
      EXPECT_GE(push.frames.size(), 2U) << one.what << ' ' << push.transition.reason;
    }
  }
}

TEST(Film, PadsPressOnTheObject) {
  int points = 0;
  for_each_frame([&](const FilmCase& one, const FilmPush&, const FilmFrame& frame) {
    for (std::size_t jaw = 0; jaw < 2; ++jaw) {
      for (const PointLoad& load : frame.loads.pad[jaw]) {
        EXPECT_NEAR(load.p.z(), frame.jaw_z[jaw], kTouch);
        EXPECT_GT(load.n.z() * (jaw == 0 ? 1.0 : -1.0), 0.0);
        ++points;
        if (one.model.scene.overhang == Overhang::kIgnore || one.model.prism) continue;
        const Vec2 p_O = transform(inverse(frame.grasp.X_HO), Vec2(load.p.head<2>()));
        EXPECT_GT(depth_inside(one.model.pad_face, p_O), -kClip);
      }
    }
  });
  EXPECT_GT(points, 1000);
}

TEST(Film, JawsTouchAndDoNotCutTheObject) {
  for_each_frame([](const FilmCase& one, const FilmPush&, const FilmFrame& frame) {
    EXPECT_LT(frame.jaw_z[0], frame.jaw_z[1]);
    if (!one.model.prism) return;
    // Corners outside the pads may stand out beyond them.
    const PadBody pad = pad_body(one.model);
    double least = 1.0, most = -1.0;
    for (const Vec3& p : vertices_of(one.model, frame)) {
      const Vec2 low = pad.outline[0], high = pad.outline[2];
      if (p.y() < low.y() || p.y() > high.y()) continue;
      least = std::min(least, p.z());
      most = std::max(most, p.z());
    }
    EXPECT_GT(least, frame.jaw_z[0] - kTouch);
    EXPECT_LT(most, frame.jaw_z[1] + kTouch);
  });
}

TEST(Film, ThePusherTouchesAndDoesNotCutTheObject) {
  const int frames = for_each_frame(
      [](const FilmCase& one, const FilmPush& push, const FilmFrame& frame) {
        const PushContact& contact = contact_of_push(one, push);
        const Vec2 n = rotated(frame.X_HP.theta, contact.n);
        const Vec2 centre = transform(frame.X_HP, push.p_PC);
        if (contact.is_point) {
          const Vec2 p_O = transform(inverse(frame.grasp.X_HO), centre);
          EXPECT_NEAR(depth_inside(one.model.outline, p_O), 0.0, kTouch);
          return;
        }
        double gap = 1.0;
        for (const Vec3& p : vertices_of(one.model, frame)) {
          const Vec2 from = p.head<2>() - centre;
          const bool faces = std::abs(perp(n).dot(from)) <= contact.half_length;
          if (faces) gap = std::min(gap, n.dot(from));
        }
        // A short pusher may touch between the corners: then it is inside the face.
        if (std::isinf(contact.half_length)) {
          EXPECT_NEAR(gap, 0.0, kTouch);
        }
        EXPECT_GT(gap, -kTouch);
        const PlanarPose X_PO = compose(inverse(frame.X_HP), frame.grasp.X_HO);
        if (push.kind == "roll") return;
        const Touch touch = touch_of(contact, as_linear(push.push).place, X_PO);
        EXPECT_GE(touch.count, 1);
        EXPECT_LT(std::abs(touch.gap), kTouch);
      });
  EXPECT_GT(frames, 200);
}

/// The pusher moves along z while an object rolls: its force must not leave it behind.
TEST(Film, RollsStayOnTheSheet) {
  int points = 0;
  for_each_frame([&](const FilmCase& one, const FilmPush& push, const FilmFrame& frame) {
    if (push.kind != "roll") return;
    const int pusher = contact_of_push(one, push).pusher;
    const double half = 0.5 * pusher_in(one.film, one.model, pusher).width;
    for (const PointLoad& load : frame.loads.pusher) {
      EXPECT_LT(std::abs(load.p.z() - frame.z_HP), half);
      ++points;
    }
  });
  EXPECT_GT(points, 50);
}

TEST(Film, ForcesStandAtContactsAndLieInTheirCones) {
  for_each_frame([](const FilmCase& one, const FilmPush& push, const FilmFrame& frame) {
    const PushContact& contact = contact_of_push(one, push);
    const Vec2 n = rotated(frame.X_HP.theta, contact.n);
    const Vec2 centre = transform(frame.X_HP, push.p_PC);
    const auto check = [](const PointLoad& load) {
      EXPECT_NEAR(load.n.norm(), 1.0, 1e-12);
      const double normal = load.normal();
      const double tangential = (load.force - normal * load.n).norm();
      EXPECT_GE(normal, -1e-6);
      EXPECT_LE(tangential, load.mu * normal + 1e-5);
      // Friction opposes slip.
      if (load.mode != ContactMode::kStick && load.mode != ContactMode::kOpen) {
        EXPECT_LE(load.force.dot(load.slip), 1e-9);
      }
    };
    for (const PointLoad& load : frame.loads.pusher) {
      check(load);
      EXPECT_NEAR(n.dot(load.p.head<2>() - centre), 0.0, kTouch);
      EXPECT_LE(std::abs(perp(n).dot(load.p.head<2>() - centre)),
                contact.half_length + kTouch);
    }
    for (const auto& pad : frame.loads.pad) std::for_each(pad.begin(), pad.end(), check);
  });
}

/// Newton's law of what is drawn: all forces and their moments, and the weight.
TEST(Film, WhatIsDrawnIsInBalance) {
  int balanced = 0;
  for_each_frame([&](const FilmCase& one, const FilmPush& push, const FilmFrame& frame) {
    if (frame.loads.pusher.empty()) return;
    const PushContact& contact = contact_of_push(one, push);
    const Vec2 g = rotated(frame.X_HP.theta, contact.g_O);
    Vec3 force(one.model.mass * g.x(), one.model.mass * g.y(),
               one.model.mass * one.model.scene.g_Wz);
    const Vec2 com = transform(frame.grasp.X_HO, one.model.p_OCom);
    Vec3 moment = Vec3(com.x(), com.y(), frame.z_HO + one.model.z_OCom).cross(force);
    double most = 0.0;
    const auto add = [&](const PointLoad& load) {
      force += load.force;
      moment += load.p.cross(load.force) + load.spin * load.n;
      most = std::max(most, load.force.norm());
    };
    std::for_each(frame.loads.pusher.begin(), frame.loads.pusher.end(), add);
    for (const auto& pad : frame.loads.pad) std::for_each(pad.begin(), pad.end(), add);
    EXPECT_LT(force.norm(), 1e-6 * most) << force.transpose();
    // A line is drawn by one arrow: moments along it are beyond what a roll shows.
    const double length = one.model.L;
    if (push.kind == "roll") {
      const Vec2 axis = rotated(frame.grasp.X_HO.theta, contact.t);
      EXPECT_LT(std::abs(axis.dot(moment.head<2>())), 1e-6 * most * length);
    } else if (push.transition.in_space) {
      EXPECT_LT(moment.norm(), 1e-6 * most * length) << moment.transpose();
    } else {
      EXPECT_LT(std::abs(moment.z()), 1e-6 * most * length);
    }
    ++balanced;
  });
  EXPECT_GT(balanced, 200);
}

/// The instants of the film are solved anew; the transition's own forces are others'
/// work.
TEST(Film, ForcesAreThoseOfTheTransition) {
  int compared = 0;
  for_each_frame([&](const FilmCase&, const FilmPush&, const FilmFrame& frame) {
    if (!std::isfinite(frame.sample.push_force) || frame.loads.pusher.empty()) return;
    EXPECT_NEAR(frame.loads.push_force, frame.sample.push_force,
                1e-5 * std::max(1.0, frame.sample.push_force));
    EXPECT_LE(frame.loads.certificate, 1e-6);
    ++compared;
  });
  EXPECT_GT(compared, 200);
}

/// Between frames the page goes straight: nowhere far from where the object is.
TEST(Film, StraightLinesBetweenFramesAreCloseToThePath) {
  for (const FilmCase& one : film_cases()) {
    for (const FilmPush& push : one.film.pushes) {
      if (push.kind == "roll") continue;
      std::vector<Sample> fine;
      apply(one.model, push.start, push.push, {.max_step = 0.005}, &fine);
      for (const Sample& sample : fine) {
        const auto next =
            std::find_if(push.frames.begin(), push.frames.end(),
                         [&](const FilmFrame& frame) { return frame.s >= sample.s; });
        if (next == push.frames.begin() || next == push.frames.end()) continue;
        const FilmFrame& a = *(next - 1);
        const double share = (sample.s - a.s) / (next->s - a.s);
        const auto between = [&](double PlanarPose::*part) {
          return std::lerp(a.grasp.X_HO.*part, next->grasp.X_HO.*part, share);
        };
        const PlanarPose& X_HO = sample.grasp.X_HO;
        EXPECT_LT(std::hypot(between(&PlanarPose::x) - X_HO.x,
                             between(&PlanarPose::y) - X_HO.y),
                  1e-4)
            << one.what << " at " << sample.s;
        EXPECT_NEAR(between(&PlanarPose::theta), X_HO.theta, 2e-3) << one.what;
      }
    }
  }
}

TEST(Film, ThePusherStandsStillInTheWorld) {
  for (const FilmCase& one : film_cases()) {
    for (const FilmPhase& phase : one.film.phases) {
      if (phase.kind != ArmPhase::kPush) continue;
      const FilmPush& push = one.film.pushes[static_cast<std::size_t>(phase.push)];
      const PushContact& contact = contact_of_push(one, push);
      const Pusher& pusher =
          one.model.scene.pushers[static_cast<std::size_t>(contact.pusher)];
      const PlanarPose X_WP = compose(phase.X_WH_from, push.frames.front().X_HP);
      EXPECT_LT((transform(X_WP, push.p_PC) - pusher.p_WP).norm(), 1e-9) << one.what;
      const double normal = X_WP.theta + std::atan2(contact.n.y(), contact.n.x());
      EXPECT_NEAR(wrapped(normal - pusher.normal_angle), 0.0, 1e-9) << one.what;
      // The hand arrives where the last frame says.
      const PlanarPose X_WH = compose(X_WP, inverse(push.frames.back().X_HP));
      EXPECT_LT((translation(X_WH) - translation(phase.X_WH_to)).norm(), 1e-9);
      EXPECT_NEAR(wrapped(X_WH.theta - phase.X_WH_to.theta), 0.0, 1e-9);
    }
  }
}

TEST(Film, TimeAndTheHandGoOnWithoutJumps) {
  for (const FilmCase& one : film_cases()) {
    const std::vector<FilmPhase>& phases = one.film.phases;
    ASSERT_FALSE(phases.empty());
    EXPECT_EQ(phases.front().begin, 0.0);
    for (std::size_t i = 1; i < phases.size(); ++i) {
      EXPECT_EQ(phases[i].begin, phases[i - 1].end) << one.what;
      EXPECT_GE(phases[i].end, phases[i].begin);
      const PlanarPose& a = phases[i - 1].X_WH_to;
      const PlanarPose& b = phases[i].X_WH_from;
      EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y), 1e-9) << one.what;
      EXPECT_NEAR(a.theta, b.theta, 1e-9) << one.what;
    }
  }
}

TEST(Film, TheMotionOfARideLiesInItsCone) {
  int inside = 0;
  for_each_frame([&](const FilmCase& one, const FilmPush& push, const FilmFrame& frame) {
    if (!std::isfinite(frame.direction) || push.transition.in_space) return;
    if (!one.model.region.is_isotropic()) return;  // the cone is the ellipsoid's
    EXPECT_GE(frame.slack, -1e-6);
    if (frame.slack < 1e-3) return;  // at the border of the cone
    const bool in_cone = std::any_of(
        frame.cone.begin(), frame.cone.end(), [&](const DirectionRange& range) {
          const double off = wrapped(frame.direction - 0.5 * (range.lo + range.hi));
          return std::abs(off) <= 0.5 * (range.hi - range.lo) + 1e-6;
        });
    EXPECT_TRUE(in_cone) << one.what << " at " << frame.s;
    ++inside;
  });
  EXPECT_GT(inside, 50);
}

TEST(Film, EndsWhereThePlanEnds) {
  for (const FilmCase& one : film_cases()) {
    if (!one.plan.usable()) continue;
    ASSERT_EQ(one.film.pushes.size(), one.plan.pushes.size());
    const PlanarPose& shown = one.film.pushes.back().frames.back().grasp.X_HO;
    const PlanarPose& stated = one.plan.pushes.back().end.X_HO;
    EXPECT_NEAR(shown.x, stated.x, 1e-6) << one.what;
    EXPECT_NEAR(shown.theta, stated.theta, 1e-6) << one.what;
  }
}

TEST(Film, ATamperedPlanIsShownAsOne) {
  FilmCase one = film_cases()[7];
  ASSERT_TRUE(one.plan.usable());
  one.plan.pushes[0].end.X_HO.x += 1e-3;
  const Film tampered = film(one.model, one.plan);
  EXPECT_FALSE(tampered.agrees);
  EXPECT_FALSE(tampered.why.empty());
}

}  // namespace
}  // namespace prehensile::viewer
