#include "server/fleet/etcd/etcd_values.hpp"

#include <utility>

namespace skerry::fleet {

StoreHeader header_of(const etcdserverpb::ResponseHeader& header) {
  return {header.cluster_id(), header.member_id(), header.revision()};
}

KeyValue key_of(mvccpb::KeyValue key) {
  return {std::move(*key.mutable_key()), std::move(*key.mutable_value()), key.create_revision(),
          key.mod_revision(), key.lease()};
}

}  // namespace skerry::fleet
