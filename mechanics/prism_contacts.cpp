#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/prism_section.h"

namespace prehensile {
namespace {

constexpr double kSame = 1e-9;  // of the size: how flat is flat

struct Candidate {
  Vec2 point;
  int vertex;
  Vec2 normal;
};

// A jaw against the rolled section. `side` +1: jaw 1, which comes from -z.
class JawTouch {
 public:
  JawTouch(const SectionPolygon& polygon, double roll, double side, const PadReach& pads)
      : tolerance_(kSame * polygon.size), side_(side) {
    Vec2 a = rotated(roll, polygon.vertex[polygon.count - 1]);
    int index = polygon.count - 1;
    for (int i = 0; i < polygon.count; ++i) {
      const Vec2 b = rotated(roll, polygon.vertex[i]);
      if (a.y() >= pads.low - tolerance_ && a.y() <= pads.high + tolerance_)
        consider({a, index, Vec2(side_, 0.0)});
      const Vec2 normal = perp((b - a).normalized());
      if (side_ * normal.x() > 0.0) {  // the side of the section looks at this jaw
        for (const double u : {pads.low, pads.high}) {
          const double share = (u - a.y()) / (b.y() - a.y());
          if (share > 0.0 && share < 1.0) consider({a + share * (b - a), -1, normal});
        }
      }
      a = b;
      index = i;
    }
  }

  SectionTouch touch() const {
    SectionTouch touch;
    if (!any_) return touch;
    touch.count = highest_.point.y() - lowest_.point.y() > tolerance_ ? 2 : 1;
    // A corner of the section beats the end of the pad that meets it.
    const Candidate& first =
        touch.count == 1 && highest_.vertex >= 0 ? highest_ : lowest_;
    touch.point = {first.point, highest_.point};
    touch.vertex = {first.vertex, highest_.vertex};
    touch.normal = touch.count == 2 ? Vec2(side_, 0.0) : first.normal;
    return touch;
  }

 private:
  // Ahead: nearer to the jaw than what was found.
  void consider(const Candidate& candidate) {
    const double ahead =
        any_ ? side_ * (lowest_.point.x() - candidate.point.x()) : 2.0 * tolerance_;
    if (ahead < -tolerance_) return;
    if (ahead > tolerance_) {
      lowest_ = highest_ = candidate;
      any_ = true;
      return;
    }
    if (candidate.point.y() < lowest_.point.y()) lowest_ = candidate;
    if (candidate.point.y() > highest_.point.y()) highest_ = candidate;
  }

  double tolerance_;
  double side_;
  bool any_ = false;
  Candidate lowest_{}, highest_{};
};

}  // namespace

SectionPolygon section_polygon(const std::vector<Vec2>& section, int side,
                               const Vec2& com) noexcept {
  SectionPolygon polygon;
  polygon.count = static_cast<int>(std::min<std::size_t>(
      section.size(), static_cast<std::size_t>(SectionPolygon::kCapacity)));
  for (int i = 0; i < polygon.count; ++i) {
    // Exchanging the two axes mirrors the drawing, so the order turns round as well.
    const Vec2& v = section[side > 0 ? polygon.count - 1 - i : i];
    polygon.vertex[i] = {v.y(), side * v.x()};
    polygon.size = std::max(polygon.size, v.norm());
  }
  polygon.com = {com.y(), side * com.x()};
  return polygon;
}

double support_height(const SectionPolygon& polygon, double roll) noexcept {
  const double c = std::cos(roll);
  const double s = std::sin(roll);
  double lowest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < polygon.count; ++i)
    lowest = std::min(lowest, s * polygon.vertex[i].x() + c * polygon.vertex[i].y());
  return lowest;
}

PrismContacts prism_contacts(const SectionPolygon& polygon, double roll,
                             const PadReach& pads) noexcept {
  PrismContacts contacts;
  contacts.touch[kJaw1] = JawTouch(polygon, roll, 1.0, pads).touch();
  contacts.touch[kJaw2] = JawTouch(polygon, roll, -1.0, pads).touch();
  for (const int jaw : {kJaw1, kJaw2})
    if (contacts.touch[jaw].count > 0)
      contacts.jaw_z[jaw] = contacts.touch[jaw].point[0].x();

  contacts.sheet_u = support_height(polygon, roll);
  SectionTouch& sheet = contacts.touch[kSheet];
  sheet.normal = {0.0, 1.0};
  for (int i = 0; i < polygon.count; ++i) {
    const Vec2 p = rotated(roll, polygon.vertex[i]);
    if (p.y() > contacts.sheet_u + kSame * polygon.size) continue;
    const bool is_first = sheet.count == 0 || p.x() < sheet.point[0].x();
    const bool is_last = sheet.count == 0 || p.x() > sheet.point[1].x();
    if (is_first) sheet.point[0] = p, sheet.vertex[0] = i;
    if (is_last) sheet.point[1] = p, sheet.vertex[1] = i;
    sheet.count = sheet.vertex[0] == sheet.vertex[1] ? 1 : 2;
  }
  return contacts;
}

int staying_point(const SectionTouch& touch, int turn) noexcept {
  if (touch.count < 2) return 0;
  // Turning moves a point by turn x perp(point); the one that gains least distance stays.
  const double gain0 = touch.normal.dot(perp(touch.point[0]));
  const double gain1 = touch.normal.dot(perp(touch.point[1]));
  return turn * (gain1 - gain0) < 0.0 ? 1 : 0;
}

}  // namespace prehensile
