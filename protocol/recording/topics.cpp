#include "protocol/recording/topics.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <array>
#include <charconv>
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

const Descriptor& message_of(const ChannelKind& channel) {
  switch (channel.topic.kind) {
    case Kind::hello:
      return *wire::Hello::descriptor();
    case Kind::spoke:
      return channel.packed ? *PackedSpokes::descriptor() : *wire::Spoke::descriptor();
    case Kind::settings:
      return *wire::Settings::descriptor();
    case Kind::own_ship:
      return *wire::OwnShip::descriptor();
    case Kind::world:
      return *wire::World::descriptor();
    case Kind::traffic:
      return *Traffic::descriptor();
    case Kind::event:
      return *Event::descriptor();
    case Kind::log:
      return *Log::descriptor();
    case Kind::input:
      break;
  }
  return *Input::descriptor();
}

// What a message is made of, of its own file: of top level only, with what is nested in it.
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

// What comes before the next '/', or all; `rest` is what comes after.
std::string_view first_of(std::string_view& rest) {
  const std::size_t slash = rest.find('/');
  const std::string_view first = rest.substr(0, slash);
  rest = slash == std::string_view::npos ? std::string_view() : rest.substr(slash + 1);
  return first;
}

}  // namespace

std::string name_of(const ChannelKind& channel) {
  const Topic& topic = channel.topic;
  switch (topic.kind) {
    case Kind::hello:
      return "hello";
    case Kind::spoke:
      return fmt::format("radar/{}/view/{}/{}", topic.radar, topic.view,
                         channel.packed ? "packed_spokes" : "spokes");
    case Kind::settings:
      return fmt::format("radar/{}/view/{}/settings", topic.radar, topic.view);
    case Kind::own_ship:
      return fmt::format("radar/{}/own_ship", topic.radar);
    case Kind::world:
      return "world";
    case Kind::traffic:
      return "traffic";
    case Kind::event:
      return "events";
    case Kind::log:
      return "log";
    case Kind::input:
      break;
  }
  return "inputs";
}

std::optional<ChannelKind> channel_named(std::string_view name) {
  if (name == "hello") return ChannelKind{{Kind::hello}};
  if (name == "world") return ChannelKind{{Kind::world}};
  if (name == "traffic") return ChannelKind{{Kind::traffic}};
  if (name == "events") return ChannelKind{{Kind::event}};
  if (name == "log") return ChannelKind{{Kind::log}};
  if (name == "inputs") return ChannelKind{{Kind::input}};
  ChannelKind channel;
  Topic& topic = channel.topic;
  if (first_of(name) != "radar" || !number_of(first_of(name), topic.radar)) return std::nullopt;
  std::string_view what = first_of(name);
  if (name.empty() && what == "own_ship") return ChannelKind{{Kind::own_ship, topic.radar}};
  if (what != "view" || !number_of(first_of(name), topic.view)) return std::nullopt;
  if (name == "settings") {
    topic.kind = Kind::settings;
  } else if (name == "spokes" || name == "packed_spokes") {
    topic.kind = Kind::spoke;
    channel.packed = name == "packed_spokes";
  } else {
    return std::nullopt;
  }
  return channel;
}

std::string schema_name(const ChannelKind& channel) { return message_of(channel).full_name(); }

std::string schema_data(const ChannelKind& channel) {
  const Descriptor& message = message_of(channel);
  Parts parts;
  parts.add(message);
  std::set<const FileDescriptor*> files;
  for (const Descriptor* part : parts.messages) files.insert(part->file());
  for (const EnumDescriptor* part : parts.enums) files.insert(part->file());

  // A file comes after those it needs: the message's own last.
  google::protobuf::FileDescriptorSet set;
  const auto add_file = [&](const FileDescriptor& file) {
    google::protobuf::FileDescriptorProto all;
    file.CopyTo(&all);
    google::protobuf::FileDescriptorProto& kept = *set.add_file();
    kept.set_name(all.name());
    kept.set_package(all.package());
    kept.set_syntax(all.syntax());
    for (const FileDescriptor* other : files) {
      if (other != &file && &file == message.file()) kept.add_dependency(other->name());
    }
    for (int i = 0; i < file.message_type_count(); ++i) {
      if (parts.messages.contains(file.message_type(i)))
        *kept.add_message_type() = all.message_type(i);
    }
    for (int i = 0; i < file.enum_type_count(); ++i) {
      if (parts.enums.contains(file.enum_type(i))) *kept.add_enum_type() = all.enum_type(i);
    }
  };
  for (const FileDescriptor* file : files) {
    if (file != message.file()) add_file(*file);
  }
  add_file(*message.file());
  return set.SerializeAsString();
}

}  // namespace skerry::recording
