// The import of captures: whatever stands in one, what comes of it can be played.
#include "protocol/captures/importer.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;

void require_playable(const Spoke& spoke) {
  wire::Spoke message;
  to_message(spoke, message);
  const auto back = from_message(message);
  fuzz::require(back.ok(), "an imported spoke is one of the native protocol");
  fuzz::require(back->cells == spoke.cells, "its cells are what was imported");
}

// Reads each picture as the importer does, and looks at the spokes.
std::uint64_t spokes_of(std::span<const std::uint8_t> capture) {
  captures::Surveyor survey;
  (void)pcap::read_capture(capture, [&](const auto& each) { survey.take(each); });
  std::uint64_t spokes = 0;
  for (const auto& picture : survey.pictures()) {
    const auto decoder = captures::make_picture(picture.traits);
    captures::SpokeFitter fitter(0, picture.traits.turn, survey.begin());
    captures::ShipTrack ship;
    std::vector<captures::CapturedSpoke> captured;
    std::vector<Spoke> fitted;
    (void)pcap::read_capture(capture, [&](const pcap::Datagram& each) {
      captured.clear();
      const auto key = captures::picture_of(each);
      if (!key) {
        decoder->hear(each);
        ship.hear(each);
      } else if (*key == picture.traits.key) {
        (void)decoder->decode(each, captured);
      }
      for (auto& spoke : captured) fitter.take(std::move(spoke), ship, fitted);
    });
    fitter.finish(fitted);
    for (const Spoke& spoke : fitted) require_playable(spoke);
    fuzz::require(fitter.counts().spokes == fitted.size(), "spokes are counted");
    spokes += fitted.size();
  }
  return spokes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> capture(data, size);
  recording::RecordingWriter writer(
      [](std::span<const std::uint8_t>) { return true; },
      {.compression = recording::Compression::none, .chunk_bytes = 64 << 10});
  const auto report = captures::import_capture(
      [&](const captures::DatagramSink& sink, const captures::ImportProgress&) {
        return pcap::read_capture(capture, sink);
      },
      "fuzz", writer);
  const std::uint64_t spokes = spokes_of(capture);
  if (!report.ok()) {
    fuzz::require(!report.error().text.empty(), "a refusal says why");
    fuzz::require(report.error().offset <= size, "a refusal's place is in the file");
    return 0;
  }
  writer.finish();
  fuzz::require(writer.counts().spokes == spokes, "every spoke is written");
  fuzz::require(report->radars.size() <= captures::kMaxPictures, "radars are few");
  return 0;
}
