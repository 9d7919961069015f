// LiveGroups: where to listen for a radar, as far as it has told.
#pragma once

#include <optional>
#include <vector>

#include "protocol/pcap/capture_reader.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"
#include "server/live/live_source.hpp"

namespace skerry::server {

// The addresses of a kind that are fixed, and those that locators announce.  At most kMost: a
// network full of false locators cannot make it listen to more.
// Thread: one at a time.
class LiveGroups {
 public:
  static constexpr std::size_t kMost = 24;

  explicit LiveGroups(const LiveSource& source);

  // Whether there is more to listen to now.
  bool hear(const pcap::Datagram& datagram);
  // Forgets the groups that locators announced: a radar may come back with others.  Commands go
  // where they went until it says another place.
  void begin_anew();
  const std::vector<Ipv4Endpoint>& all() const { return all_; }
  // Whether a picture that goes there is the source's: range A or B of a radar with two, anything
  // else of the others.
  bool is_picture(const Ipv4Endpoint& to) const;
  // What to ask the network, and where, so that radars announce themselves; empty: nothing.
  struct Question {
    Ipv4Endpoint to;
    Bytes octets;
  };
  const std::vector<Question>& questions() const { return questions_; }
  // Where the radar takes commands, as far as is known.
  const std::optional<Ipv4Endpoint>& commands() const { return commands_; }
  // Announced radars that found no room.
  std::uint64_t left_out() const { return left_out_; }

 private:
  bool add(const Ipv4Endpoint& at);

  LiveSource source_;
  std::vector<Ipv4Endpoint> all_;
  std::vector<Ipv4Endpoint> others_;  // pictures of the range that is not wanted
  std::vector<Question> questions_;
  std::optional<Ipv4Endpoint> commands_;
  std::uint64_t left_out_ = 0;
};

}  // namespace skerry::server
