#include "protocol/recording/packed_spokes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "protocol/recording/cell_differences.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/wire/varint.hpp"

namespace skerry::recording {
namespace {

// Fields of SpokeNumbers.
enum Field : std::size_t {
  kRadar,
  kView,
  kSequence,
  kScan,
  kIndex,
  kSpokesPerTurn,
  kRangeScale,
  kBits,
  kCellCount,
  kCellSize,
  kHeading,
  kLatitude,
  kLongitude,
  kUtc,
  kScenario,
};
static_assert(kScenario + 1 == SpokeNumbers::kFields);

// The order in which fields are foretold.
constexpr std::array<std::size_t, SpokeNumbers::kFields> kOrder = {
    kRadar,     kView,     kSequence, kIndex,    kScan,      kSpokesPerTurn, kRangeScale, kBits,
    kCellCount, kCellSize, kHeading,  kLatitude, kLongitude, kUtc,           kScenario};

// The most octets of a spoke's numbers: a mask, and a varint for each field's difference.
constexpr std::size_t kMaxNumberBytes = 3 + kMaxVarintOctets * SpokeNumbers::kFields;
// Before and between the parts of a message.
constexpr std::size_t kMaxFrameBytes = 64;

// Moves `offset` behind the varint that stands there; nullopt if there is none.
std::optional<std::uint64_t> varint_at(std::span<const std::uint8_t> in, std::size_t& offset) {
  const Varint varint = read_varint(in.subspan(offset));
  if (varint.octets == 0) return std::nullopt;
  offset += varint.octets;
  return varint.value;
}

std::uint64_t zigzag(std::uint64_t difference) {
  return difference << 1 ^ (difference >> 63 != 0 ? ~std::uint64_t{0} : 0);
}
std::uint64_t unzigzag(std::uint64_t value) { return value >> 1 ^ (0 - (value & 1)); }

SpokeNumbers numbers_of(const wire::Spoke& spoke) {
  return {{spoke.radar(), spoke.view(), spoke.sequence(), spoke.scan(), spoke.index(),
           spoke.spokes_per_turn(), spoke.range_scale(), spoke.bits(), spoke.cell_count(),
           std::bit_cast<std::uint64_t>(spoke.cell_size_m()), spoke.heading(),
           std::bit_cast<std::uint64_t>(spoke.latitude_deg()),
           std::bit_cast<std::uint64_t>(spoke.longitude_deg()), spoke.utc_ns(),
           spoke.scenario_ns()}};
}

void set_numbers(const SpokeNumbers& numbers, wire::Spoke& spoke) {
  const auto& v = numbers.values;
  const auto u32 = [&](Field field) { return static_cast<std::uint32_t>(v[field]); };
  spoke.set_radar(u32(kRadar));
  spoke.set_view(u32(kView));
  spoke.set_sequence(v[kSequence]);
  spoke.set_scan(u32(kScan));
  spoke.set_index(u32(kIndex));
  spoke.set_spokes_per_turn(u32(kSpokesPerTurn));
  spoke.set_range_scale(u32(kRangeScale));
  spoke.set_bits(u32(kBits));
  spoke.set_cell_count(u32(kCellCount));
  spoke.set_cell_size_m(std::bit_cast<double>(v[kCellSize]));
  spoke.set_heading(u32(kHeading));
  spoke.set_latitude_deg(std::bit_cast<double>(v[kLatitude]));
  spoke.set_longitude_deg(std::bit_cast<double>(v[kLongitude]));
  spoke.set_utc_ns(v[kUtc]);
  spoke.set_scenario_ns(v[kScenario]);
}

void serialise(const wire::Spoke& spoke, Bytes& out) {
  out.resize(spoke.ByteSizeLong());
  spoke.SerializeWithCachedSizesToArray(out.data());
}

}  // namespace

std::uint64_t SpokeForecast::of(std::size_t field, const SpokeNumbers& spoke) const {
  const auto& last = last_.values;
  switch (field) {
    case kSequence:
      return last[kSequence] + 1;
    case kScan:
      // The antenna has passed the bow.  The index comes before it, see kOrder.
      return spoke.values[kIndex] < last[kIndex] ? last[kScan] + 1 : last[kScan];
    case kIndex:
      return last[kIndex] + 1 == last[kSpokesPerTurn] ? 0 : last[kIndex] + 1;
    case kHeading:
    case kLatitude:
    case kLongitude:
    case kUtc:
    case kScenario:
      return 2 * last[field] - before_.values[field];
    default:
      return last[field];
  }
}

bool SpokePacker::add(std::span<const std::uint8_t> spoke, std::uint64_t time_ns) {
  if (!message_.ParseFromArray(spoke.data(), static_cast<int>(spoke.size()))) return false;
  message_.DiscardUnknownFields();
  serialise(message_, again_);
  if (!std::equal(again_.begin(), again_.end(), spoke.begin(), spoke.end()) ||
      message_.utc_ns() != time_ns) {
    return false;
  }
  const std::string& cells = message_.cells();
  const std::string& doppler = message_.doppler();
  if (count_ > 0 &&
      (cells.size() != cell_bytes_ || doppler.size() != doppler_bytes_ || time_ns < last_time_ ||
       time_ns - first_time_ >= static_cast<std::uint64_t>(kMaxPackedSpan.count()))) {
    return false;
  }
  if (count_ == 0) {
    first_time_ = time_ns;
    cell_bytes_ = cells.size();
    doppler_bytes_ = doppler.size();
  }
  last_time_ = time_ns;
  ++count_;
  const SpokeNumbers numbers = numbers_of(message_);
  std::uint64_t mask = 0;
  std::array<std::uint64_t, SpokeNumbers::kFields> differences{};
  for (const std::size_t field : kOrder) {
    differences[field] = numbers.values[field] - forecast_.of(field, numbers);
    if (differences[field] != 0) mask |= std::uint64_t{1} << field;
  }
  append_varint(numbers_, mask);
  for (const std::size_t field : kOrder) {
    if (differences[field] != 0) append_varint(numbers_, zigzag(differences[field]));
  }
  forecast_.take(numbers);
  cells_.insert(cells_.end(), cells.begin(), cells.end());
  doppler_.insert(doppler_.end(), doppler.begin(), doppler.end());
  return true;
}

std::size_t SpokePacker::size_bound() const {
  return kMaxFrameBytes + kMaxNumberBytes + numbers_.size() + cells_.size() + doppler_.size();
}

void SpokePacker::finish(Bytes& out) {
  Bytes data;
  data.reserve(size_bound());
  append_varint(data, cell_bytes_);
  append_varint(data, doppler_bytes_);
  append_varint(data, numbers_.size());
  data.insert(data.end(), numbers_.begin(), numbers_.end());
  append_differences(cells_, cell_bytes_, data);
  append_differences(doppler_, doppler_bytes_, data);
  PackedSpokes message;
  message.set_count(count_);
  message.set_data(data.data(), data.size());
  const std::size_t begin = out.size();
  out.resize(begin + message.ByteSizeLong());
  message.SerializeWithCachedSizesToArray(out.data() + begin);
  count_ = 0;
  forecast_ = {};
  numbers_.clear();
  cells_.clear();
  doppler_.clear();
}

std::uint32_t packed_count(std::span<const std::uint8_t> message) {
  // The tag of the count, which is written first.
  constexpr std::uint8_t kCountTag = 1 << 3;
  if (message.empty() || message[0] != kCountTag) return 0;
  std::size_t offset = 1;
  return static_cast<std::uint32_t>(varint_at(message, offset).value_or(0));
}

Result<std::unique_ptr<SpokeUnpacker>, std::string> SpokeUnpacker::open(
    std::span<const std::uint8_t> message) {
  PackedSpokes packed;
  if (!packed.ParseFromArray(message.data(), static_cast<int>(message.size()))) {
    return Failure{std::string("packed spokes are no PackedSpokes message")};
  }
  const std::span<const std::uint8_t> data(
      reinterpret_cast<const std::uint8_t*>(packed.data().data()), packed.data().size());
  std::size_t offset = 0;
  const auto cell_bytes = varint_at(data, offset);
  const auto doppler_bytes = varint_at(data, offset);
  const auto number_bytes = varint_at(data, offset);
  const std::uint64_t count = packed.count();
  const std::uint64_t left = data.size() - offset;
  // Every spoke has a mask at least; nothing overflows, for all are less than the message.
  if (!cell_bytes || !doppler_bytes || !number_bytes || *number_bytes > left ||
      *number_bytes < count || *cell_bytes > left || *doppler_bytes > left ||
      count * (*cell_bytes + *doppler_bytes) != left - *number_bytes) {
    return Failure{
        fmt::format("{} packed spokes in {} octets do not fit what they say", count, data.size())};
  }
  std::unique_ptr<SpokeUnpacker> made(new SpokeUnpacker);
  made->left_ = packed.count();
  made->cell_bytes_ = static_cast<std::size_t>(*cell_bytes);
  made->doppler_bytes_ = static_cast<std::size_t>(*doppler_bytes);
  const auto numbers = data.subspan(offset, static_cast<std::size_t>(*number_bytes));
  made->numbers_.assign(numbers.begin(), numbers.end());
  const auto video = data.subspan(offset + numbers.size());
  const auto cells = static_cast<std::size_t>(count * *cell_bytes);
  made->cells_ = rows_of(video.first(cells), made->cell_bytes_);
  made->doppler_ = rows_of(video.subspan(cells), made->doppler_bytes_);
  return made;
}

bool SpokeUnpacker::read_numbers(SpokeNumbers& spoke) {
  const auto mask = varint_at(numbers_, offset_);
  if (!mask || *mask >> SpokeNumbers::kFields != 0) return false;
  for (const std::size_t field : kOrder) {
    std::uint64_t difference = 0;
    if ((*mask >> field & 1) != 0) {
      const auto stored = varint_at(numbers_, offset_);
      if (!stored) return false;
      difference = unzigzag(*stored);
    }
    spoke.values[field] = forecast_.of(field, spoke) + difference;
  }
  return true;
}

bool SpokeUnpacker::next() {
  if (left_ == 0 || broken_) return false;
  SpokeNumbers numbers;
  broken_ = !read_numbers(numbers) || numbers.values[kUtc] >> 63 != 0;
  if (broken_) return false;
  const auto time = static_cast<std::int64_t>(numbers.values[kUtc]);
  if (taken_ == 0) first_time_ = time_ = time;
  broken_ = time < time_ || time - first_time_ >= kMaxPackedSpan.count();
  if (broken_) return false;
  time_ = time;
  forecast_.take(numbers);
  set_numbers(numbers, message_);
  const auto* cells = reinterpret_cast<const char*>(cells_.data()) + taken_ * cell_bytes_;
  const auto* doppler = reinterpret_cast<const char*>(doppler_.data()) + taken_ * doppler_bytes_;
  message_.set_cells(cells, cell_bytes_);
  message_.set_doppler(doppler, doppler_bytes_);
  serialise(message_, bytes_);
  ++taken_;
  --left_;
  return true;
}

}  // namespace skerry::recording
