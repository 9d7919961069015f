// ViewPlotter: the plotter of one view at work.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "server/core/latest.hpp"
#include "server/core/ring_reader.hpp"
#include "server/core/target_port.hpp"
#include "server/plotter/plotter.hpp"
#include "server/tracking/watch/target_watch.hpp"

namespace skerry::server {

// Takes a view's spokes from its ring, and makes lists of targets.
// Thread: take() and tell() are the plotters' thread's; the rest any thread's.  An order waits for
// at most a sector's work.
class ViewPlotter {
 public:
  static constexpr int kSectorsAtOnce = 8;
  // Spokes that are older than the newest by less than this have been looked at: two turns and
  // more.
  static constexpr Duration kSentAgain = std::chrono::seconds(15);

  // `wake` is called on the radar's thread.  Requires a channel with the format kNativeFormat.
  // `beam_deg`: of the radar's antenna; 0: not known.
  ViewPlotter(std::uint32_t radar, std::uint32_t view, VideoChannelPtr channel,
              const std::string& format, double beam_deg, std::function<void()> wake);

  bool is_of(const VideoChannel& channel) const { return reader_.is_of(channel); }

  // Spokes of at most kSectorsAtOnce sectors; true if more may wait.  Without heading or position
  // they are taken, and given to nobody.
  bool take(const OwnSensors& own);
  // Makes a list.
  void tell(const OwnSensors& own, std::span<const AisContact> ais);

  TargetListPtr list() const { return list_.get(); }
  TargetPlotsPtr plots() const { return plots_.get(); }
  wire::Reply order(const wire::TargetOrder& order);

 private:
  void give(std::span<const std::uint8_t> frame);
  void note_plots();

  RingReader reader_;
  wire::ServerMessage message_;
  std::uint64_t spokes_lost_ = 0;  // of the ring

  std::mutex mutex_;  // of what follows
  TargetWatch watch_;
  Plotter plotter_;
  ScenarioTime newest_{};        // of the spokes
  wire::TargetPlots new_plots_;  // since the last list
  std::uint64_t plots_so_far_ = 0;

  Latest<wire::TargetList> list_;
  Latest<wire::TargetPlots> plots_;
};

}  // namespace skerry::server
