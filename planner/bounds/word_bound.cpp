#include "planner/bounds/word_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/bounds/open_nodes.h"
#include "planner/bounds/portals.h"
#include "planner/bounds/single_runs.h"
#include "planner/bounds/slab_travel.h"
#include "planner/costs.h"
#include "scene/outline.h"

namespace prehensile {
namespace {

constexpr int kMostPlacements = 6;
constexpr int kPlacementsOfSlabs = 3;  // from which on it pays to ask what slabs cost

PointBox bounding_box(const std::vector<Vec2>& outline) {
  Vec2 low = outline.front(), high = outline.front();
  for (const Vec2& v : outline) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  PointBox box;
  box.centre = 0.5 * (low + high);
  const Vec2 half = 0.5 * (high - low);
  box.half = {Vec2(half.x(), 0.0), Vec2(0.0, half.y())};
  return box;
}

/// Least travel to a piece of the goal set by so many placements, whatever their contacts
/// [m].
double least_way(const WordQuestion& question, const TurnPiece& piece, int placements) {
  if (!question.slabs || placements < kPlacementsOfSlabs) return question.straight;
  return std::max(
      question.straight,
      question.slabs->least(question.p_OF, goal_arc(question, piece.low, piece.high),
                            piece.low, piece.high));
}

/// All words of this many placements.
double words(const WordScene& scene, const WordQuestion& question, int placements,
             double target, std::int64_t& nodes, const WordVisitor& visit) {
  OpenNodes open(scene, target, nodes, visit);
  const auto pieces = goal_pieces(scene, question, (target - placements) * scene.L);
  const int contacts = static_cast<int>(scene.laws->contacts.size());
  WordNode node;
  node.points = placements + 1;
  node.placements = placements;
  node.box[0].centre = question.p_OF;
  const PointBox anywhere = bounding_box(scene.outline);
  for (int i = 1; i < placements; ++i) node.box[i] = anywhere;
  std::vector<WordNode> ends;
  double least = target;
  for (const TurnPiece& piece : pieces) {
    node.bound = placements + least_way(question, piece, placements) / scene.L;
    if (node.bound >= target) continue;
    set_goal(question, piece.low, piece.high, node);
    ends.push_back(node);
    least = std::min(least, node.bound);
  }
  if (ends.empty()) return target;
  std::array<int, kMostPlacements> word{};
  for (;;) {
    const bool repeats = std::adjacent_find(word.begin(), word.begin() + placements) !=
                         word.begin() + placements;
    if (!repeats) {
      if (nodes <= 0) return least;
      for (const WordNode& end : ends) {
        WordNode child = end;
        for (int i = 0; i < placements; ++i) {
          child.contact[i + 1] = static_cast<short>(word[i]);
        }
        open.add(child);
      }
    }
    int i = 0;
    while (i < placements && ++word[i] == contacts) word[i++] = 0;
    if (i == placements) break;
  }
  return open.run(question);
}

}  // namespace

WordScene word_scene(const Model& model, const RunLaws& laws) {
  WordScene scene;
  scene.laws = &laws;
  scene.c = model.c;
  scene.L = longest_placement_length(model);
  scene.outline = model.pad_face;
  scene.portals = portals_of(scene.outline);
  return scene;
}

double word_bound(const WordScene& scene, const WordQuestion& question, double target,
                  std::int64_t& nodes, const WordVisitor& visit) {
  double best = target;
  for (int placements = 1;; ++placements) {
    if (placements + question.straight / scene.L >= best) return best;
    double way = (best - placements) * scene.L;
    for (const TurnPiece& piece : goal_pieces(scene, question, way)) {
      way = std::min(way, least_way(question, piece, placements));
    }
    const double least = placements + way / scene.L;
    if (least >= best) return best;
    if (placements > kMostPlacements || nodes <= 0) return std::min(best, least);
    const double bound = placements == 1
                             ? single_runs(scene, question, best, nodes, visit)
                             : words(scene, question, placements, best, nodes, visit);
    best = std::min(best, bound);
  }
}

}  // namespace prehensile
