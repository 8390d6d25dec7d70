// What the tests of the reader share: trees in short, for reading and comparing.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "csg/read_csg.h"

namespace whittle {

/// Reads text that must be understood.
inline Read read_good(std::string_view text, const ReadOptions& options = {}) {
  Result<Read> read = read_csg(text, "t.csg", options);
  if (!read) {
    ADD_FAILURE() << read.error().message << "\nin: " << text;
    return {};
  }
  return std::move(*read);
}

/// The message of the error that text must give.
inline std::string read_bad(std::string_view text, const ReadOptions& options = {}) {
  const Result<Read> read = read_csg(text, "t.csg", options);
  if (read) return "no error";
  EXPECT_EQ(read.error().kind, ErrorKind::kInput);
  return read.error().message;
}

/// A model as `U(D(c1 T(s2)) %c3)`: the first letters of union, difference, intersection,
/// transform, paint, and body with its id; of cube, sphere, cylinder (y), polyhedron, halfspace,
/// mesh with their ids; `%` and `#`.
inline std::string tree(const Model& model) {
  std::string text;
  std::vector<uint32_t> ends;
  for (uint32_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    const auto close_up_to = [&] {
      while (!ends.empty() && ends.back() <= i) {
        text += ')';
        ends.pop_back();
      }
    };
    close_up_to();
    if (!text.empty() && text.back() != '(') text += ' ';
    if (node.background) text += '%';
    if (node.highlight) text += '#';
    if (node.kind == NodeKind::kPrimitive) {
      const Primitive& primitive = model.primitives.at(node.payload);
      constexpr std::string_view kLetters = "csyphm";
      static_assert(kLetters.size() == std::variant_size_v<Shape>);
      text += kLetters[primitive.shape.index()];
      text += std::to_string(primitive.id);
      EXPECT_EQ(node.end, i + 1);
    } else {
      text += "UDITP?B"[static_cast<int>(node.kind)];
      if (node.kind == NodeKind::kBody) text += std::to_string(node.payload);
      text += '(';
      ends.push_back(node.end);
    }
  }
  for (const uint32_t end : ends) {
    EXPECT_EQ(end, model.nodes.size());
    text += ')';
  }
  return text;
}

inline std::string tree_of(std::string_view text) {
  return tree(read_good(text).model);
}

}  // namespace whittle
