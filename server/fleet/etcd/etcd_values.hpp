// Values of the fleet and of etcd.
#pragma once

#include "server/fleet/etcd/rpc.pb.h"
#include "server/fleet/key_store.hpp"

namespace skerry::fleet {

StoreHeader header_of(const etcdserverpb::ResponseHeader& header);
KeyValue key_of(mvccpb::KeyValue key);

}  // namespace skerry::fleet
