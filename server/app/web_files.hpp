// The web console as built into the server.
#pragma once

#include <span>

#include "server/net/common/net_config.hpp"

namespace skerry::server {

std::span<const WebFile> web_files();

}  // namespace skerry::server
