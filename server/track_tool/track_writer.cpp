#include "server/track_tool/track_writer.hpp"

#include "server/track_tool/geojson_writer.hpp"
#include "server/track_tool/track_recording.hpp"

namespace skerry::server {

std::unique_ptr<TableWriter> track_table_for(std::string_view file, std::uint32_t radar,
                                             const TextSink& sink) {
  if (file.ends_with(".csv")) return std::make_unique<TrackCsv>(radar, sink);
  if (file.ends_with(".geojson")) return std::make_unique<TrackGeoJson>(radar, sink);
  return nullptr;
}

std::unique_ptr<TrackWriter> track_writer_for(std::string_view file, const TrackedView& of,
                                              const TextSink& sink) {
  if (file.ends_with(".mcap")) return std::make_unique<TrackRecording>(of, sink);
  return track_table_for(file, of.radar, sink);
}

}  // namespace skerry::server
