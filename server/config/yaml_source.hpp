// YamlSource: where in a file each key stood, for checks made after it was read.
#pragma once

#include <map>
#include <string>

#include "server/config/config_error.hpp"

namespace skerry::server {

// Paths are as in messages: "own_ships[0].radars[1].rpm"; "" is the file itself.
class YamlSource {
 public:
  explicit YamlSource(std::string file_name) : file_name_(std::move(file_name)) {}

  void add(const std::string& path, TextPlace place) { places_[path] = place; }

  // Whether the file gives a value for the path (and not a default).
  bool has(const std::string& path) const { return places_.count(path) != 0; }

  // Of the value at `path`, or of the innermost list or map around it that the file holds.
  TextPlace place_of(std::string path) const;

  // The error to throw for the value at `path`.
  ConfigError error(const std::string& path, const std::string& text) const {
    return ConfigError(file_name_, place_of(path), path, text);
  }

  const std::string& file_name() const { return file_name_; }

 private:
  std::string file_name_;
  std::map<std::string, TextPlace> places_;
};

}  // namespace skerry::server
