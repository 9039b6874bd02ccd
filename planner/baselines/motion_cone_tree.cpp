#include <algorithm>
#include <cmath>

#include "planner/baselines/baselines.h"
#include "planner/baselines/point_tree.h"
#include "planner/baselines/random_stream.h"

namespace prehensile {
namespace {

constexpr double kSamePusher = 0.1;  // published cost of a push
constexpr double kOtherPusher = 1.0;

struct Node {
  PushState at;
  int parent = -1;
  int contact = -1;  // of the push from the parent
  double cost = 0.0;
};

class ConeTree {
 public:
  ConeTree(const BaselineQuestion& question, Work& work)
      : question_(question),
        work_(work),
        steps_(question.search, question.goal, work),
        box_(box_around(steps_.model(), question.start, question.goal)),
        random_(question.seed),
        step_(question.setting("step") * steps_.model().L),
        radius_(question.setting("radius") * steps_.model().L),
        goal_bias_(question.setting("goal_bias")),
        temperature_(question.setting("temperature")),
        scale_(cost_at(state_of(question.start))) {
    add({.at = state_of(question.start)});
  }

  /// One extension; the index of a node at the goal, or -1.
  int grow() {
    const PushState target = drawn();
    const int nearest = points_.nearest(place(target), work_);
    const PushState from = nodes_[nearest].at;
    const PushState wanted = chance_of_goal_ ? member_next_to(from) : target;
    const std::optional<PushStep> step = steps_.extend(from, wanted, step_);
    if (!step || !inside(step->to) || !passes(cost_at(from), cost_at(step->to))) {
      return -1;
    }
    const int index = add(with_best_parent(
        {step->to, nearest, step->move_contact, cost_of(nearest, step->move_contact)}));
    if (question_.setting("rewire") != 0.0) rewire(index);
    return reaches(question_.goal, grasp_of(nodes_[index].at)) ? index : -1;
  }

  std::vector<Move> moves_to(int index) const {
    std::vector<Move> moves;
    for (; nodes_[index].parent >= 0; index = nodes_[index].parent) {
      const Node& node = nodes_[index];
      moves.push_back({node.contact, nodes_[node.parent].at.flat, node.at.flat});
    }
    std::ranges::reverse(moves);
    return moves;
  }

 private:
  Vec3 place(const PushState& state) const {
    return {state.flat.p_OF.x(), state.flat.p_OF.y(),
            steps_.theta_scale() * state.flat.theta};
  }

  bool inside(const PushState& state) const {
    return state.flat.theta >= box_.low.theta && state.flat.theta <= box_.high.theta;
  }

  PushState member_next_to(const PushState& state) const {
    return state_of(member_near(question_.goal, grasp_of(state)));
  }

  /// Configuration cost: distance to the goal [m].
  double cost_at(const PushState& state) const {
    return (place(state) - place(member_next_to(state))).norm();
  }

  PushState drawn() {
    chance_of_goal_ = random_.chance(goal_bias_);
    if (chance_of_goal_) return member_next_to(nodes_.front().at);
    PushState state = nodes_.front().at;
    for (const int axis : {0, 1}) {
      state.flat.p_OF[axis] = random_.in(box_.low.p_OF[axis], box_.high.p_OF[axis]);
    }
    state.flat.theta = random_.in(box_.low.theta, box_.high.theta);
    return state;
  }

  /// Towards the goal always; away from it rarely, more often after many refusals.
  bool passes(double from, double to) {
    if (to <= from) return true;
    const double factor = question_.setting("temperature_factor");
    if (random_.chance(std::exp(-(to - from) / (scale_ * temperature_)))) {
      temperature_ /= factor;
      failures_ = 0;
      return true;
    }
    if (++failures_ > static_cast<int>(question_.setting("most_failures"))) {
      temperature_ = std::min(temperature_ * factor, 1e6);
      failures_ = 0;
    }
    return false;
  }

  double cost_of(int parent, int contact) const {
    const Node& node = nodes_[parent];
    return node.cost + (node.contact == contact ? kSamePusher : kOtherPusher);
  }

  Node with_best_parent(Node node) {
    points_.within(place(node.at), radius_, near_);
    for (const int candidate : near_) {
      // No push to the node can cost less than one by the candidate's own pusher.
      if (cost_of(candidate, nodes_[candidate].contact) >= node.cost) continue;
      const auto step =
          steps_.join(nodes_[candidate].at, node.at, nodes_[candidate].contact);
      if (!step || step->move_contact < 0) continue;
      const double cost = cost_of(candidate, step->move_contact);
      if (cost < node.cost) node = {node.at, candidate, step->move_contact, cost};
    }
    return node;
  }

  /// A neighbour that a push from the new node makes cheaper hangs there. The costs
  /// stored below it stay: they remain above its own, so that no cycle can arise.
  void rewire(int index) {
    for (const int other : near_) {
      const Node& node = nodes_[other];
      if (node.parent < 0 || cost_of(index, nodes_[index].contact) >= node.cost) continue;
      const auto step = steps_.join(nodes_[index].at, node.at, nodes_[index].contact);
      if (!step || step->move_contact < 0) continue;
      const double cost = cost_of(index, step->move_contact);
      if (cost >= node.cost) continue;
      nodes_[other] = {node.at, index, step->move_contact, cost};
    }
  }

  int add(const Node& node) {
    nodes_.push_back(node);
    points_.add(place(node.at));
    return static_cast<int>(nodes_.size()) - 1;
  }

  const BaselineQuestion& question_;
  Work& work_;
  PushSteps steps_;
  FlatBox box_;
  RandomStream random_;
  double step_, radius_, goal_bias_, temperature_;
  double scale_;  // [m] of configuration costs
  int failures_ = 0;
  bool chance_of_goal_ = false;
  std::vector<Node> nodes_;
  PointTree points_;
  std::vector<int> near_;
};

}  // namespace

std::optional<std::vector<Move>> grow_cone_tree(const BaselineQuestion& question,
                                                const Limits& limits, Work& work) {
  ConeTree tree(question, work);
  while (!limits.reached()) {
    const int goal = tree.grow();
    if (goal >= 0) return tree.moves_to(goal);
  }
  return std::nullopt;
}

}  // namespace prehensile
