/// Points of the rectangular pads of the random problem sets. Internal to them.
#pragma once

#include <array>
#include <cassert>

namespace prehensile {

/// Gauss-Legendre rule on [-1, 1], weights summing to 1.
struct GaussRule {
  int count;
  std::array<double, 8> node;
  std::array<double, 8> weight;
};

inline GaussRule gauss_rule(int count) {
  switch (count) {
    case 1:
      return {1, {0.0}, {1.0}};
    case 2:
      return {2, {-0.57735026918962576, 0.57735026918962576}, {0.5, 0.5}};
    case 4:
      return {4,
              {-0.86113631159405258, -0.33998104358485626, 0.33998104358485626,
               0.86113631159405258},
              {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
               0.17392742256872693}};
    default:
      assert(count == 8);
      return {8,
              {-0.96028985649753623, -0.79666647741362674, -0.52553240991632899,
               -0.18343464249564980, 0.18343464249564980, 0.52553240991632899,
               0.79666647741362674, 0.96028985649753623},
              {0.05061426814518813, 0.11119051722668724, 0.15685332293894364,
               0.18134189168918099, 0.18134189168918099, 0.15685332293894364,
               0.11119051722668724, 0.05061426814518813}};
  }
}

/// Splits the number of points into the sides of a product grid: 8 = 4 x 2.
inline std::array<GaussRule, 2> gauss_product(int points) {
  std::array<int, 2> sides = {1, 1};
  for (int side = 0; sides[0] * sides[1] < points; side = 1 - side) sides[side] *= 2;
  assert(sides[0] * sides[1] == points);
  return {gauss_rule(sides[0]), gauss_rule(sides[1])};
}

}  // namespace prehensile
