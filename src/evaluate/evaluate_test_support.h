// What the tests of the evaluation share: texts that must come to the same solid.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

#include "boundary/closed_mesh.h"
#include "csg/read_csg.h"
#include "lower/evaluate.h"
#include "lower/lower.h"
#include "model/instances.h"

namespace whittle {

/// To read with, so that what must be evaluated is.
inline ReadOptions with_boundaries() {
  ReadOptions options;
  options.closed_mesh = [](const Model& model, size_t&) { return closed_mesh(model, Workers(1)); };
  return options;
}

inline Read evaluated(std::string_view text, const ReadOptions& options = with_boundaries()) {
  Result<Read> read = read_csg(text, "t.csg", options);
  if (!read) {
    ADD_FAILURE() << read.error().message << "\nin: " << text;
    return {};
  }
  return std::move(*read);
}

/// The error that a text must give.
inline std::string evaluation_error(std::string_view text, const ReadOptions& options) {
  const Result<Read> read = read_csg(text, "t.csg", options);
  return read ? "no error" : read.error().message;
}

/// Points spread evenly over a box, by the golden ratio's relatives.
class Points {
 public:
  explicit Points(const Box& box) : box_(box) {}
  Vec3 next() {
    ++k_;
    const auto part = [&](double step) { return std::fmod(0.5 + k_ * step, 1); };
    const Vec3 t{part(0.8191725134), part(0.6710436067), part(0.5497004779)};
    const Vec3 s = box_.size();
    return box_.lo + Vec3{s.x * t.x, s.y * t.y, s.z * t.z};
  }

 private:
  Box box_;
  double k_ = 0;
};

/// Whether points lie inside, of a solid that lives as long as this.
class Inside {
 public:
  explicit Inside(const Model& model) : scene_(*lower(model)) {}
  bool operator()(Vec3 p) const { return contains(scene_, scene_.formula, p - scene_.origin); }

 private:
  Scene scene_;
};

/// How many of `count` points in a box are in one solid and not in the other.
inline int differing_points(const Model& a, const Model& b, Box box, int count = 4000) {
  const Vec3 margin = box.size() * 0.1;
  box = {box.lo - margin, box.hi + margin};
  const Inside in_a(a), in_b(b);
  Points points(box);
  int differing = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = points.next();
    differing += in_a(p) != in_b(p);
  }
  return differing;
}

/// The two texts must come to the same solid, which is not empty.
inline void expect_same(std::string_view a, std::string_view b,
                        const ReadOptions& options = with_boundaries()) {
  const Read one = evaluated(a, options), other = evaluated(b, options);
  const Box box = bounds(other.model).box;
  ASSERT_FALSE(box.is_empty()) << b;
  EXPECT_EQ(differing_points(one.model, other.model, unite(bounds(one.model).box, box)), 0)
      << a << "\nis not\n"
      << b;
}

inline void expect_empty(std::string_view text, const ReadOptions& options = with_boundaries()) {
  const Read read = evaluated(text, options);
  const Box box = bounds(read.model).box;
  EXPECT_TRUE(box.is_empty()) << text;
}

/// The share of a box that the solid fills.
inline double filled_share(const Model& model, const Box& box, int count = 20000) {
  const Inside inside(model);
  Points points(box);
  int in = 0;
  for (int i = 0; i < count; ++i) in += inside(points.next());
  return double(in) / count;
}

}  // namespace whittle
