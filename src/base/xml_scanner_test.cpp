#include "base/xml_scanner.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

using Event = XmlScanner::Event;

TEST(XmlScanner, AttributesHaveTheirNamesWithAndWithoutPrefix) {
  XmlScanner scanner("<a x:b='1' b=\"2\"/>");
  ASSERT_EQ(scanner.next(), Event::kOpen);
  XmlScanner::Attribute attribute;
  ASSERT_TRUE(scanner.next_attribute(attribute));
  EXPECT_EQ(attribute.name, "b");
  EXPECT_EQ(attribute.full_name, "x:b");
  EXPECT_EQ(attribute.value, "1");
  ASSERT_TRUE(scanner.next_attribute(attribute));
  EXPECT_EQ(attribute.full_name, "b");
  EXPECT_FALSE(scanner.next_attribute(attribute));
}

TEST(XmlScanner, AnElementIsReadAgainFromItsTag) {
  XmlScanner scanner("<a><b c='1'><d/></b></a>");
  ASSERT_EQ(scanner.next(), Event::kOpen);
  ASSERT_EQ(scanner.next(), Event::kOpen);
  XmlScanner::Attribute attribute;
  while (scanner.next_attribute(attribute)) {
  }
  EXPECT_EQ(scanner.from_tag(), "<b c='1'><d/></b></a>");
  XmlScanner again(scanner.from_tag());
  ASSERT_EQ(again.next(), Event::kOpen);
  EXPECT_EQ(again.name(), "b");
  ASSERT_EQ(again.next(), Event::kOpen);
  EXPECT_EQ(again.name(), "d");
  EXPECT_EQ(again.next(), Event::kClose);
  EXPECT_EQ(again.next(), Event::kClose);
  // It was not opened there.
  EXPECT_EQ(again.next(), Event::kMistake);
}

}  // namespace
}  // namespace whittle
