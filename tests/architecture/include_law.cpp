#include "tests/architecture/include_law.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

namespace skerry::architecture {
namespace {

// An entry that ends in '/' is all of a folder, any other one file.
using Places = std::vector<std::string_view>;

struct Room {
  std::string_view folder;
  Places may_include;  // besides itself
};

// Lower never includes higher.  A new folder gets a row here when it gets its first file.
const std::vector<Room>& table() {
  static const std::vector<Room> rooms = {
      // The vocabulary.
      {"protocol/quantity", {}},
      {"protocol/video", {"protocol/quantity/"}},
      // Bytes <-> values.
      {"protocol/wire", {"protocol/quantity/", "protocol/video/"}},
      {"protocol/digest", {}},
      // Scans as pictures.
      {"protocol/picture", {"protocol/quantity/", "protocol/video/", "protocol/wire/"}},
      {"protocol/asterix",
       {"protocol/quantity/", "protocol/video/", "protocol/wire/wire_error.hpp",
        "protocol/wire/byte_order.hpp"}},
      // Radars and displays of other makers, and navigation.
      {"protocol/pcap",
       {"protocol/quantity/", "protocol/wire/wire_error.hpp", "protocol/wire/byte_order.hpp",
        "protocol/wire/ipv4_endpoint.hpp"}},
      {"protocol/navico",
       {"protocol/quantity/", "protocol/video/", "protocol/wire/wire_error.hpp",
        "protocol/wire/byte_order.hpp", "protocol/wire/ipv4_endpoint.hpp"}},
      {"protocol/furuno",
       {"protocol/quantity/", "protocol/wire/wire_error.hpp", "protocol/wire/byte_order.hpp",
        "protocol/wire/ipv4_endpoint.hpp"}},
      {"protocol/garmin",
       {"protocol/quantity/", "protocol/video/", "protocol/wire/wire_error.hpp",
        "protocol/wire/byte_order.hpp", "protocol/wire/ipv4_endpoint.hpp"}},
      {"protocol/raymarine",
       {"protocol/quantity/", "protocol/video/", "protocol/wire/wire_error.hpp",
        "protocol/wire/byte_order.hpp", "protocol/wire/ipv4_endpoint.hpp"}},
      {"protocol/signalk",
       {"protocol/quantity/", "protocol/video/", "protocol/wire/wire_error.hpp",
        "protocol/wire/schema.hpp", "protocol/wire/varint.hpp", "protocol/wire/controls.pb.h"}},
      {"protocol/nmea",
       {"protocol/quantity/", "protocol/wire/wire_error.hpp", "protocol/wire/ipv4_endpoint.hpp"}},
      {"protocol/recording", {"protocol/quantity/", "protocol/video/", "protocol/wire/"}},
      {"protocol/thin", {"protocol/quantity/", "protocol/video/", "protocol/wire/"}},
      // Captures of real radars into recordings: all protocols meet here.
      {"protocol/captures", {"protocol/"}},
      {"protocol/board",
       {"protocol/quantity/", "protocol/wire/wire_error.hpp", "protocol/wire/byte_order.hpp"}},
      // The echo: from loops over cells up to whole spokes.
      {"echo/kernel", {"protocol/quantity/"}},
      {"echo/chart", {"protocol/quantity/", "protocol/video/", "echo/kernel/"}},
      {"echo/chart/gdal", {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/chart/"}},
      {"echo/chart/gdal/polygons",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/chart/"}},
      {"echo/chart/gdal/s57",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/chart/"}},
      {"echo/fractal", {"protocol/quantity/", "protocol/video/", "echo/kernel/"}},
      {"echo/fractal/as_printed", {"protocol/quantity/", "echo/kernel/", "echo/fractal/"}},
      // Dimension, spectrum and statistics of curves and pictures.
      {"echo/measure", {"protocol/quantity/", "protocol/video/", "echo/kernel/"}},
      // Antenna, transmitter, clock and beam: the equipment.
      {"echo/radar", {"protocol/quantity/", "protocol/video/", "echo/kernel/"}},
      {"echo/scene",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/chart/", "echo/fractal/",
        "echo/measure/", "echo/radar/spoke_clock.hpp"}},
      // Where how much rain falls: what it echoes and what it takes are made of one field.
      {"echo/rain", {"protocol/quantity/", "echo/kernel/", "echo/scene/"}},
      // How waves travel: between equipment and whatever echoes.
      {"echo/propagation",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/radar/", "echo/scene/",
        "echo/rain/"}},
      // Everything that echoes: land and what stands on it, sea and rain, ships, beacons, and what
      // is not
      // there.
      {"echo/returns",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/chart/", "echo/scene/",
        "echo/radar/", "echo/propagation/", "echo/targets/"}},
      {"echo/clutter",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/scene/", "echo/radar/",
        "echo/propagation/"}},
      {"echo/targets",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/scene/", "echo/radar/",
        "echo/propagation/"}},
      {"echo/beacons",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/scene/", "echo/radar/",
        "echo/propagation/", "echo/targets/"}},
      {"echo/artefacts",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/scene/", "echo/radar/",
        "echo/propagation/", "echo/targets/"}},
      {"echo/receiver",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/radar/",
        "echo/scene/own_rig.hpp"}},
      // Single pulses, for interface boards.
      {"echo/sweeps",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/radar/", "echo/receiver/"}},
      // Scenes out of plain values.
      {"echo/assembly",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/", "echo/scene/", "echo/returns/"}},
      {"echo", {"protocol/quantity/", "protocol/video/", "echo/"}},
      // The echo for other programs: a C library, and the tool that fits and judges coasts.
      {"echo/capi", {"protocol/quantity/", "protocol/video/", "echo/"}},
      {"echo/coast_tool", {"protocol/quantity/", "protocol/video/", "protocol/picture/", "echo/"}},
      // How the tools speak on a terminal.
      {"echo/tool_console", {}},
      // The tool that compares pictures with real radars': it reads recordings and captures.
      {"echo/picture_tool", {"protocol/", "echo/"}},
      // The server: radar and net do not know each other, app joins them.
      {"server/core", {"protocol/"}},
      {"server/config", {"protocol/"}},
      {"server/world",
       {"protocol/", "server/config/", "echo/radar/", "echo/scene/artefacts.hpp",
        "echo/scene/weather.hpp", "echo/kernel/exact_math.hpp", "echo/kernel/hash.hpp",
        "server/core/traffic.hpp", "server/world/handling/", "server/world/sensors/",
        "server/world/traffic/", "server/world/waters/"}},
      // How ships answer rudder, engine, wind and waves: arithmetic alone.
      {"server/world/handling",
       {"protocol/quantity/", "echo/kernel/exact_math.hpp", "echo/kernel/hash.hpp"}},
      // How sensors err: arithmetic too.
      {"server/world/sensors",
       {"protocol/quantity/", "protocol/wire/exercise.pb.h", "echo/kernel/exact_math.hpp",
        "echo/kernel/hash.hpp"}},
      // Tide, streams and banks: arithmetic on what the scenario says.
      {"server/world/waters",
       {"protocol/quantity/", "server/config/", "server/world/scenario.pb.h",
        "server/world/ship_units.hpp", "server/world/short_way.hpp",
        "server/world/hull_outline.hpp", "echo/kernel/exact_math.hpp"}},
      // The ships among the targets.
      {"server/world/traffic",
       {"protocol/", "server/config/", "server/world/", "echo/kernel/exact_math.hpp",
        "echo/kernel/hash.hpp"}},
      {"server/radar", {"protocol/", "echo/", "server/core/", "server/world/"}},
      // The video of a recorded exercise, made again.
      {"server/replay", {"protocol/", "echo/", "server/core/", "server/world/", "server/radar/"}},
      // The log that hosts of an exercise share, and its store over etcd.
      {"server/fleet", {"protocol/quantity/"}},
      {"server/fleet/etcd", {"protocol/quantity/", "server/fleet/"}},
      {"server/fleet/member", {"protocol/quantity/", "server/fleet/"}},
      {"server/board",
       {"protocol/", "echo/sweeps/", "echo/radar/", "echo/kernel/", "server/core/"}},
      {"server/displays", {"protocol/", "server/core/", "server/displays/"}},
      {"server/displays/navico", {"protocol/", "server/core/", "server/displays/"}},
      {"server/displays/garmin", {"protocol/", "server/core/", "server/displays/"}},
      {"server/displays/raymarine", {"protocol/", "server/core/", "server/displays/"}},
      // Navigation data, and how it is used.
      {"server/navigation", {"protocol/", "server/core/"}},
      // Who may do what, and the tool for its file and that of who did what.
      {"server/access",
       {"protocol/digest/", "protocol/nmea/log_time.hpp", "protocol/picture/label_text.hpp",
        "protocol/quantity/", "protocol/wire/", "server/config/"}},
      {"server/access_tool",
       {"protocol/picture/label_text.hpp", "protocol/quantity/", "protocol/recording/",
        "echo/tool_console/", "server/access/", "server/audit/", "server/config/config_error.hpp",
        "server/core/audit_port.hpp", "server/tls/"}},
      // Certificates.
      {"server/tls", {"server/config/whole_file.hpp"}},
      // What consoles keep on the server.
      {"server/setups", {"protocol/digest/", "protocol/wire/printable_text.hpp", "server/config/"}},
      // Who changed what.
      {"server/audit",
       {"protocol/digest/", "protocol/picture/label_text.hpp", "protocol/quantity/",
        "protocol/recording/recording.pb.h", "server/config/", "server/core/audit_port.hpp"}},
      // The network: what all speakers share, and a room for each that speaks.
      {"server/net/common",
       {"protocol/", "server/access/", "server/core/", "server/displays/radar_emulation.hpp",
        "server/navigation/", "server/setups/", "server/tls/"}},
      {"server/net/native", {"protocol/", "server/access/", "server/core/", "server/net/common/"}},
      {"server/net/outputs",
       {"protocol/", "server/core/", "server/displays/radar_emulation.hpp", "server/net/common/"}},
      {"server/net/navigation",
       {"protocol/", "server/core/", "server/navigation/", "server/net/common/"}},
      {"server/net/signalk",
       {"protocol/", "server/access/", "server/core/", "server/navigation/", "server/net/common/",
        "server/net/http/web_answer.hpp"}},
      {"server/net/live", {"protocol/", "server/core/", "server/live/", "server/net/common/"}},
      {"server/net/http",
       {"protocol/", "server/access/", "server/core/", "server/net/common/", "server/net/native/",
        "server/net/signalk/", "server/setups/"}},
      {"server/net", {"protocol/", "server/core/", "server/net/"}},
      // Video and all that belongs to it, to the disk.
      {"server/recorder", {"protocol/", "server/core/"}},
      // Radars whose spokes were made elsewhere: what is common, a recording, real radars.
      {"server/relayed", {"protocol/", "server/core/"}},
      {"server/playback", {"protocol/", "server/core/", "server/relayed/"}},
      {"server/live", {"protocol/", "server/core/", "server/relayed/"}},
      // Another server's: the one room of the server that is a client.
      {"server/relay", {"protocol/", "clients/common/", "server/core/", "server/relayed/"}},
      // The plotters of all views at work, whatever the source of their spokes.
      {"server/tracking",
       {"protocol/", "echo/kernel/exact_math.hpp", "echo/chart/local_plane.hpp", "server/core/",
        "server/navigation/target_geometry.hpp", "server/plotter/", "server/tracking/watch/"}},
      // Logs of AIS into traffic, and traffic into logs.
      {"server/traffic_logs", {"protocol/", "server/core/", "server/navigation/", "server/world/"}},
      {"server/app", {"protocol/", "echo/", "server/"}},
      {"server/app/control", {"protocol/", "echo/", "server/"}},
      {"server/app/fleet", {"protocol/", "echo/", "server/", "clients/common/"}},
      {"server/app/options", {"protocol/", "echo/", "server/"}},
      // What happened in a recorded exercise, as values, a page and tables.
      {"server/debrief",
       {"protocol/", "server/page/", "server/world/", "server/replay/",
        "server/app/control/control_change.hpp", "server/relayed/values_in_range.hpp",
        "server/tracking/watch/alert_list.hpp"}},
      // Pages with tables and figures, as one file.
      {"server/page", {"protocol/quantity/"}},
      // The tool that makes, checks and runs exercises without a network.
      {"server/exercise_tool", {"protocol/", "echo/", "server/"}},
      // The tool that tracks targets in recordings: it knows spokes, never how they were made.
      {"server/track_tool",
       {"protocol/", "echo/tool_console/", "echo/chart/local_plane.hpp", "server/plotter/",
        "server/playback/play_request.hpp", "server/relayed/values_in_range.hpp",
        "server/tracking/watch/told_target.hpp", "server/tracking/watch/vectors.hpp"}},
      // Targets out of the video of any source: it knows spokes, neither radar model nor truth.
      {"server/plotter",
       {"protocol/quantity/", "protocol/video/", "server/plotter/plots/",
        "server/plotter/tracks/"}},
      {"server/plotter/assignment", {"protocol/quantity/"}},
      {"server/plotter/motion", {"protocol/quantity/", "echo/kernel/exact_math.hpp"}},
      {"server/plotter/plots",
       {"protocol/quantity/", "protocol/video/", "echo/kernel/exact_math.hpp",
        "echo/kernel/isa.hpp"}},
      {"server/plotter/tracks",
       {"protocol/quantity/", "echo/kernel/exact_math.hpp", "echo/chart/local_plane.hpp",
        "server/plotter/assignment/", "server/plotter/motion/", "server/plotter/plots/"}},
      // Who judges trackers knows the truth, and what any of them told.
      {"server/plotter/judge",
       {"protocol/quantity/", "protocol/nmea/", "protocol/signalk/json.hpp",
        "echo/chart/local_plane.hpp", "echo/kernel/exact_math.hpp", "server/page/",
        "server/plotter/assignment/", "server/plotter/judge/baselines/", "server/plotter/tracks/"}},
      {"server/plotter/judge/baselines",
       {"protocol/quantity/", "echo/chart/local_plane.hpp", "server/plotter/judge/"}},
      // What a mariner has of a view's targets: it knows the plotter's tracks, never the truth.
      {"server/tracking/watch",
       {"protocol/", "echo/chart/local_plane.hpp", "echo/kernel/exact_math.hpp",
        "server/plotter/"}},
      // Clients know the protocol, never the server nor how an echo is made.
      {"clients/common", {"protocol/"}},
      // The C library of the interface board, and its signals as files.
      {"clients/board", {"protocol/", "clients/common/"}},
      {"clients/signals", {"protocol/", "clients/common/"}},
      {"clients/recording", {"protocol/", "clients/common/"}},
      {"clients/interchange", {"protocol/", "clients/recording/"}},
      {"clients/doctor", {"protocol/"}},
      {"clients/cli",
       {"protocol/", "clients/common/", "clients/cli/", "clients/board/", "clients/signals/",
        "clients/recording/", "clients/interchange/", "clients/doctor/"}},
      {"clients/cli/board",
       {"protocol/", "clients/common/", "clients/cli/", "clients/board/", "clients/signals/"}},
      {"clients/cli/exercise", {"protocol/", "clients/common/", "clients/cli/"}},
      {"clients/cli/live", {"protocol/", "clients/common/", "clients/cli/", "clients/doctor/"}},
      {"clients/cli/targets", {"protocol/", "clients/common/", "clients/cli/"}},
      {"clients/cli/recording",
       {"protocol/", "clients/common/", "clients/cli/", "clients/recording/",
        "clients/interchange/", "clients/signals/"}},
      {"clients/examples", {"protocol/", "clients/common/"}},
  };
  return rooms;
}

