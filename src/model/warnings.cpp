#include "model/warnings.h"

#include <fmt/format.h>

#include <utility>

namespace whittle {
namespace {

// A file can invent any number of names; kinds beyond these are counted as one.
constexpr size_t kMostKinds = 100;
constexpr std::string_view kOverflow = "other warnings";

}  // namespace

bool Warnings::count(std::string_view kind) {
  auto found = counts_.find(kind);
  if (found == counts_.end()) {
    if (counts_.size() >= kMostKinds) kind = kOverflow;
    found = counts_.try_emplace(std::string(kind), 0).first;
  }
  return ++found->second <= kShown;
}

void Warnings::add(std::string_view kind, SourceLocation where, std::string_view message) {
  if (count(kind)) {
    messages_.push_back(message_at(file_, where, fmt::format("warning: {}", message)));
  }
}

void Warnings::add_full(std::string_view kind, std::string message) {
  if (count(kind)) messages_.push_back(std::move(message));
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
  for (const auto& [kind, number] : counts_) {
    if (number > kShown) {
      messages_.push_back(
          fmt::format("{}: warning: {} more times: {}", file_, number - kShown, kind));
    }
  }
  counts_.clear();
  return std::exchange(messages_, {});
}

}  // namespace whittle
