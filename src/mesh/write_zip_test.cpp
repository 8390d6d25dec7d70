#include "mesh/write_zip.h"

#include <gtest/gtest.h>

#include "mesh/zip_archive.h"

namespace whittle {
namespace {

/// Two stripes and a bit, with nothing in it that repeats at once.
std::string long_text() {
  std::string text;
  for (uint32_t i = 0; text.size() < 2'200'000; ++i) text += std::to_string(i * 2654435761u);
  return text;
}

TEST(WriteZip, IsReadAgain) {
  const std::vector<ZipMember> members{{"empty", ""}, {"a/b.txt", "few"}, {"long", long_text()}};
  const Result<std::string> file = write_zip(members, Workers(2));
  ASSERT_TRUE(file);
  const Result<ZipArchive> archive = ZipArchive::open(*file);
  ASSERT_TRUE(archive);
  ASSERT_EQ(archive->entries().size(), 3u);
  for (const ZipMember& member : members) {
    const ZipArchive::Entry* entry = archive->find(member.name);
    ASSERT_NE(entry, nullptr);
    const Result<std::string> bytes = archive->unpack(*entry, 3'000'000);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_TRUE(*bytes == member.bytes) << member.name;
  }
  EXPECT_LT(file->size(), members[2].bytes.size() / 2 + 1000);
}

TEST(WriteZip, ThreadsMakeNoDifference) {
  const std::vector<ZipMember> members{{"long", long_text()}};
  EXPECT_TRUE(*write_zip(members, Workers(1)) == *write_zip(members, Workers(3)));
}

}  // namespace
}  // namespace whittle
