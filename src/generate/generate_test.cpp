#include "generate/generate.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "generate/csg_text.h"
#include "host/read_file.h"

namespace whittle {
namespace {

constexpr uint64_t kSeed = kDefaultSeed;

/// A model that must come out: its text.
std::string text_of(std::string_view name, std::optional<int> n, uint64_t seed = kSeed) {
  Result<std::string> text = generate_model(name, n, seed);
  EXPECT_TRUE(text) << name << ": " << (text ? "" : text.error().message);
  return text ? *text : std::string();
}

/// What the reader makes of a generated model, which must be free of complaints.
Model model_of(std::string_view name, std::optional<int> n, uint64_t seed = kSeed) {
  Result<Read> read = read_csg(text_of(name, n, seed), std::string(name));
  EXPECT_TRUE(read) << (read ? "" : read.error().message);
  if (!read) return {};
  for (const std::string& warning : read->warnings) ADD_FAILURE() << warning;
  EXPECT_FALSE(read->unsupported);
  return std::move(read->model);
}

size_t primitives_of(std::string_view name, std::optional<int> n) {
  return model_of(name, n).primitives.size();
}

TEST(Generate, EveryModelReadsWithoutComplaintAtItsDefaultAndSmallestSize) {
  for (const Generator& g : generators()) {
    SCOPED_TRACE(g.name);
    EXPECT_GT(primitives_of(g.name, std::nullopt), 0u);
    if (g.max_n != 0) {
      EXPECT_GT(primitives_of(g.name, g.min_n), 0u);
    }
  }
}

TEST(Generate, CountsArePromises) {
  EXPECT_EQ(primitives_of("cheese", 100), 101u);
  EXPECT_EQ(primitives_of("cyl", 7), 8u);
  EXPECT_EQ(primitives_of("cone", 250), 251u);
  EXPECT_EQ(primitives_of("widget", std::nullopt), 4u);
  EXPECT_EQ(primitives_of("r9", std::nullopt), 9u);
  EXPECT_EQ(primitives_of("plate", 5), 26u);
  // Level 3 is the cube and 3 (1 + 8 + 64) bars.
  EXPECT_EQ(primitives_of("menger", 0), 1u);
  EXPECT_EQ(primitives_of("menger", 3), 220u);
  EXPECT_EQ(primitives_of("lattice", 2), 27u + 3 * 18u);
  for (const int n : {1, 2, 17, 1000}) EXPECT_EQ(primitives_of("random", n), size_t(n));
}

TEST(Generate, TubeSharesItsHolesAsThePaperDoes) {
  EXPECT_EQ(primitives_of("tube", 300), 30u + 300);
  EXPECT_EQ(primitives_of("tube", 500), 30u + 600) << "the paper's TUBE500 is 30 x 20";
  EXPECT_EQ(primitives_of("tube", 600), 30u + 600);
  EXPECT_EQ(primitives_of("tube", 1000), 50u + 1000);
  EXPECT_EQ(primitives_of("tube", 7), 5u + 7) << "no hole is lost where the shares are uneven";
}

TEST(Generate, CheeseIsOneFlatDifference) {
  const Model model = model_of("cheese", 50);
  size_t differences = 0;
  for (const Node& node : model.nodes) differences += node.kind == NodeKind::kDifference;
  EXPECT_EQ(differences, 1u);
}

TEST(Generate, SpheresOfCheeseAreTrueCurvesThatShrinkAsTheirNumberGrows) {
  double largest_of_few = 0, largest_of_many = 0;
  for (const Primitive& p : model_of("cheese", 10).primitives) {
    if (const auto* s = std::get_if<Sphere>(&p.shape)) {
      EXPECT_EQ(s->facets, 0);
      largest_of_few = std::max(largest_of_few, s->r);
    }
  }
  for (const Primitive& p : model_of("cheese", 10000).primitives) {
    if (const auto* s = std::get_if<Sphere>(&p.shape)) {
      EXPECT_GT(s->r, 0.5);
      largest_of_many = std::max(largest_of_many, s->r);
    }
  }
  EXPECT_NEAR(largest_of_many * 10, largest_of_few, largest_of_few * 0.3);
}

TEST(Generate, RandomTreesHoldEveryOperationAndEveryPrimitive) {
  const Model model = model_of("random", 500);
  std::set<NodeKind> operations;
  for (const Node& node : model.nodes) operations.insert(node.kind);
  EXPECT_EQ(operations.size(), 6u)
      << "union, difference, intersection, transform, colour, primitive";
  std::set<size_t> shapes;
  std::set<bool> has_facets;
  for (const Primitive& p : model.primitives) {
    shapes.insert(p.shape.index());
    EXPECT_FALSE(is_empty(p.shape)) << "primitive " << p.id;
    if (const auto* s = std::get_if<Sphere>(&p.shape)) has_facets.insert(s->facets > 0);
  }
  EXPECT_EQ(shapes.size(), 4u) << "cube, sphere, cylinder, polyhedron";
  EXPECT_EQ(has_facets.size(), 2u);
}

TEST(Generate, RandomTreesAreAsLargeAsAskedAndReadWithoutComplaint) {
  EXPECT_TRUE(rc::check([] {
    const int n = *rc::gen::inRange(1, 80);
    const auto seed = *rc::gen::arbitrary<uint64_t>();
    const Result<std::string> text = generate_model("random", n, seed);
    RC_ASSERT(bool(text));
    const Result<Read> read = read_csg(*text, "random");
    RC_ASSERT(bool(read));
    RC_ASSERT(read->warnings.empty());
    RC_ASSERT(read->model.primitives.size() == size_t(n));
  }));
}

TEST(Generate, SeedsDecide) {
  for (const char* name : {"cheese", "cyl", "cone", "random"}) {
    EXPECT_EQ(text_of(name, 20, 5), text_of(name, 20, 5)) << name;
    // The headers name the seed; the bodies must differ too.
    const std::string a = text_of(name, 20, 5), b = text_of(name, 20, 6);
    EXPECT_NE(a.substr(a.find("\n\n")), b.substr(b.find("\n\n"))) << name;
  }
  EXPECT_EQ(text_of("menger", 2, 5), text_of("menger", 2, 6));
}

TEST(Generate, ChanceIsSplitMix64) {
  // The published first numbers of the generator for this seed.
  Chance chance(1234567);
  EXPECT_EQ(chance.bits(), 6457827717110365317u);
  EXPECT_EQ(chance.bits(), 3203168211198807973u);
  EXPECT_EQ(chance.bits(), 9817491932198370423u);
}

TEST(Generate, NumbersAreShortPlainDecimals) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(-0.0004), "0");
  EXPECT_EQ(number(-0.25), "-0.25");
  EXPECT_EQ(number(12), "12");
  EXPECT_EQ(number(1.005), "1.005");
  EXPECT_EQ(number(0.9999), "1");
  EXPECT_EQ(number(100.1), "100.1");
  EXPECT_EQ(number(1e9), "1000000000");
}

