// SpokeBatch: spokes that came from another server, as a sector and as the bytes they came in.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "protocol/video/spoke.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/core/video_channel.hpp"

namespace skerry::server {

// Collects consecutive spokes of one turn of one view.  Their frames are kept as they came, so that
// whoever reads them here has what the other server's own consoles have, to the bit.
// Thread: one at a time.
class SpokeBatch {
 public:
  static constexpr std::size_t kMostSpokes = 256, kMostBytes = 64 * 1024;

  // `local_view`: the number that it has here.
  SpokeBatch(std::uint32_t radar, std::uint32_t view, std::uint32_t local_view)
      : radar_(radar), view_(view), local_view_(local_view) {}

  // A spoke whose message had that body.  What does not follow those collected is not taken: take()
  // them first (follows()).
  // Error: what is wrong with it.
  std::optional<std::string> add(const wire::Spoke& spoke, std::span<const std::uint8_t> body);
  // One that came in another form: it leaves as a message of its own.
  std::optional<std::string> add(Spoke spoke);
  bool follows(std::uint64_t sequence, std::uint32_t scan) const;
  bool is_empty() const { return sector_.spokes.empty(); }
  bool is_full() const {
    return sector_.spokes.size() >= kMostSpokes ||
           (encoded_ != nullptr && encoded_->bytes.size() >= kMostBytes);
  }

  // Nothing is left.  Requires some.
  struct Spokes {
    Sector sector;
    EncodedSectorPtr native;
  };
  Spokes take();

 private:
  std::optional<std::string> fault_of(std::uint32_t radar, std::uint32_t view) const;
  void begin(std::uint64_t sequence, std::uint32_t scan, std::size_t bytes);
  void end_spoke(std::shared_ptr<const Spoke> spoke);

  std::uint32_t radar_, view_, local_view_;
  Sector sector_;
  std::shared_ptr<EncodedSector> encoded_;  // nullptr: empty
};

// The same with numbers that are larger by `shift`, modulo 2^64.
SpokeBatch::Spokes renumbered(const SpokeBatch::Spokes& spokes, std::uint64_t shift);

}  // namespace skerry::server
