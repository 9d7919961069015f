// What etcd's refusals mean to the fleet.
#pragma once

#include <grpc/support/time.h>
#include <grpcpp/support/status.h>

#include <string_view>

#include "server/fleet/host_clock.hpp"
#include "server/fleet/store_error.hpp"

namespace skerry::fleet {

// `connected`: the member was, when the call ended.  Texts are etcd's.
// Source: etcd 3.4, etcdserver/api/v3rpc/rpctypes/error.go.
StoreError store_error_of(const grpc::Status& status, std::string_view member, bool connected);

// gRPC's deadlines by a clock that is never set.
gpr_timespec as_deadline(HostTime deadline, HostTime now);

}  // namespace skerry::fleet
