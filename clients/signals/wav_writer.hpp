// WAV files of a board's signals.
#pragma once

#include <cstdint>
#include <string>

#include "clients/signals/waveform.hpp"

namespace skerry::client {

// Octets that the file will take.
std::uint64_t wav_bytes(std::uint64_t samples, std::size_t channels);
// Above so many bytes of samples the file is RF64, whose sizes have 64 bits.
inline constexpr std::uint64_t kLargestWav = 0xFFF00000;

// 16-bit PCM, channels interleaved in the order of the waveform, its rate that of the file; RF64
// where 32-bit sizes do not do.  The comment names the channels and full scale.  `large_from`: for
// tests, in place of kLargestWav.
// Error: std::runtime_error "cannot write PATH: why"; the file is then removed.
SignalFile write_wav(const std::string& path, const SignalRecording& recording, Waveform& waveform,
                     const GoOn& go_on, std::uint64_t large_from = kLargestWav);

}  // namespace skerry::client
