/// YAML as a tree of values: one document, no anchors, aliases or tags, no key
/// twice.
#include <sstream>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "io/tree_builder.h"

namespace prehensile::internal {
namespace {

/// Feeds the events of the YAML parser to the builder.
class Handler : public YAML::EventHandler {
 public:
  explicit Handler(Faults& faults) : builder_(faults), faults_(faults) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_extras(mark, "", anchor);
    builder_.scalar(Value{}, place(mark));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse_anchor(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    refuse_extras(mark, tag, anchor);
    // The parser marks what is quoted by the tag "!".
    builder_.scalar(tag == "!" ? Value::quoted(text) : Value::plain(text), place(mark));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                       YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    refuse_extras(mark, tag, anchor);
    builder_.open(Value::list(), place(mark));
  }
  void OnSequenceEnd() override { builder_.close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    refuse_extras(mark, tag, anchor);
    builder_.open(Value::map(), place(mark));
  }
  void OnMapEnd() override { builder_.close(); }

  static Place place(const YAML::Mark& mark) { return {mark.line + 1, -1}; }
  Value take() { return builder_.take(); }

 private:
  void refuse_extras(const YAML::Mark& mark, const std::string& tag,
                     YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) refuse_anchor(mark);
    if (!tag.empty() && tag != "?" && tag != "!") {
      faults_.fail(place(mark), builder_.path(),
                   "tag " + shown(tag) + ": expected plain YAML without tags");
    }
  }
  [[noreturn]] void refuse_anchor(const YAML::Mark& mark) {
    faults_.fail(place(mark), builder_.path(),
                 "anchor or alias (&, *): expected every value written out");
  }

  TreeBuilder builder_;
  Faults& faults_;
};

bool is_flat(const Value& value) {
  for (const Value& item : value.items) {
    if (item.kind == Value::Kind::kList || item.kind == Value::Kind::kMap) return false;
  }
  return true;
}

void emit(YAML::Emitter& out, const Value& value) {
  switch (value.kind) {
    case Value::Kind::kNull:
      out << YAML::Null;
      break;
    case Value::Kind::kPlain:
      out << value.text;
      break;
    case Value::Kind::kText:
      out << YAML::DoubleQuoted << value.text;
      break;
    case Value::Kind::kList:
      out << (is_flat(value) ? YAML::Flow : YAML::Block) << YAML::BeginSeq;
      for (const Value& item : value.items) emit(out, item);
      out << YAML::EndSeq;
      break;
    case Value::Kind::kMap:
      out << (value.entries.empty() ? YAML::Flow : YAML::Block) << YAML::BeginMap;
      for (const Entry& entry : value.entries) {
        out << YAML::Key << entry.key << YAML::Value;
        emit(out, entry.value);
      }
      out << YAML::EndMap;
      break;
  }
}

}  // namespace

Value parse_yaml(const std::string& text, Faults& faults) {
  check_characters(text, faults);
  Handler handler(faults);
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    if (!parser.HandleNextDocument(handler)) {
      faults.fail({1, -1}, "", "empty: expected a map of keys and values");
    }
    Value root = handler.take();
    Handler next(faults);
    if (parser.HandleNextDocument(next)) {
      faults.fail(next.take().place, "",
                  "a second YAML document: expected one document per file");
    }
    return root;
  } catch (const YAML::Exception& error) {
    faults.fail(Handler::place(error.mark), "",
                "not YAML: " + error.msg + ": expected YAML, indented by spaces");
  }
}

std::string to_yaml(const Value& value) {
  YAML::Emitter out;
  emit(out, value);
  return std::string(out.c_str()) + '\n';
}

}  // namespace prehensile::internal
