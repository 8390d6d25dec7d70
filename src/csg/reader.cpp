// A text is read in pieces, each on its own and by whichever thread has time, and the pieces are
// appended one after the other. A piece does not know what it stands in, nor whether it begins
// where a statement does. If what comes before it shows that it took either for something else, it
// is read once more, after that; so what is read never depends on how the text was cut.
#include "csg/reader.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "base/workers.h"
#include "csg/check_text.h"
#include "csg/statement_reader.h"
#include "csg/text_pieces.h"

namespace whittle {
namespace {

/// A piece of the text while it is read.
struct Piece {
  Piece(const std::string& file, const ReadOptions& options)
      : warnings(file), reader(file, options, warnings) {}

  UninitializedVector<char> buffer;
  TextPiece text;
  Warnings warnings;
  StatementReader reader;
};

/// Reads all of a text but its end.
class PieceReader {
 public:
  PieceReader(TextSource& source, const std::string& file, const ReadOptions& options,
              size_t workers, StatementReader& whole)
      : source_(source),
        size_(source.place().size()),
        file_(file),
        options_(options),
        read_((size_ + options.piece_bytes - 1) / options.piece_bytes),
        // So many may wait for one that takes longer.
        ahead_(2 * workers + 2),
        whole_(whole) {}

  /// What each of the workers does.
  void work() {
    try {
      read_pieces();
    } catch (...) {
      // Nobody is to wait for what does not come.
      const std::lock_guard lock(mutex_);
      stop_ = Stop::kThrown;
      moved_on_.notify_all();
      throw;
    }
  }

  /// Once all have done: why not all is read.
  enum class Stop { kNone, kMistake, kNotReadable, kNul, kThrown };
  Stop stop() const { return stop_; }

 private:
  bool is_over() const { return stop_ != Stop::kNone || next_ == read_.size(); }

  void read_pieces() {
    std::unique_lock lock(mutex_);
    for (;;) {
      // Who reads the piece that is waited for is at work, not waiting.
      moved_on_.wait(lock, [&] { return is_over() || next_ < appended_ + ahead_; });
      if (is_over()) return;
      const size_t number = next_++;
      std::unique_ptr<Piece> piece = take_piece();
      lock.unlock();
      piece->text = read_piece(source_, number, options_.piece_bytes, piece->buffer);
      const std::string_view text = piece->text.text;
      const bool has_nul = text.find(char{0}) != std::string_view::npos;
      if (!has_nul) piece->reader.read_piece(text, piece->text.is_last);
      lock.lock();
      if (has_nul) stop_ = Stop::kNul;
      if (!piece->text.is_whole) stop_ = Stop::kNotReadable;
      read_[number] = std::move(piece);
      append_what_is_there();
    }
  }

  std::unique_ptr<Piece> take_piece() {
    if (free_.empty()) return std::make_unique<Piece>(file_, options_);
    std::unique_ptr<Piece> piece = std::move(free_.back());
    free_.pop_back();
    return piece;
  }

  void append_what_is_there() {
    for (; !is_stopped() && appended_ < read_.size() && read_[appended_]; ++appended_) {
      append(*read_[appended_]);
      free_.push_back(std::move(read_[appended_]));
    }
    moved_on_.notify_all();
  }
  bool is_stopped() const { return stop_ != Stop::kNone; }

  void append(Piece& piece) {
    if (piece.text.text.empty()) return;
    if (whole_.offset() == piece.text.first) whole_.append(piece.reader);
    const size_t last = piece.text.last();
    if (whole_.is_before(last)) {
      if (!source_.load()) {
        stop_ = Stop::kNotReadable;
      } else if (!whole_.read_until(last)) {
        stop_ = Stop::kMistake;
      }
    }
    whole_.make_room(static_cast<double>(last) / static_cast<double>(size_));
  }

  TextSource& source_;
  const size_t size_;
  const std::string& file_;
  const ReadOptions& options_;

  std::mutex mutex_;  ///< of all below
  std::condition_variable moved_on_;
  size_t next_ = 0, appended_ = 0;
  std::vector<std::unique_ptr<Piece>> read_;  ///< and not yet appended
  std::vector<std::unique_ptr<Piece>> free_;
  const size_t ahead_;
  StatementReader& whole_;
  Stop stop_ = Stop::kNone;
};

PieceReader::Stop read_in_pieces(TextSource& source, const std::string& file,
                                 const ReadOptions& options, StatementReader& whole) {
  if (options.threads == 1) {
    PieceReader pieces(source, file, options, 1, whole);
    pieces.work();
    return pieces.stop();
  }
  const Workers workers(options.threads);
  PieceReader pieces(source, file, options, workers.count(), whole);
  workers.for_parts(workers.count(), 1, [&](size_t, size_t, size_t) { pieces.work(); });
  return pieces.stop();
}

}  // namespace

Result<Document> read_document(TextSource& source, const std::string& file_name,
                               const ReadOptions& options, Warnings& warnings) {
  StatementReader whole(file_name, options, warnings);
  whole.begin(source.place());
  using Stop = PieceReader::Stop;
  Stop stop = Stop::kNone;
  // Other threads are not worth their start for less.
  if (source.place().size() / 4 > options.piece_bytes) {
    stop = read_in_pieces(source, file_name, options, whole);
  } else {
    if (Status loaded = source.load(); !loaded) return loaded.error();
    if (Status text = check_nul(source.place(), file_name); !text) return text.error();
  }
  if (stop == Stop::kNone && whole.read_rest()) return whole.finish();
  // That it is no text at all comes before any mistake in it.
  if (Status loaded = source.load(); !loaded) return loaded.error();
  if (Status text = check_nul(source.place(), file_name); !text) return text.error();
  if (stop == Stop::kNul || stop == Stop::kNotReadable) {
    // It has changed meanwhile; so what is there now counts.
    warnings.clear();
    return read_document(source.place(), file_name, options, warnings);
  }
  return Error{ErrorKind::kInput,
               message_at(file_name, whole.mistake().where, "error: " + whole.mistake().message)};
}

Result<Document> read_document(std::string_view text, const std::string& file_name,
                               const ReadOptions& options, Warnings& warnings) {
  TextInMemory source(text);
  return read_document(source, file_name, options, warnings);
}

}  // namespace whittle
