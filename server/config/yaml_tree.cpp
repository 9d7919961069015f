#include "server/config/yaml_tree.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "protocol/wire/utf8.hpp"

namespace skerry::server {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Turns yaml-cpp's marks, which count bytes from 0, into lines and columns.
class Places {
 public:
  Places(std::string_view text, int file) : text_(text), file_(file) {
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (at % kStride == 0) characters_before_.push_back(characters_);
      characters_ += static_cast<int>(character_count(text.substr(at, 1)));
      if (text[at] == '\n') starts_.push_back(at + 1);
    }
  }

  TextPlace of(const YAML::Mark& mark) const {
    const auto line =
        std::min(static_cast<std::size_t>(std::max(mark.line, 0)), starts_.size() - 1);
    return of_byte(starts_[line] + static_cast<std::size_t>(std::max(mark.column, 0)));
  }

  TextPlace of_byte(std::size_t byte) const {
    byte = std::min(byte, text_.size());
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), byte);
    return {static_cast<int>(after - starts_.begin()),
            characters_before(byte) - characters_before(*(after - 1)) + 1, file_};
  }

 private:
  // Characters are counted up to every kStride-th byte, so that a place on a long line costs no
  // more than one on a short line.
  static constexpr std::size_t kStride = 64;

  int characters_before(std::size_t byte) const {
    const std::size_t stride = byte / kStride;
    if (stride == characters_before_.size()) return characters_;
    const std::string_view rest = text_.substr(stride * kStride, byte % kStride);
    return characters_before_[stride] + static_cast<int>(character_count(rest));
  }

  std::string_view text_;
  int file_;
  std::vector<std::size_t> starts_{0};
  std::vector<int> characters_before_;
  int characters_ = 0;  // of the whole text
};

// Builds the tree from yaml-cpp's events, so that a bound ends the parsing where it is passed.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(YamlSource& source, const Places& places) : source_(source), places_(places) {}

  YamlNode take() { return std::move(root_); }

  // "; it begins at 3:8" of the innermost list or map that has not ended, if there is one.
  std::string where_open_began() const {
    if (open_.empty()) return {};
    const TextPlace place = open_.back().node.place;
    return fmt::format("; it begins at {}:{}", place.line, place.column);
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (documents_++ > 0) {
      fail(mark,
           "the document has ended before this; allowed: one document a file, and entries "
           "of one indentation");
    }
  }
  void OnDocumentEnd() override {}
  void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
    source_.complain(
        fmt::format("anchor &{}: anchors and aliases are not supported; write the value out",
                    printable(name)),
        places_.of(mark));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    add(node(mark, YamlNode::Kind::alias));
  }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
    YamlNode null = node(mark, YamlNode::Kind::null);
    // yaml-cpp puts the value that is not there where the next thing is.
    if (!open_.empty() && open_.back().key) null.place = open_.back().key->place;
    add(std::move(null));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                const std::string& value) override {
    complain_of_tag(mark, tag);
    YamlNode scalar = node(mark, tag == "!" ? YamlNode::Kind::quoted : YamlNode::Kind::plain);
    scalar.text = value;
    add(std::move(scalar));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, YamlNode::Kind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, YamlNode::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    YamlNode node;
    std::optional<YamlNode> key;  // of a map: read, its value not yet
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& text) {
    source_.fail(text, places_.of(mark));
  }

  void complain_of_tag(const YAML::Mark& mark, const std::string& tag) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    source_.complain(fmt::format("tag {}: tags are not supported", printable(tag)),
                     places_.of(mark));
  }

  YamlNode node(const YAML::Mark& mark, YamlNode::Kind kind) {
    if (++nodes_ > kMaxYamlNodes) {
      fail(mark, fmt::format("too much: more than {} keys and values", kMaxYamlNodes));
    }
    YamlNode made;
    made.kind = kind;
    made.place = places_.of(mark);
    return made;
  }

  void open(const YAML::Mark& mark, const std::string& tag, YamlNode::Kind kind) {
    complain_of_tag(mark, tag);
    if (open_.size() == kMaxYamlDepth) {
      fail(mark,
           fmt::format("too deep: more than {} lists and maps within each other", kMaxYamlDepth));
    }
    open_.push_back({node(mark, kind), std::nullopt});
  }

  void close() {
    YamlNode done = std::move(open_.back().node);
    open_.pop_back();
    add(std::move(done));
  }

  void add(YamlNode value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == YamlNode::Kind::list) {
      parent.node.items.push_back(std::move(value));
    } else if (!parent.key) {
      parent.key = std::move(value);
    } else {
      parent.node.keys.push_back(std::move(*parent.key));
      parent.node.items.push_back(std::move(value));
      parent.key.reset();
    }
  }

  YamlSource& source_;
  const Places& places_;
  std::vector<Open> open_;
  YamlNode root_;
  std::size_t nodes_ = 0;
  int documents_ = 0;
};

void require_text(std::string_view text, YamlSource& source, const Places& places) {
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t at = text.size() - rest.size();
    const auto byte = static_cast<unsigned char>(text[at]);
    if (!take_code_point(rest)) {
      source.fail(fmt::format("byte 0x{:02x} is not UTF-8; save the file as UTF-8", byte),
                  places.of_byte(at));
    }
    if ((byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7F) {
      source.fail(fmt::format("control character 0x{:02x}; allowed: text", byte),
                  places.of_byte(at));
    }
  }
}

}  // namespace

YamlNode parse_yaml(const std::string& text, YamlSource& source, int file) {
  if (text.size() > kMaxYamlBytes) {
    source.fail(fmt::format("too long: {} bytes; allowed: at most {}", text.size(), kMaxYamlBytes),
                {});
  }
  std::string_view body = text;
  if (body.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    body.remove_prefix(kByteOrderMark.size());
  }
  // yaml-cpp takes the end of the text for the end of a quoted value if a line ends before it.
  body = body.substr(0, body.find_last_not_of(" \t\r\n") + 1);
  const Places places(body, file);
  require_text(body, source, places);
  TreeBuilder builder(source, places);
  try {
    std::istringstream in{std::string(body)};
    YAML::Parser parser(in);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    const bool no_end = error.msg.rfind("end of ", 0) == 0;
    source.fail(fmt::format("not YAML: {}{}; nothing else was checked", printable(error.msg, 200),
                            no_end ? builder.where_open_began() : ""),
                places.of(error.mark));
  }
  return builder.take();
}

}  // namespace skerry::server
