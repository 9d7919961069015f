// A protobuf message's definition, as MCAP files hold it.
#pragma once

#include <google/protobuf/descriptor.h>

#include <string>

namespace skerry::recording {

// A serialised FileDescriptorSet of that message and of those it is made of; nothing else of their
// files, and no options.
std::string message_schema(const google::protobuf::Descriptor& message);

}  // namespace skerry::recording
