// Writes the corpus of the import: import_seeds <tests/fuzz/corpus>
#include <fstream>
#include <iterator>

#include "protocol/asterix/cat240.hpp"
#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/garmin/xhd_spoke.hpp"
#include "protocol/navico/frame.hpp"
#include "protocol/navico/report.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/pcap/pcap_writer.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/quantum_spoke.hpp"
#include "tests/fuzz/corpus_folder.hpp"

namespace {

using namespace skerry;

constexpr Ipv4Endpoint kFrom{ipv4(192, 0, 2, 1), 1024}, kRaymarine{ipv4(232, 1, 1, 1), 2574},
    kCat240{ipv4(239, 1, 2, 3), 8600}, kNmea{ipv4(192, 0, 2, 255), 10110};

// Datagrams 20 ms apart.
class Seed {
 public:
  Seed()
      : writer_([this](std::span<const std::uint8_t> more) {
          bytes_.insert(bytes_.end(), more.begin(), more.end());
        }) {}
  void add(Ipv4Endpoint to, const Bytes& payload) {
    time_ += std::chrono::milliseconds(20);
    writer_.add(time_, kFrom, to, payload);
  }
  void add(Ipv4Endpoint to, const std::string& text) { add(to, Bytes(text.begin(), text.end())); }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
  pcap::PcapWriter writer_;
  UtcTime time_{std::chrono::seconds(1'700'000'000)};
};

void add_navico(Seed& seed, navico::Model model) {
  const navico::Addresses& at = navico::kAddressesA;
  navico::IdentityReport identity;
  identity.type = navico::identity_type(model);
  seed.add(at.report, encode(model, identity));
  navico::AdvancedReport advanced;
  advanced.doppler = 1;
  seed.add(at.report, encode(model, advanced));
  for (std::uint16_t i = 0; i < 4; ++i) {
    navico::SpokeFields fields;
    fields.scan = i;
    fields.angle = static_cast<std::uint16_t>(4090 + 2 * i) % navico::kTurnUnits;
    fields.heading = navico::heading_field(TrueBearing::from(degrees(40.0)));
    std::array<std::uint8_t, navico::kSpokeCells / 2> nibbles{};
    nibbles[10] = 0xFE;
    Bytes frame;
    navico::append_frame_header(frame, 1);
    navico::append_spoke(frame, fields, navico::spoke_range(model, 18'520), model, nibbles);
    seed.add(at.data, frame);
  }
}

void add_garmin(Seed& seed) {
  seed.add(garmin::kReportAddress, garmin::encode_packet(garmin::Type::gain, 2, 5000));
  const Bytes cells = {0, 200, 3, 255, 0, 0, 0, 1};
  for (std::uint16_t i = 0; i < 4; ++i) {
    Bytes spoke;
    garmin::append_spoke(spoke, {static_cast<std::uint16_t>(i * 8), 1852, 2093, cells});
    seed.add(garmin::kSpokeAddress, spoke);
  }
}

void add_quantum(Seed& seed) {
  for (std::uint16_t i = 0; i < 6; ++i) {
    if (i == 2) seed.add(kRaymarine, raymarine::encode_quantum_status({}));
    raymarine::QuantumSpoke spoke;
    spoke.sequence = i;
    spoke.cells_per_range = 103;
    spoke.azimuth = static_cast<std::uint16_t>(248 + i) % 250;
    spoke.cells.assign(231, 0);
    spoke.cells[7] = 255;
    Bytes bytes;
    append_quantum_spoke(bytes, spoke);
    seed.add(kRaymarine, bytes);
  }
}

void add_cat240(Seed& seed) {
  for (std::uint32_t i = 0; i < 4; ++i) {
    Spoke spoke;
    spoke.header.geometry = {360, 256, i < 2 ? 8u : 4u};
    spoke.header.index = 358 + i < 360 ? 358 + i : i - 2;
    spoke.cells.assign(256, 5);
    seed.add(kCat240, encode_cat240_video(spoke, {1, static_cast<std::uint8_t>(i % 2)}, i));
  }
}

// One datagram of the corpus of that scanner's decoder.
Bytes rd_packet(const std::string& corpus, const char* name) {
  std::ifstream in(corpus + "/raymarine_rd/" + name, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(in), {});
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path root = fuzz::corpora(argc, argv);
  Seed navico_4g, navico_halo, navico_br24, garmin, quantum, cat240, rd, all;
  add_navico(navico_4g, navico::Model::g4);
  add_navico(navico_halo, navico::Model::halo);
  add_navico(navico_br24, navico::Model::br24);
  add_garmin(garmin);
  add_quantum(quantum);
  add_cat240(cat240);
  rd.add(kRaymarine, rd_packet(root, "status"));
  rd.add(kRaymarine, rd_packet(root, "three_spokes"));
  rd.add(kRaymarine, rd_packet(root, "one_spoke"));
  nmea::Rmc rmc;
  rmc.position = GeoPoint{60.5, 5.25};
  rmc.course_deg = 90.0;
  rmc.speed_kn = 9.0;
  all.add(kNmea, nmea::encode(rmc) + nmea::encode(nmea::Hdt{12.5}));
  add_cat240(all);
  add_quantum(all);
  all.add(kNmea, nmea::encode(nmea::Hdt{359.5}));
  add_cat240(all);
  for (const char* decoder : {"import", "live"}) {
    const fuzz::CorpusFolder corpus(root / decoder);
    corpus.write("4g", navico_4g.bytes());
    corpus.write("halo", navico_halo.bytes());
    corpus.write("br24", navico_br24.bytes());
    corpus.write("garmin", garmin.bytes());
    corpus.write("quantum", quantum.bytes());
    corpus.write("cat240", cat240.bytes());
    corpus.write("rd", rd.bytes());
    corpus.write("two_with_own_ship", all.bytes());
  }
  return 0;
}
