#include "protocol/captures/import_notes.hpp"

#include <fmt/format.h>

namespace skerry::captures {
namespace {

// A JSON string.  What is not ASCII text is left out: names of files may be anything.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c >= 0x20 && c < 0x7F) out += c;
  }
  return out + '"';
}

std::string ranges_of(const FittedCounts& counts) {
  std::string text;
  for (const auto& [reach_dm, spokes] : counts.at_reach_dm) {
    text += fmt::format("{}\n        {{\"reach_m\": {:.1f}, \"spokes\": {}}}",
                        text.empty() ? "" : ",", static_cast<double>(reach_dm) / 10.0, spokes);
  }
  return text;
}

std::string radar_text(std::size_t number, const ImportedRadar& radar) {
  const PictureTraits& traits = radar.picture.traits;
  const FittedCounts& counts = radar.counts;
  return fmt::format(
      "    {{\"radar\": {}, \"maker\": {}, \"name\": {}, \"picture\": {},\n"
      "      \"spokes_per_turn\": {}, \"cells_decoded\": {}, \"bits\": {}, \"rpm\": {:.2f},\n"
      "      \"spokes\": {}, \"missing\": {}, \"range_unknown\": {}, \"refused\": {},\n"
      "      \"datagrams_not_read\": {}, \"padded\": {}, \"thinned\": {},\n"
      "      \"heading_magnetic\": {},\n"
      "      \"ranges\": [{}]}}",
      number, quoted(name_of(traits.key.family)), quoted(radar.picture.name),
      quoted(text_of(traits.key.to)), traits.spokes_per_turn, radar.picture.cells,
      radar.picture.bits, radar.picture.rpm, counts.spokes, counts.missing, counts.range_unknown,
      counts.refused, radar.picture.refused, counts.padded, counts.thinned,
      counts.magnetic ? "true" : "false", ranges_of(counts));
}

}  // namespace

recording::Attachment import_notes(const ImportReport& report, const std::string& capture,
                                   UtcTime time) {
  std::string radars;
  for (std::size_t i = 0; i < report.radars.size(); ++i) {
    radars += (i == 0 ? "" : ",\n") + radar_text(i, report.radars[i]);
  }
  return {.name = kImportNotes,
          .media_type = "application/json",
          .time = time,
          .bytes = fmt::format(
              "{{\"capture\": {}, \"datagrams\": {}, \"incomplete\": {},\n"
              "  \"damage\": {},\n  \"radars\": [\n{}\n  ]}}\n",
              quoted(capture), report.capture.datagrams, report.capture.incomplete,
              report.damage
                  ? quoted(fmt::format("byte {}: {}", report.damage->offset, report.damage->text))
                  : "null",
              radars)};
}

}  // namespace skerry::captures
