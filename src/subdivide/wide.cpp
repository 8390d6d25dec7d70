#include "subdivide/wide.h"

#include <algorithm>
#include <atomic>

#include "subdivide/reach.h"

namespace whittle {
namespace {

/// Operands that are dealt out by one thread in one go.
constexpr size_t kChunk = 4096;

/// With more than this, on the average, for each operand, boxes do not tell them apart.
constexpr size_t kMostPartsEach = 12;

/// The tokens of one operand of the outermost group.
struct Tokens {
  uint32_t first, count;
};

OperandReach reach_of(const Scene& scene, std::span<const Token> operand) {
  return fold(
      operand, [](TokenKind kind) { return ReachOfGroup(kind); },
      [&](Token token) { return reach_of(scene, token); });
}

/// The outermost group of several operands, if there is one: not a group around one other.
Operand outermost_group(std::span<const Token> formula) {
  Operand top = whole(formula);
  while (top.tokens.size() > 1) {
    const Operand first = *operands_of(top).begin();
    if (!first.is_group() || first.end() != top.end()) break;
    top = first;
  }
  return top;
}

std::vector<Tokens> operands_in(Operand group) {
  std::vector<Tokens> operands;
  operands.reserve(group.tokens.size());
  for (const Operand operand : operands_of(group))
    operands.push_back({uint32_t(operand.index), uint32_t(operand.tokens.size())});
  return operands;
}

/// First and last part along an axis that an interval meets.
struct Range {
  uint32_t first, last;
};
Range range_of(const std::vector<double>& cuts, double lo, double hi) {
  // The cuts are all but equally far apart, so that the parts are next to where they would be then.
  const size_t last_part = cuts.size() - 2;
  const double each = double(last_part + 1) / (cuts.back() - cuts.front());
  const auto guess = [&](double x) {
    const double part = (x - cuts.front()) * each;
    return part > 0 ? size_t(std::min(part, double(last_part))) : 0;
  };
  size_t first = guess(lo), last = guess(hi);
  while (first > 0 && cuts[first] >= lo) --first;
  while (first < last_part && cuts[first + 1] < lo) ++first;
  while (last > 0 && cuts[last] > hi) --last;
  while (last < last_part && cuts[last + 1] <= hi) ++last;
  return {uint32_t(first), uint32_t(last)};
}

/// What some operands in a row give to the parts: numbers of operands, part by part.
struct Dealt {
  std::vector<uint32_t> first;  ///< of each part, and the end
  std::vector<uint32_t> operands;
};

}  // namespace

size_t SplitGrid::size() const {
  return (cuts[0].size() - 1) * (cuts[1].size() - 1) * (cuts[2].size() - 1);
}

Box SplitGrid::part(size_t number) const {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto& c = cuts[size_t(axis)];
    const size_t along = number % (c.size() - 1);
    number /= c.size() - 1;
    box.lo[axis] = c[along], box.hi[axis] = c[along + 1];
  }
  return box;
}

SplitGrid make_grid(const Box& box, int splits, SplitRule rule, uint32_t depth) {
  SplitGrid grid;
  for (int axis = 0; axis < 3; ++axis) grid.cuts[size_t(axis)] = {box.lo[axis], box.hi[axis]};
  for (int i = 0; i < splits; ++i) {
    const int axis = split_axis(grid.part(0).size(), rule, depth + uint32_t(i));
    grid.axes.push_back(axis);
    std::vector<double>& cuts = grid.cuts[size_t(axis)];
    std::vector<double> finer;
    for (size_t k = 0; k + 1 < cuts.size(); ++k) {
      finer.push_back(cuts[k]);
      finer.push_back((cuts[k] + cuts[k + 1]) * 0.5);
    }
    finer.push_back(cuts.back());
    cuts = std::move(finer);
  }
  return grid;
}

size_t operand_count(std::span<const Token> formula) {
  const Operand top = outermost_group(formula);
  return top.is_group() ? size_t(std::ranges::distance(operands_of(top))) : 0;
}