// Rooms that build on the standard library alone.
constexpr std::array<std::string_view, 3> kStandardLibraryOnly = {"protocol/quantity",
                                                                  "protocol/video", "echo/kernel"};

// Headers of other projects, and who may name them.
struct Owned {
  std::string_view header;
  Places owners;
  std::string_view instead;
};
const std::vector<Owned>& owned_headers() {
  static const std::vector<Owned> owned = {
      {"boost/",
       {"server/net/common/asio.hpp", "clients/common/asio.hpp"},
       "include that file, which puts <utility> before Asio"},
      {"GeographicLib/",
       {"echo/chart/", "server/world/", "server/navigation/"},
       "use echo/chart/local_plane.hpp, server/world or server/navigation"},
      {"gdal_priv.h", {"echo/chart/gdal/"}, "use the readers of echo/chart/gdal"},
      {"ogrsf_frmts.h", {"echo/chart/gdal/"}, "use the readers of echo/chart/gdal"},
      {"netcdf.h", {"echo/chart/"}, "use echo/chart/gshhg_reader.hpp"},
      {"yaml-cpp/", {"server/config/"}, "use server/config/yaml_message.hpp"},
      {"CLI/",
       {"server/app/", "clients/cli/", "echo/coast_tool/", "echo/picture_tool/",
        "echo/tool_console/", "server/access_tool/", "server/exercise_tool/", "server/track_tool/"},
       "pass the options in as values"},
      {"png.h", {"protocol/picture/"}, "use protocol/picture/picture_file.hpp"},
      {"sndfile.h", {"clients/signals/"}, "use clients/signals"},
      {"openssl/",
       {"protocol/digest/", "server/tls/", "server/net/common/tls_keys.cpp",
        "clients/common/client_socket.cpp"},
       "use protocol/digest/digest.hpp, server/tls/certificate.hpp or "
       "clients/common/client_socket.hpp"},
      {"grpc/", {"server/fleet/etcd/"}, "use server/fleet/key_store.hpp"},
      {"grpcpp/", {"server/fleet/etcd/"}, "use server/fleet/key_store.hpp"},
      {"zlib.h",
       {"protocol/asterix/", "protocol/pcap/"},
       "use protocol/asterix/cat240.hpp or protocol/pcap/capture_reader.hpp"},
      {"pcap/", {"protocol/pcap/"}, "use protocol/pcap/capture_reader.hpp"},
      {"nlohmann/",
       {"clients/signals/", "clients/recording/", "clients/interchange/", "clients/doctor/",
        "protocol/signalk/", "server/app/exercise_files.cpp"},
       "use clients/signals, clients/recording, clients/interchange or protocol/signalk/json.hpp"},
      {"avahi-client/",
       {"server/net/signalk/mdns_advertiser.cpp"},
       "use server/net/signalk/mdns_advertiser.hpp"},
      {"avahi-common/",
       {"server/net/signalk/mdns_advertiser.cpp"},
       "use server/net/signalk/mdns_advertiser.hpp"},
      {"spdlog/", {"server/"}, "return the error; the server logs it"},
      {"google/protobuf/",
       {"protocol/wire/", "protocol/recording/", "server/", "clients/"},
       "use the types of protocol/quantity and protocol/video"},
      {"gtest/", {}, "put it under tests/"},
      {"gmock/", {}, "put it under tests/"},
      {"benchmark/", {}, "put it under tests/bench"},
  };
  return owned;
}

