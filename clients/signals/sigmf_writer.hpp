// SigMF recordings of a board's signals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/signals/waveform.hpp"

namespace skerry::client {

// Octets that the recordings of so many channels will take.
std::uint64_t sigmf_bytes(std::uint64_t samples, std::size_t channels);
// Turns that are marked, at most; inspectrum draws a box for each.
inline constexpr std::size_t kMaxAnnotations = 1000;

struct SigmfFiles {
  std::vector<std::string> paths;  // in the order they were written
  SignalFile data;                 // bytes: of all together
};

// One recording per channel, NAME-CHANNEL.sigmf-meta and .sigmf-data, and NAME.sigmf-collection
// that holds them together; readers that know neither interleaved channels nor collections
// (inspectrum) open any of them.  Samples as of Waveform, ri16_le.  Annotations: every turn, from
// ARP to ARP or the end.  What SigMF has no word for stands in the optional extension "skerry":
//   skerry:channel          name
//   skerry:sample_clock_hz  of the board
//   skerry:first_tick       tick of the board's clock at the first sample
//   skerry:code_bits        of video: a sample is code << (15 - code_bits)
// Source: SigMF 1.2.0, the SigMF specification and sigmf-schema.json.
// Error: std::runtime_error "cannot write PATH: why"; that recording is then removed, those before
// it stay, without a collection.  As of pulses_of().
SigmfFiles write_sigmf(const std::string& name, const SignalRecording& recording,
                       const std::vector<SignalChannel>& channels, std::uint32_t rate_hz,
                       const GoOn& go_on);

}  // namespace skerry::client
