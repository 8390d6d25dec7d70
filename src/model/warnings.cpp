#include "model/warnings.h"

#include <fmt/format.h>

#include <utility>

namespace whittle {
namespace {

// A file can invent any number of names; kinds beyond these are counted as one.
constexpr size_t kMostKinds = 100;
constexpr std::string_view kOverflow = "other warnings";

}  // namespace

Warnings::Counts::value_type& Warnings::count_of(std::string_view kind) {
  auto found = counts_.find(kind);
  if (found == counts_.end()) {
    if (counts_.size() >= kMostKinds) kind = kOverflow;
    found = counts_.try_emplace(std::string(kind), 0).first;
  }
  return *found;
}

void Warnings::add(std::string_view kind, SourceLocation where, std::string_view message) {
  auto& [name, number] = count_of(kind);
  if (++number <= kShown) shown_.push_back({&name, where, std::string(message)});
}

void Warnings::add_full(std::string_view kind, std::string message) {
  auto& [name, number] = count_of(kind);
  if (++number <= kShown) shown_.push_back({&name, {}, std::move(message)});
}

bool Warnings::has_all_kinds() const {
  return counts_.size() <= kMostKinds;
}

void Warnings::clear() {
  shown_.clear();
  counts_.clear();
  unsupported_.reset();
  missing_file_.clear();
}

void Warnings::append(const Warnings& piece, SourceLocation start) {
  for (const Shown& shown : piece.shown_) {
    add(*shown.kind, place_in_whole(shown.where, start), shown.message);
  }
  for (const auto& [kind, number] : piece.counts_) {
    if (number > kShown) count_of(kind).second += number - kShown;
  }
  if (piece.unsupported_) {
    const SourceLocation where = place_in_whole(piece.unsupported_->where, start);
    if (!unsupported_ || where < unsupported_->where) {
      unsupported_ = Unsupported{where, piece.unsupported_->message};
    }
  }
}

void Warnings::add_unsupported(std::string_view kind, SourceLocation where,
                               std::string_view message, std::string what) {
  add(kind, where, message);
  if (!unsupported_ || where < unsupported_->where) {
    unsupported_ = Unsupported{where, std::move(what)};
  }
}

void Warnings::add_missing_file(SourceLocation where, std::string_view name) {
  add("there is no file of this name; nothing is shown for it", where,
      fmt::format("there is no file {}; nothing is shown for it", name));
  if (missing_file_.empty())
    missing_file_ = message_at(file_, where, fmt::format("error: there is no file {}", name));
}

std::vector<std::string> Warnings::take() {
  std::vector<std::string> messages;
  for (Shown& shown : shown_) {
    messages.push_back(shown.where == SourceLocation{}
                           ? std::move(shown.message)
                           : message_at(file_, shown.where, "warning: " + shown.message));
  }
  shown_.clear();
  for (const auto& [kind, number] : counts_) {
    if (number > kShown) {
      messages.push_back(
          fmt::format("{}: warning: {} more times: {}", file_, number - kShown, kind));
    }
  }
  counts_.clear();
  return messages;
}

}  // namespace whittle
