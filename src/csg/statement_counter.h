// What stands in a text, counted while it is read.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "csg/statements.h"
#include "model/statement_counts.h"

namespace whittle {

class StatementCounter {
 public:
  /// A statement, dropped or not.
  void count(const StatementType& type, std::string_view name, const StatementModifiers& modifiers);

  /// All that another has counted.
  void add(const StatementCounter& other);

  StatementCounts counts() const;

 private:
  void add(const StatementType* type, size_t number);
  void add(std::string_view name, size_t number);

  std::vector<std::pair<const StatementType*, size_t>> known_;  ///< few, in order of appearance
  std::map<std::string, size_t, std::less<>> unknown_;
  StatementCounts marks_;
};

}  // namespace whittle