std::vector<Formula> deal_operands(const Scene& scene, std::span<const Token> formula,
                                   const SplitGrid& grid, double margin, const Loop& loop) {
  const Operand top = outermost_group(formula);
  const TokenKind kind = top.token().kind();
  const std::vector<Tokens> operands = operands_in(top);
  const size_t parts = grid.size(), chunks = (operands.size() + kChunk - 1) / kChunk;
  std::vector<Dealt> dealt(chunks);
  std::atomic<size_t> total = 0;
  const auto too_many = [&] { return total > kMostPartsEach * operands.size(); };

  loop(chunks, 1, [&](size_t first, size_t last, size_t) {
    std::vector<std::array<Range, 3>> ranges;
    for (size_t chunk = first; chunk < last && !too_many(); ++chunk) {
      const size_t begin = chunk * kChunk, end = std::min(begin + kChunk, operands.size());
      Dealt& mine = dealt[chunk];
      mine.first.assign(parts + 1, 0);
      ranges.clear();
      size_t given = 0;
      const auto for_parts_of = [&](const std::array<Range, 3>& r, auto&& visit) {
        const size_t nx = grid.cuts[0].size() - 1, ny = grid.cuts[1].size() - 1;
        for (size_t z = r[2].first; z <= r[2].last; ++z)
          for (size_t y = r[1].first; y <= r[1].last; ++y)
            for (size_t x = r[0].first; x <= r[0].last; ++x) visit((z * ny + y) * nx + x);
      };
      for (size_t i = begin; i < end; ++i) {
        OperandReach reach = reach_of(scene, formula.subspan(operands[i].first, operands[i].count));
        // What settles the whole group where it does not reach must be known everywhere.
        if (reach.outside == (kind == TokenKind::kOr)) reach.box = Box::everything();
        std::array<Range, 3> r;
        size_t count = 1;
        for (int axis = 0; axis < 3; ++axis) {
          r[size_t(axis)] = range_of(grid.cuts[size_t(axis)], reach.box.lo[axis] - margin,
                                     reach.box.hi[axis] + margin);
          // An empty box meets nothing.
          if (r[size_t(axis)].first > r[size_t(axis)].last) r[size_t(axis)] = {1, 0};
          count *= r[size_t(axis)].last + 1 - r[size_t(axis)].first;
        }
        given += count;
        ranges.push_back(r);
        if (given > kMostPartsEach * operands.size()) break;
        for_parts_of(r, [&](size_t part) { ++mine.first[part + 1]; });
      }
      total += given;
      if (too_many()) return;
      for (size_t part = 0; part < parts; ++part) mine.first[part + 1] += mine.first[part];
      mine.operands.resize(mine.first[parts]);
      std::vector<uint32_t> next(mine.first.begin(), mine.first.end() - 1);
      for (size_t i = begin; i < end; ++i)
        for_parts_of(ranges[i - begin],
                     [&](size_t part) { mine.operands[next[part]++] = uint32_t(i); });
    }
  });
  if (too_many()) return {};

  std::vector<Formula> result(parts);
  loop(parts, 1, [&](size_t first, size_t last, size_t) {
    for (size_t part = first; part < last; ++part) {
      Formula& out = result[part];
      size_t tokens = 1;
      for (const Dealt& chunk : dealt)
        for (uint32_t k = chunk.first[part]; k < chunk.first[part + 1]; ++k)
          tokens += operands[chunk.operands[k]].count;
      out.reserve(tokens);
      out.push_back(Token::make(kind, uint32_t(tokens)));
      for (const Dealt& chunk : dealt)
        for (uint32_t k = chunk.first[part]; k < chunk.first[part + 1]; ++k) {
          const Tokens& operand = operands[chunk.operands[k]];
          out.insert(out.end(), formula.begin() + operand.first,
                     formula.begin() + operand.first + operand.count);
        }
    }
  });
  return result;
}

}  // namespace whittle
