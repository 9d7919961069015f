#include "protocol/recording/topics.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <charconv>

#include "protocol/recording/inputs.pb.h"
#include "protocol/recording/message_schema.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/wire/radar.pb.h"

namespace skerry::recording {
namespace {

using google::protobuf::Descriptor;

constexpr std::string_view kPackedTopic = "packed_spokes";

template <typename M>
const google::protobuf::Message& empty() {
  return M::default_instance();
}

const Descriptor& message_of(const ChannelKind& channel) {
  return channel.packed ? *PackedSpokes::descriptor()
                        : *row_of(channel.topic.kind).message().GetDescriptor();
}

bool number_of(std::string_view text, std::uint32_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() &&
         (text.size() == 1 || text.front() != '0');
}

// Takes what stands before the next '/', or all, from `rest`.
std::string_view take_part(std::string_view& rest) {
  const std::size_t slash = rest.find('/');
  const std::string_view first = rest.substr(0, slash);
  rest = slash == std::string_view::npos ? std::string_view() : rest.substr(slash + 1);
  return first;
}

}  // namespace

const std::array<KindRow, kKinds>& kind_rows() {
  using enum EditRule;
  static constexpr std::array<KindRow, kKinds> kRows = {{
      {Kind::hello, "hello", "hello", Scope::recording, once, false, empty<wire::Hello>},
      {Kind::spoke, "spokes", "spokes", Scope::view, copied, true, empty<wire::Spoke>},
      {Kind::settings, "settings", "settings", Scope::view, state, true, empty<wire::Settings>},
      {Kind::own_ship, "own_ship", "own ship", Scope::radar, state, true, empty<wire::OwnShip>},
      {Kind::world, "world", "world", Scope::recording, state, true, empty<wire::World>},
      {Kind::traffic, "traffic", "traffic", Scope::recording, copied, true, empty<Traffic>},
      {Kind::event, "events", "events", Scope::recording, copied, false, empty<Event>},
      {Kind::log, "log", "log lines", Scope::recording, copied, false, empty<Log>},
      {Kind::input, "inputs", "inputs", Scope::recording, cumulated, false, empty<Input>},
      {Kind::exercise, "exercise", "exercise states", Scope::recording, state, true,
       empty<wire::ExerciseState>},
      {Kind::targets, "targets", "lists of targets", Scope::view, state, false,
       empty<wire::TargetList>},
      {Kind::plots, "plots", "lists of plots", Scope::view, copied, false,
       empty<wire::TargetPlots>},
      {Kind::audit, "audit", "entries of the audit", Scope::recording, copied, false,
       empty<AuditEntry>},
  }};
  return kRows;
}

std::string name_of(const ChannelKind& channel) {
  const Topic& topic = channel.topic;
  const KindRow& row = row_of(topic.kind);
  std::string name;
  if (row.scope != Scope::recording) name = fmt::format("radar/{}/", topic.radar);
  if (row.scope == Scope::view) name += fmt::format("view/{}/", topic.view);
  return name.append(channel.packed ? kPackedTopic : row.topic);
}

std::optional<ChannelKind> channel_named(std::string_view name) {
  ChannelKind channel;
  Scope scope = Scope::recording;
  if (name.starts_with("radar/")) {
    take_part(name);
    if (!number_of(take_part(name), channel.topic.radar)) return std::nullopt;
    scope = Scope::radar;
    if (name.starts_with("view/")) {
      take_part(name);
      if (!number_of(take_part(name), channel.topic.view)) return std::nullopt;
      scope = Scope::view;
    }
  }
  channel.packed = name == kPackedTopic;
  const std::string_view topic = channel.packed ? row_of(Kind::spoke).topic : name;
  for (const KindRow& row : kind_rows()) {
    if (row.topic != topic || row.scope != scope) continue;
    channel.topic.kind = row.kind;
    return channel;
  }
  return std::nullopt;
}

std::string schema_name(const ChannelKind& channel) { return message_of(channel).full_name(); }

std::string schema_data(const ChannelKind& channel) { return message_schema(message_of(channel)); }

}  // namespace skerry::recording
