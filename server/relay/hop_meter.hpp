// HopMeter: how a relay is connected to the server before it.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// Thread: any.  Time is passed in.
class HopMeter {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kRateOver{4};  // of bytes
  static constexpr std::size_t kRoundTrips = 5;        // of which the median is told

  // `upstream`: whom the relay is a client of.
  HopMeter(std::string upstream, Time now) : since_(now) { status_.set_upstream(upstream); }

  void connected(const std::string& server, Time now);
  void gone(const std::string& why, Time now);
  // A connection that is there has something to complain of; empty: nothing any more.
  void set_problem(const std::string& problem);
  void received(std::uint64_t spokes, std::uint64_t lost, std::uint64_t bytes, Time now);
  void set_thin(std::uint32_t level);
  void round_trip(std::chrono::steady_clock::duration time);
  void asked();
  void refused();
  // What the other server tells of its own way.
  void set_before(const wire::Hops& before);

  // The nearest first.
  std::vector<wire::HopStatus> tell(Time now) const;

 private:
  mutable std::mutex mutex_;
  wire::HopStatus status_;
  bool was_connected_ = false;
  Time since_;
  std::deque<std::pair<Time, std::uint64_t>> bytes_;  // so many had come then
  std::deque<double> round_trips_ms_;
  std::vector<wire::HopStatus> before_;
};

}  // namespace skerry::server
