#include "protocol/recording/message_schema.hpp"

#include <google/protobuf/descriptor.pb.h>

#include <functional>
#include <set>

namespace skerry::recording {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;

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

std::string message_schema(const Descriptor& message) {
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
