// fleet_store: the way to the fleet's store, whose library is loaded when it is asked for.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/fleet/key_store.hpp"

namespace skerry::server {

// Members of an etcd, "host:port" each; `tls`: folder with ca.pem, host.pem and host.key, or empty.
// Error: std::runtime_error, the library or a file is not there: what to do.
std::function<std::unique_ptr<fleet::KeyStore>()> open_fleet_store(
    const std::vector<std::string>& members, const std::string& tls);

}  // namespace skerry::server
