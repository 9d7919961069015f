// Settings, ships and the world as a file has them, brought into the ranges that the rest of the
// server relies on.
#pragma once

#include <google/protobuf/message.h>

namespace skerry::server {

// A file may have come from anywhere, while emulated radars and sentences cast these numbers to
// small integers.  Numbers are brought into the range of their field's name, or of its rule in the
// schema (what is no number is the range's least, or 0), unknown words of an enumeration become its
// first, texts end after kLongestText bytes, lists after kLongestList entries. Held by
// RecordedValues.EveryNumberHasARange.
void bring_into_range(google::protobuf::Message& message);
inline constexpr std::size_t kLongestText = 256;  // bytes; of UTF-8, whole characters
inline constexpr int kLongestList = 1024;

// Whether numbers of that field have a range.
bool has_range(const google::protobuf::FieldDescriptor& field);

}  // namespace skerry::server
