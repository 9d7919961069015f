// ClassCodes: the codes by which a class signs in without accounts, and who has.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/access/rights.hpp"

namespace skerry::server {

// A code is 6 to 8 random digits, short enough to be written on a board.  Whoever knows it is a
// trainee of one own ship until it ends.  It is kept in memory alone: with the server, and so with
// its exercise, all codes end.
//
// It cannot be guessed: after kMostWrong wrong tries, of whoever, all codes of that time take
// nobody in any more (who is in stays).  With n codes of d digits all guesses together find one
// with a probability of n * kMostWrong / 10^d: 1 in 50,000 for one code of 6 digits, 1 in 5,000,000
// for one of 8.
//
// Thread: one at a time.
class ClassCodes {
 public:
  static constexpr unsigned kFewestDigits = 6, kMostDigits = 8;
  static constexpr std::chrono::minutes kLongest{24 * 60}, kUsual{4 * 60};
  static constexpr unsigned kMostWrong = 20;
  static constexpr std::size_t kMostCodes = 64;
  // Signed in by one code; of more the one who signed in first is out.
  static constexpr std::size_t kMostTrainees = 100;

  struct Code {
    std::string ship;
    std::string digits;
    UtcTime ends{};
    unsigned wrong = 0;
    bool takes_in() const { return wrong < kMostWrong; }
  };
  struct Trainee {
    std::string name;  // as she gave it
    std::string ship;
    UtcTime began{}, ends{};
    Who who() const;  // "NAME (class)", a trainee of the ship
  };

  // The ship's code from now on; the one before it, if there was one, ends.
  // Error: std::invalid_argument if a value is not allowed or there are kMostCodes;
  // std::runtime_error if the system gives no random numbers.
  const Code& make(const std::string& ship, std::chrono::minutes time, unsigned digits,
                   UtcTime now);
  // False if there is none.  Who signed in by it is out.
  bool end(std::string_view ship);

  struct SignedIn {
    std::string token;
    Trainee trainee;
  };
  // Nothing: the code is wrong, which counts.  Spaces and hyphens in it do not.
  // Error: std::invalid_argument if the name is none (1 to 64 bytes of printable letters).
  std::optional<SignedIn> sign_in(std::string_view code, const std::string& name, UtcTime now);
  // nullptr: nobody.  `digest`: of her token (token_file.hpp).
  const Trainee* find(std::string_view digest, UtcTime now) const;
  bool sign_out(std::string_view digest);

  // Forgets what has ended.  True if somebody is out now.
  bool refresh(UtcTime now);

  // In the order of ships; also those that take nobody in any more.
  const std::map<std::string, Code, std::less<>>& codes() const { return codes_; }
  bool takes_in(UtcTime now) const;  // any of them
  std::vector<std::string> trainees_of(std::string_view ship, UtcTime now) const;

 private:
  std::map<std::string, Code, std::less<>> codes_;        // by ship
  std::map<std::string, Trainee, std::less<>> trainees_;  // by the digest of the token
};

}  // namespace skerry::server
