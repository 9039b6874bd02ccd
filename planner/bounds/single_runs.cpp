#include "planner/bounds/single_runs.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "planner/bounds/corner_bars.h"
#include "planner/bounds/open_nodes.h"
#include "planner/bounds/run_slabs.h"
#include "planner/bounds/slab_travel.h"

namespace prehensile {
namespace {

// As long as the program of a run takes, and its slabs where there is none; these are few
// for that.
constexpr std::int64_t kNodesPerRun = 350;
constexpr std::int64_t kNodesPerSlabs = 700;

/// Runs of a single placement whose goal turns by some range, best first.
class SingleRuns {
 public:
  SingleRuns(const WordScene& scene, const WordQuestion& question, double target,
             std::int64_t& nodes, const WordVisitor& visit)
      : scene_(scene),
        question_(question),
        target_(target),
        nodes_(nodes),
        asks_slabs_(question.slabs && !visit),
        barred_(scene.laws->contacts.size()),
        others_(scene, target, nodes, visit) {}

  /// `least`: a bound that is known, of slabs, too, if they were `crossed`.
  void add(int contact, double low, double high, double least = 1.0,
           bool crossed_slabs = false) {
    --nodes_;
    Run run{.contact = contact,
            .turn_low = low,
            .turn_high = high,
            .crossed_slabs = crossed_slabs};
    WordNode node = node_of(run);
    cross_portals(scene_, node);
    if (!bound_node(scene_, target_, node)) return;
    run.bound = std::max(least, node.bound);
    keep(run);
  }

  /// The least bound of what is left, at most the target. What is worst is looked at
  /// first: by its program, then across slabs, then in halves.
  double run() {
    while (!heap_.empty() && nodes_ > 0) {
      Run worst = heap_.front();
      const bool crosses_slabs = asks_slabs_ && !worst.crossed_slabs;
      if (worst.is_bounded && !crosses_slabs &&
          worst.turn_high - worst.turn_low < kNarrowestTurn) {
        break;
      }
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      if (!worst.is_bounded) {
        bound_by_program(worst);
      } else if (crosses_slabs) {
        bound_by_slabs(worst);
        keep(worst);
      } else {
        const auto [contact, low, high, bound, is_bounded, crossed_slabs] = worst;
        const double middle = 0.5 * (low + high);
        add(contact, low, middle, bound, crossed_slabs);
        add(contact, middle, high, bound, crossed_slabs);
      }
    }
    const double left = heap_.empty() ? target_ : heap_.front().bound;
    return std::min(left, others_.run(question_));
  }

 private:
  struct Run {
    int contact = 0;
    double turn_low = 0.0, turn_high = 0.0, bound = 0.0;
    bool is_bounded = false;     // by its program
    bool crossed_slabs = false;  // this one, or one that it is a part of
    bool operator<(const Run& other) const { return bound > other.bound; }
  };

  WordNode node_of(const Run& run) const {
    WordNode node;
    node.points = 2;
    node.placements = 1;
    node.box[0].centre = question_.p_OF;
    node.contact[1] = static_cast<short>(run.contact);
    node.bound = 1.0 + question_.straight / scene_.L;
    set_goal(question_, run.turn_low, run.turn_high, node);
    return node;
  }

  void keep(const Run& run) {
    if (run.bound >= target_) return;
    heap_.push_back(run);
    std::push_heap(heap_.begin(), heap_.end());
  }

  RunQuestion question_of(const Run& run) const {
    return {.laws = scene_.laws,
            .contact = run.contact,
            .c = scene_.c,
            .outline = &scene_.outline,
            .start = question_.p_OF,
            .goal = goal_arc(question_, run.turn_low, run.turn_high),
            .turn_low = run.turn_low,
            .turn_high = run.turn_high,
            .cap = (target_ - 1.0) * scene_.L};
  }

  void bound_by_program(Run& run) {
    const double travel = run_bound(question_of(run));
    if (travel <= 0.0) {  // the goal is not ahead: gravity has to help
      if (asks_slabs_) {
        nodes_ -= kNodesPerSlabs;
        bound_by_slabs(run);
      }
      if (run.bound >= target_) return;
      WordNode node = node_of(run);
      node.bound = std::max(node.bound, run.bound);
      return others_.add(node);
    }
    nodes_ -= kNodesPerRun;
    run.is_bounded = true;
    run.bound = std::max(run.bound, 1.0 + travel / scene_.L);
    keep(run);
  }

  /// All inequalities of an instant together, which the program knows one by one.
  void bound_by_slabs(Run& run) {
    run.crossed_slabs = true;
    if (is_barred(run.contact)) {
      run.bound = target_;
      return;
    }
    const double travel = travel_across_slabs(question_.slabs->law(), question_of(run),
                                              (run.bound - 1.0) * scene_.L);
    run.bound = std::max(run.bound, 1.0 + travel / scene_.L);
  }

  /// From all goals at once: their places are the same after every whole turn.
  bool is_barred(int contact) {
    std::optional<bool>& barred = barred_[contact];
    if (!barred) {
      barred = prehensile::is_barred(question_.slabs->law(), contact, scene_.outline,
                                     question_.p_OF, goal_arcs(question_));
    }
    return *barred;
  }

  const WordScene& scene_;
  const WordQuestion& question_;
  double target_;
  std::int64_t& nodes_;
  bool asks_slabs_;  // not while plans are looked for among the nodes
  std::vector<Run> heap_;
  std::vector<std::optional<bool>> barred_;  // by contact, once it has been asked
  OpenNodes others_;
};

}  // namespace

double single_runs(const WordScene& scene, const WordQuestion& question, double target,
                   std::int64_t& nodes, const WordVisitor& visit) {
  SingleRuns runs(scene, question, target, nodes, visit);
  const auto pieces = goal_pieces(scene, question, (target - 1.0) * scene.L);
  const int contacts = static_cast<int>(scene.laws->contacts.size());
  for (int contact = 0; contact < contacts; ++contact) {
    for (const TurnPiece& piece : pieces) runs.add(contact, piece.low, piece.high);
  }
  return runs.run();
}

}  // namespace prehensile
