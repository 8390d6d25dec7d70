#include "host/piped_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <future>
#include <optional>
#include <system_error>
#include <utility>

#include "host/child_process.h"
#include "host/input_file.h"
#include "host/private_folder.h"

namespace whittle {

std::optional<std::string> find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    return ::access(name.c_str(), X_OK) == 0 ? std::optional(name) : std::nullopt;
  }
  const char* const variable = std::getenv("PATH");
  std::string_view rest = variable ? variable : "";
  while (!rest.empty()) {
    const size_t colon = std::min(rest.find(':'), rest.size());
    const std::string_view folder = rest.substr(0, colon);
    rest.remove_prefix(std::min(colon + 1, rest.size()));
    // An empty entry means the current folder, where a program of that name is rather a trap.
    if (folder.empty()) continue;
    std::string candidate = fmt::format("{}/{}", folder, name);
    if (::access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return std::nullopt;
}

struct PipedProgram::State {
  State(std::string name_, PrivateFolder folder_)
      : name(std::move(name_)), folder(std::move(folder_)) {}
  ~State() {
    close();
    if (ended.valid()) ended.wait();
  }

  void close() {
    if (input >= 0) ::close(std::exchange(input, -1));
  }

  /// The last line of what it said.
  std::string last_words() const {
    const Result<std::string> text = read_text(folder.messages());
    if (!text) return "";
    const size_t last = text->find_last_not_of("\r\n");
    if (last == std::string::npos) return "";
    const size_t before = text->find_last_of("\r\n", last);
    return ": " + text->substr(before == std::string::npos ? 0 : before + 1,
                               before == std::string::npos ? last + 1 : last - before);
  }

  /// Why it ended, when it has; none if all is well.
  Status outcome() {
    close();
    const auto [status, error] = ended.get();
    if (!status) {
      return Error{ErrorKind::kMachine, fmt::format("{} cannot be run: {}", name,
                                                    std::generic_category().message(error))};
    }
    if (*status == 0) return Done{};
    return Error{ErrorKind::kMachine, fmt::format("{} failed{}", name, last_words())};
  }

  std::string name;
  PrivateFolder folder;
  int input = -1;  ///< the end of the pipe that is written to; -1: closed
  struct Ended {
    std::optional<int> status;
    int error = 0;
  };
  std::future<Ended> ended;
};

PipedProgram::PipedProgram(std::unique_ptr<State> state) : state_(std::move(state)) {}
PipedProgram::PipedProgram(PipedProgram&&) noexcept = default;
PipedProgram::~PipedProgram() = default;

Result<PipedProgram> PipedProgram::start(const std::string& program,
                                         const std::vector<std::string>& words) {
  const auto failed = [&](int error) {
    return Error{ErrorKind::kMachine, fmt::format("{} cannot be run: {}", words[0],
                                                  std::generic_category().message(error))};
  };
  std::optional<PrivateFolder> folder = PrivateFolder::create();
  if (!folder) return failed(errno);
  auto state = std::make_unique<State>(words[0], *std::move(folder));
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return failed(errno);
  state->input = ends[1];
  const auto run = [program, words, messages = state->folder.messages(), output = ends[0]] {
    std::vector<const char*> arguments;
    for (const std::string& word : words) arguments.push_back(word.c_str());
    arguments.push_back(nullptr);
    State::Ended ended;
    ended.status = run_program(program, arguments.data(),
                               {.messages = messages, .input_descriptor = output}, ended.error);
    // Nobody reads any more: who still writes is told.
    ::close(output);
    return ended;
  };
  try {
    state->ended = std::async(std::launch::async, run);
  } catch (const std::system_error& e) {
    ::close(ends[0]);
    return failed(e.code().value());
  }
  return PipedProgram(std::move(state));
}

Status PipedProgram::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(state_->input, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int reason = errno;
      if (Status ended = state_->outcome(); !ended) return ended;
      return Error{ErrorKind::kMachine, fmt::format("{} does not read on: {}", state_->name,
                                                    std::generic_category().message(reason))};
    }
    bytes.remove_prefix(size_t(written));
  }
  return Done{};
}

Status PipedProgram::end() {
  return state_->outcome();
}

}  // namespace whittle
