#include "protocol/digest/digest.hpp"

#include <gtest/gtest.h>

#include <string>

namespace skerry {
namespace {

// FIPS 180-2, appendix B.1 to B.3.
TEST(Sha256, GivesTheStandardsExamples) {
  Sha256 hash;
  hash.add("abc");
  EXPECT_EQ(hexadecimal(hash.take()),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  hash.add("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq");
  EXPECT_EQ(hexadecimal(hash.take()),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  const std::string thousand(1000, 'a');
  for (int i = 0; i < 1000; ++i) hash.add(thousand);
  EXPECT_EQ(hexadecimal(hash.take()),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, OfNothingToo) {
  EXPECT_EQ(hexadecimal(Sha256().take()),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

// FIPS 180-2, appendix C.1.
TEST(Sha512, GivesTheStandardsExample) {
  Sha512 hash;
  hash.add("abc");
  EXPECT_EQ(hexadecimal(hash.take()),
            "ddaf35a193617abacc417349ae20413112e6fa4e89a97ea20a9eeee64b55d39a"
            "2192992a274fc1a836ba3c23a3feebbd454d4423643ce80e2a9ac94fa54ca49f");
}

}  // namespace
}  // namespace skerry
