#include "edit/source_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/limit_hint.h"
#include "csg/check_text.h"
#include "edit/tree_update.h"

namespace whittle {
namespace {

/// How many bytes longer the text becomes.
ptrdiff_t growth(const std::vector<Splice>& splices) {
  ptrdiff_t bytes = 0;
  for (const Splice& s : splices) bytes += ptrdiff_t(s.text.size()) - ptrdiff_t(s.removed);
  return bytes;
}

}  // namespace

Result<SourceDocument> SourceDocument::open(std::string text, const std::string& file_name,
                                            const ReadLimits& limits) {
  SourceDocument document;
  document.text_ = std::move(text);
  document.file_name_ = file_name;
  document.limits_ = limits;
  const Result<std::string_view> checked = check_text(document.text_, file_name, limits);
  if (!checked) return checked.error();
  document.first_ = document.text_.size() - checked->size();
  Result<SyntaxTree> tree = read_syntax(document.text_, document.first_, file_name, limits);
  if (!tree) return tree.error();
  document.tree_ = std::move(*tree);
  return document;
}

/// Changes the text alone. The splices that take it back.
std::vector<Splice> SourceDocument::replace(const std::vector<Splice>& splices) {
  std::vector<Splice> inverse;
  inverse.reserve(splices.size());
  const size_t from = splices.front().offset, to = splices.back().end();
  // Between the first and the last all is written once, whatever the number of splices.
  std::string between;
  size_t copied = from;
  for (const Splice& s : splices) {
    WHITTLE_CHECK(copied <= s.offset && s.end() <= text_.size());
    between.append(text_, copied, s.offset - copied);
    inverse.push_back({from + between.size(), s.text.size(), text_.substr(s.offset, s.removed)});
    between += s.text;
    copied = s.end();
  }
  text_.replace(from, to - from, between);
  return inverse;
}

/// Makes the tree that of the text, after the splices.
Status SourceDocument::update(const std::vector<Splice>& splices) {
  const TextRange changed{splices.front().offset, splices.back().end()};
  if (!update_tree(tree_, changed, growth(splices), text_, limits_)) {
    Result<SyntaxTree> tree = read_syntax(text_, first_, file_name_, limits_);
    if (!tree) return tree.error();
    tree_ = std::move(*tree);
  }
  forget_tables();
  ++version_;
  return Done{};
}

Status SourceDocument::apply(const std::vector<Splice>& splices, Step step) {
  if (splices.empty()) return Done{};
  for (const Splice& s : splices) {
    WHITTLE_CHECK(s.offset >= first_);
    if (Status text = check_nul(s.text, file_name_); !text) return text.error();
  }
  if (ptrdiff_t(text_.size()) + growth(splices) > ptrdiff_t(limits_.bytes)) {
    return Error{ErrorKind::kInput,
                 fmt::format("{}: error: the text would be longer than the limit "
                             "of {} bytes{}",
                             file_name_, limits_.bytes, limit_hint("bytes"))};
  }
  std::vector<Splice> inverse = replace(splices);
  if (Status updated = update(splices); !updated) {
    replace(inverse);
    return updated.error();
  }
  history_.resize(done_);
  const uint64_t before = std::exchange(state_, ++last_state_);
  if (step == Step::kWithLast && done_ > 0 && joins_last(splices, inverse)) return Done{};
  history_.push_back({std::move(inverse), before, state_, done_ > 0 ? step : Step::kOwn});
  ++done_;
  return Done{};
}

/// Whether an edit has only replaced what the one before it has put there, as every move of a
/// slider does. Then the two become one in the history.
bool SourceDocument::joins_last(const std::vector<Splice>& splices,
                                const std::vector<Splice>& inverse) {
  Entry& last = history_.back();
  const auto is_same_place = [](const Splice& a, const Splice& b) {
    return a.offset == b.offset && a.removed == b.removed;
  };
  if (!std::equal(splices.begin(), splices.end(), last.splices.begin(), last.splices.end(),
                  is_same_place)) {
    return false;
  }
  for (size_t i = 0; i < inverse.size(); ++i) {
    last.splices[i].offset = inverse[i].offset;
    last.splices[i].removed = inverse[i].removed;
  }
  last.after = state_;
  return true;
}

/// Puts back what an entry holds, which then holds what was there. The node around it.
uint32_t SourceDocument::exchange(Entry& entry) {
  std::vector<Splice> inverse = replace(entry.splices);
  const Status updated = update(entry.splices);
  WHITTLE_CHECK(updated);  // The text was read before.
  entry.splices = std::move(inverse);
  return tree_.innermost(entry.splices.front().offset);
}

std::optional<uint32_t> SourceDocument::undo() {
  std::optional<uint32_t> around;
  for (bool is_first = false; done_ > 0 && !is_first;) {
    Entry& entry = history_[--done_];
    around = exchange(entry);
    state_ = entry.before;
    is_first = entry.step == Step::kOwn;
  }
  return around;
}

std::optional<uint32_t> SourceDocument::redo() {
  std::optional<uint32_t> around;
  while (done_ < history_.size() && (!around || history_[done_].step == Step::kWithLast)) {
    Entry& entry = history_[done_++];
    around = exchange(entry);
    state_ = entry.after;
  }
  return around;
}

void SourceDocument::forget_tables() {
  line_starts_.clear();
  id_nodes_.clear();
  has_ids_ = false;
}

void SourceDocument::make_line_table() const {
  if (!line_starts_.empty()) return;
  line_starts_.push_back(uint32_t(first_));
  const char *const begin = text_.data(), *const end = begin + text_.size();
  for (const char* at = begin + first_; at != end;) {
    const void* newline = std::memchr(at, '\n', size_t(end - at));
    if (newline == nullptr) break;
    at = static_cast<const char*>(newline) + 1;
    line_starts_.push_back(uint32_t(at - begin));
  }
}

SourceLocation SourceDocument::location(uint32_t index) const {
  make_line_table();
  const uint32_t at = node(index).name;
  const auto behind = std::upper_bound(line_starts_.begin(), line_starts_.end(), at);
  return {uint32_t(behind - line_starts_.begin()), at - behind[-1] + 1};
}

std::optional<uint32_t> SourceDocument::find(SourceLocation where) const {
  make_line_table();
  if (where.line == 0 || where.line > line_starts_.size() || where.column == 0) return std::nullopt;
  const size_t offset = size_t{line_starts_[where.line - 1]} + where.column - 1;
  const uint32_t found = tree_.last_beginning_by(offset);
  if (found == 0 || node(found).name != offset) return std::nullopt;
  return found;
}

void SourceDocument::make_id_table() const {
  if (has_ids_) return;
  for (uint32_t i = 1; i < tree_.nodes.size(); ++i) {
    const SyntaxNode& n = tree_.nodes[i];
    if (n.form == SyntaxNode::Form::kStatement && has_id(n.meaning)) id_nodes_.push_back(i);
  }
  has_ids_ = true;
}

uint32_t SourceDocument::id(uint32_t index) const {
  make_id_table();
  const auto found = std::lower_bound(id_nodes_.begin(), id_nodes_.end(), index);
  const bool is_there = found != id_nodes_.end() && *found == index;
  return is_there ? uint32_t(found - id_nodes_.begin()) + 1 : 0;
}

std::optional<uint32_t> SourceDocument::find_id(uint32_t id) const {
  make_id_table();
  if (id == 0 || id > id_nodes_.size()) return std::nullopt;
  return id_nodes_[id - 1];
}

}  // namespace whittle
