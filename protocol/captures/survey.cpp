#include "protocol/captures/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/asterix/cat240.hpp"
#include "protocol/captures/navico_facts.hpp"
#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/navico/frame.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/quantum_spoke.hpp"
#include "protocol/raymarine/rd_packets.hpp"

namespace skerry::captures {
namespace {

constexpr std::size_t kMostOthers = 256, kOthersTold = 4;
// The Quantum 2 with Doppler.
constexpr std::string_view kDopplerQuantum = "E70498";
constexpr std::uint32_t kNorthUnits = 65'536;  // azimuths of CAT240 in a turn

// How long a turn takes: the middle one of many measurements, each of a sixteenth of a turn or more
// without a pause.
class TurnTimer {
 public:
  void take(std::uint32_t index, std::uint32_t spokes, UtcTime time) {
    const std::uint32_t steps = spokes == spokes_ ? (index + spokes - index_) % spokes : spokes;
    const Duration passed = time - time_;
    index_ = index;
    spokes_ = spokes;
    time_ = time;
    if (steps >= spokes / 4 || passed < Duration{} || passed > kPause) {
      steps_ = 0;
      begin_ = time;
      return;
    }
    steps_ += steps;
    // Radars send in bursts: only a spoke that comes after a while ends a measurement.
    if (steps_ < spokes / 16 || passed < kWhile) return;
    const double turn_s = in_seconds(time - begin_) * spokes / steps_;
    if (turn_s >= kShortest_s && turn_s <= kLongest_s && turns_s_.size() < kMost) {
      turns_s_.push_back(turn_s);
    }
    steps_ = 0;
    begin_ = time;
  }
  // 0: not known.
  Duration turn() const {
    if (turns_s_.empty()) return {};
    std::vector<double> sorted = turns_s_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return seconds_as_duration(*middle);
  }

 private:
  static constexpr Duration kPause = std::chrono::milliseconds(500);
  static constexpr Duration kWhile = std::chrono::milliseconds(1);
  static constexpr double kShortest_s = 0.2, kLongest_s = 120.0;
  static constexpr std::size_t kMost = 10'000;

  std::uint32_t index_ = 0, spokes_ = 0, steps_ = 0;
  UtcTime time_{}, begin_{};
  std::vector<double> turns_s_;
};

// How many spokes a CAT240 sender has in a turn: by how wide they say they are, or by how far one
// is from the next where they say nothing.
class SpokeWidths {
 public:
  void take(const Cat240Video& video) {
    const std::uint16_t own = static_cast<std::uint16_t>(video.end_azimuth - video.start_azimuth);
    const std::uint16_t step = static_cast<std::uint16_t>(video.start_azimuth - last_);
    if (own > 0 && own < kWidest) add(own, own_);
    if (begun_ && step > 0 && step < kWidest) add(step, steps_);
    last_ = video.start_azimuth;
    begun_ = true;
  }
  std::uint32_t spokes_per_turn() const {
    const Sum& sum = own_.count > 0 ? own_ : steps_;
    if (sum.count == 0) return ScanGeometry::kMinSpokes;
    const double width = static_cast<double>(sum.total) / static_cast<double>(sum.count);
    return static_cast<std::uint32_t>(std::clamp(std::round(kNorthUnits / width),
                                                 double{ScanGeometry::kMinSpokes},
                                                 double{ScanGeometry::kMaxSpokes}));
  }

 private:
  static constexpr std::uint16_t kWidest = 4096;
  struct Sum {
    std::uint64_t total = 0, count = 0;
  };
  static void add(std::uint16_t width, Sum& sum) {
    sum.total += width;
    ++sum.count;
  }
  Sum own_, steps_;
  std::uint16_t last_ = 0;
  bool begun_ = false;
};

}  // namespace

struct Surveyor::Facts : NavicoFacts {};

struct Surveyor::Seen {
  explicit Seen(const PictureKey& key)
      : decoder(make_picture({.key = key,
                              .model = navico::Model::g4,
                              .reports = {},
                              .spokes_per_turn = kCat240Provisional,
                              .doppler = false,
                              .turn = {}})) {}

