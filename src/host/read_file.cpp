// Files by name: what kind they are decides how they are read.
#include "host/read_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "host/file_text.h"
#include "host/input_file.h"
#include "host/input_kinds.h"
#include "host/named_files.h"
#include "host/openscad_messages.h"
#include "host/quoted_places.h"
#include "host/scad.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

/// All messages, put in other words.
template <class Rewrite>
Result<Read> rewrite(Result<Read> read, Rewrite&& in_other_words) {
  if (!read) return Error{read.error().kind, in_other_words(read.error().message)};
  for (std::string& warning : read->warnings) warning = in_other_words(warning);
  for (std::string* message : {&read->refusal, &read->missing_file})
    if (!message->empty()) *message = in_other_words(*message);
  return read;
}

/// Reads the text of a file (a string_view or a TextSource), which may name others; `path` is what
/// messages call it.
template <class Text>
Result<Read> read_text_of(const std::string& path, Text&& text, const FileOptions& options) {
  const std::string folder = fs::path(path).parent_path().string();
  std::vector<std::string> files;
  ReadOptions reading = options.reading;
  reading.named_files = [&, read = named_files(folder, options.import_root, reading.limits.bytes)](
                            const std::string& name) {
    std::string file = (fs::path(folder) / name).string();
    if (std::ranges::find(files, file) == files.end()) files.push_back(std::move(file));
    return read(name);
  };
  Result<Read> read = read_csg(text, path == "-" ? "<stdin>" : path, reading);
  if (read) read->files = std::move(files);
  return read;
}

Result<Read> read_scad(const std::string& path, const FileOptions& options) {
  Result<Flattened> flattened = flatten_scad(path, options.flatten);
  if (!flattened) return flattened.error();
  Result<Read> read =
      rewrite(read_text_of(path, flattened->csg, options), QuotedPlaces(flattened->csg, path));
  if (!read) return read;
  read->model.view = flattened->view;
  read->files = std::move(flattened->files);
  // What openscad complains about comes before what whittle does.
  std::vector<std::string> warnings;
  for (const std::string& line : lines_of(flattened->messages)) {
    warnings.push_back(fmt::format("{}: openscad: {}", path, line));
  }
  read->warnings.insert(read->warnings.begin(), warnings.begin(), warnings.end());
  return read;
}

/// As many as tell what a file is.
std::string first_bytes(const std::string& path) {
  std::string bytes(16, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), std::streamsize(bytes.size()));
  bytes.resize(size_t(file.gcount()));
  return bytes;
}

Result<Read> read_shape(const std::string& path, const FileOptions& options) {
  // That it is not there is an error here, while what import() misses is a warning.
  if (::access(path.c_str(), R_OK) != 0) {
    return Error{ErrorKind::kInput, fmt::format("{}: error: cannot be read: {}", path,
                                                std::generic_category().message(errno))};
  }
  if (const std::optional<std::string> compressed = describe_compressed(first_bytes(path)))
    return Error{ErrorKind::kInput, fmt::format("{}: error: {}", path, *compressed)};
  const std::string name = fs::path(path).filename().string();
  Result<Read> read = read_text_of(path, fmt::format("import({});", quoted_string(name)), options);
  // The place is in a text that is not there, and so is the name of the file once more.
  return rewrite(std::move(read), [&](const std::string& message) {
    std::string rest = without_place(message, path);
    const std::string twice = fmt::format(": {}: ", name);
    if (const size_t at = rest.find(twice, path.size()); at != std::string::npos) {
      rest.replace(at, twice.size(), ": ");
    }
    return rest;
  });
}

/// A file that is too large to be in memory before it is read; null if it is not, or what
/// check_text() or describe_foreign() may have something to say of.
std::unique_ptr<FileText> large_text(const std::string& path, size_t most_bytes) {
  constexpr size_t kLarge = size_t{1} << 20, kHead = 1 << 12;
  std::unique_ptr<FileText> text = path == "-" ? nullptr : FileText::open(path, most_bytes);
  if (!text || text->place().size() < kLarge) return nullptr;
  UninitializedVector<char> buffer;
  const std::string_view head = text->read(0, kHead, buffer);
  const bool is_plain = std::ranges::all_of(
      head.substr(0, 4), [](char c) { return (c >= ' ' && c < 0x7f) || c == '\n' || c == '\t'; });
  return is_plain && !describe_foreign(head) ? std::move(text) : nullptr;
}

Result<Read> read_plain(const std::string& path, const FileOptions& options) {
  const std::string name = path == "-" ? "<stdin>" : path;
  const size_t most_bytes = std::min(options.reading.limits.bytes, kMostTextBytes);
  const auto with_file = [&](Result<Read> read) {
    if (read && path != "-") read->files.insert(read->files.begin(), path);
    return read;
  };
  if (const std::unique_ptr<FileText> large = large_text(path, most_bytes)) {
    return with_file(read_text_of(path, *large, options));
  }
  std::optional<std::string>* const kept = path == "-" ? options.standard_input : nullptr;
  const Result<std::string> text =
      kept && *kept ? Result<std::string>(**kept) : read_text(path, most_bytes);
  if (!text) return text.error();
  if (kept && !*kept) *kept = *text;
  if (const std::optional<std::string> foreign = describe_foreign(*text)) {
    return Error{ErrorKind::kInput, fmt::format("{}: error: {}", name, *foreign)};
  }
  return with_file(read_text_of(path, *text, options));
}

}  // namespace

Result<Read> read_file(const std::string& path, const FileOptions& options) {
  switch (kind_of_input(path)) {
    case InputKind::kScad:
      return read_scad(path, options);
    case InputKind::kShape:
      return read_shape(path, options);
    case InputKind::kCsg:
      break;
  }
  return read_plain(path, options);
}

Result<Read> read_edited_text(const std::string& path, const std::string& text,
                              const FileOptions& options) {
  Result<Read> read = read_text_of(path, std::string_view(text), options);
  if (read) read->files.insert(read->files.begin(), path);
  return read;
}

}  // namespace whittle
