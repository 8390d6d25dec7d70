#include "model/model.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

TEST(MessageAt, NamesThePlace) {
  EXPECT_EQ(message_at("a.csg", {3, 14}, "no."), "a.csg:3:14: no.");
}

}  // namespace
}  // namespace whittle
