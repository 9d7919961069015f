#include "server/config/yaml_include.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "server/config/field_value.hpp"
#include "server/config/yaml_message.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;
using Kind = YamlNode::Kind;

constexpr const char* kInclude = "include";

YamlNode* find_key(YamlNode& map, const std::string& key) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    if (map.keys[i].text == key) return &map.items[i];
  }
  return nullptr;
}

// `before` is what was included, `node` wins.
void put_before(YamlNode before, YamlNode& node) {
  if (before.kind != node.kind) return;
  if (node.kind == Kind::list) {
    for (YamlNode& item : node.items) before.items.push_back(std::move(item));
    node.items = std::move(before.items);
  } else if (node.kind == Kind::map) {
    for (std::size_t i = 0; i < before.keys.size(); ++i) {
      if (YamlNode* own = find_key(node, before.keys[i].text)) {
        put_before(std::move(before.items[i]), *own);
      } else {
        node.keys.push_back(std::move(before.keys[i]));
        node.items.push_back(std::move(before.items[i]));
      }
    }
  }
}

class Includer {
 public:
  explicit Includer(YamlSource& source) : source_(source) {}

  YamlNode read(const std::string& text, const fs::path& path, int file, int depth) {
    bytes_ += text.size();
    YamlNode root = parse_yaml(text, source_, file);
    if (file != 0 && root.kind == Kind::null) root.kind = Kind::map;
    if (file != 0 && root.kind != Kind::map) {
      source_.complain("expected keys and values, given " + given_by(root), root.place);
      root = {Kind::map, root.place, {}, {}, {}};
    }
    open_.push_back(canonical(path));
    seen_.push_back(open_.back());
    YamlNode included{Kind::map, root.place, {}, {}, {}};
    for (const YamlNode& name : taken_includes(root)) {
      YamlNode part = include(name, path.parent_path(), depth);
      put_before(std::move(included), part);
      included = std::move(part);
    }
    open_.pop_back();
    put_before(std::move(included), root);
    return root;
  }

 private:
  static fs::path canonical(const fs::path& path) {
    std::error_code ignored;
    fs::path found = fs::weakly_canonical(path, ignored);
    return ignored ? path : found;
  }

  void refuse(const std::string& text, TextPlace place) { source_.refuse(kInclude, text, place); }

  std::optional<std::string> text_of(const fs::path& path, TextPlace place) {
    try {
      return read_yaml_file(path.string());
    } catch (const ConfigError& error) {
      refuse(error.what(), place);
      return std::nullopt;
    }
  }

  // Takes the key out of the map.
  std::vector<YamlNode> taken_includes(YamlNode& root) {
    std::vector<YamlNode> names;
    for (std::size_t i = 0; i < root.keys.size();) {
      if (root.keys[i].text != kInclude) {
        ++i;
        continue;
      }
      const YamlNode list = std::move(root.items[i]);
      root.keys.erase(root.keys.begin() + static_cast<std::ptrdiff_t>(i));
      root.items.erase(root.items.begin() + static_cast<std::ptrdiff_t>(i));
      if (list.kind != Kind::list) {
        refuse("expected a list of files, given " + given_by(list), list.place);
        continue;
      }
      for (const YamlNode& name : list.items) {
        if (name.kind == Kind::plain || name.kind == Kind::quoted) {
          names.push_back(name);
        } else {
          refuse("expected a file, given " + given_by(name), name.place);
        }
      }
    }
    return names;
  }

  YamlNode include(const YamlNode& name, const fs::path& folder, int depth) {
    YamlNode nothing{Kind::map, name.place, {}, {}, {}};
    const fs::path path = folder / name.text;
    const fs::path real = canonical(path);
    const auto is_in = [&](const std::vector<fs::path>& files) {
      return std::find(files.begin(), files.end(), real) != files.end();
    };
    if (is_in(open_)) {
      refuse(fmt::format("{} includes itself", printable(path.string(), 4096)), name.place);
    } else if (is_in(seen_)) {
      refuse(fmt::format("{} is included already", printable(path.string(), 4096)), name.place);
    } else if (depth == kMaxIncludeDepth) {
      refuse(fmt::format("files include each other more than {} deep", kMaxIncludeDepth),
             name.place);
    } else if (++count_ > kMaxIncludedFiles) {
      refuse(fmt::format("more than {} files are included", kMaxIncludedFiles), name.place);
    } else {
      const std::optional<std::string> text = text_of(path, name.place);
      if (text && bytes_ + text->size() > kMaxYamlBytes) {
        refuse(fmt::format("with {} the files are too long; allowed: {} bytes together",
                           printable(path.string(), 4096), kMaxYamlBytes),
               name.place);
      } else if (text) {
        return read(*text, path, source_.add_file(path.string()), depth + 1);
      }
    }
    return nothing;
  }

  YamlSource& source_;
  std::vector<fs::path> open_, seen_;
  std::size_t bytes_ = 0;
  int count_ = 0;
};

void write_quoted(const std::string& text, std::string& out) {
  out += '"';
  for (const char c : text) {
    if (c == '\n') {
      out += "\\n";
    } else if (c == '\r') {
      out += "\\r";
    } else if (c == '\t') {
      out += "\\t";
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
  }
  out += '"';
}

// In one line.  A plain value keeps its kind: only quotes make text of a number.
void write_flow(const YamlNode& node, std::string& out) {
  switch (node.kind) {
    case Kind::null:
      out += "~";
      break;
    case Kind::alias:
      out += "~";
      break;
    case Kind::quoted:
      write_quoted(node.text, out);
      break;
    case Kind::plain: {
      const bool simple =
          !node.text.empty() &&
          node.text.find_first_not_of(
              "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.+- ") ==
              std::string::npos &&
          node.text.find("- ") != 0 && node.text != "-";
      if (simple) {
        out += node.text;
      } else {
        write_quoted(node.text, out);
      }
      break;
    }
    case Kind::list:
      out += '[';
      for (std::size_t i = 0; i < node.items.size(); ++i) {
        if (i > 0) out += ", ";
        write_flow(node.items[i], out);
      }
      out += ']';
      break;
    case Kind::map:
      out += '{';
      for (std::size_t i = 0; i < node.keys.size(); ++i) {
        if (i > 0) out += ", ";
        write_flow(node.keys[i], out);
        out += ": ";
        write_flow(node.items[i], out);
      }
      out += '}';
      break;
  }
}

}  // namespace

YamlNode parse_yaml_whole(const std::string& text, YamlSource& source) {
  return Includer(source).read(text, source.file_name(), 0, 0);
}

std::string yaml_text(const YamlNode& root) {
  std::string out;
  for (std::size_t i = 0; i < root.keys.size(); ++i) {
    write_flow(root.keys[i], out);
    out += ':';
    const YamlNode& value = root.items[i];
    if (value.kind == Kind::list && !value.items.empty()) {
      for (const YamlNode& item : value.items) {
        out += "\n  - ";
        write_flow(item, out);
      }
    } else {
      out += ' ';
      write_flow(value, out);
    }
    out += '\n';
  }
  return out;
}

}  // namespace skerry::server
