#include "server/recorder/checkpoints.hpp"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace skerry::server {

struct Checkpoints::Stretch {
  struct Free {
    void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
  };
  std::unique_ptr<EVP_MD_CTX, Free> hash{EVP_MD_CTX_new()};
  std::uint64_t first = 0, spokes = 0;
  UtcTime begun{};

  explicit Stretch(const FramedSpoke& spoke) : first(spoke.sequence), begun(spoke.utc) {
    if (!hash || EVP_DigestInit_ex(hash.get(), EVP_sha256(), nullptr) != 1) {
      throw std::runtime_error("OpenSSL has no SHA-256");
    }
  }
  void add(const FramedSpoke& spoke) {
    EVP_DigestUpdate(hash.get(), spoke.bytes.data(), spoke.bytes.size());
    ++spokes;
  }
};

Checkpoints::Checkpoints() = default;
Checkpoints::~Checkpoints() = default;

std::optional<recording::Input> Checkpoints::add(std::uint32_t radar, std::uint32_t view,
                                                 const FramedSpoke& spoke) {
  std::unique_ptr<Stretch>& stretch = stretches_[{radar, view}];
  std::optional<recording::Input> ended;
  const bool goes_on = stretch && spoke.sequence == stretch->first + stretch->spokes &&
                       spoke.utc - stretch->begun < kTime;
  if (!goes_on) {
    if (stretch) ended = end({radar, view}, *stretch);
    stretch = std::make_unique<Stretch>(spoke);
  }
  stretch->add(spoke);
  return ended;
}

std::optional<recording::Input> Checkpoints::take() {
  if (stretches_.empty()) return std::nullopt;
  const auto first = stretches_.begin();
  recording::Input ended = end(first->first, *first->second);
  stretches_.erase(first);
  return ended;
}

recording::Input Checkpoints::end(const View& view, Stretch& stretch) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  EVP_DigestFinal_ex(stretch.hash.get(), digest.data(), &size);
  recording::Input input;
  recording::Input::Checkpoint& checkpoint = *input.mutable_checkpoint();
  checkpoint.set_radar(view.first);
  checkpoint.set_view(view.second);
  checkpoint.set_first_sequence(stretch.first);
  checkpoint.set_spokes(stretch.spokes);
  checkpoint.set_sha256(digest.data(), size);
  return input;
}

}  // namespace skerry::server