TEST(Generate, WrongRequestsAreUsageErrors) {
  const Result<std::string> unknown = generate_model("gouda", 3, kSeed);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().kind, ErrorKind::kUsage);
  for (const Generator& g : generators()) {
    EXPECT_NE(unknown.error().message.find(g.name), std::string::npos) << g.name;
  }
  for (const auto& [name, n] : {std::pair{"cheese", 0}, {"cheese", -4}, {"menger", 7}, {"r9", 9}}) {
    const Result<std::string> text = generate_model(name, n, kSeed);
    ASSERT_FALSE(text) << name << " " << n;
    EXPECT_EQ(text.error().kind, ErrorKind::kUsage);
    EXPECT_EQ(text.error().message.find('\n'), std::string::npos);
  }
}

struct Example {
  const char* file;
  const char* model;
  std::optional<int> n;
};

void PrintTo(const Example& example, std::ostream* out) {
  *out << example.file;
}

class MadeExamples : public testing::TestWithParam<Example> {};

TEST_P(MadeExamples, AreWhatTheGeneratorsWrite) {
  const Example& example = GetParam();
  std::ifstream file(std::string(WHITTLE_EXAMPLES) + "/" + example.file, std::ios::binary);
  ASSERT_TRUE(file) << example.file;
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_TRUE(text.str() == text_of(example.model, example.n))
      << "examples/" << example.file << " is not what its generator writes";
}

INSTANTIATE_TEST_SUITE_P(
    Committed, MadeExamples,
    testing::Values(Example{"cheese100.csg", "cheese", 100},
                    Example{"cheese1000.csg", "cheese", 1000}, Example{"cyl100.csg", "cyl", 100},
                    Example{"cone100.csg", "cone", 100}, Example{"tube300.csg", "tube", 300},
                    Example{"widget.csg", "widget", {}}, Example{"r9.csg", "r9", {}},
                    Example{"menger3.csg", "menger", 3}, Example{"plate30.csg", "plate", 30}),
    [](const testing::TestParamInfo<Example>& example) {
      const std::string file = example.param.file;
      return file.substr(0, file.find('.'));
    });

TEST(Examples, AllReadWithoutComplaint) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WHITTLE_EXAMPLES)) {
    if (entry.path().extension() != ".csg") continue;
    ++files;
    const Result<Read> read = read_file(entry.path().string());
    ASSERT_TRUE(read) << read.error().message;
    for (const std::string& warning : read->warnings) ADD_FAILURE() << warning;
    EXPECT_FALSE(read->unsupported) << entry.path();
    EXPECT_GT(read->model.primitives.size(), 0u) << entry.path();
  }
  EXPECT_GE(files, 16);
}

}  // namespace
}  // namespace whittle
