// Json: documents of the Signal K interfaces, and how those of others are read.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace skerry::signalk {

// Members stand in the order in which they were written.
using Json = nlohmann::ordered_json;

// A whole document; nothing if the text is not JSON, deeper than kMaxDepth, or longer than
// kMaxText.  Never throws.  What comes back is bounded by a multiple of the text.
inline constexpr std::size_t kMaxText = 64 * 1024;
inline constexpr int kMaxDepth = 16;
std::optional<Json> read_json(std::string_view text);

// The member of an object; nullptr if it is no object or has none of that name.
const Json* member(const Json& object, const char* name);
// The same as text; empty if it is not there or no text.
std::string text_member(const Json& object, const char* name);
// A finite number, also one written as a text ("50"), as older displays do.
std::optional<double> number_in(const Json& value);

// Whole numbers without a fraction: 5556, not 5556.0.
Json number_document(double value);

// One line of text; what is not UTF-8 becomes U+FFFD.
std::string text_of(const Json& document);

}  // namespace skerry::signalk
