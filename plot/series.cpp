/// How each kind of series looks, in the chart and in the legend.
#include <algorithm>
#include <array>
#include <cmath>

#include "plot/colours.h"
#include "plot/frame.h"

namespace prehensile::plot {
namespace {

constexpr double kLineWidth = 2.0;

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

std::string dashes(Dash dash) {
  switch (dash) {
    case Dash::kSolid:
      return "";
    case Dash::kDashed:
      return "7 4";
    case Dash::kDotted:
      return "1.5 3.5";
  }
  return "";
}

/// Filled marks, one for each round of colours.
Mark nth_mark(int round) {
  static constexpr std::array kOrder = {Mark::kCircle, Mark::kSquare, Mark::kDiamond,
                                        Mark::kTriangle};
  return kOrder[static_cast<std::size_t>(round) % kOrder.size()];
}

Mark mark_of(const Scatter& scatter, const Look& look) {
  return scatter.mark == Mark::kCircle ? nth_mark(look.round) : scatter.mark;
}

/// Series without marks differ by their dashes from those of the round before.
Dash nth_dash(Dash own, int round) {
  return static_cast<Dash>((static_cast<int>(own) + round) % 3);
}

Dash dash_of(const Line& line, const Look& look) {
  return line.marks ? line.dash : nth_dash(line.dash, look.round);
}

Dash dash_of(const Steps& steps, const Look& look) {
  return nth_dash(steps.dash, look.round);
}

std::string at(double x, double y) { return px(x) + ' ' + px(y); }

std::string at(const Frame& frame, const Point& point) {
  return at(frame.px_x(point.x), frame.px_y(point.y));
}

/// Points that cannot be drawn break the line.
std::string polyline(const Frame& frame, const std::vector<Point>& points) {
  std::string out;
  bool pen_down = false;
  for (const Point& point : points) {
    const bool shown = frame.drawable(point);
    if (shown) out += (pen_down ? " L" : " M") + at(frame, point);
    pen_down = shown;
  }
  return out;
}

std::string staircase(const Frame& frame, const std::vector<Point>& points) {
  std::string out;
  bool pen_down = false;
  for (const Point& point : points) {
    const bool shown = frame.drawable(point);
    if (shown && pen_down) {
      out += " H" + px(frame.px_x(point.x)) + " V" + px(frame.px_y(point.y));
    } else if (shown) {
      out += " M" + at(frame, point);
    }
    pen_down = shown;
  }
  return out;
}

/// Rows that cannot be drawn cut the band in two.
std::string band_outline(const Frame& frame, const std::vector<Band::Row>& rows) {
  std::string out, back;
  const auto close = [&] {
    if (!back.empty()) out += back + " Z";
    back.clear();
  };
  for (const Band::Row& row : rows) {
    if (!frame.drawable({row.x, row.low}) || !frame.drawable({row.x, row.high})) {
      close();
      continue;
    }
    out += (back.empty() ? " M" : " L") + at(frame, {row.x, row.high});
    back.insert(0, " L" + at(frame, {row.x, row.low}));
  }
  close();
  return out;
}

std::string mark_path(Mark mark, double x, double y, double r) {
  switch (mark) {
    case Mark::kCircle:
      return 'M' + at(x - r, y) + " a" + at(r, r) + " 0 1 0 " + at(2.0 * r, 0.0) + " a" +
             at(r, r) + " 0 1 0 " + at(-2.0 * r, 0.0) + " Z";
    case Mark::kSquare:
      return 'M' + at(x - r, y - r) + " h" + px(2.0 * r) + " v" + px(2.0 * r) + " h" +
             px(-2.0 * r) + " Z";
    case Mark::kDiamond:
      return 'M' + at(x - r, y) + " L" + at(x, y - r) + " L" + at(x + r, y) + " L" +
             at(x, y + r) + " Z";
    case Mark::kTriangle:
      return 'M' + at(x - r, y + r) + " L" + at(x, y - r) + " L" + at(x + r, y + r) +
             " Z";
    case Mark::kCross:
      return 'M' + at(x - r, y - r) + " L" + at(x + r, y + r) + " M" + at(x - r, y + r) +
             " L" + at(x + r, y - r);
  }
  return "";
}

double size_of(double size) {
  return std::clamp(std::isfinite(size) ? size : 3.0, 0.5, 20.0);
}

void draw_marks(Drawing& drawing, Mark mark, const std::string& data,
                const std::string& colour) {
  if (data.empty()) return;
  const bool open = mark == Mark::kCross;
  drawing.path(data, open ? "none" : colour, 0.75,
               {.colour = open ? colour : "none", .width = 1.5});
}

void draw_mark(Drawing& drawing, Mark mark, double x, double y, double size,
               const std::string& colour) {
  draw_marks(drawing, mark, mark_path(mark, x, y, size_of(size)), colour);
}

void draw_path(Drawing& drawing, const std::string& data, const std::string& colour,
               Dash dash) {
  if (data.empty()) return;
  drawing.path(data, "none", 1.0,
               {.colour = colour, .width = kLineWidth, .dashes = dashes(dash)});
}

void draw_arrow(Drawing& drawing, double x1, double y1, double x2, double y2,
                const std::string& colour) {
  const double length = std::hypot(x2 - x1, y2 - y1);
  if (!(length > 0.0) || !std::isfinite(length)) return;
  const double ux = (x2 - x1) / length;
  const double uy = (y2 - y1) / length;
  const double head = std::min(9.0, length);
  drawing.line(x1, y1, x2 - 0.8 * head * ux, y2 - 0.8 * head * uy,
               {.colour = colour, .width = kLineWidth});
  const std::string corners =
      'M' + at(x2, y2) + " L" +
      at(x2 - head * ux - 0.4 * head * uy, y2 - head * uy + 0.4 * head * ux) + " L" +
      at(x2 - head * ux + 0.4 * head * uy, y2 - head * uy - 0.4 * head * ux) + " Z";
  drawing.path(corners, colour, 1.0, {});
}

}  // namespace

const std::string& label_of(const Series& series) {
  static const std::string kNone;
  return std::visit(
      Overloaded{[](const Note&) -> const std::string& { return kNone; },
                 [](const auto& s) -> const std::string& { return s.label; }},
      series);
}

Look look_of(const Series& series, int& used) {
  const Colour own = std::visit(Overloaded{[](const Note&) { return Colour::kBlack; },
                                           [](const auto& s) { return s.colour; }},
                                series);
  if (own != Colour::kNext && own != Colour::kSame) return {own};
  if (own == Colour::kNext) ++used;
  const int n = std::max(0, used - 1);
  return {nth_colour(n), n / kColourCount};
}

void add_extent(const Series& series, RangeBuilder& x, RangeBuilder& y) {
  const auto add = [&](const Point& point) {
    x.add(point.x);
    y.add(point.y);
  };
  std::visit(Overloaded{[&](const Band& s) {
                          for (const Band::Row& row : s.rows) {
                            add({row.x, row.low});
                            add({row.x, row.high});
                          }
                        },
                        [&](const Rule& s) { (s.vertical ? x : y).add(s.value); },
                        [&](const Arrow& s) {
                          add(s.tail);
                          add(s.head);
                        },
                        [&](const Note& s) { add(s.at); },
                        [&](const auto& s) {
                          for (const Point& point : s.points) add(point);
                        }},
             series);
}

void draw(Drawing& drawing, const Frame& frame, const Series& series, const Look& look) {
  const std::string paint = hex(look.colour);
  std::visit(
      Overloaded{
          [&](const Line& s) {
            draw_path(drawing, polyline(frame, s.points), paint, dash_of(s, look));
            if (!s.marks) return;
            for (const Point& p : s.points) {
              if (!frame.drawable(p)) continue;
              draw_mark(drawing, nth_mark(look.round), frame.px_x(p.x), frame.px_y(p.y),
                        3.0, paint);
            }
          },
          [&](const Steps& s) {
            draw_path(drawing, staircase(frame, s.points), paint, dash_of(s, look));
          },
          [&](const Scatter& s) {
            // One path for all marks: a large cloud stays a small file.
            std::string marks;
            for (const Point& p : s.points) {
              if (!frame.drawable(p)) continue;
              marks += mark_path(mark_of(s, look), frame.px_x(p.x), frame.px_y(p.y),
                                 size_of(s.size));
            }
            draw_marks(drawing, mark_of(s, look), marks, paint);
          },
          [&](const Band& s) {
            const std::string outline = band_outline(frame, s.rows);
            if (!outline.empty()) drawing.path(outline, paint, 0.22, {});
          },
          [&](const Region& s) {
            const std::string outline = polyline(frame, s.points);
            if (outline.empty()) return;
            drawing.path(outline + " Z", s.filled ? paint : "none", 0.22,
                         {.colour = paint, .width = 1.2});
          },
          [&](const Rule& s) {
            const Drawing::Stroke stroke{
                .colour = paint, .width = 1.3, .dashes = dashes(s.dash)};
            if (!drawable(s.value, s.vertical ? frame.x.scale : frame.y.scale)) return;
            const double x = frame.px_x(s.value);
            const double y = frame.px_y(s.value);
            if (s.vertical) {
              drawing.line(x, frame.top, x, frame.top + frame.height, stroke);
            } else {
              drawing.line(frame.left, y, frame.left + frame.width, y, stroke);
            }
          },
          [&](const Arrow& s) {
            if (!frame.drawable(s.tail) || !frame.drawable(s.head)) return;
            draw_arrow(drawing, frame.px_x(s.tail.x), frame.px_y(s.tail.y),
                       frame.px_x(s.head.x), frame.px_y(s.head.y), paint);
          },
          [&](const Note& s) {
            if (!frame.drawable(s.at)) return;
            const double x = frame.px_x(s.at.x);
            const bool right = x > frame.left + 0.7 * frame.width;
            drawing.text(
                x + (right ? -6.0 : 6.0), frame.px_y(s.at.y) - 6.0, s.text,
                {.size = 11.0,
                 .anchor = right ? Drawing::Anchor::kEnd : Drawing::Anchor::kStart});
          }},
      series);
}

void draw_key(Drawing& drawing, double x, double y, double width, double height,
              const Series& series, const Look& look) {
  const std::string paint = hex(look.colour);
  const double middle = x + 0.5 * width;
  const auto stroke = [&](Dash dash) {
    return Drawing::Stroke{.colour = paint, .width = kLineWidth, .dashes = dashes(dash)};
  };
  std::visit(
      Overloaded{
          [&](const Line& s) {
            drawing.line(x, y, x + width, y, stroke(dash_of(s, look)));
            if (s.marks) draw_mark(drawing, nth_mark(look.round), middle, y, 3.0, paint);
          },
          [&](const Steps& s) {
            drawing.line(x, y, x + width, y, stroke(dash_of(s, look)));
          },
          [&](const Scatter& s) {
            draw_mark(drawing, mark_of(s, look), middle, y, 3.5, paint);
          },
          [&](const Band&) {
            drawing.path('M' + at(x, y - 0.5 * height) + " h" + px(width) + " v" +
                             px(height) + " h" + px(-width) + " Z",
                         paint, 0.22, {});
          },
          [&](const Region& s) {
            drawing.path('M' + at(x, y - 0.5 * height) + " h" + px(width) + " v" +
                             px(height) + " h" + px(-width) + " Z",
                         s.filled ? paint : "none", 0.22,
                         {.colour = paint, .width = 1.2});
          },
          [&](const Arrow&) { draw_arrow(drawing, x, y, x + width, y, paint); },
          [](const Note&) {},
          [&](const Rule& s) { drawing.line(x, y, x + width, y, stroke(s.dash)); }},
      series);
}

}  // namespace prehensile::plot