  static constexpr std::uint32_t kCat240Provisional = ScanGeometry::kMaxSpokes;
  std::unique_ptr<PictureDecoder> decoder;
  SurveyedPicture picture;
  TurnTimer timer;
  NavicoForms forms;
  SpokeWidths widths;
};

Surveyor::Surveyor() : facts_(std::make_unique<Facts>()) {}
Surveyor::~Surveyor() = default;

Surveyor::Seen* Surveyor::find_or_begin(const PictureKey& key) {
  for (const auto& each : seen_) {
    if (each->decoder->traits().key == key) return each.get();
  }
  if (seen_.size() >= kMaxPictures) return nullptr;
  seen_.push_back(std::make_unique<Seen>(key));
  return seen_.back().get();
}

void Surveyor::take(const capture::Datagram& datagram) {
  begin_ = std::min(begin_, datagram.time);
  end_ = std::max(end_, datagram.time);
  const auto key = picture_of(datagram);
  if (!key) {
    facts_->take(datagram);
    const auto info = raymarine::decode_quantum_info(datagram.payload);
    if (info && info->part_number == kDopplerQuantum && doppler_quantums_.size() < kMaxPictures) {
      doppler_quantums_.insert(datagram.from.address);
    }
    if (others_.contains(datagram.to) || others_.size() < kMostOthers) ++others_[datagram.to];
    return;
  }
  Seen* const seen = find_or_begin(*key);
  if (seen == nullptr) {
    ++left_out_;
    return;
  }
  std::vector<CapturedSpoke> spokes;
  if (const auto refusal = seen->decoder->decode(datagram, spokes)) {
    if (seen->picture.refused++ == 0) seen->picture.refusal = refusal->text;
    return;
  }
  if (key->family == Family::navico) seen->forms.take(datagram.payload);
  if (key->family == Family::cat240) {
    if (const auto records = decode_cat240(datagram.payload)) {
      for (const auto& record : *records) {
        if (record.video) seen->widths.take(*record.video);
      }
    }
  }
  for (const CapturedSpoke& spoke : spokes) {
    ++seen->picture.spokes;
    seen->picture.cells =
        std::max(seen->picture.cells, static_cast<std::uint32_t>(spoke.cells.size()));
    seen->picture.bits = spoke.bits;
    seen->timer.take(spoke.index, spoke.spokes_per_turn, spoke.time);
  }
}

void Surveyor::finish(const Seen& seen, SurveyedPicture& picture) const {
  PictureTraits& traits = picture.traits;
  traits = seen.decoder->traits();
  traits.turn = seen.timer.turn();
  picture.rpm = traits.turn > Duration{} ? 60.0 / in_seconds(traits.turn) : 0.0;
  picture.name = name_of(traits.key.family);
  switch (traits.key.family) {
    case Family::navico:
      traits.model = facts_->model_of(traits.key.from, seen.forms);
      traits.reports = facts_->reports_of(traits.key.from, traits.key.to);
      traits.doppler = facts_->begins_with_doppler(traits.reports);
      traits.spokes_per_turn = navico::kTurnSpokes;
      picture.name = facts_->name_of(traits.key.from, seen.forms);
      break;
    case Family::garmin:
      traits.spokes_per_turn = garmin::kSpokesPerTurn;
      break;
    case Family::quantum:
      traits.doppler = doppler_quantums_.contains(traits.key.from);
      traits.spokes_per_turn = raymarine::kQuantumSpokes;
      break;
    case Family::rd:
      traits.spokes_per_turn = raymarine::kRdSpokes;
      break;
    case Family::cat240:
      traits.spokes_per_turn = seen.widths.spokes_per_turn();
      picture.name += fmt::format(" {}/{}", traits.key.source >> 8, traits.key.source & 0xFF);
      break;
  }
}

std::vector<SurveyedPicture> Surveyor::pictures() const {
  std::vector<SurveyedPicture> pictures;
  std::map<std::string, int> namesakes;
  for (const auto& seen : seen_) {
    if (seen->picture.spokes == 0) continue;
    pictures.push_back(seen->picture);
    finish(*seen, pictures.back());
    ++namesakes[pictures.back().name];
  }
  std::map<std::string, char> letters;
  for (SurveyedPicture& picture : pictures) {
    if (namesakes[picture.name] < 2) continue;
    const char letter = static_cast<char>('A' + letters[picture.name]++);
    picture.name += fmt::format(" {}", letter);
  }
  return pictures;
}

std::string Surveyor::others() const {
  std::vector<std::pair<std::uint64_t, Ipv4Endpoint>> most;
  for (const auto& [to, count] : others_) most.emplace_back(count, to);
  std::sort(most.rbegin(), most.rend());
  std::string text;
  for (std::size_t i = 0; i < std::min(most.size(), kOthersTold); ++i) {
    text += fmt::format("{}{} to {}", i == 0 ? "" : ", ", most[i].first, text_of(most[i].second));
  }
  return text;
}

}  // namespace skerry::captures
