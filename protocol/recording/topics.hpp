// Topics of a recording as channels of MCAP: their names and their schemas.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/recording/item.hpp"

namespace skerry::recording {

// What a channel carries: items of a topic, or spokes of one packed together.
struct ChannelKind {
  Topic topic;
  bool packed = false;  // only of spokes
  friend constexpr auto operator<=>(const ChannelKind&, const ChannelKind&) = default;
};

// "hello", "radar/1/own_ship", "radar/1/view/0/spokes", "radar/1/view/0/packed_spokes".
std::string name_of(const ChannelKind& channel);
// Of numbers without leading zeros up to 2^32-1; nothing for other names.
std::optional<ChannelKind> channel_named(std::string_view name);

// "skerry.wire.Spoke"
std::string schema_name(const ChannelKind& channel);
// The FileDescriptorSet of that message and what it is made of, nothing else of its file.
std::string schema_data(const ChannelKind& channel);

}  // namespace skerry::recording
