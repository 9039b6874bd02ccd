#include <algorithm>

#include "planner/baselines/baselines.h"
#include "planner/baselines/point_tree.h"
#include "planner/baselines/random_stream.h"
#include "planner/steering/goal.h"

namespace prehensile {
namespace {

/// A state and the push that joins it to its neighbour nearer to the root: the push that
/// leads to it in the tree of the start, the one that leads on in that of the goals.
struct Node {
  PushState at;
  int towards_root = -1;
  int contact = -1;
};

class Tree {
 public:
  explicit Tree(double theta_scale) : theta_scale_(theta_scale) {}

  int size() const { return static_cast<int>(nodes_.size()); }
  const Node& operator[](int index) const {
    return nodes_[static_cast<std::size_t>(index)];
  }

  int add(const Node& node) {
    nodes_.push_back(node);
    points_.add(place(node.at));
    return size() - 1;
  }

  int nearest(const PushState& to, Work& work) const {
    return points_.nearest(place(to), work);
  }

  double distance(const PushState& a, const PushState& b) const {
    return (place(a) - place(b)).norm();
  }

 private:
  Vec3 place(const PushState& state) const {
    return {state.flat.p_OF.x(), state.flat.p_OF.y(), theta_scale_ * state.flat.theta};
  }

  double theta_scale_;  // [m]
  std::vector<Node> nodes_;
  PointTree points_;
};

enum class Growth { kAlongPushes, kAgainstPushes };

class TwoTrees {
 public:
  TwoTrees(const BaselineQuestion& question, const Limits& limits, Work& work)
      : question_(question),
        limits_(limits),
        work_(work),
        steps_(question.search, question.goal, work),
        box_(box_around(steps_.model(), question.start, question.goal)),
        random_(question.seed),
        longest_(question.setting("longest") * steps_.model().L),
        draws_(static_cast<int>(question.setting("draws"))),
        links_(static_cast<int>(question.setting("links"))),
        from_start_(steps_.theta_scale()),
        to_goals_(steps_.theta_scale()) {
    const FlatState start = flat_state(question.start);
    from_start_.add({.at = {start, question.start.psi}});
    add_goals(goal_places(steps_.model(), question.goal, start, question.search.margin));
    add_goals(tolerated_places(steps_.model(), question.goal, start));
  }

  bool has_goal() const { return to_goals_.size() > 0; }

  /// Both trees by at most one node each; the pushes from the start to a goal, if they
  /// met.
  std::vector<Move> grow() {
    if (const auto node = grown(from_start_, Growth::kAlongPushes)) {
      const int added = from_start_.add(*node);
      auto moves = first_of(to_goals_, [&](int other) { return joined(added, other); });
      if (!moves.empty()) return moves;
    }
    if (const auto node = grown(to_goals_, Growth::kAgainstPushes)) {
      const int added = to_goals_.add(*node);
      return first_of(from_start_, [&](int other) { return joined(other, added); });
    }
    return {};
  }

 private:
  void add_goals(const GoalPlaces& goals) {
    for (int i = 0; i < goals.count; ++i) {
      const GoalPlace& place = goals.places[static_cast<std::size_t>(i)];
      for (int j = 0; j < place.count; ++j) {
        const FlatState flat{place.p_OF, place.theta[static_cast<std::size_t>(j)]};
        const PushState goal{flat, question_.start.psi};
        if (steps_.is_valid(goal)) to_goals_.add({.at = goal});
      }
    }
  }

  PushState drawn() {
    PushState state = from_start_[0].at;
    for (const int axis : {0, 1}) {
      state.flat.p_OF[axis] = random_.in(box_.low.p_OF[axis], box_.high.p_OF[axis]);
    }
    state.flat.theta = random_.in(box_.low.theta, box_.high.theta);
    return state;
  }

  bool inside(const PushState& state) const {
    return state.flat.theta >= box_.low.theta && state.flat.theta <= box_.high.theta;
  }

  /// A node for this tree: of some random pushes at the node nearest to a random state
  /// the one that comes closest to that; nothing if it does not work.
  std::optional<Node> grown(const Tree& tree, Growth growth) {
    const bool along = growth == Growth::kAlongPushes;
    const PushState target = drawn();
    const int nearest = tree.nearest(target, work_);
    const PushState& at = tree[nearest].at;
    std::optional<Node> best;
    for (int i = 0; i < draws_; ++i) {
      PushControl control =
          steps_.random_push(longest_, [this] { return random_.in(0.0, 1.0); });
      if (!along) control.travel = -control.travel;
      const std::optional<PushState> end = steps_.end_of(at, control);
      if (!end || !inside(*end)) continue;
      if (!best || tree.distance(*end, target) < tree.distance(best->at, target)) {
        best = {*end, nearest, control.letter};
      }
    }
    if (!best) {
      ++work_.propagations;  // so that a search without any push ends, too
      return std::nullopt;
    }
    const bool works = along ? steps_.works(best->contact, at, best->at)
                             : steps_.works(best->contact, best->at, at);
    return works ? best : std::nullopt;
  }

  /// The first plan through a node of a tree: through the newest, or through its root.
  template <class Joined>
  std::vector<Move> first_of(const Tree& tree, const Joined& joined) {
    const int oldest = std::max(1, tree.size() - links_);
    for (int i = tree.size() - 1; i >= oldest && !limits_.reached(); --i) {
      auto moves = joined(i);
      if (!moves.empty()) return moves;
    }
    return joined(0);
  }

  /// The pushes from the start to a goal through these nodes, if one push joins them.
  std::vector<Move> joined(int of_start, int of_goals) {
    const PushState& from = from_start_[of_start].at;
    const PushState& to = to_goals_[of_goals].at;
    const auto step = steps_.join(from, to, from_start_[of_start].contact);
    if (!step || step->move_contact < 0) return {};
    std::vector<Move> moves = {{step->move_contact, from.flat, to.flat}};
    for (int i = of_start; i != 0; i = from_start_[i].towards_root) {
      const Node& node = from_start_[i];
      moves.push_back(
          {node.contact, from_start_[node.towards_root].at.flat, node.at.flat});
    }
    std::ranges::reverse(moves);
    for (int i = of_goals; to_goals_[i].towards_root >= 0;) {
      const Node& node = to_goals_[i];
      i = node.towards_root;
      moves.push_back({node.contact, node.at.flat, to_goals_[i].at.flat});
    }
    return moves;
  }

  const BaselineQuestion& question_;
  const Limits& limits_;
  Work& work_;
  PushSteps steps_;
  FlatBox box_;
  RandomStream random_;
  double longest_;  // [m]
  int draws_, links_;
  Tree from_start_, to_goals_;
};

}  // namespace

std::optional<std::vector<Move>> grow_two_trees(const BaselineQuestion& question,
                                                const Limits& limits, Work& work) {
  TwoTrees trees(question, limits, work);
  if (!trees.has_goal()) return std::nullopt;
  while (!limits.reached()) {
    std::vector<Move> moves = trees.grow();
    if (!moves.empty()) return moves;
  }
  return std::nullopt;
}

}  // namespace prehensile
