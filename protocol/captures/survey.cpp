#include "protocol/captures/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/asterix/cat240.hpp"
#include "protocol/captures/navico_facts.hpp"
#include "protocol/captures/spoke_widths.hpp"
#include "protocol/captures/turn_timer.hpp"
#include "protocol/furuno/spoke_frame.hpp"
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
  std::uint32_t spokes_per_turn = 0;  // of the last spoke
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

void Surveyor::take(const pcap::Datagram& datagram) {
  begin_ = std::min(begin_, datagram.time);
  end_ = std::max(end_, datagram.time);
  const auto key = picture_of(datagram);
  if (!key) {
    facts_->take(datagram);
    const auto info = raymarine::decode_quantum_info(datagram.payload);
    if (info && info->part_number == kDopplerQuantum && doppler_quantums_.size() < kMaxPictures) {
      doppler_quantums_.insert(datagram.from.address);
    }
    const auto furuno = furuno::decode_model(datagram.payload);
    if (furuno && furuno_models_.size() < kMaxPictures) {
      furuno_models_.emplace(datagram.from.address, *furuno);
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
    seen->spokes_per_turn = spoke.spokes_per_turn;
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
      picture.certain = facts_->knows_generation(traits.key.from, seen.forms);
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
    case Family::furuno: {
      traits.spokes_per_turn = kFurunoSpokes;
      const auto model = furuno_models_.find(traits.key.from);
      if (model != furuno_models_.end()) picture.name += " " + model->second;
      if (traits.key.source != 0) picture.name += " B";
      break;
    }
    case Family::native:
      traits.spokes_per_turn = seen.spokes_per_turn;
      picture.name +=
          fmt::format(" radar {} view {}", traits.key.source >> 8, traits.key.source & 0xFF);
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
