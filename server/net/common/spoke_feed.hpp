// SpokeFeed: one view in one format, or a board's records, as seen from the network thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "protocol/wire/wire_error.hpp"
#include "server/core/radar_host.hpp"
#include "server/net/common/asio.hpp"

namespace skerry::server {

using SharedBytes = std::shared_ptr<const Bytes>;
// Keeps alive what the ring is part of: a channel or a board.
using FormatRingPtr = std::shared_ptr<FormatRing>;

// A second.
inline constexpr std::uint32_t kOwnShipLeastHz = 1, kOwnShipMostHz = 10, kExerciseMostHz = 4,
                               kTargetsMostHz = 2;

// Told of news; takes the spokes itself, from SpokeFeed::ring() with its own cursor.
// None of these may add or remove readers.  Thread: net-0.
class FeedReader {
 public:
  virtual ~FeedReader() = default;
  virtual void on_sector() = 0;
  // On the server's own host, or has shown the control token.
  virtual bool is_trusted() const { return true; }
  // How often it wants on_own_ship(): kOwnShipLeastHz .. kOwnShipMostHz.
  virtual std::uint32_t own_ship_hz() const { return kOwnShipLeastHz; }
  // How often it wants on_exercise(): 0 (not at all) .. kExerciseMostHz.
  virtual std::uint32_t exercise_hz() const { return 0; }
  virtual void on_exercise(const SharedBytes& /*frame*/) {}
  // How often it wants on_targets(): 0 (not at all) .. kTargetsMostHz.
  virtual std::uint32_t targets_hz() const { return 0; }
  virtual void on_targets(const SharedBytes& /*frame*/) {}
  virtual void on_settings(const SharedBytes& /*frame*/) {}
  virtual void on_own_ship(const SharedBytes& /*frame*/) {}
  virtual void on_world(const SharedBytes& /*frame*/) {}
  virtual void on_recorder(const SharedBytes& /*frame*/) {}
  virtual void on_playback(const SharedBytes& /*frame*/) {}
  virtual void on_fleet(const SharedBytes& /*frame*/) {}
  // A board's feed calls it now and then: the bytes that may wait in the kernel.
  virtual void on_send_buffer(std::size_t /*bytes*/) {}
};

// Wakes net-0 once per publish, and not once per reader: a publish while a wake-up is still posted
// posts none.  The format is encoded only while there are readers.
// Thread: net-0; destroy it only when its io_context runs no more, or with retire().
class SpokeFeed {
 public:
  SpokeFeed(asio::io_context& io, FormatRingPtr ring) : io_(io), ring_(std::move(ring)) {}

  // Destroys a feed without readers behind the wake-ups of it that are still posted.
  static void retire(std::unique_ptr<SpokeFeed> feed);

  // The reader's cursor begins at the next sector published.
  Cursor add(FeedReader& reader);
  // A reader of news alone: told of no sector, and nothing is encoded for it.
  void add_listener(FeedReader& reader) { readers_.push_back(&reader); }
  void remove(FeedReader& reader);  // no effect on one that was not added

  FormatRing& ring() { return *ring_; }
  const std::vector<FeedReader*>& readers() const { return readers_; }  // listeners among them

 private:
  void wake();  // radar thread

  asio::io_context& io_;
  FormatRingPtr ring_;
  std::vector<FeedReader*> readers_, takers_;  // takers_: those of them that take spokes
  std::atomic<bool> wake_posted_{false};
  FormatRing::Registration registration_;  // last: released before what its wake uses
};

}  // namespace skerry::server
