// Survey: which pictures are in a capture, and what must be known before they can be read.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "protocol/captures/picture_decoder.hpp"

namespace skerry::captures {

struct SurveyedPicture {
  PictureTraits traits;
  bool certain = true;        // of a Navico: its generation is not a guess
  std::string name;           // "HALO20", "4G A", "Garmin xHD"
  std::uint64_t spokes = 0;   // that could be read
  std::uint64_t refused = 0;  // datagrams that could not
  std::string refusal;        // of the first of them
  std::uint32_t cells = 0;    // of a spoke, at most
  std::uint32_t bits = 8;
  double rpm = 0.0;  // 0: not known
};

// More pictures than these are left out; a capture has one or two.
inline constexpr std::size_t kMaxPictures = 32;

// Give it every datagram of a capture, then ask.  Memory: bounded.  Thread: one at a time.
class Surveyor {
 public:
  Surveyor();
  ~Surveyor();

  void take(const pcap::Datagram& datagram);

  // Those of which spokes could be read, in the order of their first datagrams.
  std::vector<SurveyedPicture> pictures() const;
  std::uint64_t left_out() const { return left_out_; }  // datagrams of more pictures
  UtcTime begin() const { return begin_; }              // the earliest datagram
  UtcTime end() const { return end_; }
  // "449 to 239.255.0.2:10024, ...": where most of what is no picture went.
  std::string others() const;

 private:
  struct Seen;   // a picture
  struct Facts;  // what Navico radars said of themselves

  Seen* find_or_begin(const PictureKey& key);
  void finish(const Seen& seen, SurveyedPicture& picture) const;

  std::vector<std::unique_ptr<Seen>> seen_;
  std::unique_ptr<Facts> facts_;
  std::map<Ipv4Endpoint, std::uint64_t> others_;
  std::set<std::uint32_t> doppler_quantums_;            // senders
  std::map<std::uint32_t, std::string> furuno_models_;  // by sender
  std::uint64_t left_out_ = 0;
  UtcTime begin_ = UtcTime::max(), end_ = UtcTime::min();
};

}  // namespace skerry::captures
