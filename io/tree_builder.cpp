#include "io/tree_builder.h"

namespace prehensile::internal {

bool TreeBuilder::key_is_due() const {
  return !open_.empty() && open_.back().value.kind == Value::Kind::kMap &&
         !open_.back().pending;
}

void TreeBuilder::scalar(Value value, const Place& place) {
  value.place = place;
  if (key_is_due()) {
    key(value.text, place);
  } else {
    put(std::move(value));
  }
}

void TreeBuilder::open(Value container, const Place& place) {
  if (key_is_due()) {
    faults_.fail(
        place, path(),
        "a list or a map as a key, or a bracket that is never closed: expected a "
        "word as key");
  }
  if (static_cast<int>(open_.size()) >= kDeepest) {
    faults_.fail(
        place, path(),
        "nested too deeply: expected at most " + std::to_string(kDeepest) + " levels");
  }
  container.place = place;
  open_.push_back({std::move(container), std::nullopt, false});
}

void TreeBuilder::close() {
  Value value = std::move(open_.back().value);
  open_.pop_back();
  put(std::move(value));
}

void TreeBuilder::key(const std::string& key, const Place& place) {
  Frame& frame = open_.back();
  if (++frame.keys > kMostKeys) {
    faults_.fail(place, path(),
                 "a map of more keys: expected at most " + std::to_string(kMostKeys));
  }
  const Value* before = frame.value.find(key);
  if (before) {
    faults_.add(place, join(path(), key),
                "given twice, first in line " + std::to_string(before->place.line) +
                    ": expected once");
  }
  frame.skips = before != nullptr;
  frame.pending = Entry{key, place, {}};
}

void TreeBuilder::put(Value value) {
  if (open_.empty()) {
    root_ = std::move(value);
    return;
  }
  Frame& frame = open_.back();
  if (frame.value.kind == Value::Kind::kList) {
    frame.value.items.push_back(std::move(value));
    return;
  }
  // An empty value has no place of its own: parsers mark what follows it.
  if (value.kind == Value::Kind::kNull) value.place = frame.pending->place;
  frame.pending->value = std::move(value);
  if (!frame.skips) frame.value.entries.push_back(std::move(*frame.pending));
  frame.pending.reset();
}

std::string TreeBuilder::path() const {
  std::string path;
  for (const Frame& frame : open_) {
    if (frame.pending) path = join(path, frame.pending->key);
    if (frame.value.kind == Value::Kind::kList) {
      path = join(path, std::to_string(frame.value.items.size()));
    }
  }
  return path;
}

}  // namespace prehensile::internal