struct Banned {
  std::string_view word;
  Places where;  // nowhere given: everywhere
  std::string_view reason;
};
const std::vector<Banned>& banned_words() {
  static const std::vector<Banned> banned = {
      {"views::", {}, "clang 14 cannot parse it: write the loop or use a std::ranges algorithm"},
      {"source_location", {}, "clang 14 cannot parse it: pass the name in"},
      {"_clock::now(", {"protocol/", "echo/"}, "no clocks down here: time is passed in"},
      {"std::random_device",
       {"protocol/", "echo/"},
       "use the pure functions of echo/kernel/hash.hpp"},
      {"std::mt19937", {"protocol/", "echo/"}, "use the pure functions of echo/kernel/hash.hpp"},
  };
  return banned;
}

constexpr std::size_t kMostLines = 400, kMostTestLines = 600;
constexpr std::array<std::string_view, 5> kTopFolders = {"protocol", "echo", "server", "clients",
                                                         "tests"};
constexpr std::array<std::string_view, 8> kSourceEndings = {".hpp", ".cpp",  ".proto", ".js",
                                                            ".mjs", ".html", ".css",   ".txt"};

bool is_among(std::string_view path, const Places& places) {
  return std::any_of(places.begin(), places.end(), [&](std::string_view place) {
    return place.ends_with('/') ? path.starts_with(place) : path == place;
  });
}

