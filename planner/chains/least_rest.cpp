#include "planner/chains/least_rest.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace prehensile {

/// From the ends backwards, the nearest first.
LeastRest::LeastRest(const PushesTo& pushes, int contacts, std::span<const int> ends)
    : contacts_(static_cast<std::size_t>(contacts)),
      rest_(pushes.size() / contacts_ * (contacts_ + 1),
            std::numeric_limits<double>::infinity()) {
  using Entry = std::pair<double, std::size_t>;  // rest, place in rest_
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto offer = [&](std::size_t at, double rest) {
    if (rest >= rest_[at]) return;
    rest_[at] = rest;
    open.push({rest, at});
  };
  for (const int node : ends) {
    const std::size_t first = static_cast<std::size_t>(node) * (contacts_ + 1);
    for (std::size_t k = 0; k < contacts_; ++k) offer(first + k, 0.0);
  }
  while (!open.empty()) {
    const auto [rest, at] = open.top();
    open.pop();
    if (rest > rest_[at]) continue;
    const std::size_t node = at / (contacts_ + 1);
    const std::size_t contact = at % (contacts_ + 1);
    if (contact == contacts_) {  // a push by any other contact begins here
      for (std::size_t k = 0; k < contacts_; ++k) offer(at - contacts_ + k, rest + 1.0);
      continue;
    }
    for (const PushTo& push : pushes[node * contacts_ + contact]) {
      const std::size_t first = static_cast<std::size_t>(push.from) * (contacts_ + 1);
      const double before = rest + push.cost;
      offer(first + contact, before);
      offer(first + contacts_, before);
    }
  }
}

}  // namespace prehensile
