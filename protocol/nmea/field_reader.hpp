// FieldReader: values out of the fields of a sentence.
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// A field that is empty, or beyond the end of the sentence, is absent: that is how NMEA 0183 says
// that a value is not known.  A field that is there and cannot be read is remembered as the error;
// the first stays.  `sentence` must outlive the reader.
class FieldReader {
 public:
  explicit FieldReader(const Sentence& sentence) : sentence_(sentence) {}

  std::string_view text(std::size_t index) const;
  // The only character of the field, '\0' if it is empty.
  char letter(std::size_t index);
  // A sign, digits and a point; nothing else, in [min, max].
  std::optional<double> number(std::size_t index, double min, double max);
  std::optional<unsigned> whole(std::size_t index, unsigned min, unsigned max);
  // A number whose unit or reference stands in the next field, and is the one that is asked for;
  // otherwise absent.
  std::optional<double> number_in(std::size_t index, char unit, double min, double max);
  // Four fields from `index` on; absent if the first or third is.
  std::optional<GeoPoint> position(std::size_t index);
  std::optional<Duration> time(std::size_t index);  // of day: hhmmss or hhmmss.sss

  // The error of the first field that could not be read.
  const std::optional<WireError>& error() const { return error_; }
  void fail(std::size_t index, const std::string& expected);

 private:
  std::optional<double> degrees_and_minutes(std::size_t index, std::size_t degree_digits,
                                            double most, std::string_view signs);

  const Sentence& sentence_;
  std::optional<WireError> error_ = {};
};

// The value read, or why it could not be read.
template <typename T>
Result<T, WireError> answer(const FieldReader& in, T value) {
  if (in.error()) return Failure{*in.error()};
  return value;
}

}  // namespace skerry::nmea
