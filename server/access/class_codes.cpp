#include "server/access/class_codes.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "server/access/file_text.hpp"
#include "server/access/token_file.hpp"

namespace skerry::server {
namespace {

// Each of the 10^digits numbers is as likely, to 1 in 10^11.
std::string random_digits(unsigned digits) {
  std::uint64_t random = 0;
  if (::getrandom(&random, sizeof random, 0) != static_cast<ssize_t>(sizeof random)) {
    throw std::runtime_error("the system gives no random numbers");
  }
  std::string text;
  for (unsigned i = 0; i < digits; ++i, random /= 10) text += static_cast<char>('0' + random % 10);
  return text;
}

std::string digits_of(std::string_view code) {
  std::string digits;
  for (const char c : code.substr(0, 64)) {
    if (c != ' ' && c != '-') digits += c;
  }
  return digits;
}

}  // namespace

Who ClassCodes::Trainee::who() const { return {access::TRAINEE, ship, name + " (class)", {}}; }

const ClassCodes::Code& ClassCodes::make(const std::string& ship, std::chrono::minutes time,
                                         unsigned digits, UtcTime now) {
  if (ship.empty()) throw std::invalid_argument("a class code is of an own ship; name her");
  require_entry("class code", "of", ship);
  if (time < std::chrono::minutes(1) || time > kLongest) {
    throw std::invalid_argument(fmt::format("a class code holds for 1 to {} minutes, not {}",
                                            kLongest.count(), time.count()));
  }
  if (digits < kFewestDigits || digits > kMostDigits) {
    throw std::invalid_argument(fmt::format("a class code has {} to {} digits, not {}",
                                            kFewestDigits, kMostDigits, digits));
  }
  if (codes_.size() >= kMostCodes && codes_.count(ship) == 0) {
    throw std::invalid_argument(
        fmt::format("there are {} class codes; end one before another is made", kMostCodes));
  }
  std::string made;
  const auto is_taken = [&](const auto& each) { return each.second.digits == made; };
  do {
    made = random_digits(digits);
  } while (std::any_of(codes_.begin(), codes_.end(), is_taken));
  end(ship);
  return codes_[ship] = {ship, std::move(made), now + time, 0};
}

bool ClassCodes::end(std::string_view ship) {
  std::erase_if(trainees_, [&](const auto& each) { return each.second.ship == ship; });
  const auto code = codes_.find(ship);
  if (code == codes_.end()) return false;
  codes_.erase(code);
  return true;
}

std::optional<ClassCodes::SignedIn> ClassCodes::sign_in(std::string_view given,
                                                        const std::string& name, UtcTime now) {
  require_entry("trainee", name, {});
  // What is compared are digests: how long that takes tells nothing of a code.
  const std::string digest = digest_of(digits_of(given));
  const Code* right = nullptr;
  for (const auto& [ship, code] : codes_) {
    if (digest_of(code.digits) == digest && code.takes_in() && now < code.ends) right = &code;
  }
  if (right == nullptr) {
    for (auto& [ship, code] : codes_) code.wrong += code.takes_in() ? 1 : 0;
    return std::nullopt;
  }
  auto oldest = trainees_.end();
  std::size_t others = 0;
  for (auto each = trainees_.begin(); each != trainees_.end(); ++each) {
    if (each->second.ship != right->ship) continue;
    ++others;
    if (oldest == trainees_.end() || each->second.began < oldest->second.began) oldest = each;
  }
  if (others >= kMostTrainees) trainees_.erase(oldest);
  SignedIn made{make_token(), {name, right->ship, now, right->ends}};
  trainees_[digest_of(made.token)] = made.trainee;
  return made;
}

const ClassCodes::Trainee* ClassCodes::find(std::string_view digest, UtcTime now) const {
  const auto found = trainees_.find(digest);
  return found != trainees_.end() && now < found->second.ends ? &found->second : nullptr;
}

bool ClassCodes::sign_out(std::string_view digest) {
  const auto found = trainees_.find(digest);
  if (found == trainees_.end()) return false;
  trainees_.erase(found);
  return true;
}

bool ClassCodes::refresh(UtcTime now) {
  std::erase_if(codes_, [&](const auto& each) { return now >= each.second.ends; });
  return std::erase_if(trainees_, [&](const auto& each) { return now >= each.second.ends; }) > 0;
}

bool ClassCodes::takes_in(UtcTime now) const {
  return std::any_of(codes_.begin(), codes_.end(), [&](const auto& each) {
    return each.second.takes_in() && now < each.second.ends;
  });
}

std::vector<std::string> ClassCodes::trainees_of(std::string_view ship, UtcTime now) const {
  std::vector<std::string> names;
  for (const auto& [digest, trainee] : trainees_) {
    if (trainee.ship == ship && now < trainee.ends) names.push_back(trainee.name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace skerry::server
