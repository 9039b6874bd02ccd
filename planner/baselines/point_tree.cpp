#include "planner/baselines/point_tree.h"

#include <algorithm>

namespace prehensile {
namespace {

/// Of the points below a node, on one side: at more than this share it is built anew.
constexpr double kMostOnOneSide = 0.7;

constexpr int kFew = 8;  // points that may lie in a row

constexpr std::int64_t kLooksPerTest = 20;  // points looked at in the time of one

}  // namespace

void PointTree::add(const Vec3& point) {
  const int index = size();
  nodes_.push_back({.point = point, .low = point, .high = point});
  if (index == 0) return;
  int* lopsided = nullptr;  // link to the highest such node
  for (int* link = &root_;;) {
    Node& node = nodes_[*link];
    ++node.count;
    node.low = node.low.cwiseMin(point);
    node.high = node.high.cwiseMax(point);
    int& child = node.child[point[node.axis] < node.point[node.axis] ? 0 : 1];
    if (child < 0) {
      nodes_[index].axis = (node.axis + 1) % 3;
      child = index;
      break;
    }
    // The point goes to that side, whose count does not know it yet.
    if (!lopsided && node.count > kFew &&
        count_of(child) + 1 > kMostOnOneSide * node.count) {
      lopsided = link;
    }
    link = &child;
  }
  if (!lopsided) return;
  std::vector<int> indices;
  collect(*lopsided, indices);
  *lopsided = build(indices.data(), indices.data() + indices.size());
}

void PointTree::collect(int node, std::vector<int>& indices) const {
  if (node < 0) return;
  indices.push_back(node);
  for (const int child : nodes_[node].child) collect(child, indices);
}

/// The middle one along the longest side of their box, with the rest on both sides.
int PointTree::build(int* begin, int* end) {
  if (begin == end) return -1;
  Vec3 low = nodes_[*begin].point, high = low;
  for (const int* i = begin; i != end; ++i) {
    low = low.cwiseMin(nodes_[*i].point);
    high = high.cwiseMax(nodes_[*i].point);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  int* middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](int a, int b) {
    const double p = nodes_[a].point[axis], q = nodes_[b].point[axis];
    return p != q ? p < q : a < b;
  });
  const std::array<int, 2> child = {build(begin, middle), build(middle + 1, end)};
  Node& node = nodes_[*middle];
  node.low = low;
  node.high = high;
  node.axis = axis;
  node.count = static_cast<int>(end - begin);
  node.child = child;
  return *middle;
}

int PointTree::nearest(const Vec3& to, Work& work) const {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  std::int64_t looks = 0;
  visit(to, least, [&](int index, double distance) {
    ++looks;
    if (distance < least || (distance == least && index < best)) {
      least = distance;
      best = index;
    }
  });
  work.other += looks / kLooksPerTest;
  return best;
}

void PointTree::within(const Vec3& of, double radius, std::vector<int>& found) const {
  found.clear();
  visit(of, radius, [&](int index, double distance) {
    if (distance <= radius) found.push_back(index);
  });
  std::ranges::sort(found);
}

}  // namespace prehensile