std::string_view without_template_ending(std::string_view path) {
  return path.ends_with(".in") ? path.substr(0, path.size() - 3) : path;
}

bool is_cpp(std::string_view path) {
  const auto name = without_template_ending(path);
  return name.ends_with(".hpp") || name.ends_with(".cpp");
}

// The folder of a file: "echo/kernel" of "echo/kernel/isa.hpp".
std::string_view room_of(std::string_view path) { return path.substr(0, path.rfind('/')); }

std::string_view trimmed(std::string_view line) {
  const auto from = line.find_first_not_of(" \t");
  return from == std::string_view::npos ? std::string_view{} : line.substr(from);
}

// The file that an #include or a .proto's import names.
struct Inclusion {
  std::string_view path;
  bool quoted = false;
};
std::optional<Inclusion> inclusion_in(std::string_view line, bool proto) {
  line = trimmed(line);
  if (proto) {
    if (!line.starts_with("import ")) return std::nullopt;
  } else {
    if (!line.starts_with('#')) return std::nullopt;
    line = trimmed(line.substr(1));
    if (!line.starts_with("include")) return std::nullopt;
  }
  const auto open = line.find_first_of("\"<");
  if (open == std::string_view::npos) return std::nullopt;
  const auto close = line.find_first_of("\">", open + 1);
  if (close == std::string_view::npos) return std::nullopt;
  return Inclusion{line.substr(open + 1, close - open - 1), line[open] == '"'};
}

