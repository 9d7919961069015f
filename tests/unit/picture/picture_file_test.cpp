#include "protocol/picture/picture_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "tests/unit/picture/synthetic_scan.hpp"

namespace skerry {
namespace {

RgbaImage gradient(int width, int height) {
  RgbaImage image{.width = width, .height = height, .pixels = {}};
  for (int i = 0; i < width * height; ++i) {
    image.pixels.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8),
                            static_cast<std::uint8_t>(3 * i), 255});
  }
  return image;
}

bool contains(const Bytes& bytes, const std::string& text) {
  return std::search(bytes.begin(), bytes.end(), text.begin(), text.end()) != bytes.end();
}

TEST(PictureFile, WritesAPngThatReadsBackPixelByPixel) {
  const RgbaImage image = gradient(83, 41);
  const Bytes bytes = encode_png(image, {{"Software", "skerry"}});
  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&reader, bytes.data(), bytes.size()));
  EXPECT_EQ(reader.width, 83u);
  EXPECT_EQ(reader.height, 41u);
  reader.format = PNG_FORMAT_RGBA;
  std::vector<Rgba> pixels(83 * 41);
  ASSERT_TRUE(png_image_finish_read(&reader, nullptr, pixels.data(), 0, nullptr));
  EXPECT_EQ(pixels, image.pixels);
}

TEST(PictureFile, SaysInThePngWhatItShows) {
  const Scan scan = empty_scan(kSmall, 75.5);
  const Bytes bytes = encode_png(gradient(8, 8), describe(scan, "Main\nmast"));
  EXPECT_TRUE(contains(bytes, std::string("tEXtScan\0"
                                          "7",
                                          10)));
  EXPECT_TRUE(contains(bytes, std::string("tEXtRadar\0"
                                          "0",
                                          11)));
  EXPECT_TRUE(contains(bytes, std::string("tEXtRadar name\0Main?mast", 24)));
  EXPECT_TRUE(contains(bytes, std::string("tEXtRange NM\0"
                                          "12",
                                          15)));
  EXPECT_TRUE(contains(bytes, std::string("tEXtHeading deg\0"
                                          "75.5000",
                                          23)));
  EXPECT_TRUE(contains(bytes, std::string("tEXtCell size m\0"
                                          "86.812500",
                                          25)));
}

TEST(PictureFile, RefusesAnImageWithoutPixels) {
  EXPECT_THROW(encode_png({}, {}), std::runtime_error);
}

TEST(PictureFile, WritesTheCellsOfAScanAsTheyCame) {
  Scan scan = scan_of(kSmall, 0.0, [](Spoke& spoke) {
    for (std::size_t n = 0; n < spoke.cells.size(); ++n) {
      spoke.cells[n] = static_cast<std::uint8_t>(n ^ spoke.header.index);
    }
  });
  remove_spoke(scan, 9);
  const Bytes bytes = encode_pgm(scan);
  const std::string head = "P5\n256 256\n255\n";
  ASSERT_EQ(bytes.size(), head.size() + 256 * 256);
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + static_cast<int>(head.size())), head);
  for (std::size_t i = 0; i < 256; ++i) {
    for (std::size_t n = 0; n < 256; ++n) {
      ASSERT_EQ(bytes[head.size() + 256 * i + n], i == 9 ? 0 : static_cast<std::uint8_t>(n ^ i));
    }
  }
  const ScanGeometry nibbles{.spokes_per_turn = 256, .cells = 300, .bits = 4};
  EXPECT_TRUE(contains(encode_pgm(empty_scan(nibbles, 0.0)), "P5\n300 256\n15\n"));
}

TEST(PictureFile, NamesTheFileThatCannotBeWritten) {
  try {
    write_file("/no-such-folder/radar.png", {1, 2, 3});
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/no-such-folder/radar.png"));
    EXPECT_THAT(error.what(), testing::HasSubstr("No such file"));
  }
  EXPECT_THROW(write_file("/dev/full", Bytes(100000, 1)), std::runtime_error);
}

TEST(PictureFile, WritesAllBytes) {
  const std::string path = testing::TempDir() + "skerry_picture_file_test.bin";
  const Bytes bytes = {0, 10, 13, 255, 26};
  write_file(path, bytes);
  std::ifstream file(path, std::ios::binary);
  const Bytes read{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(read, bytes);
}

}  // namespace
}  // namespace skerry
