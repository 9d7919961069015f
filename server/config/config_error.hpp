// The errors of a configuration file, each with its place, in one list.
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace skerry::server {

// A place in a text: line and column count from 1, columns in characters.  `file` is 0 for the file
// itself and YamlSource::add_file()'s number for one that it includes.
struct TextPlace {
  int line = 1;
  int column = 1;
  int file = 0;
  auto operator<=>(const TextPlace& other) const {
    return std::tie(file, line, column) <=> std::tie(other.file, other.line, other.column);
  }
  bool operator==(const TextPlace&) const = default;
};

// what() has one line for each error, in the order of the text:
//   FILE:LINE:COLUMN: KEY PATH: what is wrong, what is allowed
// for example
//   bergen.yaml:12:10: own_ships[0].radars[1].rpm: 75 is out of range; allowed: 10 to 60 turns/min
// in printable text; the key path is left out where there is none.  If there are several, a last
// line gives their number.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  ConfigError(const std::string& file, TextPlace place, const std::string& path,
              const std::string& text);
};

// YamlSource: where in a file each key stands, and every error found in the file so far.  The
// reader of the text and all later checks add to it; require_sound() ends with the whole list.
// Paths are as in messages: "own_ships[0].radars[1].rpm"; "" is the file itself.
class YamlSource {
 public:
  // The first errors in the order of the text that a message shows; the others are counted.
  static constexpr std::size_t kMostShown = 100;

  explicit YamlSource(std::string file_name) : files_{std::move(file_name)} {}

  // A file that this one includes; gives the number for its places.
  int add_file(std::string name) {
    files_.push_back(std::move(name));
    return static_cast<int>(files_.size()) - 1;
  }

  void add(const std::string& path, TextPlace place) { places_[path] = place; }

  // Whether the file gives a value for the path (and not a default).
  bool has(const std::string& path) const { return places_.count(path) != 0; }

  // The place of the value at `path`, or of the innermost list or map around it that the file
  // holds.
  TextPlace place_of(std::string path) const;

  // Adds an error of the value at `path`, which is not sound from now on.
  void refuse(const std::string& path, const std::string& text);
  // The same where the error has another place, as that of a key.
  void refuse(const std::string& path, const std::string& text, TextPlace place);
  // Adds an error of the text, which leaves all values as they are.
  void complain(const std::string& text, TextPlace place);

  // Whether no value was refused at `path`, in it or around it.  A check looks at sound values
  // only, so that one mistake is reported once.
  bool is_sound(const std::string& path) const;

  // Error: ConfigError with all errors, if there are any.
  void require_sound() const;

  // Adds an error behind which nothing can be read.  Error: ConfigError with all errors.
  [[noreturn]] void fail(const std::string& text, TextPlace place);

  const std::string& file_name() const { return files_.front(); }
  std::size_t file_count() const { return files_.size(); }
  // "line 12", or "harbour.yaml, line 12" of an included file: for messages about another place.
  std::string where(const std::string& path) const;

 private:
  struct Shown {
    TextPlace place;
    std::string message;
  };

  void add_error(const std::string& path, const std::string& text, TextPlace place);
  ConfigError all_errors() const;

  std::vector<std::string> files_;  // this one first
  std::map<std::string, TextPlace> places_;
  std::set<std::string> refused_;  // paths
  std::vector<Shown> shown_;       // by place, then as they came
  std::size_t errors_ = 0;
};

// `text` as it may stand in a message: control characters and what is not UTF-8 as \xNN, and cut
// after `longest` bytes, at a character's border, with "..." in place of the rest.
std::string printable(std::string_view text, std::size_t longest = 60);

}  // namespace skerry::server
