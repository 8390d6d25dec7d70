#include "csg/statement_counter.h"

#include <algorithm>
#include <string>
#include <tuple>

namespace whittle {

void StatementCounter::count(const StatementType& type, std::string_view name,
                             const Modifiers& modifiers) {
  marks_.background += modifiers.background;
  marks_.highlight += modifiers.highlight;
  marks_.root += modifiers.root;
  marks_.disabled += modifiers.disabled;
  if (type.name.empty()) {
    ++unknown_[name];
    return;
  }
  for (auto& [known, number] : known_) {
    if (known != &type) continue;
    ++number;
    return;
  }
  known_.emplace_back(&type, 1);
}

StatementCounts StatementCounter::counts() const {
  StatementCounts counts = marks_;
  for (const auto& [type, number] : known_)
    counts.words.push_back({std::string(type->name), number});
  for (const auto& [name, number] : unknown_) counts.words.push_back({std::string(name), number});
  std::ranges::sort(counts.words, [](const WordCount& a, const WordCount& b) {
    return std::tie(b.count, a.word) < std::tie(a.count, b.word);
  });
  return counts;
}

}  // namespace whittle
