// LiveRadar: what comes from a real radar's network, into spokes, settings and own ship.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/captures/ship_track.hpp"
#include "protocol/captures/spoke_fitter.hpp"
#include "protocol/captures/survey.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/live/live_groups.hpp"

namespace skerry::server {

// Cells are as the import of a capture of the same datagrams has them.
//
// It looks first: from the first datagram of a wanted picture on for kSurvey, or until kMostHeld
// octets came, datagrams are held; then it knows the model and the turn, and takes those held and
// all later ones.  The picture is that of one sender: another radar of the same kind is counted and
// left alone.  Of a Navico the input's kind decides what its reports and spokes leave open; where
// they tell another generation, they are believed.  After kSilence without a spoke it looks anew:
// the radar may come back as another. Memory: kMostHeld while it looks, and that of SpokeFitter. No
// sockets, no clocks, no threads; one thread at a time.
class LiveRadar {
 public:
  static constexpr Duration kSurvey = std::chrono::milliseconds(1500);
  static constexpr Duration kSilence = std::chrono::seconds(5);
  static constexpr std::size_t kMostHeld = 16u << 20;
  static constexpr std::size_t kMostReports = 256;  // held before the first of a picture

  explicit LiveRadar(const LiveSource& source);

  // What a datagram, or the time, brought.
  struct News {
    std::vector<Spoke> spokes;
    bool anew = false;      // it found a radar: spokes count from 0 again
    bool settings = false;  // settings() has changed
    bool groups = false;    // groups().all() is another
    bool lost = false;      // nothing came for kSilence
    std::string refusal;    // the datagram could not be read
  };
  void take(const pcap::Datagram& datagram, News& news);
  // Call it a few times a second.
  void look(UtcTime now, News& news);
  // Own ship from elsewhere than the radar's network.  It holds until that says something.
  void put_own_ship(const captures::ShipFix& fix) { ship_.put(fix); }

  const LiveGroups& groups() const { return groups_; }
  // The radar it found; nothing while it looks.
  const std::optional<captures::SurveyedPicture>& picture() const { return picture_; }
  wire::Settings settings() const { return settings_; }
  // As the radar's network, or what was put, say it.
  wire::OwnShip own_ship(UtcTime now) const;
  // Whether spokes have a heading.
  bool knows_heading() const { return heading_.has_value() || ship_.heading().has_value(); }
  // Pictures of other senders, in datagrams.
  std::uint64_t others() const { return others_; }

 private:
  struct Held {
    UtcTime time;
    Ipv4Endpoint from, to;
    std::vector<std::uint8_t> payload;
    pcap::Datagram datagram() const { return {time, from, to, payload}; }
  };
  bool is_wanted(const captures::PictureKey& key) const;
  void hold(const pcap::Datagram& datagram, bool is_picture);
  void adopt(News& news);
  void look_anew();
  void decode(const pcap::Datagram& datagram, News& news);
  void hear(const pcap::Datagram& datagram, News& news);
  void tell_settings(News& news);
  void settle_model();

  LiveSource source_;
  LiveGroups groups_;
  captures::ShipTrack ship_;
  // While it looks.
  std::unique_ptr<captures::Surveyor> survey_;
  std::deque<Held> held_;
  std::size_t held_bytes_ = 0;
  std::optional<UtcTime> since_;  // the first datagram of a wanted picture
  // Once it found one.
  std::optional<captures::SurveyedPicture> picture_;
  std::unique_ptr<captures::PictureDecoder> decoder_;
  std::unique_ptr<captures::SpokeFitter> fitter_;
  std::optional<SpokeHeader> last_;
  std::optional<TrueBearing> heading_;
  UtcTime heard_{};  // the last spoke
  std::vector<captures::CapturedSpoke> captured_;
  wire::Settings settings_;
  std::string told_;  // settings_ as octets
  std::uint64_t others_ = 0;
};

}  // namespace skerry::server
