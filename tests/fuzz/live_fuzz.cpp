// A live radar: whatever comes from its network, what it gives on can be sent, and it holds no more
// than it promises.
#include "server/live/live_radar.hpp"

#include "protocol/wire/spoke_message.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using server::LiveRadar;

void require_sendable(const LiveRadar::News& news) {
  std::uint32_t scan = 0;
  for (const Spoke& spoke : news.spokes) {
    wire::Spoke message;
    to_message(spoke, message);
    const auto back = from_message(message);
    fuzz::require(back.ok(), "a live spoke is one of the native protocol");
    fuzz::require(back->cells == spoke.cells, "its cells are what came");
    fuzz::require(news.anew || spoke.header.scan >= scan, "turns do not go back");
    scan = spoke.header.scan;
  }
}

void listen(std::span<const std::uint8_t> capture, const server::LiveKind& kind) {
  server::LiveSource source;
  source.kind = &kind;
  if (kind.has_address) source.at = Ipv4Endpoint{ipv4(239, 192, 43, 78), 4378};
  LiveRadar radar(source);
  UtcTime last{};
  (void)pcap::read_capture(capture, [&](const pcap::Datagram& each) {
    LiveRadar::News news;
    radar.take(each, news);
    radar.look(each.time, news);
    require_sendable(news);
    last = std::max(last, each.time);
  });
  LiveRadar::News news;
  radar.look(std::min(last, UtcTime::max() - LiveRadar::kSilence) + LiveRadar::kSurvey, news);
  require_sendable(news);
  fuzz::require(radar.groups().all().size() <= server::LiveGroups::kMost, "few groups");
  (void)radar.own_ship(last);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const char* kind : {"navico_halo", "garmin_xhd", "raymarine_quantum", "raymarine_rd",
                           "furuno_drs", "cat240", "native"}) {
    listen({data, size}, *server::find_live_kind(kind));
  }
  return 0;
}
