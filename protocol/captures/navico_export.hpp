// NavicoExport: spokes into the datagrams of a Navico radar.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/navico/frame.hpp"
#include "protocol/navico/model.hpp"
#include "protocol/pcap/pcap_writer.hpp"
#include "protocol/video/spoke_resampler.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::captures {

// Thread: one at a time.
class NavicoExport {
 public:
  NavicoExport(navico::Model model, pcap::PcapWriter& out);

  // Those of the spokes to come.
  void set(const wire::Settings& settings) { settings_ = settings; }
  void add(const Spoke& spoke);
  // The frame in the making.
  void finish();

  std::uint64_t cut() const { return cut_; }

 private:
  void write_reports(UtcTime time);
  void fit_range(const Spoke& spoke);
  const Spoke& fit_cells(const Spoke& spoke);
  void append(const SpokeHeader& header, std::span<const std::uint8_t> cells,
              std::span<const DopplerClass> doppler);
  void write_frame();

  navico::Model model_;
  pcap::PcapWriter& out_;
  wire::Settings settings_;
  SpokeResampler resampler_;
  Spoke fitted_;
  double reach_m_ = 0.0;
  std::uint32_t range_dm_ = 0;
  navico::SpokeRange range_;
  Bytes spokes_;  // of the frame in the making
  std::size_t held_ = 0;
  std::uint16_t rotation_ = 0;
  std::uint64_t cut_ = 0;
  UtcTime last_{};
  std::optional<UtcTime> reported_;
};

}  // namespace skerry::captures
