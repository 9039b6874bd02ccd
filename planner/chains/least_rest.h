/// What is still to be paid from each node of a graph of pushes. Internal to the own
/// planner.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace prehensile {

/// A push that leads to a node.
struct PushTo {
  int from = -1;
  double cost = 0.0;  ///< its share of J, without a placement
};

/// By the node that they lead to and the contact: those by contact k of `contacts` to
/// node n are at n * contacts + k.
using PushesTo = std::vector<std::vector<PushTo>>;

/// The least J from each node to one of the ends, whatever the object turns by on the
/// way. A push by another contact than the one before is one placement more.
class LeastRest {
 public:
  /// Infinite where no way leads to an end. Takes as long as sorting the pushes.
  LeastRest(const PushesTo& pushes, int contacts, std::span<const int> ends);

  /// Of what has come to a node by a push of this contact; negative: by none.
  double after(int node, int contact) const {
    const auto index = static_cast<std::size_t>(node) * (contacts_ + 1);
    return contact < 0 ? rest_[index + contacts_] + 1.0 : rest_[index + contact];
  }

 private:
  std::size_t contacts_;
  std::vector<double> rest_;  // by node and contact, and the least of these
};

}  // namespace prehensile
