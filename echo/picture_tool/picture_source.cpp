#include "echo/picture_tool/picture_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "protocol/captures/importer.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/video/scan.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kMostMissing = 20;  // one of so many spokes

// A file of our own, gone with us.
class TemporaryFile {
 public:
  TemporaryFile() {
    path_ = (std::filesystem::temp_directory_path() / "skerry_picture_XXXXXX").string();
    const int file = ::mkstemp(path_.data());
    if (file < 0) throw std::runtime_error("cannot write a temporary file " + path_);
    ::close(file);
  }
  ~TemporaryFile() { ::unlink(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

bool is_recording(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file + ": cannot be opened");
  std::array<char, 5> magic{};
  in.read(magic.data(), magic.size());
  return in && magic == std::array<char, 5>{'\x89', 'M', 'C', 'A', 'P'};
}

// Unpacks a capture into a recording.
void import_to(const std::string& file, const std::string& path) {
  std::ofstream out(path, std::ios::binary);
  recording::RecordingWriter writer(
      [&](std::span<const std::uint8_t> bytes) {
        out.write(reinterpret_cast<const char*>(bytes.data()),
                  static_cast<std::streamsize>(bytes.size()));
        return out.good();
      },
      {});
  const auto report = captures::import_capture_file(file, writer);
  if (!report) throw std::runtime_error(report.error().to_string());
  if (!writer.finish() || !out) throw std::runtime_error(path + ": no room for the capture");
}

// Reaches are told apart to 2 %.
struct Collected {
  double reach_m = 0.0;
  ScanGeometry geometry;
  std::size_t whole = 0, broken = 0;
};

bool alike(double a, double b) { return std::fabs(a - b) <= 0.02 * std::max(a, b); }

struct Collector {
  void take(const Scan& scan) {
    const Spoke* newest = scan.newest();
    if (!newest) return;
    const double reach = newest->header.reach().in_metres();
    const bool one = std::all_of(scan.spokes.begin(), scan.spokes.end(), [&](const auto& spoke) {
      return !spoke || alike(spoke->header.reach().in_metres(), reach);
    });
    const bool whole = one && scan.missing() * kMostMissing <= scan.geometry.spokes_per_turn;
    Collected& all = at(reach, scan.geometry);
    ++(whole ? all.whole : all.broken);
  }

  std::vector<Collected> found;

  Collected& at(double reach, const ScanGeometry& geometry) {
    for (Collected& each : found) {
      if (alike(each.reach_m, reach) && each.geometry == geometry) return each;
    }
    return found.emplace_back(Collected{reach, geometry, 0, 0});
  }
};

// Its cells in order; a missing spoke is its neighbour before.
std::vector<std::uint8_t> video_of(const Scan& scan) {
  const std::uint32_t spokes = scan.geometry.spokes_per_turn, cells = scan.geometry.cells;
  std::vector<std::uint8_t> video(std::size_t{spokes} * cells);
  const Spoke* last = nullptr;
  for (std::uint32_t k = 0; k < 2 * spokes; ++k) {
    const auto& spoke = scan.spokes[k % spokes];
    if (spoke) last = &*spoke;
    if (last && last->cells.size() == cells)
      std::copy(last->cells.begin(), last->cells.end(),
                video.begin() + static_cast<std::ptrdiff_t>(std::size_t{k % spokes} * cells));
  }
  return video;
}

template <typename Sink>
void each_scan(const recording::RecordingReader& reader, std::uint32_t radar, Sink sink) {
  recording::ItemCursor cursor = reader.items({{recording::Kind::spoke, radar, 0}});
  ScanAssembler assembler;
  wire::Spoke message;
  while (const auto item = cursor.next()) {
    if (!message.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) continue;
    auto spoke = from_message(message);
    if (!spoke) continue;
    if (const auto scan = assembler.feed(*std::move(spoke))) sink(*scan);
  }
  if (assembler.unfinished().received > 0) sink(assembler.unfinished());
}

std::string reaches_text(const std::vector<Collected>& found) {
  std::string text;
  for (const Collected& each : found)
    text += fmt::format("{}{:.0f} m ({} whole, {} not)", text.empty() ? "" : ", ", each.reach_m,
                        each.whole, each.broken);
  return text.empty() ? "none at all" : text;
}

const Collected& chosen(const std::vector<Collected>& found, const PictureChoice& choice,
                        const std::string& file) {
  const Collected* best = nullptr;
  for (const Collected& each : found) {
    if (each.whole == 0 || (choice.reach_m > 0.0 && !alike(each.reach_m, choice.reach_m))) continue;
    if (!best || each.whole > best->whole) best = &each;
  }
  if (best) return *best;
  throw std::runtime_error(fmt::format(
      "{}: no whole turn of radar {}{}: a picture needs a turn of which at most a twentieth of the "
      "spokes is missing. Turns by reach: {}",
      file, choice.radar,
      choice.reach_m > 0.0 ? fmt::format(" at a reach of {:.0f} m", choice.reach_m) : "",
      reaches_text(found)));
}

}  // namespace

TurnsOfPicture read_picture(const std::string& file, const PictureChoice& choice) {
  std::optional<TemporaryFile> unpacked;
  std::string path = file;
  if (!is_recording(file)) {
    unpacked.emplace();
    import_to(file, unpacked->path());
    path = unpacked->path();
  }
  const auto reader = recording::RecordingReader::open(path);
  if (!reader) throw std::runtime_error(reader.error().to_string());

  Collector collector;
  each_scan(*reader, choice.radar, [&](const Scan& scan) { collector.take(scan); });
  const Collected& best = chosen(collector.found, choice, file);

  TurnsOfPicture picture;
  picture.file = file;
  picture.reach_m = best.reach_m;
  picture.spokes = best.geometry.spokes_per_turn;
  picture.cells = best.geometry.cells;
  picture.full_scale = best.geometry.bits == 4 ? 15 : 255;
  if (const auto hello = reader->hello()) {
    for (const auto& info : hello->radars()) {
      if (info.radar() == choice.radar) picture.radar = info.name(), picture.rpm = info.rpm();
    }
  }
  std::optional<std::uint32_t> last;
  each_scan(*reader, choice.radar, [&](const Scan& scan) {
    const Spoke* newest = scan.newest();
    if (!newest || !(scan.geometry == best.geometry) ||
        scan.missing() * kMostMissing > scan.geometry.spokes_per_turn)
      return;
    for (const auto& spoke : scan.spokes) {
      if (spoke && !alike(spoke->header.reach().in_metres(), best.reach_m)) return;
    }
    if (picture.turns.size() >= choice.most_turns) return;
    picture.turns.push_back(video_of(scan));
    picture.follows.push_back(last && scan.number == *last + 1);
    last = scan.number;
  });
  if (best.broken > 0)
    picture.notes.push_back(fmt::format("{} turn{} with gaps or a change of range left out",
                                        best.broken, best.broken == 1 ? "" : "s"));
  if (best.whole > picture.turns.size())
    picture.notes.push_back(
        fmt::format("the first {} of {} whole turns", picture.turns.size(), best.whole));
  return picture;
}

}  // namespace skerry::echo