class FileCheck {
 public:
  FileCheck(std::string_view path, std::string_view text)
      : path_(path), text_(text), room_(room_of(path)), in_tests_(path.starts_with("tests/")) {}

  std::vector<Breach> run() {
    if (!in_tests_ && (is_cpp(path_) || is_proto())) find_row();
    bool guarded = false;
    std::size_t begin = 0;
    while (begin < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', begin), text_.size());
      const std::string_view line = text_.substr(begin, end - begin);
      begin = end + 1;
      ++line_;
      guarded = guarded || line.starts_with("#pragma once");
      if (in_tests_) continue;
      if (const auto inclusion = inclusion_in(line, is_proto())) check_inclusion(*inclusion);
      if (is_cpp(path_)) check_words(line.substr(0, line.find("//")));
    }
    check_length();
    if (without_template_ending(path_).ends_with(".hpp") && !guarded) {
      line_ = 1;
      add("has no #pragma once; every header has one");
    }
    return std::move(breaches_);
  }

 private:
  bool is_proto() const { return path_.ends_with(".proto"); }

  void add(std::string text) { breaches_.push_back({std::string(path_), line_, std::move(text)}); }

  void find_row() {
    for (const Room& room : table()) {
      if (room.folder == room_) row_ = &room;
    }
    if (row_) return;
    line_ = 1;
    add(
        fmt::format("{} has no row in the layer table; add one to tests/architecture/"
                    "include_law.cpp that says what it may include",
                    room_));
    line_ = 0;
  }

