// A text is read in pieces, each on its own and by whichever thread has time, and the pieces are
// appended one after the other. A piece does not know what it stands in, nor whether it begins
// where a statement does. If what comes before it shows that it took either for something else, it
// is read once more, after that; so what is read never depends on how the text was cut.
#include "csg/reader.h"

#include <condition_variable>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "base/workers.h"
#include "csg/statement_reader.h"

namespace whittle {
namespace {

/// Where pieces of about so many bytes may end: behind a character that statements begin or end
/// with, unless it stands in a string or a comment. The last is the end of the text.
std::vector<size_t> find_cuts(std::string_view text, size_t piece_bytes) {
  std::vector<size_t> cuts;
  for (size_t at = piece_bytes; at < text.size(); at += piece_bytes) {
    const size_t mark = text.find_first_of(";{}", at);
    if (mark == std::string_view::npos) break;
    at = mark + 1;
    cuts.push_back(at);
  }
  if (cuts.empty() || cuts.back() < text.size()) cuts.push_back(text.size());
  return cuts;
}

/// A piece of the text while it is read.
struct Piece {
  Piece(const std::string& file, const ReadOptions& options)
      : warnings(file), reader(file, options, warnings) {}
  Warnings warnings;
  StatementReader reader;
};

class PieceReader {
 public:
  PieceReader(std::string_view text, const std::string& file, const ReadOptions& options,
              const Workers& workers, size_t piece_bytes, StatementReader& whole)
      : text_(text),
        file_(file),
        options_(options),
        cuts_(find_cuts(text, piece_bytes)),
        read_(cuts_.size()),
        // So many may wait for one that takes longer.
        ahead_(2 * workers.count() + 2),
        whole_(whole) {}

  /// What each of the workers does.
  void work() {
    try {
      read_pieces();
    } catch (...) {
      // Nobody is to wait for what does not come.
      const std::lock_guard lock(mutex_);
      failed_ = true;
      moved_on_.notify_all();
      throw;
    }
  }

  /// Once all have done. False: a mistake.
  bool is_read() const { return !failed_; }

 private:
  void read_pieces() {
    std::unique_lock lock(mutex_);
    for (;;) {
      // Who reads the piece that is waited for is at work, not waiting.
      moved_on_.wait(lock, [&] { return is_over() || next_ < appended_ + ahead_; });
      if (is_over()) return;
      const size_t k = next_++;
      std::unique_ptr<Piece> piece = take_piece();
      lock.unlock();
      const size_t first = k == 0 ? 0 : cuts_[k - 1];
      piece->reader.read_piece(text_.substr(first, cuts_[k] - first));
      lock.lock();
      read_[k] = std::move(piece);
      append_what_is_there();
    }
  }

  bool is_over() const { return failed_ || next_ == cuts_.size(); }

  std::unique_ptr<Piece> take_piece() {
    if (free_.empty()) return std::make_unique<Piece>(file_, options_);
    std::unique_ptr<Piece> piece = std::move(free_.back());
    free_.pop_back();
    return piece;
  }

  void append_what_is_there() {
    for (; !failed_ && appended_ < cuts_.size() && read_[appended_]; ++appended_) {
      const size_t first = appended_ == 0 ? 0 : cuts_[appended_ - 1], last = cuts_[appended_];
      if (whole_.offset() == first) whole_.append(read_[appended_]->reader);
      failed_ = !whole_.read_until(last);
      whole_.make_room(static_cast<double>(last) / static_cast<double>(text_.size()));
      free_.push_back(std::move(read_[appended_]));
    }
    moved_on_.notify_all();
  }

  const std::string_view text_;
  const std::string& file_;
  const ReadOptions& options_;
  const std::vector<size_t> cuts_;

  std::mutex mutex_;  ///< of all below
  std::condition_variable moved_on_;
  size_t next_ = 0, appended_ = 0;
  std::vector<std::unique_ptr<Piece>> read_;  ///< and not yet appended
  std::vector<std::unique_ptr<Piece>> free_;
  const size_t ahead_;
  StatementReader& whole_;
  bool failed_ = false;
};

bool read_in_pieces(std::string_view text, const std::string& file, const ReadOptions& options,
                    size_t piece_bytes, StatementReader& whole) {
  const Workers workers(options.threads);
  PieceReader pieces(text, file, options, workers, piece_bytes, whole);
  workers.for_parts(workers.count(), 1, [&](size_t, size_t, size_t) { pieces.work(); });
  return pieces.is_read();
}

}  // namespace

Result<Document> read_document(std::string_view text, const std::string& file_name,
                               const ReadOptions& options, Warnings& warnings, size_t piece_bytes) {
  StatementReader whole(file_name, options, warnings);
  whole.begin(text);
  // Other threads are not worth their start for less.
  const bool in_pieces = options.threads != 1 && text.size() > 4 * piece_bytes;
  if ((in_pieces && !read_in_pieces(text, file_name, options, piece_bytes, whole)) ||
      !whole.read_rest()) {
    return Error{ErrorKind::kInput,
                 message_at(file_name, whole.mistake().where, "error: " + whole.mistake().message)};
  }
  return whole.finish();
}

}  // namespace whittle
