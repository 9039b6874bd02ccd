#include <gtest/gtest.h>

#include "scene/pad_quadrature.h"
#include "scene/polygon_pieces.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// A face that one edge bounds from the right, as far as pads reach.
std::vector<Vec2> left_of(const Vec2& a, const Vec2& b) {
  const Vec2 far = 10.0 * (b - a).normalized();
  return {a - far, b + far, b + far + perp(far), a - far + perp(far)};
}

/// Cut by the edge alone a cell is what it is when cut by all of the face.
TEST(PadCells, AtAnEdgeAreThoseOnTheFace) {
  Random random(1);
  int cut = 0;
  for (const Pad& pad :
       {Pad(DiscPad{0.009}), Pad(RectanglePad{{0.02, 0.01}}), Pad(LinePad{0.02, 0.3})}) {
    const std::vector<PadCell> cells = pad_cells(pad, {}, 6);
    for (int i = 0; i < 200; ++i) {
      const Vec2 a = random.in_box(0.01, 0.01);
      const Vec2 b = a + 0.05 * random.direction();
      const std::vector<Triangle> face = triangulate(left_of(a, b));
      const CellFrame frame(
          {random.in(-0.01, 0.01), random.in(-0.01, 0.01), random.in(-3.0, 3.0)});
      for (const PadCell& cell : cells) {
        const PressedCell all = press(cell, face, frame);
        const PressedCell one = press_at_edge(cell, {a, b}, frame);
        cut += one.measure > 0.0 && one.measure < 0.999 * cell.measure;
        EXPECT_NEAR(one.measure, all.measure, 1e-9 * cell.measure);
        if (one.measure < 1e-3 * cell.measure) continue;
        EXPECT_LT((one.centroid - all.centroid).norm(), 1e-9);
      }
    }
  }
  EXPECT_GT(cut, 500);
}

/// Of a corner that turns left, both edges.
TEST(PadCells, AtACornerAreThoseOnTheFace) {
  Random random(2);
  int cut = 0;
  for (const Pad& pad :
       {Pad(DiscPad{0.009}), Pad(RectanglePad{{0.02, 0.01}}), Pad(LinePad{0.02, 0.3})}) {
    const std::vector<PadCell> cells = pad_cells(pad, {}, 6);
    for (int i = 0; i < 300; ++i) {
      const Vec2 corner = random.in_box(0.01, 0.01);
      const Vec2 in = random.direction();
      const Vec2 out = rotated(random.in(0.1, 3.0), in);
      const std::vector<Triangle> face = {{{corner - in, corner, corner + out}}};
      const CellFrame frame(
          {random.in(-0.01, 0.01), random.in(-0.01, 0.01), random.in(-3.0, 3.0)});
      for (const PadCell& cell : cells) {
        const PressedCell all = press(cell, face, frame);
        const PressedCell one =
            press_at_corner(cell, {corner - in, corner}, {corner, corner + out}, frame);
        cut += one.measure > 0.0 && one.measure < 0.999 * cell.measure;
        EXPECT_NEAR(one.measure, all.measure, 1e-9 * cell.measure);
        if (one.measure < 1e-3 * cell.measure) continue;
        EXPECT_LT((one.centroid - all.centroid).norm(), 1e-9);
      }
    }
  }
  EXPECT_GT(cut, 500);
}

}  // namespace
}  // namespace prehensile