  void check_inclusion(const Inclusion& inclusion) {
    const auto top = inclusion.path.substr(0, inclusion.path.find('/'));
    const bool ours = inclusion.path.find('/') != std::string_view::npos &&
                      std::find(kTopFolders.begin(), kTopFolders.end(), top) != kTopFolders.end();
    if (ours) {
      check_layer(inclusion.path);
    } else if (inclusion.quoted && !is_proto()) {
      add(
          fmt::format("includes \"{}\"; our headers are named from the repository's root, others "
                      "stand in <>",
                      inclusion.path));
    } else {
      check_owner(inclusion.path);
    }
  }

  void check_layer(std::string_view included) {
    if (!row_ || room_of(included) == room_ || is_among(included, row_->may_include)) return;
    add(
        fmt::format("includes {}; {} may include itself{}{} and nothing else of ours. Move what "
                    "both need to a lower layer, or pass it in as a value or a function",
                    included, room_, row_->may_include.empty() ? "" : ", ",
                    fmt::join(row_->may_include, ", ")));
  }

  void check_owner(std::string_view included) {
    const bool standard = included.find_first_of("/.") == std::string_view::npos;
    if (!standard && std::find(kStandardLibraryOnly.begin(), kStandardLibraryOnly.end(), room_) !=
                         kStandardLibraryOnly.end()) {
      add(
          fmt::format("includes <{}>; {} builds on the standard library alone. Do it in a higher "
                      "layer",
                      included, room_));
      return;
    }
    for (const Owned& owned : owned_headers()) {
      const bool is_it = owned.header.ends_with('/') ? included.starts_with(owned.header)
                                                     : included == owned.header;
      if (!is_it || is_among(path_, owned.owners)) continue;
      add(fmt::format("includes <{}>, which only {} may; {}", included,
                      owned.owners.empty() ? std::string("tests")
                                           : fmt::format("{}", fmt::join(owned.owners, " and ")),
                      owned.instead));
    }
  }

