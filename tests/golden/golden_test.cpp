// One hash per named scene.  A change of the model changes them: then look at the pictures, say in
// the commit why, and write the printed values here.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "echo/kernel/isa.hpp"
#include "server/core/worker_pool.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry {
namespace {

const std::map<std::string, std::uint64_t> kHashes = {
    {"open sea", 0x8B80247FE90CC9DCull},     {"islands", 0x49C890D08098BCD0ull},
    {"traffic", 0x15FA21E612653BB7ull},      {"coarse", 0x28BFCD185B415E80ull},
    {"fine", 0xF0DD05D14394380Bull},         {"four bits", 0x47FAAD112AB4FDADull},
    {"rain control", 0x4DF31A3CE9FF0EE2ull}, {"kinds", 0x1F31109940FA5649ull},
    {"rain", 0x9D5AEF64B1A46E94ull},         {"koch", 0x895A62F001E511DCull},
    {"midpoint", 0x9553403E86B99DB0ull},     {"weierstrass", 0x83E5A23EC4E36509ull},
    {"Bergen", 0x9B08747F976D7B87ull},
};

// Every instruction set this machine has, and 1, 2, 3 and 8 workers (the caller is one).
void expect_golden(const scenes::NamedScene& named) {
  const auto known = kHashes.find(named.name);
  const std::uint64_t expected = known == kHashes.end() ? 0 : known->second;
  for (const echo::Isa isa : {echo::Isa::baseline, echo::Isa::avx2, echo::Isa::avx512}) {
    if (isa > echo::best_isa()) continue;
    echo::force_isa(isa);
    const std::uint64_t hash = scenes::hash_of(scenes::render_scans(named, 1));
    std::printf("    {\"%s\", 0x%016llXull},  // %s\n", named.name.c_str(),
                static_cast<unsigned long long>(hash), std::string(echo::name_of(isa)).c_str());
    EXPECT_EQ(hash, expected) << named.name << ", " << echo::name_of(isa);
  }
  echo::force_isa(echo::best_isa());
  for (std::size_t workers : {1u, 2u, 3u, 8u}) {
    server::WorkerPool pool(workers - 1);
    const auto video =
        scenes::render_scans(named, 1, [&](std::size_t n, const auto& body) { pool.run(n, body); });
    EXPECT_EQ(scenes::hash_of(video), expected) << named.name << ", " << workers << " workers";
  }
}

TEST(Golden, MadeUpScenesGiveTheSameVideoEverywhere) {
  for (const auto& named : scenes::made_up_scenes()) expect_golden(named);
}

TEST(Golden, BergenGivesTheSameVideoEverywhere) {
  const auto named = scenes::bergen();
  if (!named || named->scene->coast->edge_count() == 0) GTEST_SKIP() << "no chart installed";
  expect_golden(*named);
}

}  // namespace
}  // namespace skerry
