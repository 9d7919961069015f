// Names of recordings.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

inline constexpr std::size_t kMaxName = 100;  // bytes
inline constexpr std::string_view kFileEnding = ".mcap";

// Why that cannot be a recording's name, if it cannot: letters of any script and digits, and within
// them space, ".", "_" and "-".  So no name leaves its folder, hides in it or looks like another.
std::optional<std::string> fault_in_file_name(std::string_view name);
// A mark's name may be any UTF-8 text without control characters.
std::optional<std::string> fault_in_mark_name(std::string_view name);

// "2026-11-22 103000Z".
std::string name_of_time(UtcTime time);
// The file of that number in a series, from 1: "NAME.mcap", "NAME-002.mcap", ...
std::string file_name(const std::string& name, std::uint32_t number);

}  // namespace skerry::server
