#include "server/app/greeting.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <iterator>
#include <variant>

#include "protocol/wire/host_and_port.hpp"
#include "server/app/version.hpp"

namespace skerry::server {
namespace {

// No right of root's is needed.  A right to a higher priority is used if there is one (NetServer).
void tell_of_root() {
  if (geteuid() != 0) return;
  spdlog::warn(
      "skerryd runs as root and does not need to; start it as a user of its own, who may write "
      "to the folder of recordings");
}

}  // namespace

void greet(const Options& options, const NetServer& net, const std::string& what) {
  const std::string& host = options.net.bind;
  std::fprintf(stderr,
               "%s: %s\n"
               "  web console      http%s://%s/\n"
               "  native protocol  %s %s\n",
               kServerName, what.c_str(), options.net.tls.empty() ? "" : "s",
               host_and_port(host, net.http_port()).c_str(),
               options.net.tls.empty() ? "tcp" : "tls",
               host_and_port(host, net.tcp_port()).c_str());
  for (const StreamOutputConfig& stream : options.net.streams) {
    constexpr const char* kNames[] = {"native datagrams", "ASTERIX CAT240", "board's records"};
    static_assert(std::size(kNames) == std::variant_size_v<decltype(stream.shape)>);
    std::fprintf(stderr, "  %-16s udp %s (radar %u)\n", kNames[stream.shape.index()],
                 host_and_port(stream.to.address, stream.to.port).c_str(), stream.to.radar);
  }
  for (const DisplayOutputConfig& d : options.net.displays) {
    std::fprintf(stderr, "  %-16s at %s (radar %u)\n", d.identity.family.c_str(),
                 d.interface_address.c_str(), d.sources.front().radar);
  }
  for (const LiveSource& live : options.live) {
    std::fprintf(stderr, "  %-16s listened for at %s (radar %u)\n",
                 std::string(live.kind->name).c_str(), live.interface_address.c_str(), live.radar);
  }
  const wire::Status status = net.status();
  for (const wire::OutputStatus& nmea : status.outputs()) {
    if (!nmea.name().starts_with("nmea")) continue;
    std::fprintf(stderr, "  %-16s %s (radar %u)\n", nmea.name().c_str(), nmea.address().c_str(),
                 nmea.radar());
  }
  tell_of_root();
  std::fprintf(stderr, "  stop with Ctrl-C\n");
  if (options.print_ports) {
    std::printf("tcp %u http %u\n", net.tcp_port(), net.http_port());
    std::fflush(stdout);
  }
}

}  // namespace skerry::server
