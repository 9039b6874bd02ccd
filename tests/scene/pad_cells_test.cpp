#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "scene/pad_quadrature.h"
#include "scene/polygon_pieces.h"
#include "tests/support/random.h"

namespace prehensile {
namespace {

using testing::Random;

/// A face that one edge bounds from the right, as far as pads reach.
std::vector<Vec2> left_of(const FaceEdge& edge) {
  const Vec2 far = 10.0 * (edge.b - edge.a).normalized();
  const Vec2 a = edge.a - far;
  const Vec2 b = edge.b + far;
  return {a, b, b + perp(far), a + perp(far)};
}

/// Compares cells of many pads, cut by what of a face is near alone, with those cut by
/// all of the face. `draw` gives the face and the shorter way for a cell in some frame.
/// Returns how many are cut.
template <class Draw>
int compare_cells(Random& random, Draw draw) {
  int cut = 0;
  for (const Pad& pad :
       {Pad(DiscPad{0.009}), Pad(RectanglePad{{0.02, 0.01}}), Pad(LinePad{0.02, 0.3})}) {
    const std::vector<PadCell> cells = pad_cells(pad, {}, 6);
    for (int i = 0; i < 300; ++i) {
      const auto [face, press_near] = draw();
      const CellFrame frame(
          {random.in(-0.01, 0.01), random.in(-0.01, 0.01), random.in(-3.0, 3.0)});
      for (const PadCell& cell : cells) {
        const PressedCell all = press(cell, face, frame);
        const PressedCell near = press_near(cell, frame);
        cut += near.measure > 0.0 && near.measure < 0.999 * cell.measure;
        EXPECT_NEAR(near.measure, all.measure, 1e-9 * cell.measure);
        if (near.measure < 1e-3 * cell.measure) continue;
        EXPECT_LT((near.centroid - all.centroid).norm(), 1e-9);
      }
    }
  }
  return cut;
}

TEST(PadCells, AtAnEdgeAreThoseOnTheFace) {
  Random random(1);
  const int cut = compare_cells(random, [&] {
    const Vec2 a = random.in_box(0.01, 0.01);
    const FaceEdge edge{a, a + 0.05 * random.direction()};
    return std::pair(triangulate(left_of(edge)),
                     [edge](const PadCell& cell, const CellFrame& frame) {
                       return press_at_edge(cell, edge, frame);
                     });
  });
  EXPECT_GT(cut, 500);
}

TEST(PadCells, AtACornerAreThoseOnTheFace) {
  Random random(2);
  const int cut = compare_cells(random, [&] {
    const Vec2 corner = random.in_box(0.01, 0.01);
    const Vec2 along = random.direction();
    const FaceEdge in{corner - along, corner};
    const FaceEdge out{corner, corner + rotated(random.in(0.1, 3.0), along)};
    return std::pair(std::vector<Triangle>{{{in.a, corner, out.b}}},
                     [in, out](const PadCell& cell, const CellFrame& frame) {
                       return press_at_corner(cell, in, out, frame);
                     });
  });
  EXPECT_GT(cut, 500);
}

}  // namespace
}  // namespace prehensile
