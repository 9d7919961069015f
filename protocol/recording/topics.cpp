#include "protocol/recording/topics.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <charconv>
#include <functional>
#include <set>

#include "protocol/recording/inputs.pb.h"
#include "protocol/recording/recording.pb.h"
#include "protocol/wire/radar.pb.h"

namespace skerry::recording {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;

constexpr std::string_view kPackedTopic = "packed_spokes";

template <typename M>
const google::protobuf::Message& empty() {
  return M::default_instance();
}

const Descriptor& message_of(const ChannelKind& channel) {
  return channel.packed ? *PackedSpokes::descriptor()
                        : *row_of(channel.topic.kind).message().GetDescriptor();
}

// The messages and enumerations of top level that a message is made of.
struct Parts {
  std::set<const Descriptor*> messages;
  std::set<const EnumDescriptor*> enums;

  void add(const Descriptor& message) {
    const Descriptor* top = &message;
    while (top->containing_type() != nullptr) top = top->containing_type();
    if (!messages.insert(top).second) return;
    add_fields(*top);
  }

 private:
  void add_fields(const Descriptor& message) {
    for (int i = 0; i < message.field_count(); ++i) {
      const FieldDescriptor& field = *message.field(i);
      if (field.message_type() != nullptr) add(*field.message_type());
      if (field.enum_type() != nullptr && field.enum_type()->containing_type() == nullptr) {
        enums.insert(field.enum_type());
      }
    }
    for (int i = 0; i < message.nested_type_count(); ++i) add_fields(*message.nested_type(i));
  }
};

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

namespace {

// Options are rules of controls: a reader of a recording needs none of them.
void without_options(google::protobuf::EnumDescriptorProto& type) {
  for (auto& value : *type.mutable_value()) value.clear_options();
}
void without_options(google::protobuf::DescriptorProto& type) {
  for (auto& field : *type.mutable_field()) field.clear_options();
  for (auto& nested : *type.mutable_nested_type()) without_options(nested);
  for (auto& nested : *type.mutable_enum_type()) without_options(nested);
}

}  // namespace

std::string schema_name(const ChannelKind& channel) { return message_of(channel).full_name(); }

std::string schema_data(const ChannelKind& channel) {
  const Descriptor& message = message_of(channel);
  Parts parts;
  parts.add(message);
  std::set<const FileDescriptor*> files;
  for (const Descriptor* part : parts.messages) files.insert(part->file());
  for (const EnumDescriptor* part : parts.enums) files.insert(part->file());

  google::protobuf::FileDescriptorSet set;
  std::set<const FileDescriptor*> added;
  // A file comes after those it needs.
  const std::function<void(const FileDescriptor&)> add_file = [&](const FileDescriptor& file) {
    if (!added.insert(&file).second) return;
    for (int i = 0; i < file.dependency_count(); ++i) {
      if (files.contains(file.dependency(i))) add_file(*file.dependency(i));
    }
    google::protobuf::FileDescriptorProto all;
    file.CopyTo(&all);
    google::protobuf::FileDescriptorProto& kept = *set.add_file();
    kept.set_name(all.name());
    kept.set_package(all.package());
    kept.set_syntax(all.syntax());
    for (int i = 0; i < file.dependency_count(); ++i) {
      if (files.contains(file.dependency(i))) kept.add_dependency(file.dependency(i)->name());
    }
    for (int i = 0; i < file.message_type_count(); ++i) {
      if (parts.messages.contains(file.message_type(i)))
        without_options(*kept.add_message_type() = all.message_type(i));
    }
    for (int i = 0; i < file.enum_type_count(); ++i) {
      if (parts.enums.contains(file.enum_type(i)))
        without_options(*kept.add_enum_type() = all.enum_type(i));
    }
  };
  add_file(*message.file());
  return set.SerializeAsString();
}

}  // namespace skerry::recording
