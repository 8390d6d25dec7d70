// The text that is edited in the window: which of its statements are chosen, what the panel shows
// of them, and whether the picture is behind.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edit/source_document.h"
#include "whittle/options.h"

namespace whittle {

class Editing {
 public:
  /// Opens the text of a .csg file, unless it is open. Errors: it is no such file, or is not
  /// understood.
  Status open(const std::string& file, const ReadLimits& limits);
  void close();

  bool is_open() const { return document_.has_value(); }
  /// Precondition of all below: it is open.
  SourceDocument& document() { return *document_; }
  const std::string& file() const { return file_; }

  /// A line of the panel.
  struct Row {
    uint32_t node = 0;
    uint32_t depth = 0;
  };
  /// The statements in whose first bytes the words stand that are searched for, in any case of
  /// letters; all of them for no words. Made anew only when something has changed.
  const std::vector<Row>& rows();
  /// A statement in a few words, on one line.
  std::string label(uint32_t node) const;

  /// The words that are searched for, as they are typed.
  std::array<char, 64>& search() { return search_; }

  /// Those that are chosen, in order.
  const std::vector<uint32_t>& chosen() const { return chosen_; }
  bool is_chosen(uint32_t node) const;
  /// Chooses one alone, or one more, or one less.
  void choose(uint32_t node, bool is_added);
  /// Chooses where somebody pointed.
  void choose(SourceLocation where);
  /// The row to be brought into view, once.
  std::optional<uint32_t> take_wanted_node();

  /// What an edit has given: the statement is chosen, or the error is returned.
  Status take(const Result<uint32_t>& edited);
  void undo();
  void redo();
  Status save();
  /// The file may have been written by somebody else: it is read again, if nothing is edited that
  /// would be lost. False if there is.
  bool follow_file();

  /// Whether the text is another than the one that was last asked for.
  bool is_behind() const { return is_open() && document_->version() != shown_version_; }
  void mark_shown() { shown_version_ = document_->version(); }

 private:
  void keep_chosen_in_range();

  std::optional<SourceDocument> document_;
  std::string file_;
  std::string file_text_;  ///< what it held when it was last read or written here
  ReadLimits limits_;
  uint64_t shown_version_ = 0;
  std::array<char, 64> search_{};
  std::vector<uint32_t> chosen_;
  std::optional<uint32_t> wanted_node_;
  std::vector<Row> rows_;
  std::string rows_search_;
  std::optional<uint64_t> rows_version_;
};

}  // namespace whittle
