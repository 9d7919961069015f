// The exercises that come with the server, by name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skerry::server {

// Where they lie: share/skerry/exercises beside the folder of the running program, where both the
// installation and the build put them.
std::filesystem::path exercises_folder();

// The YAML files of a folder, by name.  Empty if there is no such folder.
std::vector<std::filesystem::path> scenario_files(const std::filesystem::path& folder);

// What is meant by `name`: the file of that name or, if there is none, the shipped exercise
// ("crossing").  `name` itself if there is neither, so that opening it fails by that name.
std::string find_scenario(const std::string& name);

}  // namespace skerry::server
