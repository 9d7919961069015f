// HttpSession: one HTTP connection: the web console, /status, and the way to a WebSocket at /ws.
#pragma once

#include <memory>

#include "server/net/net_context.hpp"
#include "server/net/web_answer.hpp"

namespace skerry::server {

// Serves GET and HEAD, keeps the connection open between requests; bounded in bytes and in time
// (NetConfig::http_timeout).  Hands the socket to a NativeSession after an upgrade.
// `files` must outlive the session.  Thread: net-0.
void begin_http_session(NetContext& context, const WebFiles& files, TcpSocket socket,
                        ConnectionSlotPtr slot);

}  // namespace skerry::server