  void check_words(std::string_view code) {
    for (const Banned& banned : banned_words()) {
      if (code.find(banned.word) == std::string_view::npos) continue;
      if (!banned.where.empty() && !is_among(path_, banned.where)) continue;
      add(fmt::format("uses {}; {}", banned.word, banned.reason));
    }
  }

  void check_length() {
    const std::size_t most = in_tests_ ? kMostTestLines : kMostLines;
    if (line_ <= most) return;
    add(fmt::format("has {} lines, more than {}; split it by idea", line_, most));
  }

  std::string_view path_, text_, room_;
  bool in_tests_;
  const Room* row_ = nullptr;
  std::size_t line_ = 0;
  std::vector<Breach> breaches_;
};

}  // namespace

std::string listed(const std::vector<Breach>& breaches) {
  std::string out;
  for (const Breach& breach : breaches) {
    out += fmt::format("{}:{}: {}\n", breach.file, breach.line, breach.text);
  }
  return out;
}

std::vector<Breach> breaches_of(std::string_view path, std::string_view text) {
  return FileCheck(path, text).run();
}

std::vector<std::string> source_files(const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  for (const std::string_view top : kTopFolders) {
    for (auto it = fs::recursive_directory_iterator(root / top);
         it != fs::recursive_directory_iterator(); ++it) {
      const std::string name = it->path().filename().string();
      if (it->is_directory()) {
        if (name == "node_modules" || name.starts_with('.')) it.disable_recursion_pending();
        continue;
      }
      const auto plain = without_template_ending(name);
      const bool source = std::any_of(kSourceEndings.begin(), kSourceEndings.end(),
                                      [&](std::string_view end) { return plain.ends_with(end); });
      if (source) files.push_back(fs::relative(it->path(), root).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> rooms() {
  std::vector<std::string> names;
  for (const Room& room : table()) names.emplace_back(room.folder);
  return names;
}

}  // namespace skerry::architecture
