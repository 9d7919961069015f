// HttpSession: one HTTP connection: the web console, /status, /metrics, Signal K, and the way to a
// WebSocket at /ws or one of Signal K's.
#pragma once

#include <memory>

#include "server/net/common/net_context.hpp"
#include "server/net/common/peer_stream.hpp"
#include "server/net/http/web_answer.hpp"
#include "server/net/signalk/signalk_site.hpp"

namespace skerry::server {

// Serves GET and HEAD, and of Signal K and set-ups all their methods; keeps the connection open
// between requests; bounded in bytes and in time (PeerLimits, NetConfig::http_timeout).  Hands the
// socket to a NativeSession or a Signal K session after an upgrade. `site` is nullptr where no
// Signal K is served; it and `files` must outlive the session.  Where the
// server has a certificate, other hosts in the clear are sent on to https.  Thread: net-0.
void begin_http_session(NetContext& context, const WebFiles& files, SignalkSite* site,
                        PeerStream stream, ConnectionSlotPtr slot);

}  // namespace skerry::server
