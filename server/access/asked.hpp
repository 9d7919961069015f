// What a message of the native protocol asks for, in the words of the table of rights.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

struct Asked {
  std::vector<std::string> rights;  // all are needed; "sign_in" is everybody's
  std::uint32_t radar = 0;          // of messages that name one
  std::string token;                // of messages that carry one
};

// Thread: any.
Asked asked_by(const wire::ClientMessage& message);

}  // namespace skerry::server
