#include "protocol/pcap/ipv4_fragments.hpp"

#include <algorithm>
#include <iterator>

namespace skerry::pcap {
namespace {

constexpr std::size_t kMaxTotal = 65535;

}  // namespace

std::list<Ipv4Fragments::Pending>::iterator Ipv4Fragments::find_or_begin(const Key& key) {
  const auto found = std::find_if(pending_.begin(), pending_.end(),
                                  [&](const Pending& each) { return each.key == key; });
  if (found != pending_.end()) return found;
  if (pending_.size() >= max_pending_) {
    pending_.pop_front();
    ++given_up_;
  }
  return pending_.insert(pending_.end(), Pending{key, {}, 0, std::nullopt});
}

Ipv4Fragments::Fit Ipv4Fragments::put(Pending& datagram, std::size_t offset, bool more,
                                      std::span<const std::uint8_t> fragment) {
  const std::size_t end = offset + fragment.size();
  if (fragment.empty() || end > kMaxTotal || (datagram.total && end > *datagram.total)) {
    return Fit::contradiction;
  }
  const auto next = datagram.pieces.lower_bound(offset);
  if (next != datagram.pieces.end() && next->first == offset) {
    return std::equal(fragment.begin(), fragment.end(), next->second.begin(), next->second.end())
               ? Fit::again
               : Fit::contradiction;
  }
  const bool into_next = next != datagram.pieces.end() && next->first < end;
  const bool into_previous = next != datagram.pieces.begin() &&
                             std::prev(next)->first + std::prev(next)->second.size() > offset;
  const bool beyond_last = !more && next != datagram.pieces.end();
  if (into_next || into_previous || beyond_last) return Fit::contradiction;
  if (!more) datagram.total = end;
  datagram.pieces.emplace_hint(next, offset,
                               std::vector<std::uint8_t>(fragment.begin(), fragment.end()));
  datagram.held += fragment.size();
  return Fit::taken;
}

std::optional<std::vector<std::uint8_t>> Ipv4Fragments::add(
    const Key& key, std::size_t offset, bool more, std::span<const std::uint8_t> fragment) {
  const auto datagram = find_or_begin(key);
  if (put(*datagram, offset, more, fragment) == Fit::contradiction) {
    pending_.erase(datagram);
    ++given_up_;
    return std::nullopt;
  }
  if (datagram->held != datagram->total) return std::nullopt;
  std::vector<std::uint8_t> whole;
  whole.reserve(datagram->held);
  for (const auto& [at, piece] : datagram->pieces) {
    whole.insert(whole.end(), piece.begin(), piece.end());
  }
  pending_.erase(datagram);
  return whole;
}

}  // namespace skerry::pcap
