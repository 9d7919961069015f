// Writes the seeds of the Garmin and Raymarine fuzz targets.  Usage: display_seeds
// <tests/fuzz/corpus>
#include <filesystem>
#include <string>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/garmin/xhd_reports.hpp"
#include "protocol/garmin/xhd_spoke.hpp"
#include "protocol/raymarine/quantum_command.hpp"
#include "protocol/raymarine/quantum_locator.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/quantum_spoke.hpp"
#include "protocol/raymarine/rd_packets.hpp"
#include "protocol/raymarine/run_length.hpp"
#include "protocol/wire/byte_order.hpp"
#include "tests/fuzz/corpus_folder.hpp"

namespace {

using namespace skerry;
namespace fs = std::filesystem;
using Corpus = fuzz::CorpusFolder;

void write_garmin(const Corpus& corpus) {
  using garmin::Type;
  corpus.write("transmit", garmin::encode_packet(Type::transmit, 1, 1));
  corpus.write("range", garmin::encode_packet(Type::range, 4, 1852));
  corpus.write("gain", garmin::encode_packet(Type::gain, 2, 5600));
  corpus.write("no_transmit_to", garmin::encode_packet(Type::no_transmit_to, 4, -5440));
  corpus.write("gain_out_of_range", garmin::encode_packet(Type::gain, 4, 1'000'000));
  corpus.write("no_command", garmin::encode_packet(Type::scanner_state, 1, 5));
  corpus.write("ranges", garmin::encode_ranges());
  const Bytes cells(698, 9);
  Bytes spoke;
  garmin::append_spoke(spoke, {800, 1852, 2093, cells});
  corpus.write("spoke", spoke);
  spoke.resize(spoke.size() - 1);
  corpus.write("spoke_cut_short", spoke);
  Bytes small;
  garmin::append_spoke(small, {11512, 232, 262, std::span(cells).first(8)});
  corpus.write("spoke_of_eight_cells", small);
}

void write_quantum(const Corpus& corpus) {
  using namespace raymarine;
  corpus.write("status", encode_quantum_status({}));
  corpus.write("info", encode_quantum_info({"E70498", "0000001"}));
  corpus.write("stay_alive", encode_quantum_command(QuantumControl::stay_alive, 0));
  corpus.write("gain", encode_quantum_command(QuantumControl::gain, 40));
  corpus.write("bearing", encode_quantum_command(QuantumControl::bearing_offset, -20));
  corpus.write("older_bearing", {0x07, 0x82, 0x01, 0x00, 0xEC, 0xFF, 0xFF, 0xFF});
  corpus.write("locator", encode_locator_addresses({{1, kQuantumModel},
                                                    {ipv4(232, 1, 215, 1), 2574},
                                                    {ipv4(198, 18, 4, 117), 2575}}));
  corpus.write("name", encode_locator_name({{1, kQuantumDevice}, "QuantumRadar"}));
  QuantumSpoke spoke{7, 103, 249, std::vector<std::uint8_t>(231, 0)};
  for (std::size_t i = 60; i < 90; ++i) spoke.cells[i] = static_cast<std::uint8_t>(i * i);
  Bytes bytes;
  append_quantum_spoke(bytes, spoke);
  corpus.write("spoke", bytes);
  bytes.resize(bytes.size() - 2);
  corpus.write("spoke_cut_short", bytes);
  corpus.write("longest_runs", {kRunMark, 255, 1, kRunMark, 255, 2, kRunMark, 255, 3});
}

// One frame of `azimuths.size()` spokes, as an E-120 sends it.
Bytes rd_frame(const std::vector<std::uint32_t>& azimuths, bool extra_header) {
  Bytes out;
  const auto words = [&](std::initializer_list<std::uint32_t> values) {
    for (const std::uint32_t value : values) append_little_endian(out, value, 4);
  };
  words({raymarine::kRdSpokesType, 0, 28, static_cast<std::uint32_t>(azimuths.size()), ~0u, 0, 1,
         ~0u});
  for (const std::uint32_t azimuth : azimuths) {
    words({1, 40, azimuth, 1, 2, 1, 1, 500, 0, 1});
    if (extra_header) words({2, 12, 0});
    const Bytes video = {raymarine::kRunMark, 91, 0, 0xC0, 0xFF, 0xFF, raymarine::kRunMark, 128, 0};
    words({3, 24, static_cast<std::uint32_t>(video.size())});
    out.insert(out.end(), video.begin(), video.end());
    out.resize(out.size() + 12 - video.size());
  }
  return out;
}

void write_rd(const Corpus& corpus) {
  corpus.write("one_spoke", rd_frame({0}, false));
  corpus.write("three_spokes", rd_frame({2046, 2047, 0}, false));
  corpus.write("extra_header", rd_frame({5, 6}, true));
  corpus.write("azimuth_out_of_range", rd_frame({2048}, false));
  Bytes cut = rd_frame({1, 2}, false);
  cut.resize(cut.size() - 5);
  corpus.write("cut_short", cut);
  Bytes hd = rd_frame({1}, false);
  hd[32 + 12] = 3;
  corpus.write("hd_scanner", hd);
  Bytes status(245);
  status[0] = status[2] = 1;
  status[4] = 125;
  status[180] = 1;
  corpus.write("status", status);
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path root = fuzz::corpora(argc, argv);
  write_garmin(Corpus(root / "garmin"));
  write_quantum(Corpus(root / "quantum"));
  write_rd(Corpus(root / "raymarine_rd"));
  return 0;
}
