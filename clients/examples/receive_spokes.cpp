// Receives one radar's spokes and prints, once per turn, what a display would draw.
// Build against an installed Skerry:  find_package(skerry) and link skerry::client_library.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <variant>

#include "clients/common/spoke_client.hpp"
#include "protocol/video/scan.hpp"

int main(int argc, char** argv) {
  using namespace skerry;
  using namespace std::chrono_literals;
  const char* host = argc > 1 ? argv[1] : client::kDefaultHost;
  const int turns = argc > 2 ? std::atoi(argv[2]) : 3;

  auto radar = client::SpokeClient::connect(host, client::kDefaultTcpPort, 5s);
  if (!radar) return std::fprintf(stderr, "%s\n", radar.error().text.c_str()), 1;
  if (auto subscribed = radar->subscribe(0, 0, 5s); !subscribed) {
    return std::fprintf(stderr, "%s\n", subscribed.error().text.c_str()), 1;
  }

  ScanAssembler assembler;
  for (int turn = 0; turn < turns;) {
    auto event = radar->receive(5s);
    if (!event) return std::fprintf(stderr, "%s\n", event.error().text.c_str()), 1;
    if (!*event) return std::fprintf(stderr, "nothing for 5 s\n"), 1;
    auto* spoke = std::get_if<Spoke>(&**event);
    if (!spoke) continue;  // settings, own ship: std::get_if<wire::Settings>(&**event) ...
    if (auto scan = assembler.feed(std::move(*spoke))) {
      const SpokeHeader& header = scan->newest()->header;
      std::printf("scan %u: %u of %u spokes, range %g NM, heading %.1f, lost %llu\n", scan->number,
                  scan->received, scan->geometry.spokes_per_turn,
                  header.range_scale.in_nautical_miles(), header.heading.in_degrees(),
                  static_cast<unsigned long long>(radar->losses().lost()));
      ++turn;
    }
  }
}
