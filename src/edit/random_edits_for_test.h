// Random texts and random edits of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "edit/marks.h"
#include "edit/parameters.h"
#include "edit/structure.h"
#include "edit/wraps.h"

namespace whittle {

class EditDice {
 public:
  explicit EditDice(uint64_t seed)
      : roll_([random = std::mt19937(uint32_t(seed))]() mutable { return uint32_t(random()); }) {}
  /// Dice that fall as somebody says.
  explicit EditDice(std::function<uint32_t()> roll) : roll_(std::move(roll)) {}

  int below(int limit) { return int(roll_() % unsigned(limit)); }

  /// A text as many hands might have written it.
  std::string text() {
    std::string out = below(8) == 0 ? "\xef\xbb\xbf" : "";
    for (int n = below(6); n >= 0; --n) write_statements(out, 4);
    if (below(4) == 0) out += "// the end";
    return out;
  }

  /// A node that is not the file; 0 if there is none.
  uint32_t node(const SourceDocument& document) {
    const auto count = int(document.tree().nodes.size());
    return count < 2 ? 0 : 1 + uint32_t(below(count - 1));
  }

  /// Some edit, which may be refused. One step at most.
  void edit(SourceDocument& document) {
    const uint32_t at = node(document);
    if (at == 0) return;
    switch (below(10)) {
      case 0:
        static_cast<void>(remove_nodes(document, some_nodes(document)));
        break;
      case 1:
        static_cast<void>(duplicate_node(document, at));
        break;
      case 2:
        static_cast<void>(move_node(document, at, document.node(at).parent, size_t(below(4))));
        break;
      case 3:
        static_cast<void>(move_node(
            document, at, uint32_t(below(int(document.tree().nodes.size()))), size_t(below(3))));
        break;
      case 4:
        static_cast<void>(group_nodes(document, some_nodes(document), operation()));
        break;
      case 5:
        static_cast<void>(set_mark(document, at, Mark("*!#%"[below(4)]), below(2) == 0));
        break;
      case 6:
        static_cast<void>(change_operation(document, at, operation()));
        break;
      case 7:
        static_cast<void>(set_color(document, at, {share(), share(), share(), share()}));
        break;
      case 8:
        static_cast<void>(transform_node(document, at, map()));
        break;
      default:
        static_cast<void>(set_number(document, at, place(document, at), number()));
    }
  }

 private:
  double number() { return (below(41) - 20) / 4.0; }
  double share() { return below(5) / 4.0; }
  const char* operation() {
    constexpr const char* kNames[] = {"group", "union", "difference", "hull"};
    return kNames[below(4)];
  }
  Affine map() {
    if (below(2) == 0) return translation({number(), number(), number()});
    return {.row = {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, .translation = {number(), 0, 0}};
  }
  NumberPlace place(const SourceDocument& document, uint32_t at) {
    const std::vector<NumberValue> numbers = numbers_of(document, at, 20);
    if (numbers.empty() || below(4) == 0) return {"r"};
    return numbers[size_t(below(int(numbers.size())))].place;
  }
  std::vector<uint32_t> some_nodes(const SourceDocument& document) {
    std::vector<uint32_t> nodes{node(document)};
    const uint32_t parent = document.node(nodes[0]).parent;
    const SyntaxTree& tree = document.tree();
    for (uint32_t c = parent + 1; c < tree.nodes[parent].last; c = tree.nodes[c].last) {
      if (below(3) == 0) nodes.push_back(c);
    }
    return nodes;
  }

  std::string blank() {
    constexpr const char* kBlanks[] = {"",     "",        " ",      "\n",       "\n\t",
                                       "\r\n", "/* } */", "// ;\n", " // a\n\n"};
    return kBlanks[below(9)];
  }

  void write_statements(std::string& out, int depth) {
    for (int n = below(4); n > 0; --n) write_statement(out += blank(), depth);
    out += blank();
  }

  void write_statement(std::string& out, int depth) {
    if (below(10) == 0) {
      out += "x" + blank() + "=" + blank() + "[1, 2]" + blank() + ";";
      return;
    }
    if (depth > 0 && below(8) == 0) {
      write_body(out, depth);
      return;
    }
    for (; below(5) == 0;) out += "*#%!"[below(4)] + blank();
    constexpr const char* kSolids[] = {
        "cube([1, 2, 3])",         "cube(size = 5, center = true)",
        "sphere(r = x)",           "text(text = \"a\"b;\", size = 3)",
        "sphere(/* ) */ $fn = 5)", "cylinder(1, 2 , r2 = 0.50)"};
    constexpr const char* kHolders[] = {"union()",
                                        "group ( )",
                                        "difference()",
                                        "render(convexity = 2)",
                                        "color(\"red\", 0.5)",
                                        "translate([1, 2, 3])",
                                        "multmatrix([[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0]])",
                                        "mine(a = 1)"};
    const bool holds = depth > 0 && below(2) == 0;
    out += holds ? kHolders[below(8)] : kSolids[below(6)];
    out += blank();
    if (holds && below(3) == 0) {
      const std::string before = out;
      write_statement(out, depth - 1);
      // One statement without braces cannot be an assignment or a block.
      if (out[before.size()] == 'x') out = before + ";";
    } else if (holds) {
      write_body(out, depth);
    } else {
      out += ";";
    }
  }

  void write_body(std::string& out, int depth) {
    out += "{";
    write_statements(out, depth - 1);
    out += "}";
  }

  std::function<uint32_t()> roll_;
};

}  // namespace whittle
