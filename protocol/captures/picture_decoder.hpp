// PictureDecoder: the datagrams of one picture into spokes and settings.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/captures/captured_spoke.hpp"
#include "protocol/navico/model.hpp"
#include "protocol/pcap/capture_reader.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/wire_error.hpp"

namespace skerry::captures {

// Facts that must be known before a picture's first spoke can be read.
struct PictureTraits {
  PictureKey key;
  navico::Model model = navico::Model::g4;
  std::optional<Ipv4Endpoint> reports;  // Navico: where the reports of this picture go
  std::uint32_t spokes_per_turn = 0;    // CAT240: counted
  bool doppler = false;                 // cells may stand for motion from the beginning
  Duration turn{};                      // 0: less than a turn was seen
};

// Places of a turn that a Furuno's sweeps are put into, each into all that it passed.
inline constexpr std::uint32_t kFurunoSpokes = 2048;

class PictureDecoder {
 public:
  explicit PictureDecoder(const PictureTraits& traits) : traits_(traits) {}
  virtual ~PictureDecoder() = default;
  PictureDecoder(const PictureDecoder&) = delete;
  PictureDecoder& operator=(const PictureDecoder&) = delete;

  // A datagram of this picture: appends its spokes.  Error: of the family's decoder; then nothing
  // was appended.
  virtual std::optional<WireError> decode(const pcap::Datagram& datagram,
                                          std::vector<CapturedSpoke>& out) = 0;
  // Any other datagram of the same capture: a report, perhaps.
  virtual void hear(const pcap::Datagram& datagram) = 0;

  const PictureTraits& traits() const { return traits_; }
  // Gain to antenna height, as far as reports told; the range is the spokes'.
  const wire::Settings& settings() const { return settings_; }

 protected:
  PictureTraits traits_;
  wire::Settings settings_;
};

// The picture that a datagram belongs to, by its first octets; nullopt if to none.
std::optional<PictureKey> picture_of(const pcap::Datagram& datagram);

std::unique_ptr<PictureDecoder> make_navico_picture(const PictureTraits& traits);
std::unique_ptr<PictureDecoder> make_garmin_picture(const PictureTraits& traits);
std::unique_ptr<PictureDecoder> make_quantum_picture(const PictureTraits& traits);
std::unique_ptr<PictureDecoder> make_rd_picture(const PictureTraits& traits);
std::unique_ptr<PictureDecoder> make_furuno_picture(const PictureTraits& traits);
std::unique_ptr<PictureDecoder> make_cat240_picture(const PictureTraits& traits);
std::unique_ptr<PictureDecoder> make_native_picture(const PictureTraits& traits);
// The one of traits.key.family.
std::unique_ptr<PictureDecoder> make_picture(const PictureTraits& traits);

// What its reports tell, with the range of its last spoke; `rpm` 0: not known.
wire::Settings told_settings(const PictureDecoder& decoder, std::uint32_t radar,
                             const SpokeHeader& last, double rpm);

}  // namespace skerry::captures
