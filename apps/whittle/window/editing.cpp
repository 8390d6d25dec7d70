#include "editing.h"

#include <algorithm>
#include <utility>

#include "base/printable.h"
#include "edit/mistake.h"
#include "host/input_file.h"
#include "host/input_kinds.h"
#include "host/output_file.h"

namespace whittle {
namespace {

constexpr size_t kLongestLabel = 80;

char to_lower(char c) {
  return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}

bool contains_word(std::string_view text, std::string_view word) {
  const auto is_same = [](char a, char b) { return to_lower(a) == to_lower(b); };
  return std::search(text.begin(), text.end(), word.begin(), word.end(), is_same) != text.end();
}

/// The beginning of a statement, up to its children.
std::string_view head_of(const SourceDocument& document, const SyntaxNode& node) {
  const size_t end = node.form == SyntaxNode::Form::kBlock ? node.name + 1 : node.body;
  const std::string_view head =
      std::string_view(document.text()).substr(node.name, end - node.name);
  return head.substr(0, kLongestLabel);
}

}  // namespace

Status Editing::open(const std::string& file, const ReadLimits& limits) {
  if (is_open() && file_ == file) return Done{};
  close();
  if (file == "-" || kind_of_input(file) != InputKind::kCsg) {
    return mistake("only a .csg file can be edited");
  }
  Result<std::string> text = read_text(file, limits.bytes);
  if (!text) return text.error();
  Result<SourceDocument> document = SourceDocument::open(std::move(*text), file, limits);
  if (!document) return document.error();
  document_ = std::move(*document);
  file_ = file;
  file_text_ = document_->text();
  limits_ = limits;
  shown_version_ = document_->version();
  return Done{};
}

void Editing::close() {
  *this = Editing();
}

const std::vector<Editing::Row>& Editing::rows() {
  const std::string search = search_.data();
  if (rows_version_ == document_->version() && rows_search_ == search) return rows_;
  rows_version_ = document_->version();
  rows_search_ = search;
  rows_.clear();
  const std::vector<SyntaxNode>& nodes = document_->tree().nodes;
  std::vector<uint32_t> depths(nodes.size());
  for (uint32_t i = 1; i < nodes.size(); ++i) {
    depths[i] = nodes[i].parent == 0 ? 0 : depths[nodes[i].parent] + 1;
    if (search.empty() || contains_word(head_of(*document_, nodes[i]), search)) {
      rows_.push_back({i, depths[i]});
    }
  }
  return rows_;
}

std::string Editing::label(uint32_t node) const {
  std::string text(head_of(*document_, document_->node(node)));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t' || c == '\r'; }, ' ');
  return printable(text);
}

bool Editing::is_chosen(uint32_t node) const {
  return std::binary_search(chosen_.begin(), chosen_.end(), node);
}

void Editing::choose(uint32_t node, bool is_added) {
  if (!is_added) {
    chosen_.assign(1, node);
    return;
  }
  const auto at = std::lower_bound(chosen_.begin(), chosen_.end(), node);
  if (at != chosen_.end() && *at == node) {
    chosen_.erase(at);
  } else {
    chosen_.insert(at, node);
  }
}

void Editing::choose(SourceLocation where) {
  if (const std::optional<uint32_t> node = document_->find(where)) {
    choose(*node, false);
    wanted_node_ = node;
  }
}

std::optional<uint32_t> Editing::take_wanted_node() {
  return std::exchange(wanted_node_, std::nullopt);
}

void Editing::keep_chosen_in_range() {
  const size_t count = document_->tree().nodes.size();
  chosen_.erase(std::remove_if(chosen_.begin(), chosen_.end(),
                               [&](uint32_t node) { return node == 0 || node >= count; }),
                chosen_.end());
}

Status Editing::take(const Result<uint32_t>& edited) {
  if (!edited) return edited.error();
  chosen_.assign(1, *edited);
  keep_chosen_in_range();
  return Done{};
}

void Editing::undo() {
  if (const std::optional<uint32_t> node = document_->undo()) chosen_.assign(1, *node);
  keep_chosen_in_range();
}

void Editing::redo() {
  if (const std::optional<uint32_t> node = document_->redo()) chosen_.assign(1, *node);
  keep_chosen_in_range();
}

Status Editing::save() {
  if (Status written = write_file(file_, document_->text()); !written) return written.error();
  document_->mark_saved();
  file_text_ = document_->text();
  return Done{};
}

bool Editing::follow_file() {
  const Result<std::string> text = read_text(file_, limits_.bytes);
  if (!text || *text == document_->text() || *text == file_text_) return true;
  if (document_->is_modified()) {
    file_text_ = *text;
    return false;
  }
  const std::string file = file_;
  const ReadLimits limits = limits_;
  close();
  static_cast<void>(open(file, limits));
  return true;
}

}  // namespace whittle
