#include "image/near_formula.h"

#include <algorithm>

namespace whittle {
namespace {

constexpr size_t kOperandsARow = 8;

}  // namespace

NearFormula::NearFormula(const Scene& scene) : scene_(scene) {
  struct Group {
    Row row;  ///< of the header; box and value are found when it ends
    bool conjunction;
    std::vector<Row> operands;
  };
  // Below is a group that holds the formula as its one operand.
  std::vector<Group> open = {{{}, false, {}}};
  walk(
      scene.formula,
      [&](Operand operand) {
        const Token token = operand.token();
        open.push_back({{uint32_t(operand.index), uint32_t(operand.end()), 0, false, {}},
                        token.kind() == TokenKind::kAnd,
                        {}});
      },
      [&](Operand operand) {
        const Token token = operand.token();
        open.back().operands.push_back({uint32_t(operand.index), uint32_t(operand.end()), 0,
                                        token.negated(), scene.units[unit_of(token)].outer});
      },
      [&] {
        Group group = std::move(open.back());
        open.pop_back();
        const Row joined = join(group.operands, group.conjunction);
        group.row.box = joined.box, group.row.outside = joined.outside;
        rows_.push_back(group.row);
        open.back().operands.push_back(group.row);
        gather(std::move(group.operands), group.conjunction);
      });
  std::ranges::sort(rows_, [](const Row& a, const Row& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
  });
  std::vector<uint32_t> around;
  for (uint32_t i = 0; i <= rows_.size(); ++i) {
    while (!around.empty() && (i == rows_.size() || rows_[around.back()].end <= rows_[i].begin)) {
      rows_[around.back()].next = i;
      around.pop_back();
    }
    around.push_back(i);
  }
}

NearFormula::Row NearFormula::join(std::span<const Row> operands, bool conjunction) {
  // One operand that is false makes a conjunction false, one that is true a disjunction true.
  const bool deciding = !conjunction;
  const bool decided = std::ranges::any_of(
      operands, [&](const Row& operand) { return operand.outside == deciding; });
  Row row;
  row.outside = decided ? deciding : !deciding;
  if (decided) row.box = Box::everything();
  for (const Row& operand : operands) {
    if (!decided) {
      row.box = unite(row.box, operand.box);
    } else if (operand.outside == deciding) {
      // As it is even where the boxes are apart: they may be so by less than the margin.
      row.box = {max(row.box.lo, operand.box.lo), min(row.box.hi, operand.box.hi)};
    }
  }
  return row;
}

void NearFormula::gather(std::vector<Row> operands, bool conjunction) {
  while (operands.size() > kOperandsARow) {
    std::vector<Row> rows;
    for (size_t i = 0; i < operands.size(); i += kOperandsARow) {
      const auto some =
          std::span<const Row>(operands).subspan(i, std::min(kOperandsARow, operands.size() - i));
      Row row = join(some, conjunction);
      row.begin = some.front().begin, row.end = some.back().end;
      rows.push_back(row);
    }
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    operands = std::move(rows);
  }
}

}  // namespace whittle
