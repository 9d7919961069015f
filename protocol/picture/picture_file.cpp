#include "protocol/picture/picture_file.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "protocol/picture/label_text.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry {
namespace {

void append_bytes(png_structp png, png_bytep data, png_size_t size) {
  bool kept = true;
  try {
    auto& out = *static_cast<Bytes*>(png_get_io_ptr(png));
    out.insert(out.end(), data, data + size);
  } catch (const std::exception&) {
    kept = false;
  }
  if (!kept) png_error(png, "out of memory");
}

void keep_message(png_structp png, png_const_charp message) {
  auto* kept = static_cast<char*>(png_get_error_ptr(png));
  std::snprintf(kept, 128, "%s", message);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

// libpng reports errors by longjmp, so nothing here may own anything.
bool run_libpng(png_structp png, png_infop info, const RgbaImage& image, png_textp text,
                int text_count) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (text_count > 0) png_set_text(png, info, text, text_count);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) {
    png_write_row(png, reinterpret_cast<png_const_bytep>(&image.at(0, y)));
  }
  png_write_end(png, info);
  return true;
}

}  // namespace

PngText describe(const Scan& scan, const std::string& radar_name) {
  PngText text = {{"Software", "skerry"},
                  {"Radar", fmt::format("{}", scan.radar)},
                  {"Radar name", radar_name},
                  {"View", fmt::format("{}", scan.view)},
                  {"Scan", fmt::format("{}", scan.number)},
                  {"Spokes per turn", fmt::format("{}", scan.geometry.spokes_per_turn)},
                  {"Spokes missing", fmt::format("{}", scan.missing())},
                  {"Cells", fmt::format("{}", scan.geometry.cells)}};
  if (const Spoke* newest = scan.newest()) {
    const SpokeHeader& header = newest->header;
    text.insert(text.end(),
                {{"Range NM", range_text(header.range_scale)},
                 {"Cell size m", fmt::format("{:.6f}", header.cell_size().in_metres())},
                 {"Heading deg", fmt::format("{:.4f}", header.heading.in_degrees())},
                 {"Latitude deg", fmt::format("{:.7f}", header.own_ship.latitude_deg)},
                 {"Longitude deg", fmt::format("{:.7f}", header.own_ship.longitude_deg)},
                 {"UTC", utc_text(header.utc)}});
  }
  return text;
}

Bytes encode_png(const RgbaImage& image, const PngText& text) {
  static_assert(sizeof(Rgba) == 4, "rows are handed to libpng as they lie in memory");
  Bytes out;
  char message[128] = "cannot start";
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, message, keep_message, ignore_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  bool written = false;
  if (info) {
    std::vector<std::string> values;
    for (const auto& [keyword, value] : text) values.push_back(printable(value));
    std::vector<png_text> chunks(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
      chunks[i].compression = PNG_TEXT_COMPRESSION_NONE;
      chunks[i].key = const_cast<char*>(text[i].first.c_str());
      chunks[i].text = values[i].data();
      chunks[i].text_length = values[i].size();
    }
    png_set_write_fn(png, &out, append_bytes, nullptr);
    written = run_libpng(png, info, image, chunks.data(), static_cast<int>(chunks.size()));
  }
  png_destroy_write_struct(&png, &info);
  if (!written) throw std::runtime_error(fmt::format("cannot make a PNG: {}", message));
  return out;
}

Bytes encode_pgm(const Scan& scan) {
  const ScanGeometry& geometry = scan.geometry;
  const std::string head = fmt::format("P5\n{} {}\n{}\n", geometry.cells, geometry.spokes_per_turn,
                                       geometry.bits == 4 ? 15 : 255);
  Bytes out(head.begin(), head.end());
  out.resize(head.size() + std::size_t{geometry.cells} * geometry.spokes_per_turn, 0);
  auto row = out.begin() + static_cast<std::ptrdiff_t>(head.size());
  for (const auto& spoke : scan.spokes) {
    if (spoke) std::copy(spoke->cells.begin(), spoke->cells.end(), row);
    row += geometry.cells;
  }
  return out;
}

void write_file(const std::string& path, const Bytes& bytes) {
  const auto fail = [&] {
    throw std::runtime_error(
        fmt::format("cannot write {}: {}", printable(path), std::strerror(errno)));
  };
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) fail();
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int why = errno;
  const bool closed = std::fclose(file) == 0;
  if (!whole) errno = why;
  if (!whole || !closed) fail();
}

}  // namespace skerry
