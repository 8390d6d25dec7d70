// A .csg text that is edited: the text, the tree of its statements, and all that was done to it.
//
// Whoever edits says which bytes are replaced by what; all others stay as they are, comments and
// layout included. After every edit the tree is right again: only the statements around the edit
// are read once more (tree_update.h). What was there before an edit is kept, so that it can be
// undone; memory grows with the edits, not with the text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "csg/syntax_tree.h"
#include "model/model.h"
#include "whittle/options.h"

namespace whittle {

/// So many bytes from an offset on give way to a text.
struct Splice {
  size_t offset = 0, removed = 0;
  std::string text;

  size_t end() const { return offset + removed; }
};

class SourceDocument {
 public:
  /// Errors are those of reading the text as a document (read_syntax).
  static Result<SourceDocument> open(std::string text, const std::string& file_name,
                                     const ReadLimits& limits = {});

  /// What is to be saved.
  const std::string& text() const { return text_; }
  const SyntaxTree& tree() const { return tree_; }
  const SyntaxNode& node(uint32_t index) const { return tree_.nodes[index]; }
  const ReadLimits& limits() const { return limits_; }

  /// Another number after every change.
  uint64_t version() const { return version_; }

  /// Whether an edit is undone with the one before it.
  enum class Step : uint8_t { kOwn, kWithLast };

  /// Replaces bytes. The splices must be in the text, one behind the other, and none may overlap.
  /// If the new text is not understood, nothing changes, and the error says why (kInput).
  Status apply(const std::vector<Splice>& splices, Step step = Step::kOwn);

  bool can_undo() const { return done_ > 0; }
  bool can_redo() const { return done_ < history_.size(); }
  /// Takes back the last step, or does it again. The innermost node around what has changed; none
  /// if there is nothing to be taken back.
  std::optional<uint32_t> undo();
  std::optional<uint32_t> redo();

  /// Whether the text differs from the one that was opened or last saved, as far as the history
  /// knows.
  bool is_modified() const { return state_ != saved_state_; }
  void mark_saved() { saved_state_ = state_; }

  /// Where the reader says that a statement stands: its name. Precondition: not the file.
  SourceLocation location(uint32_t index) const;
  /// The statement that stands there; none if none does.
  std::optional<uint32_t> find(SourceLocation where) const;

  /// The id of a statement's shape; 0 if it is none.
  uint32_t id(uint32_t index) const;
  /// The statement of that id; none if there is none.
  std::optional<uint32_t> find_id(uint32_t id) const;

 private:
  struct Entry {
    std::vector<Splice> splices;  ///< that take it back; of what is undone, that do it again
    uint64_t before = 0, after = 0;
    Step step = Step::kOwn;
  };

  SourceDocument() = default;
  std::vector<Splice> replace(const std::vector<Splice>& splices);
  Status update(const std::vector<Splice>& splices);
  bool joins_last(const std::vector<Splice>& splices, const std::vector<Splice>& inverse);
  uint32_t exchange(Entry& entry);
  void forget_tables();
  void make_line_table() const;
  void make_id_table() const;

  std::string text_;
  std::string file_name_;
  size_t first_ = 0;  ///< behind the byte-order mark
  ReadLimits limits_;
  SyntaxTree tree_;
  uint64_t version_ = 0;
  uint64_t state_ = 0, saved_state_ = 0, last_state_ = 0;
  std::vector<Entry> history_;
  size_t done_ = 0;  ///< entries that are not undone

  // Made when they are asked for.
  mutable std::vector<uint32_t> line_starts_;
  mutable std::vector<uint32_t> id_nodes_;  ///< [id - 1]
  mutable bool has_ids_ = false;
};

}  // namespace whittle
