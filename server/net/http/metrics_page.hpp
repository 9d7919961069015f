// The page /metrics: the status message as monitoring reads it.
#pragma once

#include <string>

#include "protocol/wire/radar.pb.h"
#include "server/net/common/client_registry.hpp"
#include "server/net/http/metrics_text.hpp"

namespace skerry::server {

// All numbers of `status` in base units (seconds, bytes, ratio), and of clients the sums by
// transport.  What the status does not have (recorder, playback, boards) is left out.  Nothing says
// who the clients and displays are, or where files lie.  At most MetricsText::kMaxBytes.
std::string metrics_page(const wire::Status& status, const ClientTotalsByTransport& clients,
                         MetricsFormat format);

}  // namespace skerry::server
