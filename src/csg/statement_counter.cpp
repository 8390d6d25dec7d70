#include "csg/statement_counter.h"

#include <algorithm>
#include <string>
#include <tuple>

namespace whittle {

void StatementCounter::count(const StatementType& type, std::string_view name,
                             const StatementModifiers& modifiers) {
  marks_.background += modifiers.background;
  marks_.highlight += modifiers.highlight;
  marks_.root += modifiers.root;
  marks_.disabled += modifiers.disabled;
  if (type.name.empty()) {
    add(name, 1);
  } else {
    add(&type, 1);
  }
}

void StatementCounter::add(const StatementType* type, size_t number) {
  for (auto& [known, count] : known_) {
    if (known != type) continue;
    count += number;
    return;
  }
  known_.emplace_back(type, number);
}

void StatementCounter::add(std::string_view name, size_t number) {
  auto found = unknown_.find(name);
  if (found == unknown_.end()) found = unknown_.try_emplace(std::string(name), 0).first;
  found->second += number;
}

void StatementCounter::add(const StatementCounter& other) {
  marks_.background += other.marks_.background;
  marks_.highlight += other.marks_.highlight;
  marks_.root += other.marks_.root;
  marks_.disabled += other.marks_.disabled;
  for (const auto& [type, number] : other.known_) add(type, number);
  for (const auto& [name, number] : other.unknown_) add(name, number);
}

StatementCounts StatementCounter::counts() const {
  StatementCounts counts = marks_;
  for (const auto& [type, number] : known_)
    counts.words.push_back({std::string(type->name), number});
  for (const auto& [name, number] : unknown_) counts.words.push_back({name, number});
  std::ranges::sort(counts.words, [](const WordCount& a, const WordCount& b) {
    return std::tie(b.count, a.word) < std::tie(a.count, b.word);
  });
  return counts;
}

}  // namespace whittle
