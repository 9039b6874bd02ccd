/// One picture of key frames: what is drawn in metres of the hand, y up, goes to its
/// place on the drawing. Internal to key_frames.cpp.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "plot/svg.h"
#include "scene/frames.h"

namespace prehensile::viewer {

inline constexpr double kPanel = 300.0;  ///< [px] width and height of a picture

class Panel {
 public:
  Panel(plot::Drawing& drawing, double left, double top, const Vec2& middle,
        double half_width)
      : drawing_(drawing),
        left_(left),
        top_(top),
        middle_(middle),
        scale_(0.5 * kPanel / half_width) {}

  Vec2 to_px(const Vec2& p) const {
    const Vec2 q = scale_ * (p - middle_);
    return {left_ + 0.5 * kPanel + q.x(), top_ + 0.5 * kPanel - q.y()};
  }
  double scale() const { return scale_; }

  void polygon(const std::vector<Vec2>& points, const std::string& fill, double opacity,
               const plot::Drawing::Stroke& stroke) {
    std::string data;
    for (const Vec2& p : points) {
      const Vec2 q = to_px(p);
      data += data.empty() ? 'M' : 'L';
      data += plot::px(q.x()) + ' ' + plot::px(q.y());
    }
    drawing_.path(data + 'Z', fill, opacity, stroke);
  }

  /// What is drawn until end_clip shows only within a polygon, once in a picture.
  void clip_to(const std::vector<Vec2>& points) {
    drawing_.raw("<clipPath id=\"within\">");
    polygon(points, "none", 1.0, {});
    drawing_.raw("</clipPath><g clip-path=\"url(#within)\">");
  }
  void end_clip() { drawing_.raw("</g>"); }

  void line(const Vec2& a, const Vec2& b, const plot::Drawing::Stroke& stroke) {
    const Vec2 p = to_px(a);
    const Vec2 q = to_px(b);
    drawing_.line(p.x(), p.y(), q.x(), q.y(), stroke);
  }

  /// From a, along a vector in pixels; y up.
  void arrow(const Vec2& a, const Vec2& along, const char* colour, double width) {
    const Vec2 p = to_px(a);
    const Vec2 v(along.x(), -along.y());
    const double length = v.norm();
    if (!(length > 1.0)) return;
    const Vec2 u = v / length;
    const double head = std::min(4.5 * width, 0.6 * length);
    const Vec2 neck = p + (length - head) * u;
    drawing_.line(p.x(), p.y(), neck.x(), neck.y(), {colour, width, ""});
    const Vec2 side = 0.42 * head * perp(u);
    const Vec2 tip = p + v;
    const std::string data =
        std::string("M") + plot::px(tip.x()) + ' ' + plot::px(tip.y()) + 'L' +
        plot::px((neck + side).x()) + ' ' + plot::px((neck + side).y()) + 'L' +
        plot::px((neck - side).x()) + ' ' + plot::px((neck - side).y()) + 'Z';
    drawing_.path(data, colour, 1.0, {});
  }

  void words(double x, double y, const std::string& text,
             const plot::Drawing::Font& font) {
    drawing_.text(left_ + x, top_ + y, text, font);
  }

 private:
  plot::Drawing& drawing_;
  double left_, top_;
  Vec2 middle_;
  double scale_;
};

}  // namespace prehensile::viewer
