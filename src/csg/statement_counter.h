// What stands in a text, counted while it is read.
#pragma once

#include <cstddef>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "csg/document_builder.h"
#include "csg/statements.h"
#include "model/statement_counts.h"

namespace whittle {

class StatementCounter {
 public:
  /// A statement, dropped or not. `name` must outlive this.
  void count(const StatementType& type, std::string_view name, const Modifiers& modifiers);

  StatementCounts counts() const;

 private:
  std::vector<std::pair<const StatementType*, size_t>> known_;  ///< few, in order of appearance
  std::map<std::string_view, size_t> unknown_;
  StatementCounts marks_;
};

}  // namespace whittle
