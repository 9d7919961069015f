// The kinds of recorded items, a row each, and their topics as channels of MCAP.
#pragma once

#include <google/protobuf/message.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/recording/item.hpp"

namespace skerry::recording {

// Which numbers a topic has in its name.
enum class Scope : std::uint8_t { recording, radar, view };

// The rule by which `skerry recording cut` and `cat` treat items of a kind.
enum class EditRule : std::uint8_t {
  copied,     // cut: those of the part; cat: all
  state,      // the same, but cut also writes the last one before the part at the part's begin
  cumulated,  // cut: also all before the part; cat: each once, of one exercise only
  once,       // cut and cat write one of their own at the begin
};

// All that holds for a kind.  An item's bytes are its message as protobuf serialises it; in compact
// mode spokes are packed (packed_spokes.hpp).  `export` and `verify` read spokes and what they are
// shown with; verify copies all other kinds to its --video.
struct KindRow {
  Kind kind;
  std::string_view topic;  // the last part of its name
  std::string_view title;  // for people; plural where there are many
  Scope scope;
  EditRule edit;
  bool is_played;                                 // by skerryd --play (RelayedState, Player)
  const google::protobuf::Message& (*message)();  // the default instance
};
// In the order of Kind.
const std::array<KindRow, kKinds>& kind_rows();
inline const KindRow& row_of(Kind kind) { return kind_rows()[static_cast<std::size_t>(kind)]; }
// Whether topics of that kind name a radar.
inline bool is_of_a_radar(Kind kind) { return row_of(kind).scope != Scope::recording; }

// The content of a channel: items of a topic, or spokes of one packed together.
struct ChannelKind {
  Topic topic;
  bool packed = false;  // only of spokes
  friend constexpr auto operator<=>(const ChannelKind&, const ChannelKind&) = default;
};

// "hello", "radar/1/own_ship", "radar/1/view/0/spokes", "radar/1/view/0/packed_spokes".
std::string name_of(const ChannelKind& channel);
// The numbers are decimal, without leading zeros, at most 2^32-1.  Nothing for other names.
std::optional<ChannelKind> channel_named(std::string_view name);

// "skerry.wire.Spoke"
std::string schema_name(const ChannelKind& channel);
// A FileDescriptorSet of that message and of those it is made of; nothing else of their files.
std::string schema_data(const ChannelKind& channel);

}  // namespace skerry::recording
