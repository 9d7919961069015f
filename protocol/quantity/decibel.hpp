// Decibels (a ratio) and PowerDbm (a level).  level - level = ratio, level + ratio = level;
// level + level does not compile.
#pragma once

#include <cmath>
#include <compare>

namespace skerry {

class Decibels {
 public:
  constexpr Decibels() = default;
  static Decibels from_ratio(double power_ratio) {
    return Decibels(10.0 * std::log10(power_ratio));
  }
  constexpr double value() const { return db_; }
  double as_ratio() const { return std::pow(10.0, db_ / 10.0); }

  friend constexpr Decibels operator+(Decibels a, Decibels b) { return Decibels(a.db_ + b.db_); }
  friend constexpr Decibels operator-(Decibels a, Decibels b) { return Decibels(a.db_ - b.db_); }
  friend constexpr Decibels operator-(Decibels a) { return Decibels(-a.db_); }
  friend constexpr Decibels operator*(Decibels a, double k) { return Decibels(a.db_ * k); }
  friend constexpr auto operator<=>(Decibels, Decibels) = default;

 private:
  explicit constexpr Decibels(double db) : db_(db) {}
  friend constexpr Decibels decibels(double value);
  double db_ = 0.0;
};
constexpr Decibels decibels(double value) { return Decibels(value); }

// A power level relative to 1 mW.
class PowerDbm {
 public:
  constexpr PowerDbm() = default;
  static PowerDbm from_watts(double watts) { return PowerDbm(10.0 * std::log10(watts) + 30.0); }
  constexpr double value() const { return dbm_; }
  double in_watts() const { return std::pow(10.0, (dbm_ - 30.0) / 10.0); }

  friend constexpr PowerDbm operator+(PowerDbm a, Decibels b) {
    return PowerDbm(a.dbm_ + b.value());
  }
  friend constexpr PowerDbm operator-(PowerDbm a, Decibels b) {
    return PowerDbm(a.dbm_ - b.value());
  }
  friend constexpr Decibels operator-(PowerDbm a, PowerDbm b) { return decibels(a.dbm_ - b.dbm_); }
  friend constexpr auto operator<=>(PowerDbm, PowerDbm) = default;

 private:
  explicit constexpr PowerDbm(double dbm) : dbm_(dbm) {}
  friend constexpr PowerDbm dbm(double value);
  double dbm_ = 0.0;
};
constexpr PowerDbm dbm(double value) { return PowerDbm(value); }

}  // namespace skerry
