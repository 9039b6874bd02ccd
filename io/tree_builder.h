/// Builds a tree of values from the events of a parser. Internal to the io layer.
#pragma once

#include <optional>

#include "io/document.h"

namespace prehensile::internal {

class TreeBuilder {
 public:
  explicit TreeBuilder(Faults& faults) : faults_(faults) {}

  void scalar(Value value, const Place& place);
  void open(Value container, const Place& place);
  void close();

  /// The next value belongs to this key. Parsers that have no event for keys need not
  /// call it: a scalar where a key is due is one.
  void key(const std::string& key, const Place& place);

  /// Dotted path of what comes next.
  std::string path() const;

  Value take() { return std::move(root_); }

 private:
  struct Frame {
    Value value;
    std::optional<Entry> pending;  // its value comes next
    bool skips = false;            // the pending key was there before
    int keys = 0;                  // of this map so far, doubled ones too
  };
  bool key_is_due() const;
  void put(Value value);

  Faults& faults_;
  std::vector<Frame> open_;
  Value root_;
};

}  // namespace prehensile::internal
